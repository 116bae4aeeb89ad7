"""Shares what the checks of the house need: the files that git tracks, and the command, which runs a check's self-test
before it looks at a tree."""

import subprocess
import sys
from pathlib import Path


def tracked(root, *patterns):
    """Returns {path: text} of files that git tracks and that are there; the text of what is not UTF-8 has other
    letters."""
    names = subprocess.run(["git", "-C", root, "ls-files", *patterns], capture_output=True, text=True,
                           check=True).stdout.splitlines()
    return {name: (Path(root) / name).read_text(encoding="utf-8", errors="replace") for name in names
            if (Path(root) / name).is_file()}


def run(document, self_test, findings):
    """Prints what `self_test()` and `findings(root)` return, sentences about planted and real faults; exits with status
    1 where there are any. The only argument is the root, or --self-test."""
    if len(sys.argv) != 2:
        print(document, file=sys.stderr)
        sys.exit(2)
    found = self_test() + ([] if sys.argv[1] == "--self-test" else list(findings(sys.argv[1])))
    print("\n".join(found))
    sys.exit(1 if found else 0)
