"""The steps of figures on one machine: which are due, that nothing is beside a step that uses all cores, that an
interrupt keeps what is finished, and what `reproduce` says meanwhile. Also what a build says.

Usage: local.py SOURCE_DIR. Exit status 77: skipped, PyYAML or matplotlib is missing.
"""

import io
import os
import pty
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

SOURCE = Path(sys.argv.pop(1)).resolve()
sys.path.insert(0, str(SOURCE))
try:
    import matplotlib  # noqa: F401  (the steps draw with it)
    from paper_figures.workflow import job, local, recipes
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
        self.known = local.Known(self.folder, "smoke", "cpu", ["fig18", "fig07"])
        self.known.seconds.update({"fig18_run": 100, "fig07": None})
        self.course = local.Course(self.known, ["fig18_run", "fig18", "fig07"], lambda: self.now)

    def test_the_line_says_figure_step_and_time_from_what_steps_took_before(self):
        self.course.begins("fig18_run")
        self.now = 10
        begin = r"^Step 1 of 3, fig18 \(.+\): simulating cloth_on_sphere; "
        self.assertRegex(self.course.line(), begin + "at least 2 min left$")
        self.course.due.remove("fig07")  # its duration is unknown
        self.assertRegex(self.course.line(), r"^Step 1 of 2, .*; about 2 min left$")  # 90 of the run, 40 of drawing

    def test_how_far_the_running_program_says_it_is_counts_more(self):
        self.course.begins("fig18_run")
        log = self.known.logs["fig18_run"]
        log.parent.mkdir(parents=True, exist_ok=True)
        log.write_text("step 1/30, 2 ms a step\nstep 10/30, 2 ms a step, 3 contacts\n")
        self.now, self.course.due = 5, ["fig18_run"]
        self.assertRegex(self.course.line(), "simulating cloth_on_sphere, 10 of 30; about 10 s left$")

    def test_of_a_study_runs_count_and_not_the_steps_of_one(self):
        known = local.Known(self.folder, "smoke", "cpu", ["ablation_membrane"])
        course = local.Course(known, ["ablation_membrane"], lambda: self.now)
        course.begins("ablation_membrane")
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
        self.course.begins("fig18_run")
        self.course.ends("fig18_run", 7)
        self.assertRegex(self.course.said[0], r"^Step 1 of 3, fig18 .*: simulating cloth_on_sphere took 7 s$")
        self.course.begins("fig18")
        self.course.begins("fig07")
        self.assertRegex(self.course.line(), r"^Step 2 of 3, .*, 1 more beside it; at least 40 s left$")

    def test_a_failure_is_said_at_once_with_its_words(self):
        self.course.begins("fig18_run")
        self.course.fails("fig18_run", "FAILED (exit status 3): ogc run")
        self.assertRegex(self.course.said[0], r"^fig18 .*: FAILED \(exit status 3\): ogc run$")
        self.assertEqual(self.course.line(), "")

    def test_every_recipe_has_words_for_every_step(self):
        known = local.Known(self.folder, "smoke", "cpu", ["all", "ablations"])
        for name, words in known.words.items():
            self.assertNotRegex(words, r"None|simulating (,|$)", name)
        self.assertEqual(known.words["table1_knot"], "the runs of knot")
        self.assertEqual(known.words["fig12_movie"], "making the movie")
        self.assertEqual(known.words["fig07_data"], "computing it exactly")


class Shown(Scratch):
    def test_a_file_gets_a_line_a_step_and_every_half_minute(self):
        out = io.StringIO()
        screen = local.Screen(out)
        screen.show("one", True)
        screen.show("two", False)
        screen.said -= local.SAY
        screen.show("three", False)
        self.assertEqual(out.getvalue(), "one\nthree\n")

    def test_a_terminal_gets_one_line_that_is_redrawn_and_cut_to_its_width(self):
        ours, theirs = pty.openpty()
        self.addCleanup(os.close, ours)
        with os.fdopen(theirs, "w") as stream:
            screen = local.Screen(stream)
            screen.show("x" * 1000, False)
            screen.show("two", False)
            screen.keep("kept")
            shown = ""
            while not shown.endswith("\n"):  # a terminal may hand over in pieces what was written at once
                shown += os.read(ours, 10000).decode()
        self.assertEqual(shown.count("\n"), 1)
        self.assertLess(len(shown), 600)
        self.assertTrue(shown.endswith("\rtwo\x1b[K\r\x1b[Kkept\r\n"), repr(shown[-40:]))


