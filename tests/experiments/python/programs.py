"""The programs that experiments/python/README.md prints run as printed.

Usage: programs.py BUILD_DIR SOURCE_DIR OGC. Exit status 77: skipped, a Python package is missing.
"""

import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from package import main, prepare

_, (SOURCE, OGC) = prepare(__doc__)
PAGE = (Path(SOURCE) / "experiments/python/README.md").read_text(encoding="utf-8")


class Programs(unittest.TestCase):
    def test_run_as_printed(self):
        programs = re.findall(r"^```python\n(.*?)^```", PAGE, re.M | re.S)
        self.assertEqual(len(programs), 6)
        for program in programs:
            with self.subTest(program.splitlines()[3]), tempfile.TemporaryDirectory() as folder:
                path = Path(folder) / "program.py"
                path.write_text(program, encoding="utf-8")
                done = subprocess.run([sys.executable, path], env={**os.environ, "OGC_PROGRAM": OGC}, cwd=folder,
                                      capture_output=True, text=True)
                self.assertEqual(done.returncode, 0, done.stderr)
                if "print" in program:
                    self.assertTrue(done.stdout)


if __name__ == "__main__":
    main()
