#!/usr/bin/env python3
"""Checks that no line has more than 120 columns, so that a file fits beside another window. C, C++ and CUDA are laid
out by .clang-format (version 14; comments by hand), all else by hand. In documents rows of tables and what programs
print may be longer; data may be as they are. Usage:

    tests/columns.py ROOT         the self-test, then ROOT; one line for each finding, exit status 1 where there is any
    tests/columns.py --self-test  only the self-test
"""

import re
import subprocess
import sys
import tempfile
from pathlib import Path

MOST_COLUMNS = 120
SOURCE_SUFFIXES = {".c", ".hpp", ".h", ".cpp", ".cu", ".cuh"}
# Besides them; "" are scripts that are called by a name without a suffix, and such.
OTHER_SUFFIXES = {".py", ".sh", ".cmake", ".yaml", ".md", ".in", ".toml", ""}
OTHER_NAMES = {"CMakeLists.txt"}
# Blocks of a document (their language), rows of its tables, and lines that are indented by four spaces.
PART = re.compile(r"^ *```(?P<language>\w*)\n.*?^ *```$|^ *\|[^\n]*$|^ {4}[^\n]*$", re.M | re.S)


def too_long(path):
    """Numbers and lengths of the lines of a text file that are too long."""
    text = path.read_text(encoding="utf-8")
    if path.suffix == ".md":
        text = PART.sub(lambda part: part[0] if part["language"] else "\n" * part[0].count("\n"), text)
    lines = text.split("\n")
    return [(number, len(line)) for number, line in enumerate(lines, 1) if len(line) > MOST_COLUMNS]


def findings(root, names):
    for name in sorted(names):
        suffix = Path(name).suffix
        checked = suffix in SOURCE_SUFFIXES | OTHER_SUFFIXES or Path(name).name in OTHER_NAMES
        if checked and (root / name).is_file():
            do = f"run clang-format -i {name}" if suffix in SOURCE_SUFFIXES else "wrap it"
            for number, length in too_long(root / name):
                yield f"{name}:{number}: {length} columns, {MOST_COLUMNS} are allowed; {do}"


def tracked(root):
    command = ["git", "-C", str(root), "ls-files", "--cached", "--others", "--exclude-standard"]
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout.splitlines()


def self_test():
    with tempfile.TemporaryDirectory() as folder:
        root = Path(folder)
        (root / "fits.cpp").write_text("/" * MOST_COLUMNS + "\n" + "é" * MOST_COLUMNS, encoding="utf-8")
        (root / "long.hpp").write_text("// short\n" + "/" * (MOST_COLUMNS + 1), encoding="utf-8")
        longer = "x" * (MOST_COLUMNS + 1)
        document = Path("a").with_suffix(".md").name  # by parts, as this is no citation of a document
        (root / document).write_text(f"| {longer} |\n```\n{longer}\n```\n```sh\n{longer}\n```\n{longer}\n",
                                     encoding="utf-8")
        others = ["CMakeLists.txt", "Snakefile", "corpus.txt", "data.csv", "x.py", "x.sh"]
        for name in others:
            (root / name).write_text(longer, encoding="utf-8")
        found = list(findings(root, ["fits.cpp", "long.hpp", "gone.cpp", document, *others]))
        expected = ["CMakeLists.txt:1: 121", "Snakefile:1: 121", f"{document}:6: 121", f"{document}:8: 121",
                    "long.hpp:2: 121", "x.py:1: 121", "x.sh:1: 121"]
        if [line.partition(" columns")[0] for line in found] != expected:
            sys.exit(f"self-test: found {found}")


if __name__ == "__main__":
    self_test()
    if sys.argv[1:] != ["--self-test"]:
        root = Path(sys.argv[1])
        found = list(findings(root, tracked(root)))
        print("\n".join(found) if found else "no line is too long")
        sys.exit(1 if found else 0)