class Due(Scratch):
    """Of one step, why it is due."""

    def setUp(self):
        super().setUp()
        self.output, self.input = self.folder / "run/out", self.folder / "in"
        self.input.touch()
        self.step = recipes.Step("one", str(self.output), (str(self.input),), ("touch", str(self.output)))

    def why(self, made=(), step=None):
        return local.why_due(step or self.step, set(made))

    def test_missing_done_newer_input_other_command_and_interrupted(self):
        self.assertIn("is missing", self.why())
        job.run(self.step.log, self.output, self.step.command)
        self.assertEqual(self.why(), "")
        self.assertIn("made anew", self.why([str(self.input)]))
        other = recipes.Step("one", str(self.output), (), ("touch", str(self.output), "more"))
        self.assertEqual(self.why(step=other), "its command is another")
        os.utime(self.input, (time.time() + 9, time.time() + 9))
        self.assertIn("is newer", self.why())
        with self.assertRaises(job.StepFailure):
            job.run(self.step.log, self.output, ["false"])
        self.assertIn("interrupted", self.why())

    def test_what_another_machine_made_is_done(self):
        self.output.parent.mkdir()
        self.output.touch()
        self.assertEqual(self.why(), "")

    def test_nothing_is_beside_a_step_that_uses_all_cores(self):
        cores, beside, at_work = local.Cores(3), [], []
        steps = [recipes.Step(str(k), "", (), (), all_cores=k % 4 == 0) for k in range(12)]

        def work(step):
            with cores.taken(step):
                at_work.append(step)
                time.sleep(0.01)
                beside.append((step.all_cores, len(at_work)))
                at_work.remove(step)

        with ThreadPoolExecutor(max_workers=12) as pool:
            list(pool.map(work, steps))
        self.assertEqual({count for alone, count in beside if alone}, {1})
        self.assertLessEqual(max(count for _, count in beside), 3)


class Whole(Scratch):
    """All of it with a stand-in for `ogc`."""

    def setUp(self):
        super().setUp()
        self.ogc = self.folder / "ogc"
        self.ogc.write_text(OGC)
        self.ogc.chmod(0o755)
        self.runs = self.folder / "runs"

    def begun(self, *words, **variables):
        command = [sys.executable, "-m", "paper_figures.workflow.local", self.runs, self.ogc, "smoke", "cpu", *words]
        return subprocess.Popen(list(map(str, command)), cwd=SOURCE, env={**os.environ, **variables},
                                stderr=subprocess.PIPE, stdout=subprocess.PIPE, text=True)

    def said(self, *words, status=0, **variables):
        process = self.begun(*words, **variables)
        out, said = process.communicate(timeout=120)
        self.assertEqual((process.returncode, out), (status, ""), said)
        return said

    def test_what_is_due_is_said_done_and_not_done_again_but_for_what_failed(self):
        self.assertRegex(self.said("fig07", "--dry-run"), r"fig07_data → illustrations/fig07.json: .* is missing\n"
                                                          r"fig07 → illustrations/fig07.png: .* is missing\n")
        said = self.said("fig07", OGC_SLOW="1", status=1)
        self.assertRegex(said, r"^Step 1 of 2, fig07 \(.+\): computing it exactly(, 3 of 4)?; (about|at least) \d+ s "
                               r"left\n")
        self.assertRegex(said, r"\nStep 1 of 2, fig07 \(.+\): computing it exactly took \d+ s\n")
        self.assertRegex(said, r"\nfig07 \(.+\): FAILED \(exit status 1\): ")  # the stand-in's data can't be drawn
        self.assertTrue(said.endswith("1 of 2 steps FAILED, 1 done\n"), said)
        again = self.said("fig07", "--dry-run")
        self.assertNotIn("fig07_data", again)
        (self.runs / "illustrations/fig07.png").touch()
        self.assertIn("interrupted, or failed", self.said("fig07", "--dry-run"))
        self.ogc.write_text(OGC + "# another program\n")
        self.assertIn("program.txt is newer", self.said("fig07", "--dry-run"))

    def test_an_interrupt_keeps_what_is_finished(self):
        process = self.begun("fig07", OGC_SLOW="20")
        self.assertIn("computing it exactly", process.stderr.readline())
        process.send_signal(signal.SIGINT)
        _, said = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 130, said)
        self.assertIn("What is finished is kept: call it again to go on", said)
        self.assertNotIn("FAILED", said)

    def test_a_figure_that_is_not_there_is_refused(self):
        self.assertIn("no figure or scene 'fig99'", self.said("fig99", status=1))


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
