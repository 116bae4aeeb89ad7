"""Table 1 from runs whose numbers are known, and from real ones that were cut off on the way.

Usage: table1.py SOURCE_DIR OGC. The standard library is enough.
"""

import csv
import json
import os
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

SOURCE, OGC = Path(sys.argv[1]), sys.argv[2]
del sys.argv[1:3]
sys.path.insert(0, str(SOURCE))
from paper_figures.figures import table1  # noqa: E402
from paper_figures.workflow import accept, audited, commands  # noqa: E402
from paper_figures.workflow.evidence import Evidence, EvidenceError, run_at  # noqa: E402
from paper_figures.workflow.jobs import Limit  # noqa: E402


def make_run(folder, backend, rows, first=1, **changes):
    """Rows: (time [ms], contacts of either kind, repeats)."""
    folder.mkdir(parents=True)
    manifest = {"status": "finished", "dirty": False, "commit": "0123456789abcdef", "device": backend + " device",
                "ended": "2026-01-01T00:00:00Z", "backend": backend,
                "scale": "paper", "solver": "vbd", "guarantee_kept": True, "audited_states": "7",
                "scene": {"name": "twist", "vertices": 10000, "triangles": 19602, "bodies": []},
                "settings": {"steps": {"value": 9600}, "iterations": {"value": 10}}, **changes}
    (folder / "run.json").write_text(json.dumps(manifest))
    lines = ["step [1],wall [ms],vertex_facet_contacts [1],edge_edge_contacts [1],repeats [1]"]
    lines += [f"{first + i},{ms},{n},{n},{repeats}" for i, (ms, n, repeats) in enumerate(rows)]
    (folder / "steps.csv").write_text("\n".join(lines) + "\n")


