"""From the repository to a user: the sdist is built, the wheel from the sdist alone, and the wheel runs the first
program of experiments/python/README.md in an empty environment.

Usage: wheel.py BUILD_DIR SOURCE_DIR. Exit status 77: skipped, a Python package is missing or the package index can't be
reached.
"""

import os
import re
import subprocess
import sys
import tempfile
import time
import unittest
import venv
import zipfile
from pathlib import Path

from package import main, prepare

_, (SOURCE,) = prepare(__doc__)
try:
    import build  # noqa: F401
except ImportError as missing:
    print(f"SKIPPED: {missing}")
    sys.exit(77)
LARGEST = 10 * 2**20  # the limit that the package sets itself [bytes]
SCRATCH = tempfile.TemporaryDirectory()
FOLDER = Path(SCRATCH.name)
ENVIRONMENT = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}


def run(*command, **options):
    done = subprocess.run([str(word) for word in command], env=ENVIRONMENT, capture_output=True, text=True, **options)
    if done.returncode != 0:
        raise AssertionError(f"{command}\n{done.stdout[-4000:]}\n{done.stderr[-4000:]}")
    return done.stdout


def index_is_there():
    """Returns whether pip finds a package that the wheel needs."""
    command = [sys.executable, "-m", "pip", "download", "-q", "--no-deps", "-d", FOLDER / "try", "nanobind-backend"]
    return subprocess.run(command, capture_output=True).returncode == 0


class Wheel(unittest.TestCase):
    def test_of_the_sdist_runs_in_an_empty_environment(self):
        begun = time.monotonic()
        run(sys.executable, "-m", "build", "--outdir", FOLDER / "built", SOURCE)  # the sdist, then the wheel from it
        print(f"sdist and wheel took {time.monotonic() - begun:.0f} s")
        (wheel,) = (FOLDER / "built").glob("*.whl")
        self.assertRegex(wheel.name, r"^ogc_testbed-[\d.]+-cp310-abi3-linux_\w+\.whl$")
        self.assertLess(wheel.stat().st_size, LARGEST)
        with zipfile.ZipFile(wheel) as archive:
            names = {Path(name).name for name in archive.namelist() if name.startswith("ogc_testbed/")}
            self.assertLessEqual({"__init__.py", "__init__.pyi", "py.typed", "_fast.abi3.so", "_fast.pyi"}, names)
            self.assertFalse([name for name in names if "_audit" in name], "its licence is Apache-2.0 alone")
        home = FOLDER / "home"
        venv.create(home, with_pip=True)
        run(home / "bin" / "pip", "install", "-q", wheel)
        page = (Path(SOURCE) / "experiments/python/README.md").read_text(encoding="utf-8")
        program = re.search(r"^```python\n(.*?find_contacts.*?)^```", page, re.M | re.S)[1]
        place = run(home / "bin" / "python", "-c", program + "\nprint(ogc.__file__)", cwd=FOLDER).strip()
        self.assertTrue(place.startswith(str(home)), place)


if not index_is_there():
    print("SKIPPED: the Python package index can't be reached")
    sys.exit(77)

if __name__ == "__main__":
    main()
