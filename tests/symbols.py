#!/usr/bin/env python3
"""Checks that objects compiled for a larger machine share no function with the rest of the program: of a function that
several objects define the linker keeps one, and it must not be one that a smaller machine cannot run.

    tests/symbols.py NM NAMESPACE OBJECT...     one line for each symbol that the linker may merge and that does not
      name NAMESPACE; exit status 1 where there is any
"""

import subprocess
import sys

MERGED = "VWuvw"  # nm's letters for weak and unique symbols


def strangers(lines, namespace):
    """Returns symbols of nm's `lines` that the linker may merge and that do not name `namespace`."""
    fields = (line.split(maxsplit=2) for line in lines)
    return [name for _, kind, name in (f for f in fields if len(f) == 3) if kind in MERGED and namespace not in name]


def main(nm, namespace, *objects):
    planted = ["0000 W f<lanes_x::Lanes>()", "0000 W std::sqrt<double>(double)", "0000 T main"]
    if strangers(planted, "lanes_x") != ["std::sqrt<double>(double)"]:
        sys.exit("symbols: does not find what is planted")
    found = []
    for path in objects:
        lines = subprocess.run([nm, "-C", "--defined-only", path], check=True, capture_output=True,
                               text=True).stdout.splitlines()
        if not any(namespace in line for line in lines):
            sys.exit(f"symbols: nothing of {namespace} in {path}")
        found += [f"{path}: {name}" for name in strangers(lines, namespace)]
    print("\n".join(found))
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
