"""What `reproduce` says while it works: which figure, which step of how many, how long yet; the workflow's own output
goes to a log. Also what a build says.

Usage: progress.py SOURCE_DIR. Exit status 77: skipped, PyYAML or matplotlib is missing; without Snakemake its part is
left out, and the test says so.
"""

import importlib.util
import io
import os
import pty
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

SOURCE = Path(sys.argv.pop(1)).resolve()
sys.path.insert(0, str(SOURCE))
try:
    import matplotlib  # noqa: F401  (the steps draw with it)
    from paper_figures.workflow import progress
except ImportError as missing:
    print(f"SKIPPED: {missing}")
    sys.exit(77)

# Writes what an illustration is drawn of: an empty one, so that drawing fails.
OGC = """#!/bin/sh
echo "stand-in: $*"
[ -z "$OGC_SLOW" ] || { echo "step 3/4, 1 ms a step"; sleep "$OGC_SLOW"; }
for last; do :; done
mkdir -p "$last" && echo '{}' > "$last/fig07.json"
"""


class Scratch(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = Path(holder.name)


class Words(Scratch):
    """A course of three steps by a clock of the test's own."""

    def setUp(self):
        super().setUp()
        self.now = 0.0
        (self.folder / "fig18-smoke-cpu").mkdir()
        (self.folder / "fig18-smoke-cpu/fig18.log.json").write_text('{"seconds": 40}')
        self.known = progress.Known(self.folder, "smoke", "cpu", ["fig18", "fig07"])
        self.known.seconds.update({"fig18_run": 100, "fig07": None})
        self.course = progress.Course(self.known, lambda: self.now)
        self.course.take({"due": ["fig18_run", "fig18", "fig07"]})

    def begin(self, name):
        self.course.take({"what": "begins", "step": name})

    def end(self, name):
        return self.course.take({"what": "ends", "step": name, "seconds": 7})

    def test_the_line_says_figure_step_and_time_from_what_steps_took_before(self):
        self.begin("fig18_run")
        self.now = 10
        begin = r"^Step 1 of 3, fig18 \(.+\): simulating cloth_on_sphere; "
        self.assertRegex(self.course.line(), begin + "at least 2 min left$")
        self.course.due.remove("fig07")  # of which nobody knows how long it takes
        self.assertRegex(self.course.line(), r"^Step 1 of 2, .*; about 2 min left$")  # 90 of the run, 40 of drawing

    def test_how_far_the_running_program_says_it_is_counts_more(self):
        self.begin("fig18_run")
        log = self.known.logs["fig18_run"]
        log.parent.mkdir(parents=True, exist_ok=True)
        log.write_text("step 1/30, 2 ms a step\nstep 10/30, 2 ms a step, 3 contacts\n")
        self.now, self.course.due = 5, ["fig18_run"]
        self.assertRegex(self.course.line(), "simulating cloth_on_sphere, 10 of 30; about 10 s left$")

    def test_of_a_study_runs_count_and_not_the_steps_of_one(self):
        known = progress.Known(self.folder, "smoke", "cpu", ["ablation_membrane"])
        course = progress.Course(known, lambda: self.now)
        course.take({"due": ["ablation_membrane"]})
        course.take({"what": "begins", "step": "ablation_membrane"})
        log, self.now = known.logs["ablation_membrane"], 30
        log.parent.mkdir(parents=True, exist_ok=True)
        log.write_text("s: twist (1 of 2): ogc ablate twist\ndefault,seed=1 (1 of 4)\nstep 1/720, 2 s left\n")
        self.assertRegex(course.line(), r": simulating, then drawing; no time is known yet$")
        with log.open("a") as file:
            file.write("step 720/720, 0 s left\ndefault,seed=2 (2 of 4)\nstep 1/720, 2 s left\n")
        self.assertRegex(course.line(), ", 1 of 8; about 4 min left$")
        with log.open("a") as file:
            file.write("s: knot (2 of 2): ogc ablate knot\ndefault,seed=1 (1 of 4)\nstep 9/100, 2 s left\n")
        self.assertRegex(course.line(), ", 4 of 8; about 30 s left$")

    def test_a_finished_step_is_said_with_its_time_and_counted(self):
        self.begin("fig18_run")
        self.assertRegex(self.end("fig18_run"), r"^Step 1 of 3, fig18 .*: simulating cloth_on_sphere took 7 s$")
        self.begin("fig18")
        self.begin("fig07")
        self.assertRegex(self.course.line(), r"^Step 2 of 3, .*, 1 more beside it; at least 40 s left$")

    def test_a_failure_is_said_at_once_with_its_words(self):
        self.begin("fig18_run")
        said = self.course.take({"what": "fails", "step": "fig18_run", "words": "FAILED (exit status 3): ogc run"})
        self.assertRegex(said, r"^fig18 .*: FAILED \(exit status 3\): ogc run$")
        self.assertEqual(self.course.line(), "")

    def test_every_recipe_has_words_for_every_step(self):
        known = progress.Known(self.folder, "smoke", "cpu", ["all", "sweep", "ablations"])
        for name, words in known.words.items():
            self.assertNotRegex(words, r"None|simulating (,|$)", name)
        self.assertEqual(known.words["sweep_03"], "point 3 of 60")
        self.assertEqual(known.words["table1_knot"], "the runs of knot")
        self.assertEqual(known.words["fig12_movie"], "making the movie")
        self.assertEqual(known.words["fig07_data"], "computing it exactly")

    def test_the_table_of_jobs_is_read(self):
        counts = (("all", 1), ("fig07", 1), ("fig07_data", 1), ("total", 3))
        rows = "".join(f"{name:12}{count:7}\n" for name, count in counts)
        text = f"Building DAG of jobs...\nJob stats:\njob           count\n----------  -------\n{rows}\n"
        self.assertEqual(progress.due_by_snakemake(text), ["fig07", "fig07_data"])
        self.assertIsNone(progress.due_by_snakemake(text[:60]))


class Shown(Scratch):
    def test_a_file_gets_a_line_a_step_and_every_half_minute(self):
        out = io.StringIO()
        screen = progress.Screen(out)
        screen.show("one", True)
        screen.show("two", False)
        screen.said -= progress.SAY
        screen.show("three", False)
        self.assertEqual(out.getvalue(), "one\nthree\n")

    def test_a_terminal_gets_one_line_that_is_redrawn_and_cut_to_its_width(self):
        ours, theirs = pty.openpty()
        self.addCleanup(os.close, ours)
        with os.fdopen(theirs, "w") as stream:
            screen = progress.Screen(stream)
            screen.show("x" * 1000, False)
            screen.show("two", False)
            screen.keep("kept")
            shown = ""
            while not shown.endswith("\n"):  # a terminal may hand over in pieces what was written at once
                shown += os.read(ours, 10000).decode()
        self.assertEqual(shown.count("\n"), 1)
        self.assertLess(len(shown), 600)
        self.assertTrue(shown.endswith("\rtwo\x1b[K\r\x1b[Kkept\r\n"), repr(shown[-40:]))


class Whole(Scratch):
    """The words of a workflow with a stand-in for `ogc`."""

    def setUp(self):
        super().setUp()
        self.ogc = self.folder / "ogc"
        self.ogc.write_text(OGC)
        self.ogc.chmod(0o755)
        self.runs = self.folder / "runs"
        self.runs.mkdir()
        self.variables = {**os.environ, "PYTHONPATH": str(SOURCE), "XDG_CACHE_HOME": str(self.folder / "cache")}

    def words(self, command, *names, **variables):
        begun = [sys.executable, "-m", "paper_figures.workflow.progress", str(self.runs), "smoke", "cpu", *names, "--"]
        return subprocess.Popen([*begun, *map(str, command)], cwd=SOURCE, env={**self.variables, **variables},
                                stderr=subprocess.PIPE, stdout=subprocess.PIPE, text=True)

    def in_order(self, **variables):
        command = [sys.executable, "-m", "paper_figures.workflow.in_order", self.runs, self.ogc, "smoke", "cpu",
                   "fig07"]
        return self.words(command, "fig07", **variables)

    def check(self, process, raw):
        out, said = process.communicate(timeout=120)
        self.assertNotEqual(process.returncode, 0, "the stand-in's data can't be drawn")
        self.assertEqual(out, "")
        lines = said.splitlines()
        self.assertRegex(lines[0], r"^Step 1 of 2, fig07 \(.+\): computing it exactly(, 3 of 4)?; (about|at least) \d+ "
                                   r"s left$")
        self.assertRegex(said, r"\nStep 1 of 2, fig07 \(.+\): computing it exactly took \d+ s\n")
        self.assertRegex(said, r"\nfig07 \(.+\): FAILED \(exit status 1\): ")
        log = self.runs.resolve() / progress.LOG
        self.assertEqual(lines[-1], f"1 of 2 steps FAILED, 1 done; what the workflow said: {log}")
        self.assertNotIn(raw, said)
        self.assertIn(raw, (self.runs / progress.LOG).read_text())

    def test_without_snakemake(self):
        self.check(self.in_order(OGC_SLOW="1"), "fig07_data → illustrations/fig07.json")

    @unittest.skipUnless(importlib.util.find_spec("snakemake"), "Snakemake is not installed: its part is left out")
    def test_with_snakemake(self):
        command = [sys.executable, "-m", "snakemake", "-s", SOURCE / "paper_figures/workflow/Snakefile", "-d",
                   self.runs,
                   "--nolock", "--cores", "1", "--config", "figures=fig07", "scale=smoke", f"ogc={self.ogc}"]
        self.check(self.words(command, "fig07", OGC_SLOW="1"), "Building DAG of jobs")

    def test_nothing_due_and_a_workflow_that_fails_by_itself(self):
        for program, status, words in ((["true"], 0, "Nothing is missing or changed\n"),
                                       (["sh", "-c", "echo no such rule; exit 4"], 4, "no such rule")):
            process = self.words(program, "fig07")
            _, said = process.communicate(timeout=60)
            self.assertEqual(process.returncode, status)
            self.assertIn(words, said)

    def test_an_interrupt_says_that_what_is_finished_is_kept(self):
        process = self.in_order(OGC_SLOW="20")
        self.assertIn("computing it exactly", process.stderr.readline())
        time.sleep(1)
        children = (Path(f"/proc/{process.pid}/task/{process.pid}/children")).read_text().split()
        for pid in (*children, process.pid):  # a terminal's Ctrl-C reaches them all
            os.kill(int(pid), signal.SIGINT)
        _, said = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 130)
        self.assertIn("What is finished is kept: call it again to go on", said)


