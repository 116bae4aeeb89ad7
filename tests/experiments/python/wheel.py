"""From the repository to a user: the sdist is built, the wheel from the sdist alone, and the wheel runs the first
program of experiments/python/README.md in an empty environment. With the judge of this build, installed as the wheel of
the judge has it, the environment runs the third program, too.

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

BUILD, (SOURCE,) = prepare(__doc__)
try:
    import build  # noqa: F401
except ImportError as missing:
    print(f"SKIPPED: {missing}")
    sys.exit(77)
LARGEST = 10 * 2**20  # the limit that the package sets itself [bytes]
SCRATCH = tempfile.TemporaryDirectory()
FOLDER = Path(SCRATCH.name)
ENVIRONMENT = {name: value for name, value in os.environ.items() if name not in ("PYTHONPATH", "OGC_PROGRAM")}
PAGE = (Path(SOURCE) / "experiments/python/README.md").read_text(encoding="utf-8")


def run(*command, env=ENVIRONMENT, **options):
    done = subprocess.run([str(word) for word in command], env=env, capture_output=True, text=True, **options)
    if done.returncode != 0:
        raise AssertionError(f"{command}\n{done.stdout[-4000:]}\n{done.stderr[-4000:]}")
    return done.stdout


def program_with(word):
    """Returns the first program of the page that has this word."""
    return next(program for program in re.findall(r"^```python\n(.*?)^```", PAGE, re.M | re.S) if word in program)


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
        program = program_with("find_contacts")
        place = run(home / "bin" / "python", "-c", program + "\nprint(ogc.__file__)", cwd=FOLDER).strip()
        self.assertTrue(place.startswith(str(home)), place)
        on_cuda = program.replace("query_radius", "backend='cuda', query_radius")
        with self.assertRaisesRegex(AssertionError, "RuntimeError: backend: this package has no CUDA; .*-cu13"):
            run(home / "bin" / "python", "-c", on_cuda, cwd=FOLDER)
        self.judge(home / "bin" / "python", Path(place).parents[1])

    def judge(self, python, packages):
        """The page's kernel gets its verdict in an environment whose path has no `ogc`."""
        (FOLDER / "mine.py").write_text(program_with("ogc.judge"), encoding="utf-8")
        bare = {**ENVIRONMENT, "PATH": str(python.parent)}
        with self.assertRaisesRegex(AssertionError, r"RuntimeError: .*'ogc-testbed\[judge\]'.*OGC_PROGRAM"):
            run(python, "mine.py", cwd=FOLDER, env=bare)
        run("cmake", "--install", BUILD, "--component", "python_judge", "--prefix", packages)
        self.assertRegex(run(python, "mine.py", cwd=FOLDER, env=bare), r"stage=truncate gen=\w+ seed=1")


if not index_is_there():
    print("SKIPPED: the Python package index can't be reached")
    sys.exit(77)

if __name__ == "__main__":
    main()
