"""The table of the distances between VBD's ends and Newton's, made from smoke runs: a row a scene, and nothing is made
twice.

Usage: minimiser.py SOURCE_DIR OGC. Exit status 77: skipped, a package that plots need is missing.
"""

import csv
import json

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

OGC, SOURCE = Path(sys.argv.pop(2)).resolve(), Path(sys.argv.pop(1)).resolve()
sys.path.insert(0, str(SOURCE))
try:
    from paper_figures.figures import minimiser  # noqa: F401
    from paper_figures.workflow import commands
except ImportError as missing:
    print(f"SKIPPED: {missing}")
    sys.exit(77)


# A contact pushes with k_c (r − d). Ends that lie a hundredth of r apart differ by a hundredth of the full force k_c r,
# seven times the largest residual that either of them leaves (0.0013).
SHARE_OF_RADIUS = 1e-2


class Table(unittest.TestCase):
    def made(self, folder, program=OGC):
        command = [sys.executable, "-m", "paper_figures.figures.minimiser", folder, "--ogc", program,
                   "--scale", "smoke"]
        return subprocess.run(list(map(str, command)), cwd=SOURCE, capture_output=True, text=True)

    def test_a_row_a_scene_whose_two_ends_are_near(self):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            done = self.made(folder)
            self.assertEqual(done.returncode, 0, done.stderr)
            with (folder / "minimiser.csv").open(newline="") as file:
                rows = list(csv.DictReader(file))
            self.assertEqual({row["scene"]: int(row["step [1]"]) - 1 for row in rows},
                             commands.MINIMISER_STEPS["smoke"])
            for row in rows:
                settings = json.loads((folder / row["scene"] / "run.json").read_text())["settings"]
                radius = float(settings["contact_radius"]["value"])
                self.assertTrue(0 < float(row["largest_distance [m]"]) <= SHARE_OF_RADIUS * radius, row)
            made = {path: path.stat().st_mtime_ns for path in folder.glob("*/run.json")}
            self.assertEqual(len(made), 9)
            self.assertEqual(self.made(folder).returncode, 0)
            self.assertEqual(made, {path: path.stat().st_mtime_ns for path in folder.glob("*/run.json")})

    def test_a_program_that_fails_is_named(self):
        with tempfile.TemporaryDirectory() as name:
            done = self.made(name, "/bin/false")
            self.assertEqual(done.returncode, 1)
            self.assertIn("minimiser: /bin/false run cloth_on_sphere", done.stderr)


if __name__ == "__main__":
    unittest.main()