class Known(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = Path(holder.name)

    def test_averages_maxima_contacts_and_quotients_are_those_counted_by_hand(self):
        make_run(self.folder / "twist/whole", "cuda", [(1, 10, 0), (9, 20, 1), (2, 30, 0)])
        make_run(self.folder / "twist/cpu_0", "cpu", [(10, 1, 0), (20, 1, 0)])
        make_run(self.folder / "twist/cpu_100", "cpu", [(40, 3, 0)], first=9601)
        device, cpu = table1.rows_of(self.folder)
        self.assertEqual((device["average [ms]"], device["maximum [ms]"], device["repeated steps"]), (4, 2, 1))
        self.assertEqual((device["contacts, average"], device["contacts, maximum"], device["steps"],
                          device["of steps"]), (40, 60, 3, 9600))
        self.assertEqual((device["paper average [ms]"], device["paper maximum [ms]"]), (0.9, 1.5))
        self.assertAlmostEqual(device["average / paper's"], 4 / 0.9)
        self.assertEqual((cpu["average [ms]"], cpu["maximum [ms]"], cpu["windows [ms]"]),
                         (27.5, 40, "0: 15; 9600: 40; 3 of 5 not run"))
        self.assertEqual((cpu["paper average [ms]"], cpu["paper maximum [ms]"]), (21, 30))

    def test_residuals_stand_by_the_state_that_the_step_began_in(self):
        make_run(self.folder / "twist/whole", "cuda", [(1, 10, 0)])
        for share, first, fresh in ((100, 9601, 0.5), (25, 2401, 0.25)):
            run = self.folder / f"twist/residual_{share}"
            make_run(run, "cuda", [], first=first)
            (run / "steps.csv").write_text(f"step [1],residual [1]\n{first},{fresh}\n")
        (run / "iterations.csv").write_text("iteration [1],residual [1]\n0,1\n1,0.125\n")
        row, = table1.rows_of(self.folder)
        self.assertEqual((row[table1.STALE], row[table1.FRESH]), ("2400: 0.125", "2400: 0.25; 9600: 0.5"))

    def test_of_several_whole_runs_the_median_counts(self):
        for name, ms in (("whole", 3), ("whole_2", 1), ("whole_3", 2)):
            make_run(self.folder / "twist" / name, "cuda", [(ms, 0, 0)])
        row, = table1.rows_of(self.folder)
        self.assertEqual((row["average [ms]"], row["maximum [ms]"], row["runs"]), (2, 2, 3))

    def test_a_scene_of_which_only_windows_are_here_is_not_said_to_be_whole(self):
        make_run(self.folder / "twist/cpu_0", "cpu", [(10, 1, 0)])
        cpu, left_out = table1.rows_of(self.folder)
        self.assertEqual((cpu["scene"], cpu["backend"]), ("twist", "cpu"))
        self.assertEqual((left_out["scene"], left_out["status"], left_out["average [ms]"], left_out["commit"]),
                         ("twist", "not run", "", "-"))
        table1.write([cpu, left_out], self.folder)
        self.assertEqual(list(accept.left_out(self.folder)), ["twist"])

    def test_a_claim_can_read_the_table(self):
        make_run(self.folder / "runs/twist/whole", "cuda", [(1, 10, 0)])
        paths = table1.write(table1.rows_of(self.folder / "runs"), self.folder / "results")
        self.assertEqual([path.name for path in paths], ["table1_paper.csv", "table1_paper.md", "table1_paper.html"])
        found = Evidence(self.folder / "results").measure({"table": "table1",
                                                           "where": {"scene": "twist", "backend": "cuda"},
                                                           "column": "average [ms]"}, {"scale": "paper"})
        self.assertEqual((found.value, found.device, found.commit), (1, "cuda device", "0123456789"))
        for path in paths[1:]:
            self.assertIn("RTX 4090", path.read_text())

    def test_what_does_not_belong_together_is_refused(self):
        with self.assertRaisesRegex(EvidenceError, "experiments/reproduce table1"):
            table1.rows_of(self.folder)
        make_run(self.folder / "twist/whole", "cuda", [(1, 10, 0)])
        make_run(self.folder / "twist/whole_2", "cuda", [(1, 10, 0), (1, 10, 0)])
        with self.assertRaisesRegex(EvidenceError, "different lengths"):
            table1.rows_of(self.folder)
        make_run(self.folder / "other/twist/cpu_0", "cpu", [(1, 10, 0)])
        make_run(self.folder / "other/twist/cpu_25", "cpu", [(1, 10, 0)], commit="another")
        with self.assertRaisesRegex(EvidenceError, "different programs"):
            table1.rows_of(self.folder / "other")


# `ogc audit RUN --json`: of each frame its step; one of step 7 intersects; with OGC_SLOW it is asked to stop after two.
AUDIT = """import json, os, pathlib, signal, sys, time
steps = sorted(int(path.stem[-6:]) for path in (pathlib.Path(sys.argv[2]) / "frames").iterdir())
assert sys.argv[1] == "audit" and sys.argv[3] == "--json" and (pathlib.Path(sys.argv[2]) / "scene/scene.json").is_file()
stopped = []
signal.signal(signal.SIGINT, lambda *_: stopped.append(1))
done = []
for step in steps:
    done.append({"state": f"step {step}", "count": int(step == 7)})
    while os.environ.get("OGC_SLOW") and len(done) == 2 and not stopped:
        time.sleep(0.01)
    if stopped:
        break
found = sum(state["count"] for state in done)
print(json.dumps({"states": done, "intersections": found, "complete": not stopped}))
sys.exit(1 if found else 130 if stopped else 0)
"""


class Afterwards(unittest.TestCase):
    """The audit after a run, with a stand-in for `ogc`."""

    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = Path(holder.name)
        self.program = self.folder / "ogc"
        self.program.write_text(f"#!{sys.executable}\n{AUDIT}")
        self.program.chmod(0o755)
        self.addCleanup(os.environ.pop, "OGC_SLOW", None)

    def run_of(self, steps):
        run = self.folder / "run"
        make_run(run, "cuda", [(1, 10, 0)], guarantee_kept="not checked", audited_states="0")
        for name in ("frames", "scene"):
            (run / name).mkdir()
        (run / "scene/scene.json").touch()
        for step in steps:
            (run / f"frames/frame_{step:06d}.h5").touch()
        return run

    def test_what_was_audited_is_not_audited_again(self):
        run = self.run_of((0, 5, 10, 15, 20))
        os.environ["OGC_SLOW"] = "yes"
        for status, states, words in ((75, 2, "not all yet"), (75, 4, "not all yet"), (0, 5, "no intersection"),
                                      (0, 5, "no intersection")):
            os.environ["OGC_SLOW"] = "yes" if status else ""
            ended, found = audited.audit(self.program, run, Limit(0.5 if status else None))
            self.assertEqual((ended, found["states"]), (status, states))
            self.assertIn(words, audited.in_words(found))
        self.assertEqual(found["steps"], [0, 5, 10, 15, 20])
        made = run_at(run)
        self.assertEqual((made.audited_states, made.guarantee_kept), (5, True))

    def test_an_intersection_refutes_and_is_named(self):
        run = self.run_of((0, 7, 9))
        for _ in range(2):
            status, found = audited.audit(self.program, run)
            self.assertEqual((status, found["clean"], found["intersecting_steps"]), (1, False, [7]))
        self.assertIn("1 INTERSECTIONS, the first in step 7", audited.in_words(found))
        self.assertTrue(run_at(run).failed_audit)

    def test_a_run_that_was_made_anew_is_audited_anew(self):
        run = self.run_of((0, 7))
        audited.audit(self.program, run)
        later = time.time() + 9
        os.utime(run / "run.json", (later, later))
        (run / "frames/frame_000007.h5").unlink()
        self.assertEqual(audited.audit(self.program, run)[0], 0)

    def test_what_cannot_be_audited_exits_2(self):
        run = self.run_of((0,))
        self.program.write_text("#!/bin/sh\necho 'ogc: no such thing' >&2\nexit 2\n")
        self.assertEqual(audited.audit(self.program, run)[0], 2)
        self.assertFalse((run / "audit.json").exists())


class Frames(unittest.TestCase):
    def test_every_row_stores_a_state_in_a_60th_of_a_second(self):
        """As many steps as go into it, at least one; of h as the paper prints it where no run is accepted."""
        results, claims = SOURCE / "paper_figures/results/h200", SOURCE / "paper_figures/claims"
        for row in table1.ROWS:
            scene = commands.scene_of(row)
            n = commands.FRAME_STEPS[scene]
            printed = next(claim["value"] for claim in json.loads((claims / f"{scene}.json").read_text())["claims"]
                           if claim["id"] == f"{scene}.time_step")
            paths = [*results.glob(f"table1_paper/{row}_whole_run.json"), *results.glob(f"{row}_run.json")]
            time_step = json.loads(paths[0].read_text())["settings"]["time_step"]["value"] if paths else printed
            self.assertEqual(n, max(1, int(1 / 60 / time_step * (1 + 1e-6))), row)


class Real(unittest.TestCase):
    def call(self, folder, *words):
        command = [sys.executable, "-m", "paper_figures.workflow.runner", "--program", OGC, "--out", folder, *words]
        return subprocess.run(command, cwd=SOURCE, capture_output=True, text=True, timeout=250, check=False)

    def test_a_run_that_was_killed_is_gone_on_with_and_all_make_the_table(self):
        with tempfile.TemporaryDirectory() as folder:
            rows = ("cloth_on_sphere", "windows_cloth_on_sphere", "twist", "windows_twist")
            words = [folder, "--backend", "cpu", "--scale", "smoke", "--window", "3", *rows]
            there = Path(folder) / "table1-smoke-cpu"
            twist = there / "twist/whole"
            job = next(commands.whole_runs("twist", "smoke", "cpu"))
            command = [OGC, *job.words(there)]
            cut = subprocess.Popen([*command, "--checkpoint", "0"], stdout=subprocess.DEVNULL,
                                   stderr=subprocess.DEVNULL)
            while cut.poll() is None and not (twist / "checkpoint.h5").is_file():
                time.sleep(0.01)
            cut.kill()
            was_cut = cut.wait() != 0
            manifest = json.loads((twist / "run.json").read_text())
            said = manifest["command"].replace(" --checkpoint 0", "")
            (twist / "run.json").write_text(json.dumps({**manifest, "command": said}, indent=2))
            whole = self.call(*words)
            self.assertEqual(whole.returncode, 0, whole.stdout + whole.stderr)
            self.assertEqual("resumed" in json.loads((twist / "run.json").read_text()), was_cut)
            self.check_table(there)
            again = self.call(*words)
            self.assertEqual([line.split()[3] for line in again.stdout.splitlines()], ["kept"] * 4)

    def check_table(self, there):
        with table1.write(table1.rows_of(there), there)[0].open(newline="") as file:
            rows = list(csv.DictReader(file))
        # The whole runs are of the CPU here, so each scene has two rows of it: the run, then the windows.
        self.assertEqual([row["scene"] for row in rows], ["twist", "twist", "cloth_on_sphere", "cloth_on_sphere"])
        self.assertEqual([row["runs"] for row in rows], ["1", "5", "1", "5"])
        self.assertEqual({row["steps"] for row in rows[1::2]}, {"15"})
        self.assertEqual(rows[2]["steps"], rows[2]["of steps"])
        for name in ("twist", "cloth_on_sphere"):
            run = there / name / "whole"
            frames, found = len(list((run / "frames").iterdir())), json.loads((run / "audit.json").read_text())
            self.assertEqual((found["states"], found["clean"], found["complete"]), (frames, True, True), name)
        sphere = rows[2]
        for column in (table1.STALE, table1.FRESH):
            found = [float(text.split(": ")[1]) for text in sphere[column].split("; ")]
            self.assertEqual((len(found), min(found) > 0), (5, True), column)
        self.assertEqual(sphere["audited states"], f"{frames}, no intersection")
        self.assertGreater(float(sphere["audit [s]"]), 0)
        self.assertEqual(json.loads((run / "run.json").read_text())["audit"], "off", "its time is the steps' alone")


if __name__ == "__main__":
    unittest.main()
