"""The runner: what is finished is kept, what was cut off goes on, a limit ends with 75, what is packed and unpacked is
what the figures' scripts want to find.

Usage: runner.py SOURCE_DIR OGC. The standard library is enough.
"""

import json
import os
import signal
import subprocess
import sys
import tarfile
import tempfile
import time
import unittest
from pathlib import Path

SOURCE, OGC = Path(sys.argv[1]).resolve(), str(Path(sys.argv[2]).resolve())
del sys.argv[1:3]
sys.path.insert(0, str(SOURCE))
from paper_figures.figures import table1  # noqa: E402
from paper_figures.figures.measured import growth  # noqa: E402
from paper_figures.workflow import commands, device_memory, job, jobs, layers  # noqa: E402
from paper_figures.workflow import packing, parts  # noqa: E402
from paper_figures.workflow.evidence import run_at  # noqa: E402
from paper_figures.workflow.jobs import FINISHED, KEPT, PROCESSOR_TIME, STOPPED, Job, Limit, Step  # noqa: E402

SPHERE = ("cloth_on_sphere", "--scale", "smoke")


class Scratch(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = Path(holder.name)

    def program(self, text, name="stand_in"):
        path = self.folder / name
        path.write_text(text)
        path.chmod(0o755)
        return path


class Until(Limit):
    """A limit that comes when there is such a file."""

    def __init__(self, folder, pattern):
        super().__init__()
        self.folder, self.pattern = folder, pattern

    def left(self):
        return 0.0 if any(self.folder.glob(self.pattern)) else super().left()


class OneJob(Scratch):
    LONG = Job("long", ("twist", "--scale", "smoke", "--steps", "150", "--set", "iterations=60", "--checkpoint", "0",
                        "--audit", "end"), processor_time=True)
    ENDLESS = tuple("100000" if word == "150" else word for word in LONG.arguments)

    def make(self, job):
        return job.make(OGC, self.folder)

    def cut(self):
        """The long run, stopped on its way."""
        return self.LONG.make(OGC, self.folder, Until(self.folder, "long/checkpoint.h5"))

    def test_a_run_stopped_at_the_limit_goes_on_and_is_then_kept(self):
        self.assertEqual(self.cut(), STOPPED)
        self.assertIn(jobs.manifest_of(self.folder / "long")["status"], ("interrupted", "running"))
        before = json.loads((self.folder / "long" / PROCESSOR_TIME).read_text())
        self.assertEqual([self.make(self.LONG), self.make(self.LONG)], [FINISHED, KEPT])
        self.assertIn("resumed", jobs.manifest_of(self.folder / "long"))
        self.assertEqual(len((self.folder / "long/steps.csv").read_text().splitlines()), 151)
        after = json.loads((self.folder / "long" / PROCESSOR_TIME).read_text())
        self.assertGreater(after["user [s]"], before["user [s]"], "of all attempts")

    def test_a_step_of_the_workflow_whose_run_was_cut_off_goes_on(self):
        command, log, output = [OGC, *self.LONG.words(self.folder)], self.folder / "log", self.folder / "long/run.json"
        with self.assertRaises(job.StepFailure):
            job.run(log, output, command, Until(self.folder, "long/checkpoint.h5"))
        job.run(log, output, command)
        self.assertIn("resumed", jobs.manifest_of(self.folder / "long"))
        job.run(log, output, command)
        self.assertNotIn("resumed", jobs.manifest_of(self.folder / "long"), "a finished run is made anew")

    def test_a_run_that_is_given_seconds_is_whole_when_they_are_over_and_it_has_its_steps(self):
        job = Job("by_time", self.ENDLESS, seconds=0.5, least=3)
        self.assertEqual([self.make(job), self.make(job)], [FINISHED, KEPT])
        said = json.loads((self.folder / "by_time" / jobs.ENDED_BY_TIME).read_text())
        steps = len((self.folder / "by_time/steps.csv").read_text().splitlines()) - 1
        self.assertEqual((said["seconds"], said["steps"]), (0.5, steps))
        self.assertGreaterEqual(steps, 3)
        packed = [path.name for path in job.results(self.folder, 2, 0)]
        self.assertLessEqual({"run.json", "steps.csv", jobs.ENDED_BY_TIME}, set(packed))

    def test_seconds_end_nothing_that_is_faster_or_that_the_limit_ends(self):
        job = Job("run", (*SPHERE, "--steps", 2), seconds=200, least=1)
        self.assertEqual(self.make(job), FINISHED)
        self.assertFalse((self.folder / "run" / jobs.ENDED_BY_TIME).exists())
        slow = Job("slow", self.ENDLESS, seconds=200, least=1)
        self.assertEqual(slow.make(OGC, self.folder, Until(self.folder, "slow/checkpoint.h5")), STOPPED)
        self.assertFalse((self.folder / "slow" / jobs.ENDED_BY_TIME).exists())

    def test_an_attempt_that_nobody_measured_leaves_no_processor_time(self):
        self.assertEqual(self.cut(), STOPPED)
        (self.folder / "long" / PROCESSOR_TIME).unlink()  # as if the runner had been killed with it
        self.assertEqual(self.make(self.LONG), FINISHED)
        self.assertFalse((self.folder / "long" / PROCESSOR_TIME).exists())

    def test_processor_time_is_that_of_the_process_alone(self):
        spin = "import time\nend = time.process_time() + 0.3\nwhile time.process_time() < end: pass"
        sum(k for k in range(10**6))
        code, used = jobs.command_in([sys.executable, "-c", spin], log=self.folder / "log")
        self.assertEqual(code, 0)
        self.assertGreaterEqual(sum(used.values()), 0.3)
        self.assertLess(sum(jobs.command_in(["true"], log=self.folder / "log")[1].values()), 0.3)

    def test_another_command_in_the_same_folder_is_run_anew(self):
        short, longer = (Job("run", (*SPHERE, "--steps", steps)) for steps in (2, 3))
        self.assertEqual([self.make(job) for job in (short, short, longer)], [FINISHED, KEPT, FINISHED])

    def test_a_run_that_cannot_go_on_begins_anew(self):
        for field in ("commit", "dirty"):  # another program's
            self.assertEqual(self.cut(), STOPPED)
            manifest = self.folder / "long/run.json"
            about = json.loads(manifest.read_text())
            about[field] = not about[field] if field == "dirty" else f"0{about[field]}"
            manifest.write_text(json.dumps(about))
            self.assertEqual(self.make(self.LONG), FINISHED)
            self.assertNotIn("resumed", jobs.manifest_of(self.folder / "long"))
            jobs.remove(self.folder / "long")

    def test_a_failure_is_a_result_where_a_step_failed_and_not_where_the_disk_was_taken_away(self):
        job = Job("run", (*SPHERE, "--steps", "2"), may_fail=True)
        self.assertEqual(self.make(job), FINISHED)
        manifest = self.folder / "run/run.json"
        about = json.loads(manifest.read_text())
        for status, is_result in (("Newton's method did not converge in step 34: residual 0.00186", True),
                                  ("the audit of step 7 failed (meeting_7.obj): 2 pairs of faces intersect", True),
                                  ("run/trajectory.vtkhdf.growing: can't open the file (No such file or directory): "
                                   "its folder or disk was taken away", False)):
            manifest.write_text(json.dumps({**about, "status": f"failed: {status}"}))
            self.assertEqual(job.done(self.folder), is_result, status)

    def test_a_run_begins_with_the_frame_after_a_step_or_at_a_share_if_there_is_one(self):
        self.assertEqual(self.make(Job("run", (*SPHERE, "--steps", "6", "--set", "frame_steps=2"))), FINISHED)
        for place, steps in ((Step(4), ["5"]), (jobs.Share(50, 2), ["3"]), (jobs.Share(100, 2), ["7"]), (0, ["1"])):
            window = Job("window", SPHERE, ("run", place), more_steps=1)
            self.assertEqual(self.make(window), FINISHED)
            rows = (self.folder / "window/steps.csv").read_text().splitlines()[1:]
            self.assertEqual([row.partition(",")[0] for row in rows], steps, place)
        with self.assertRaisesRegex(jobs.RunFailure, "begins with a frame of .*, which does not have it"):
            self.make(Job("window", SPHERE, ("run", Step(5))))
        with self.assertRaisesRegex(jobs.RunFailure, "none has no step yet: make that run first"):
            self.make(Job("window", SPHERE, ("none", jobs.Share(50, 2))))

    def test_a_frame_with_which_jobs_begin_elsewhere_is_packed_and_is_enough_there(self):
        whole = Job("run", (*SPHERE, "--steps", "6", "--set", "frame_steps=2"), begins=(jobs.Share(50, 2),))
        self.assertEqual(self.make(whole), FINISHED)
        packed, home = self.folder / "packed", self.folder / "home"
        packing.Archive(packed, self.folder).write({"part": parts.Part(".", ((whole,),), frames=0)})
        self.assertEqual(packing.unpack(packed, home, OGC), [home / "run"])
        self.assertEqual([path.name for path in (home / "run/frames").iterdir()], ["frame_000002.h5"])
        self.assertFalse((home / "run/scene").exists() or (home / "run/trajectory.vtkhdf").exists())
        self.assertTrue(whole.done(home))
        window = Job("window", SPHERE, ("run", jobs.Share(50, 2)), more_steps=1)
        self.assertEqual(window.make(OGC, home), FINISHED)

    def test_a_packed_run_is_done_without_the_frame_with_which_it_began(self):
        whole = Job("run", (*SPHERE, "--steps", "6", "--set", "frame_steps=2"))
        self.assertEqual(self.make(whole), FINISHED)
        windows = [Job(f"window_{number}", SPHERE, ("run", place), more_steps=1)
                   for number, place in enumerate((Step(4), jobs.Share(50, 2), -1))]
        self.assertEqual([self.make(window) for window in windows], [FINISHED] * 3)
        packed, home = self.folder / "packed", self.folder / "home"
        packing.Archive(packed, self.folder).write({"part": parts.Part(".", ((whole, *windows),), frames=0)})
        packing.unpack(packed, home, OGC)
        self.assertFalse((home / "run/frames").exists())
        self.assertEqual([window.done(home) for window in windows], [True] * 3)
        self.assertFalse(Job("window_0", SPHERE, ("run", Step(2)), more_steps=1).done(home))

    def test_a_failure_has_its_command_and_last_words(self):
        with self.assertRaisesRegex(jobs.RunFailure, "(?s)run no_scene .*exit status 2.*no_scene"):
            self.make(Job("run", ("no_scene",)))

    def test_a_job_that_does_not_stop_is_killed(self):
        deaf = self.program(f"#!/bin/sh\ntrap '' INT\n: > {self.folder}/deaf\nwhile :; do sleep 0.05; done\n")
        jobs.SECONDS_TO_STOP, before = 0.3, jobs.SECONDS_TO_STOP
        self.addCleanup(setattr, jobs, "SECONDS_TO_STOP", before)
        self.assertEqual(jobs.command_in([deaf], Until(self.folder, "deaf"), self.folder / "log")[0], -signal.SIGKILL)

    def test_a_limit_within_another_comes_with_it(self):
        whole = Limit()
        part = Limit(1000, whole)
        self.assertGreater(part.left(), 900)
        whole.stop()
        self.assertEqual((part.left(), Limit(0).left()), (0, 0))


class Called(Scratch):
    """The command, as it is called."""

    OPTIONS = ["--scale", "smoke", "--backend", "cpu", "--window", "3"]
    COMMAND = [sys.executable, "-m", "paper_figures.workflow.runner"]

    def call(self, out, *words):
        command = [*self.COMMAND, "--out", out, "--program", OGC, *self.OPTIONS, *words]
        return subprocess.run(list(map(str, command)), cwd=SOURCE, capture_output=True, text=True, check=False)

    def say(self, out, *words, status=0):
        done = self.call(out, *words)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return done.stdout.splitlines()

    def test_made_kept_packed_unpacked_and_found_finished(self):
        there, home, packed = self.folder / "there", self.folder / "home", self.folder / "packed"
        wanted = ["fig20", "cloth_on_sphere", "windows_cloth_on_sphere"]
        self.assertEqual([line.split()[3] for line in self.say(there, *wanted)], ["finished"] * 3)
        lines = self.say(there, "--pack", packed, *wanted)
        self.assertEqual([line.split()[3] for line in lines[:3]], ["kept"] * 3)
        self.assertEqual({line.split()[0] for line in lines[3:-1]}, {f"{name}:" for name in wanted})
        self.assertEqual(len(self.say(there, "--pack", packed, *wanted)), 3, "nothing is packed twice")
        self.assertEqual(len(list(packed.iterdir())), 1)
        self.assertEqual(len(self.say(home, "--unpack", packed)), 13)
        part = parts.book(parts.Wanted("smoke", "cpu"))["fig20"]
        job, = part.jobs
        self.assertTrue(job.done(home / part.folder))
        frames = [len(list((place / part.folder / job.name / "frames").iterdir())) for place in (there, home)]
        self.assertEqual(frames[1], min(25, frames[0]))
        for path in (home / part.folder / job.name, home / "fig18-smoke-cpu/run"):
            self.assertTrue((path / "trajectory.vtkhdf").is_file() and not path.is_symlink(), path)
        rows = table1.rows_of(home / "table1-smoke-cpu")
        self.assertEqual([(row["scene"], row["backend"]) for row in rows], [("cloth_on_sphere", "cpu")] * 2)
        self.assertEqual(rows[0]["audited states"], "31, no intersection", "all, though not all frames came along")

    def test_a_limit_ends_with_75_and_calls_go_on_until_all_is_finished(self):
        out, calls, ends = self.folder / "out", 0, []
        while not ends or ends[-1] == 75:
            calls += 1
            limit = 0.3 * 1.2**calls  # one of them ends within the run, none stays too short
            done = self.call(out, "--time-limit", limit, "--pack", self.folder / "packed", "twist")
            ends.append(done.returncode)
        self.assertEqual((ends[0], ends[-1]), (75, 0), done.stdout + done.stderr)
        self.assertIn("resumed", json.loads((out / "table1-smoke-cpu/twist/whole/run.json").read_text()))
        self.assertEqual(self.say(out, "twist")[0].split()[3], "kept")
        home = self.folder / "home"
        self.say(home, "--unpack", self.folder / "packed")
        for place in (out, home):
            row, = table1.rows_of(place / "table1-smoke-cpu")
            self.assertEqual((row["steps"], row["status"]), (row["of steps"], "finished"))
            self.assertEqual(len(row[table1.FRESH].split(";")), 5)

    def test_what_is_not_begun_at_the_limit_says_so(self):
        lines = self.say(self.folder, "--time-limit", "0.01", "fig12", "fig20", status=75)
        self.assertRegex(lines[1], "fig20 +not begun: no time is left; call again to go on")

    def test_sigterm_is_a_limit_that_comes_now(self):
        command = [*self.COMMAND, "--out", self.folder, "--program", OGC, *self.OPTIONS, "fig12"]
        runner = subprocess.Popen(list(map(str, command)), cwd=SOURCE, stdout=subprocess.PIPE, text=True)
        while not (self.folder / "table1-smoke-cpu/twist_planes/whole/frames").is_dir():
            time.sleep(0.01)
        runner.terminate()
        said, _ = runner.communicate()
        self.assertEqual((runner.returncode, "stopped at the limit" in said), (75, True), said)

    def test_a_figure_of_a_rows_scene_finds_its_run(self):
        self.say(self.folder, "fig12", "--steps", "4")
        link = self.folder / "fig12-smoke-cpu/run"
        self.assertTrue(link.is_symlink())
        self.assertEqual(len((link / "steps.csv").read_text().splitlines()), 5)
        self.assertEqual(json.loads((link / "audit.json").read_text())["complete"], True)

    def test_jobs_side_by_side_are_made_kept_and_packed_once(self):
        there, home, packed = self.folder / "there", self.folder / "home", self.folder / "packed"
        words = ("--cores", "2", "--steps", "8", "--pack", packed, "mat_twist_planes", "fig19", "fig20")
        lines = self.say(there, *words)
        self.assertEqual({line.split()[7].rstrip(";") for line in lines if " s on " in line}, {"finished"}, lines)
        self.assertTrue((there / "fig19-smoke-cpu/planes/whole").is_symlink())
        archive, = packed.iterdir()
        with tarfile.open(archive) as found:
            names = found.getnames()
        self.assertTrue([name for name in names if name.startswith("fig19-smoke-cpu/ball/whole/")])
        self.assertFalse([name for name in names if name.startswith("fig19-smoke-cpu/planes/")], "the row's run is")
        again = self.say(there, *words)
        self.assertEqual({line.split()[7].rstrip(";") for line in again if " s on " in line}, {"kept"}, again)
        self.assertEqual(len(list(packed.iterdir())), 1, "nothing is packed twice")
        self.say(home, "--unpack", packed)
        self.assertTrue((home / "fig19-smoke-cpu/planes/whole/run.json").is_file())
        plan = self.say(there, *words, "--plan", "--known", there / "times.json")
        self.assertRegex(plan[0], r"\d+ jobs, \d+ s of a core, \d+ s of 2 cores; the longest chain, \d+ s: .*/")

    def test_whole_runs_are_as_many_and_as_long_as_asked(self):
        self.say(self.folder, "twist", "--steps", "10", "--runs", "2", "--audit", "every")
        row, = table1.rows_of(self.folder / "table1-smoke-cpu")
        self.assertEqual((row["runs"], row["steps"], row["audited states"]), (2, 10, "10, no intersection"))

    def test_solvers_of_fig_18_are_made_one_by_one_with_their_processor_time(self):
        there, home, packed = self.folder / "there", self.folder / "home", self.folder / "packed"
        self.assertEqual(self.say(there, "--pack", packed, "fig18_solvers")[0].split()[3], "finished")
        self.say(home, "--unpack", packed)
        ended = []
        for name in ("ipc", "newton", "vbd"):
            run = home / "fig18_solvers-smoke-cpu" / name
            manifest = jobs.manifest_of(run)
            self.assertEqual((manifest["solver"], manifest["device"]),
                             (name, f"{len(os.sched_getaffinity(0))} threads"))
            self.assertGreater(json.loads((run / PROCESSOR_TIME).read_text())["user [s]"], 0)
            ended.append(manifest["ended"])
        self.assertEqual(ended, sorted(ended))
        chain, = parts.book(parts.Wanted("paper", "cuda"))["fig18_solvers"].chains
        self.assertEqual([job.name for job in chain], ["ipc", "newton", "vbd", "vbd_cuda"])

    def test_each_part_is_packed_as_soon_as_it_is_finished(self):
        """What was killed in the second part must have left the first."""
        there, home, packed = self.folder / "there", self.folder / "home", self.folder / "packed"
        code = ("import sys\nfrom paper_figures.workflow import runner\nmake = runner.Runner.make\n"
                "runner.Runner.make = lambda self, name, part: make(self, name, part) if name == 'fig20' else "
                "sys.exit(9)\n"
                "runner.main()")
        command = [sys.executable, "-c", code, "--out", there, "--program", OGC, *self.OPTIONS, "--pack", packed]
        done = subprocess.run(list(map(str, [*command, "fig20", "fig12"])), cwd=SOURCE, capture_output=True,
                              check=False)
        self.assertEqual(done.returncode, 9)
        self.assertEqual(self.say(home, "--unpack", packed), [str(home / "fig20-smoke-cpu/vbd")])

    def test_an_archive_that_is_cut_or_leads_elsewhere_is_refused_and_nothing_is_written(self):
        packed, out = self.folder / "packed", self.folder / "above/out"
        packed.mkdir()
        out.mkdir(parents=True)
        (out / "elsewhere").symlink_to(self.folder)
        path = packed / "runs_01.tar.gz"

        def refused(*names, kind=tarfile.REGTYPE, end=None):
            with tarfile.open(path, "w:gz") as archive:
                for name in ("a/run.json", *names):
                    info = tarfile.TarInfo(name)
                    info.type, info.linkname = (kind, "/etc") if name != "a/run.json" else (tarfile.REGTYPE, "")
                    archive.addfile(info)
            path.write_bytes(path.read_bytes()[:end])
            done = self.call(out, "--unpack", packed)
            self.assertEqual((done.returncode, [entry.name for entry in out.iterdir()]), (1, ["elsewhere"]), names)
            return done.stderr

        for name in ("/tmp/x", "../x", "b/../../x", "elsewhere/x"):
            self.assertIn(f"'{name}' is no plain file, or would be written outside the folder", refused(name))
        for kind in (tarfile.SYMTYPE, tarfile.LNKTYPE, tarfile.FIFOTYPE, tarfile.DIRTYPE):
            self.assertIn("'link' is no plain file", refused("link", kind=kind))
        self.assertIn("runs_01.tar.gz is cut or damaged", refused(end=-20))

    def test_wrong_words_exit_2(self):
        for words, said in ((["twisted"], "no part or figure 'twisted'"),
                            (["--figures", "twist"], "no part or figure 'twist'"),
                            (["--windw", "3"], "--windw"),
                            (["--cores", "2", "--backend", "cuda"], "--cores is for --backend cpu"),
                            (["--program", "/nowhere"], "no program at '/nowhere'")):
            done = self.call(self.folder, *words)
            self.assertEqual((done.returncode, said in done.stderr), (2, True), done.stderr)


class Book(Scratch):
    def test_rows_are_those_of_the_table_and_the_largest_is_last_on_the_cpu(self):
        book = parts.book(parts.Wanted())
        self.assertEqual(set(parts.ROWS), set(table1.ROWS))
        windows = [name for name in book if name.startswith("windows_")]
        self.assertEqual((len(windows), {commands.scene_of(name) for name in windows[-2:]}),
                         (len(parts.ROWS), {"windows_fifty_layers_1m"}))

    def test_the_whole_runs_of_fig_19_are_those_of_its_rows(self):
        book = parts.book(parts.Wanted())
        for bounds, (row, _) in commands.MAT_BOUNDS.items():
            of_row, of_figure = book[row].jobs[0], next(job for job in book["fig19"].jobs
                                                        if job.name == f"{bounds}/whole")
            self.assertEqual(of_row.arguments, of_figure.arguments)
            self.assertEqual(book[row].shown_as, f"fig19-paper-cuda/{of_figure.name}")
            self.assertEqual(parts.SHOWN[row], of_figure.name)

    def test_a_figure_is_all_of_its_parts_and_a_part_itself(self):
        book = parts.book(parts.Wanted())
        self.assertEqual(list(parts.chosen(book, ["fig02"])), ["fig02"])
        self.assertEqual(set(parts.chosen(book, [], ["fig02", "growth"])),
                         {"fig02", "growth_cuda", "growth_cpu", "contacts", "threads"})
        everything = parts.chosen(book)
        self.assertLessEqual({"twist", "windows_knot", "fig21", "minimiser"}, set(everything))
        self.assertNotIn("judge", everything)

    def test_fewer_iterations_before_the_step_of_fig_17_change_its_start_alone(self):
        whole, fewer = commands.three_cloths("paper", ["cpu"]), commands.three_cloths("paper", ["cpu"], 40)
        self.assertEqual(fewer[0][0].arguments, (*whole[0][0].arguments[:-1], "iterations=40"))
        self.assertEqual((fewer[0][1:], fewer[1]), (whole[0][1:], whole[1]))

    def test_other_steps_of_fig_17_begin_with_states_that_its_start_stores(self):
        (start, *single), double = commands.three_cloths("paper", ["cpu"])
        others = [job for job in (*single, *double) if "_at_" in job.name]
        solvers = {job.name.split("_at_")[0] for job in others}
        by_newton = {f"newton{bounds}" for bounds in ("", "_any", "_any_pairs", "_any_pairs_narrow")}
        self.assertEqual(solvers, {"vbd_cpu_any", *by_newton})
        self.assertEqual(len(others), len(solvers) * len(commands.THREE_CLOTHS_OTHERS["paper"]))
        between = round(100 / 60)  # steps of 1/100 s between two frames, 60 of them a second
        for job in others:
            name, before = job.state
            self.assertEqual((name, before.number % between), (start.name, 0))
            self.assertIn(before.number + 1, job.arguments)
            self.assertLess(before.number, start.arguments[start.arguments.index("--steps") + 1])

    def test_frames_are_the_first_evenly_on_to_the_last(self):
        (self.folder / "frames").mkdir()
        for step in range(0, 105, 5):
            (self.folder / f"frames/frame_{step:06d}.h5").touch()
        for frames, last, first, steps in ((4, 0, 0, [0, 35, 65, 100]), (0, 0, 0, []), (2, 2, 0, [0, 95, 100]),
                                           (2, 0, 2, [0, 5, 100])):
            found = jobs.chosen_frames(self.folder, frames, last, first)
            self.assertEqual([int(path.stem[-6:]) for path in found], steps)

    def test_an_audit_that_goes_on_is_packed_again_and_what_parts_share_once(self):
        run, home = self.folder / "there/t/twist/whole", self.folder / "home"
        run.mkdir(parents=True)
        (run / "run.json").write_text('{"status": "finished"}')
        book = {name: parts.Part("t", ((Job("twist/whole", ()),),)) for name in ("twist", "fig12")}
        for number, states in enumerate((1, 2), 1):
            (run / "audit.json").write_text(json.dumps({"states": states}))
            archive = packing.Archive(self.folder / "packed", self.folder / "there")
            archive.write(book)
            self.assertEqual(archive.path.name, f"runs_{number:02d}.tar.gz")
            self.assertEqual(packing.unpack(self.folder / "packed", home, OGC), [home / "t/twist/whole"])
            self.assertEqual(json.loads((home / "t/twist/whole/audit.json").read_text()), {"states": states})


class Memory(Scratch):
    def test_memory_is_sampled_while_a_run_goes_on_and_kept_over_the_next(self):
        for samples in ("100 700", "90 300"):
            command = ("sh", "-c", f"printf '%s\\n' {samples} none; exec sleep 9")
            with device_memory.DeviceMemory(self.folder / "x.json", True, command):
                time.sleep(0.2)
        found = json.loads((self.folder / "x.json").read_text())
        self.assertEqual(found, {"before [MiB]": 90, "largest [MiB]": 700, "samples": 2})
        with device_memory.DeviceMemory(self.folder / "y.json", True, ("no such program",)):
            pass
        self.assertFalse((self.folder / "y.json").exists())

    def test_the_memory_of_a_row_is_what_it_took_beyond_what_was_in_use(self):
        for row, before, largest, samples in (("twist", 500, 2500, 3), ("short", 0, 0, 1)):
            said = {"before [MiB]": before, "largest [MiB]": largest, "samples": samples}
            (self.folder / f"{row}{jobs.MEMORY}").write_text(json.dumps(said))
        taken = [device_memory.taken(self.folder / f"{row}{jobs.MEMORY}") for row in ("twist", "knot", "short")]
        self.assertEqual(taken, [2000, "", ""])

    def test_it_is_sampled_of_what_runs_on_a_device(self):
        on_device = [job.on_device for job in commands.whole_runs("twist", "paper", "cuda")]
        self.assertEqual(on_device, [True, False], "the audit is the CPU's")
        self.assertFalse(any(job.on_device for job in commands.cpu_windows("twist", 20, "paper")))


class Growth(Scratch):
    def contacts(self, side):
        """A vertex, after the first step."""
        Job(f"run_{side}", ("--audit", "end"), scene=layers.Stack(side, 1)).make(OGC, self.folder)
        run = run_at(self.folder / f"run_{side}")
        self.assertTrue(run.manifest["guarantee_kept"])
        self.assertEqual(sum(body["vertex_count"] for body in run.manifest["scene"]["bodies"] if not body["fixed"]),
                         layers.vertices(side))
        return table1.contacts(run)[0] / layers.vertices(side)

    def test_stacks_of_two_sizes_differ_in_density_by_their_rim_alone(self):
        """Of side² vertices of a sheet less than 4 side lie at the rim, and a rim vertex has at least half the contacts
        of an inner one: it loses one side of its neighbourhood. So density (1 - 2/side) D at least, and at most D."""
        small, large = self.contacts(10), self.contacts(20)
        self.assertGreater(large, small)
        self.assertLess(large, small / (1 - 2 / 10))
        self.assertGreater(small, 5)  # pairs of neighbouring sheets, not of the ground alone

    def test_a_power_law_and_its_words(self):
        rows = [{"over": "vertices", "backend": "cuda", "vertices": n, "median [ms]": 2e-3 * n**1.25,
                 "contacts a vertex": 7} for n in (10**4, 10**5, 10**6)]
        rows += [{"over": "threads", "backend": "cpu", "vertices": 9, "threads": n, "median [ms]": 8 / n,
                  "final_hash": bits} for n, bits in ((1, "a"), (4, "b"))]
        slope, factor = growth.exponent(rows[:3])
        self.assertAlmostEqual(slope, 1.25)
        self.assertAlmostEqual(factor, 2e-3)
        planes = [{**row, "bounds": "planes", "median [ms]": row["vertices"]} for row in rows[:3]]
        contacts = {"over": "contacts", "contacts": 2 * 10**7, "median [ms]": 200.0}
        self.assertEqual(growth.in_words([*planes, contacts]),
                         ["cuda, planes: time ∝ vertices^1.000 from 10,000 to 1,000,000, ^1.000 from 10,000 on; 7 to 7 "
                          "contacts a vertex", "20,000,000 contacts: 200 ms a step"])
        self.assertEqual(growth.in_words(rows), ["cuda: time ∝ vertices^1.250 from 10,000 to 1,000,000, ^1.250 from "
                                                 "10,000 on; 7 to 7 contacts a vertex",
                                                 "4 threads are 4 times as fast as 1 (9 vertices), NOT with the same "
                                                 "bits"])

    def test_the_last_state_with_many_contacts_is_audited_in_boxes(self):
        run, boxes = commands.many_contacts("smoke", "cpu")
        for job in (run, boxes):
            self.assertEqual(job.make(OGC, self.folder), FINISHED)
        self.assertEqual(boxes.make(OGC, self.folder), KEPT)
        row, = growth.table(self.folder)
        self.assertEqual((row["over"], row["repeated steps"], row["boxes"], row["seed"], row["wrong in boxes"]),
                         ("contacts", 0, commands.BOXES["smoke"], commands.SEED_OF_BOXES, 0))
        self.assertGreater(row["contacts in boxes"], row["contacts"] / 2)  # the boxes are nearly all cells
        self.assertEqual([path.name for path in boxes.results(self.folder, 0, 0)], ["boxes.json"])

    def test_threads_are_powers_of_two_and_all_cores(self):
        for cores, numbers in ((1, [1]), (6, [1, 2, 4, 6]), (16, [1, 2, 4, 8, 16])):
            self.assertEqual([int(job.name.rpartition("_")[2]) for job in commands.threads("paper", cores)], numbers)


if __name__ == "__main__":
    unittest.main()
