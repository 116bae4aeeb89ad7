"""The programs that experiments/python/README.md prints run as printed.

Usage: programs.py BUILD_DIR SOURCE_DIR. Exit status 77: skipped, a Python package is missing.
"""

import contextlib
import io
import re
import unittest
from pathlib import Path

from package import main, prepare

_, (SOURCE,) = prepare(__doc__)
PAGE = (Path(SOURCE) / "experiments/python/README.md").read_text(encoding="utf-8")


class Programs(unittest.TestCase):
    def test_run_as_printed(self):
        programs = re.findall(r"^```python\n(.*?)^```", PAGE, re.M | re.S)
        self.assertEqual(len(programs), 4)
        for program in programs:
            with self.subTest(program.splitlines()[3]), contextlib.redirect_stdout(io.StringIO()) as said:
                exec(compile(program, "README.md", "exec"), {})
            if "print" in program:
                self.assertTrue(said.getvalue())


if __name__ == "__main__":
    main()
