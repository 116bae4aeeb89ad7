"""Fig. 19 from smoke runs: windows count alike, GIPC's times stand beside as many steps as were measured of it or
nowhere, one step of VBD ends near Newton's, and what the claims read is there.

Usage: fig19_mat_twist.py SOURCE_DIR OGC. Exit status 77: skipped, matplotlib or h5py is missing.
"""

import argparse
import json
import shutil
import statistics
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SOURCE, OGC = Path(sys.argv[1]).resolve(), str(Path(sys.argv[2]).resolve())
del sys.argv[1:3]
sys.path.insert(0, str(SOURCE))
try:
    import numpy as np
    from paper_figures.figures import fig19_mat_twist as fig19
except ImportError as missing:
    print(f"SKIPPED: {missing}")
    sys.exit(77)
from paper_figures.workflow import commands  # noqa: E402

RMS = "rms distance to Newton [m]"


class Smoke(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        holder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(holder.cleanup)
        cls.folder = Path(holder.name)
        commands.WINDOW_SECONDS["smoke"] = 1
        asked = argparse.Namespace(scale="smoke", folder=holder.name, backend="cpu", made=False, ogc=OGC)
        cls.runs = fig19.runs_of(asked)
        cls.rows = fig19.table(cls.runs, None)

    def of(self, **wanted):
        return [row for row in self.rows if all(row[key] == value for key, value in wanted.items())]

    def test_whole_runs_are_audited_and_all_runs_are_there(self):
        self.assertEqual(len(self.runs), 4 + 4 * 3 + 4 * (1 + len(commands.MAT_ITERATIONS["smoke"])))
        for row in (*self.of(what="whole"), *self.of(what="without friction")):
            self.assertEqual(row["intersections"], "none", row)
        self.assertEqual([row["friction [1]"] for row in self.of(what="without friction")], [0, 0])

    def test_each_window_has_the_same_weight(self):
        for solver, bounds in (("vbd", "ball"), ("vbd", "planes"), ("ipc", "")):
            windows, (mean,) = (self.of(what=what, solver=solver, bounds=bounds) for what in ("window", "windows"))
            self.assertEqual(len(windows), len(commands.MAT_WINDOWS))
            self.assertAlmostEqual(mean["mean [ms]"], statistics.fmean(row["mean [ms]"] for row in windows))
            self.assertEqual(mean["steps [1]"], sum(row["steps [1]"] for row in windows))
        for row in self.of(what="window", solver="ipc"):
            self.assertGreaterEqual(row["steps [1]"], commands.IPC_STEPS)

    def test_a_movie_of_the_run_with_planes_is_made_of_the_runs_that_are_there(self):
        few, movie = self.folder / "few", self.folder / "fig19.mp4"
        shutil.copytree(self.folder / "planes/whole", few / "planes/whole")
        for frame in sorted((few / "planes/whole/frames").iterdir())[3:]:
            frame.unlink()
        made = subprocess.run([sys.executable, "-m", "paper_figures.figures.fig19_mat_twist", str(few), "--movie",
                               str(movie)], cwd=SOURCE, capture_output=True, text=True, check=False)
        if "can't be made" in made.stderr:
            self.skipTest(made.stderr)
        self.assertEqual((made.returncode, movie.is_file()), (0, True), made.stderr)

    def test_gipc_stands_beside_ours_at_the_papers_size_alone(self):
        self.assertIsNone(fig19.gipc_times("smoke"))
        self.assertEqual(self.of(solver="gipc"), [])
        self.assertLessEqual(len(fig19.gipc_times("paper")), commands.GIPC_STEPS["paper"])
        _, planes, gipc = fig19.without_friction(self.runs, np.array([6.0, 8.0, 7.0]))
        self.assertEqual(planes["steps [1]"], len(self.runs["planes/free"].column("wall")))
        self.assertEqual((gipc["device"], gipc["mean [ms]"], gipc["worst [ms]"], gipc["steps [1]"]),
                         (fig19.GIPC_DEVICE, 7, 8, 3))

    def test_one_step_of_vbd_ends_near_newtons_where_nothing_is_in_contact(self):
        newton, swept = self.of(what="one step", solver="newton"), self.of(what="one step", solver="vbd")
        self.assertEqual([row[RMS] for row in newton], [0] * len(commands.MAT_WINDOWS))
        for row in swept:  # floats of half a metre are 6e-8 m apart
            self.assertLess(row["largest distance to Newton [m]"], 6e-7, row)
            self.assertGreater(row["rms motion of the step [m]"], 1e-4)
        for row in self.of(what="one step", solver="ipc"):
            self.assertEqual(row["residual [1]"], "", "IPC's is another measure")

    def test_what_the_claims_read_is_there(self):
        claims = json.loads((SOURCE / "paper_figures/claims/mat_twist.json").read_text())["claims"]
        found = [claim.get("measure", {}) for claim in claims]
        each = [spec for specs in found for spec in (specs if isinstance(specs, list) else [specs])]
        read = [spec for spec in each if spec.get("table") == "fig19"]
        self.assertEqual(len(read), 1)
        for measure in read:
            self.assertIn(measure["column"], self.rows[0])
            for key in ("over", "under", "where"):
                wanted = {name: value for name, value in measure.get(key, {}).items() if name != "backend"}
                self.assertTrue(not wanted or self.of(**wanted), (measure, key))

    def test_it_is_drawn(self):
        fig19.draw(self.runs, None, "cpu", self.folder / "fig19.png")
        self.assertGreater((self.folder / "fig19.png").stat().st_size, 50_000)


if __name__ == "__main__":
    unittest.main()
