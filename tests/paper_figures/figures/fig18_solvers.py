"""Fig. 18 of the solvers from small runs: one made in parts is drawn as one, VBD on CUDA where its run lies in the folder, with each ratio beside the paper's.

Usage: fig18_solvers.py SOURCE_DIR OGC. Exit status 77: skipped, matplotlib or h5py is missing. The run on CUDA is a fixture: VBD's run on the CPU with another backend in its manifest.
"""

import csv
import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SOURCE, OGC = Path(sys.argv[1]).resolve(), str(Path(sys.argv[2]).resolve())
del sys.argv[1:3]
sys.path.insert(0, str(SOURCE))
try:
    from paper_figures.figures import fig18_solvers
except ImportError as missing:
    print(f"SKIPPED: {missing}")
    sys.exit(77)
from paper_figures.workflow import in_time  # noqa: E402

BASE = ["cloth_on_sphere", "--scale", "smoke", "--set", "membrane=stable_neo_hookean", "--audit", "end"]
FIRST, STEPS = 12, 30
THREADS = f"{len(os.sched_getaffinity(0))} threads"


def change(manifest, **changes):
    document = json.loads(manifest.read_text())
    document["settings"]["steps"]["value"] = STEPS
    manifest.write_text(json.dumps({**document, **changes}))


class Solvers(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        holder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(holder.cleanup)
        cls.made = Path(holder.name) / "made"
        for name in ("ipc", "newton", "vbd"):
            in_time.run_for(OGC, [*BASE, *in_time.SOLVERS[name]], cls.made / name, 100)

    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = Path(holder.name) / "fig18_solvers-smoke-cpu"
        shutil.copytree(self.made, self.folder)

    def cut_vbd(self):
        """VBD's run as if it had been stopped after its first steps."""
        shutil.rmtree(self.folder / "vbd")
        part = self.folder / "vbd/part_00"
        subprocess.run([OGC, "run", *BASE, "--steps", str(FIRST), "--out", part], check=True, capture_output=True)
        change(part / "run.json", status="interrupted")
        (part / in_time.PROCESSOR_TIME).write_text('{"user [s]": 1, "system [s]": 0}')

    def on_cuda(self):
        shutil.copytree(self.folder / "vbd", self.folder / "vbd_cuda")
        change(self.folder / "vbd_cuda/part_00/run.json", backend="cuda", device="no GPU: a fixture")

    def draw(self, *words):
        command = [sys.executable, "-m", "paper_figures.figures.fig18_solvers", self.folder, "--ogc", OGC, "--scale", "smoke", *words]
        return subprocess.run(command, cwd=SOURCE, capture_output=True, text=True)

    def rows(self):
        with (self.folder / "fig18_solvers.csv").open(newline="") as file:
            return list(csv.DictReader(file))

    def test_every_ratio_stands_beside_the_papers(self):
        self.on_cuda()
        done = self.draw()
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertTrue((self.folder / "fig18_solvers.png").is_file())
        for measured in ("time on the clock", "processor time"):
            for solver, paper in (("Newton-OGC", "9.2"), ("VBD-OGC", "128")):
                ratio = rf"{measured} of 30 steps that {solver} \({THREADS}\) takes \(paper: {paper}\)"
                self.assertRegex(done.stdout, rf"IPC \({THREADS}\) takes \S+ times the {ratio}")
        on_cuda = r"30 steps that VBD-OGC, CUDA \(no GPU: a fixture\) takes \(the paper has none\)"
        self.assertRegex(done.stdout, f"time on the clock of {on_cuda}")
        self.assertNotIn("NOT ON THE SAME CORES", done.stdout)
        self.assertNotRegex(done.stdout, "processor time of 30 steps that VBD-OGC, CUDA")
        self.assertEqual([(row["solver"], row["backend"], row["steps"]) for row in self.rows()],
                         [("ipc", "cpu", "30"), ("newton", "cpu", "30"), ("vbd", "cpu", "30"), ("vbd", "cuda", "30")])

    def test_runs_on_different_numbers_of_threads_are_said_to_be_so(self):
        change(self.folder / "vbd/part_00/run.json", device="999 threads")
        said = self.draw().stdout
        self.assertRegex(said, rf"IPC \({THREADS}\) takes .* that VBD-OGC \(999 threads\) takes")
        self.assertIn(f"NOT ON THE SAME CORES ({', '.join(sorted([THREADS, '999 threads']))})", said)

    def test_the_ratio_is_that_of_the_rows(self):
        runs = {name: fig18_solvers.Joined(in_time.parts(self.folder / name)) for name in ("ipc", "vbd")}
        found = {measured.partition(" of ")[0]: ratio for _, ratio, measured, _ in fig18_solvers.ratios(list(runs.values()))}
        self.assertAlmostEqual(found["time on the clock"], runs["ipc"].column("wall").sum() / runs["vbd"].column("wall").sum())
        self.assertAlmostEqual(found["processor time"], runs["ipc"].processor_ms / runs["vbd"].processor_ms)

    def test_a_run_in_parts_is_drawn_when_it_has_reached_its_end(self):
        self.cut_vbd()
        refused = self.draw()
        self.assertNotEqual(refused.returncode, 0)
        self.assertIn("vbd has not reached its end: call paper_figures.workflow.in_time again", refused.stderr)
        self.assertTrue(in_time.run_for(OGC, BASE, self.folder / "vbd", 100))
        self.assertEqual(len(in_time.parts(self.folder / "vbd")), 2)
        self.assertEqual(self.draw().returncode, 0)
        vbd = self.rows()[-1]
        self.assertEqual((vbd["solver"], vbd["steps"], vbd["of steps"]), ("vbd", "30", "30"))


if __name__ == "__main__":
    unittest.main()
