"""The table of distances to the minimiser, made from smoke runs: a row a scene, each distance within its bounds, and
nothing is made twice.

Usage: minimiser.py SOURCE_DIR OGC
"""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

OGC, SOURCE = Path(sys.argv.pop(2)).resolve(), Path(sys.argv.pop(1)).resolve()
sys.path.insert(0, str(SOURCE))
from paper_figures.figures import minimiser  # noqa: E402
from paper_figures.workflow import commands  # noqa: E402


class Table(unittest.TestCase):
    def made(self, folder):
        command = [sys.executable, "-m", "paper_figures.figures.minimiser", str(folder), "--ogc", str(OGC), "--scale",
                   "smoke",
                   "--no-picture"]
        return subprocess.run(command, cwd=SOURCE, capture_output=True, text=True)

    def test_a_row_a_scene_each_within_its_bounds(self):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            done = self.made(folder)
            self.assertEqual(done.returncode, 0, done.stderr)
            rows = minimiser.rows_of(folder / "minimiser.csv")
            self.assertEqual({row["scene"]: int(row["step [1]"]) - 1 for row in rows},
                             commands.MINIMISER_STEPS["smoke"])
            for row in rows:
                distance, bounds = float(row["largest_distance [m]"]), ("bound_by_energy [m]", "bound_by_gradient [m]")
                self.assertEqual((row["reached_floor"], row["newton_converged"]), ("yes", "yes"))
                self.assertTrue(0 < distance <= min(float(row[bound]) for bound in bounds), row)
                self.assertLessEqual(set(minimiser.DISTANCES), set(row))
            made = {path: path.stat().st_mtime_ns for path in folder.glob("*/run.json")}
            self.assertEqual(self.made(folder).returncode, 0)
            self.assertEqual(made, {path: path.stat().st_mtime_ns for path in folder.glob("*/run.json")})

    def test_a_program_that_fails_is_named(self):
        with tempfile.TemporaryDirectory() as name:
            command = [sys.executable, "-m", "paper_figures.figures.minimiser", name, "--ogc", "/bin/false",
                       "--no-picture"]
            done = subprocess.run(command, cwd=SOURCE, capture_output=True, text=True)
            self.assertEqual(done.returncode, 1)
            self.assertIn("minimiser: /bin/false run cloth_on_sphere", done.stderr)


if __name__ == "__main__":
    unittest.main()
