"""The programs that experiments/python/README.md prints run as printed, and fit the stubs.

Usage: programs.py BUILD_DIR SOURCE_DIR OGC. Exit status 77: skipped, a Python package is missing.
"""

import importlib.util
import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from package import main, prepare

_, (SOURCE, OGC) = prepare(__doc__)
PROGRAMS = re.findall(r"^```python\n(.*?)^```",
                      (Path(SOURCE) / "experiments/python/README.md").read_text(encoding="utf-8"), re.M | re.S)


class Programs(unittest.TestCase):
    def test_fit_the_stubs(self):
        if importlib.util.find_spec("mypy") is None:
            self.skipTest("mypy is missing")
        wrong = "import ogc_testbed as ogc\nogc.find_contacts(ogc.Mesh(5), radius='x')\n"
        with tempfile.TemporaryDirectory() as folder:
            for i, program in enumerate([*PROGRAMS, wrong]):
                path = Path(folder) / f"program_{i}.py"
                path.write_text(program, encoding="utf-8")
                command = [sys.executable, *"-m mypy --check-untyped-defs --follow-imports=silent".split(),
                           f"--cache-dir={folder}", path]
                done = subprocess.run(command, env={**os.environ, "MYPYPATH": os.environ["PYTHONPATH"]}, cwd=folder,
                                      capture_output=True, text=True)
                self.assertEqual(done.returncode, 1 if program == wrong else 0, done.stdout + done.stderr)
        self.assertIn("radius", done.stdout)

    def test_run_as_printed(self):
        self.assertEqual(len(PROGRAMS), 6)
        for program in PROGRAMS:
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