class Building(Scratch):
    """experiments/dependencies.sh with a stand-in for ninja."""

    def build(self, terminal, fail=False):
        tools = self.folder / "tools"
        tools.mkdir()
        failing = 'echo "FAILED: x.o"; echo "x.cpp:1: error: no"; exit 1\n' if fail else ""
        compiling = 'for i in 1 2 3 4; do echo "[$i/8] Building x.o"; sleep 1; done'
        (tools / "ninja").write_text(f"#!/bin/sh\n{compiling}\n{failing}")
        (tools / "ninja").chmod(0o755)
        (self.folder / "root/build/p").mkdir(parents=True)
        (self.folder / "root/build/p/build.ninja").touch()
        script = (f'set -euo pipefail; . "{SOURCE}/experiments/dependencies.sh"; seconds_between_lines=2; '
                  f"PATH={tools}:$PATH; build {self.folder}/root p all")
        ours, theirs = pty.openpty() if terminal else os.pipe()
        done = subprocess.run(["bash", "-c", script], stderr=theirs, timeout=60, check=False)
        os.close(theirs)
        said = b""
        try:
            while more := os.read(ours, 10000):
                said += more
        except OSError:  # a terminal that nobody holds any more
            pass
        os.close(ours)
        return done.returncode, said.decode()

    def test_a_terminal_sees_one_line_that_is_redrawn(self):
        status, said = self.build(True)
        self.assertEqual(status, 0)
        self.assertRegex(said, r"\rbuilding [1-4] of 8(, about \d+ s left)?\x1b\[K")
        self.assertRegex(said, r"building [34] of 8, about [2-6] s left")
        self.assertEqual(said.count("\n"), 1, said)

    def test_a_file_gets_a_line_now_and_then_and_what_failed(self):
        status, said = self.build(False, True)
        self.assertEqual(status, 1)
        self.assertRegex(said, r"\nbuilding [234] of 8, about \d+ s left\n")
        self.assertIn("FAILED: x.o\nx.cpp:1: error: no\n", said)


if __name__ == "__main__":
    unittest.main()
