"""Fig. 18 of the solvers from small runs: VBD on CUDA where its run lies in the folder, each ratio beside the paper's.

Usage: fig18_solvers.py SOURCE_DIR OGC. Exit status 77: skipped, matplotlib or h5py is missing. The run on CUDA is a
fixture: VBD's run on the CPU with another backend in its manifest.
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
from paper_figures.workflow import commands  # noqa: E402
from ogc_testbed.runs import Run  # noqa: E402

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
        for job in commands.solvers("smoke"):
            job.make(OGC, cls.made)

    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = Path(holder.name) / "fig18_solvers-smoke-cpu"
        shutil.copytree(self.made, self.folder)

    def on_cuda(self):
        shutil.copytree(self.folder / "vbd", self.folder / "vbd_cuda")
        command = json.loads((self.folder / "vbd/run.json").read_text())["command"]
        job = commands.solvers("smoke", cuda=True)[-1]
        change(self.folder / "vbd_cuda/run.json", backend="cuda", device="no GPU: a fixture",
               command=" ".join([command.split()[0], *job.words(self.folder)]))

    def draw(self, *words):
        command = [sys.executable, "-m", "paper_figures.figures.fig18_solvers", self.folder, "--ogc", OGC, "--scale",
                   "smoke", *words]
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
        change(self.folder / "vbd/run.json", device="999 threads")
        said = self.draw().stdout
        self.assertRegex(said, rf"IPC \({THREADS}\) takes .* that VBD-OGC \(999 threads\) takes")
        self.assertIn(f"NOT ON THE SAME CORES ({', '.join(sorted([THREADS, '999 threads']))})", said)

    def test_the_ratio_is_that_of_the_rows(self):
        runs = {name: Run(self.folder / name) for name in ("ipc", "vbd")}
        found = {measured.partition(" of ")[0]: ratio for _, ratio, measured,
                 _ in fig18_solvers.ratios(list(runs.values()))}
        self.assertAlmostEqual(found["time on the clock"],
                               runs["ipc"].column("wall").sum() / runs["vbd"].column("wall").sum())
        self.assertAlmostEqual(found["processor time"],
                               fig18_solvers.processor_ms(runs["ipc"]) / fig18_solvers.processor_ms(runs["vbd"]))

    def test_runs_that_were_stopped_are_drawn_as_far_as_they_came(self):
        vbd = self.folder / "vbd"
        rows = (vbd / "steps.csv").read_text().splitlines(keepends=True)
        (vbd / "steps.csv").write_text("".join(rows[:FIRST + 1]))
        change(vbd / "run.json", status="interrupted")
        shutil.rmtree(self.folder / "newton")
        said = self.draw("--made").stdout
        self.assertRegex(said, rf"of {FIRST} steps that VBD-OGC \({THREADS}\), first {FIRST} of 30 steps takes")
        self.assertEqual([(row["solver"], row["steps"], row["of steps"]) for row in self.rows()],
                         [("ipc", "30", "30"), ("vbd", str(FIRST), "30")])
        shutil.rmtree(self.folder / "ipc")
        shutil.rmtree(vbd)
        self.assertIn("has no run; leave --made out", self.draw("--made").stderr)


if __name__ == "__main__":
    unittest.main()
