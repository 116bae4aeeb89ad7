"""The command that makes all evidence: what there is on a device and without one, what is kept, what goes on after a
limit, what is packed, which parts stay together, and which programs are refused.

Usage: everything.py SOURCE_DIR OGC. The standard library is enough.
"""

import csv
import io
import json
import os
import re
import subprocess
import sys
import tarfile
import tempfile
import unittest
from contextlib import redirect_stderr
from pathlib import Path
from unittest import mock

SOURCE, OGC = Path(sys.argv[1]).resolve(), str(Path(sys.argv[2]).resolve())
del sys.argv[1:3]
sys.path.insert(0, str(SOURCE))
from paper_figures.workflow import contents, everything, parts  # noqa: E402
from paper_figures.workflow.jobs import FINISHED, KEPT, STOPPED, Job, Limit, RunFailure, Step  # noqa: E402

CALL_AGAIN = 75
STUDIES = {"ablation_x": {scale: {backend: {"twist": ["ablate", "twist", "--backend", backend]}
                                  for backend in ("cpu", "cuda")} for scale in ("smoke", "small", "paper")}}
# A program that says which commit it is of, counts its calls, and answers as ogc does; `--laws` of it break.
STAND_IN = """#!{python}
import json, pathlib, sys, time
calls = pathlib.Path(__file__).with_suffix(".calls")
if sys.argv[1] == "--version":
    print("OGC Testbed\\ncommit {commit}\\nbackends\\n  cpu: usable (3 threads)")
    sys.exit()
calls.write_text((calls.read_text() if calls.is_file() else "") + " ".join(sys.argv[1:3]) + "\\n")
if sys.argv[1] == "compare":
    metric = {{"name": "force", "maximum": 0.5, "tolerance": 2.0}}
    print(json.dumps({{"stages": [{{"stage": "bound", "cases": 100, "mismatches": 0, "grey_share_generic": 0.0,
                                   "metrics": [metric], "seconds": 0.25}}]}}))
elif sys.argv[1] == "ablate":
    out = pathlib.Path(sys.argv[sys.argv.index("--out") + 1])
    out.mkdir(parents=True, exist_ok=True)
    (out / "ablation.csv").write_text("seed\\n1\\n")
else:
    time.sleep(600 if "{slow}" else 0)
    print("{{}}")
sys.exit({status} if sys.argv[1] == "laws" else 0)
"""


class Scratch(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = Path(holder.name).resolve()
        self.out = self.folder / "runs"

    def program(self, commit="a" * 40, status=0, slow=""):
        path = self.folder / "ogc"
        path.write_text(STAND_IN.format(python=sys.executable, commit=commit, status=status, slow=slow))
        path.chmod(0o755)
        return str(path)

    def call(self, *words, program=None):
        """Calls the command; returns exit status and what it printed."""
        command = [SOURCE / "experiments/evidence", "cores", "--scale", "smoke", "--out", self.out, "--changed",
                   "--program", program or self.folder / "ogc", *words]
        done = subprocess.run(list(map(str, command)), capture_output=True, text=True, check=False)
        return done.returncode, done.stdout + done.stderr

    @property
    def calls(self):
        path = self.folder / "ogc.calls"
        return path.read_text().splitlines() if path.is_file() else []


class Calls(Scratch):
    def test_what_is_finished_is_kept_and_another_program_makes_it_again(self):
        self.program()
        status, said = self.call("laws", "judge")
        self.assertEqual(status, 0, said)
        self.assertRegex(said, r"laws .* s  finished\njudge .* s  finished")
        made = len(self.calls)
        self.assertEqual(made, 1 + 2 * everything.SEEDS["smoke"])
        self.assertRegex(self.call("laws", "judge")[1], r"laws .* s  kept\njudge .* s  kept")
        self.assertEqual(len(self.calls), made)
        self.program(commit="b" * 40)
        self.assertRegex(self.call("laws")[1], r"laws .* s  finished")
        self.assertEqual(len(self.calls), made + 1)

    def test_a_limit_ends_with_75_and_the_next_call_goes_on(self):
        self.program(slow="yes")
        status, said = self.call("--time-limit", "1", "laws", "judge")
        self.assertEqual(status, CALL_AGAIN, said)
        self.assertIn("not begun: no time is left", said)
        self.program()
        self.assertEqual(self.call("laws", "judge")[0], 0)

    def test_a_check_that_failed_is_a_result_and_a_crash_a_failure(self):
        for status, ended in ((1, 0), (2, 1), (3, 1)):
            self.program(status=status, commit=f"{status}" * 40)
            self.assertEqual(self.call("laws")[0], ended)
        self.assertIn("exit status 3", self.call("laws")[1])
        self.program(status=1)
        self.call("laws")
        self.assertEqual(json.loads((self.out / "laws-smoke-cpu/all/made.json").read_text())["status"], 1)

    def test_tables_are_packed_as_parts_end(self):
        self.program()
        packed = self.folder / "packed"
        self.assertEqual(self.call("--pack", packed, "judge", "jittered")[0], 0)
        with tarfile.open(packed / "runs_01.tar.gz") as archive:
            names = archive.getnames()
        self.assertIn("judge-smoke-cpu/judge_cpu.csv", names)
        for scene in everything.JITTERED:
            for bounds in ("ball", "planes"):
                self.assertIn(f"jittered-smoke-cpu/starts/{bounds}/{scene}/runs/ablation.csv", names)
        self.call("--pack", packed, "judge", "laws")
        with tarfile.open(packed / "runs_02.tar.gz") as archive:
            self.assertEqual({name.partition("/")[0] for name in archive.getnames()},
                             {everything.STAMP, everything.TIMES, "laws-smoke-cpu"})

    def test_the_judge_s_table_has_a_row_for_each_stage_and_seed(self):
        self.program()
        self.call("judge")
        with (self.out / "judge-smoke-cpu/judge_cpu.csv").open(newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([row["seed"] for row in rows], ["1", "1", "2", "2"])
        self.assertEqual([rows[0][key] for key in ("stage", "cases", "largest errors over tolerances", "device",
                                                   "commit")], ["bound", "100", "force 0.5/2", "3 threads", "a" * 10])
        with (SOURCE / "paper_figures/results/h200/judge_cuda.csv").open(newline="") as file:
            self.assertEqual(list(rows[0]), next(csv.reader(file)), "the columns of the accepted table")

    def test_the_judge_is_asked_every_stage_that_the_program_has(self):
        listed = subprocess.run([OGC, "compare", "--list", "--json"], capture_output=True, text=True, check=True).stdout
        ours = {stage["name"] for stage in json.loads(listed)["stages"]} - {"barrier", "ccd"}  # of plug-ins alone
        self.assertEqual(sorted((*everything.CHEAP, *everything.DEAR)), sorted(ours))

    def test_a_dry_run_says_what_there_is_and_how_long_it_took(self):
        self.program()
        status, said = self.call("--dry-run", "--no-studies")
        self.assertEqual((status, self.calls), (0, []))
        self.assertRegex(said, r"(?m)^fig18_solvers +\d+ s$")
        self.assertRegex(said, r"(?m)^judge +–$")
        self.call("judge")
        self.assertRegex(self.call("--dry-run", "--no-studies")[1], r"(?m)^judge +\d+ s  finished$")

    def test_wrong_words_are_refused(self):
        self.program()
        for words, message in ((("nothing",), "no part 'nothing'"),
                               (("--program", "nowhere", "laws"), "no program at 'nowhere'")):
            status, said = self.call("--no-studies", *words)
            self.assertEqual(status, 2)
            self.assertIn(message, said)

    def test_a_real_run_is_made_packed_and_kept(self):
        packed = self.folder / "packed"
        status, said = self.call("--pack", packed, "cloth_on_sphere", program=OGC)
        self.assertEqual(status, 0, said)
        with tarfile.open(packed / "runs_01.tar.gz") as archive:
            self.assertIn("table1-smoke-cpu/cloth_on_sphere/whole/run.json", archive.getnames())
        self.assertRegex(self.call("cloth_on_sphere", program=OGC)[1], r"cloth_on_sphere .* s  kept")


    def test_what_a_part_finished_is_packed_before_the_part_ends(self):
        class Ends(Exception):
            """Stands for the machine that is taken away in the part's second job."""

        first, second = everything.Command("first", ("true",)), mock.Mock(on_device=None, state=(), name="second")
        second.make.side_effect, second.results.return_value = Ends, ()
        part = parts.Part("f", ((first, second),), frames=0)
        options = everything.arguments().parse_args(
            ["cores", "--out", str(self.out), "--pack", str(self.folder / "packed")])
        everything.stamp(self.out, "commit a")
        with self.assertRaises(Ends):
            everything.make(options, {"part": part})
        with tarfile.open(self.folder / "packed/runs_01.tar.gz") as archive:
            self.assertIn("f/first/made.json", archive.getnames())


class Moved(Scratch):
    """What one machine packed goes on in an empty folder of another one."""

    def move(self):
        self.out.rename(self.folder / "left_behind")

    def test_a_real_run_and_commands_that_were_packed_are_kept_and_the_rest_is_made(self):
        packed, names = self.folder / "packed", ("cloth_on_sphere", "fig20")
        self.assertEqual(self.call("--pack", packed, names[0], program=OGC)[0], 0)
        self.move()
        status, said = self.call("--unpack", packed, "--pack", packed, *names, program=OGC)
        self.assertEqual(status, 0, said)
        self.assertRegex(said, r"cloth_on_sphere .* s  kept\nfig20 .* s  finished")
        with tarfile.open(packed / "runs_02.tar.gz") as archive:
            self.assertEqual({name.partition("/")[0] for name in archive.getnames()},
                             {everything.STAMP, everything.TIMES, "fig20-smoke-cpu"})
        self.move_again(packed, names)

    def move_again(self, packed, names):
        self.out.rename(self.folder / "left_behind_too")
        status, said = self.call("--unpack", packed, "--pack", packed, *names, program=OGC)
        self.assertRegex(said, r"cloth_on_sphere .* s  kept\nfig20 .* s  kept")
        self.assertEqual(len(list(packed.iterdir())), 2, "nothing is packed twice")
        self.assertRegex(self.call("--dry-run", *names)[1], r"(?m)^fig20 +\d+ s  kept$")

    def test_a_command_that_was_cut_off_is_made_there_and_finished_ones_are_not(self):
        packed = self.folder / "packed"
        self.program()
        self.assertEqual(self.call("--pack", packed, "judge")[0], 0)
        self.program(slow="yes")
        self.assertEqual(self.call("--pack", packed, "--time-limit", "1", "judge", "laws")[0], CALL_AGAIN)
        self.move()
        self.program()
        before = len(self.calls)
        status, said = self.call("--unpack", packed, "judge", "laws")
        self.assertEqual(status, 0, said)
        self.assertRegex(said, r"judge .* s  kept\nlaws .* s  finished")
        self.assertEqual(len(self.calls), before + 1)

    def test_a_run_whose_states_are_needed_and_were_not_packed_is_made_again(self):
        twist = parts.book(parts.Wanted(scale="smoke", backend="cpu"))["twist"]
        whole, archive = "table1-smoke-cpu/twist/whole", self.folder / "runs_01.tar.gz"
        for complete, end, expected in ((False, "stopped", [f"{whole}/"]), (False, FINISHED, []),
                                        (True, "stopped", [f"{whole}/"])):
            with tarfile.open(archive, "w:gz") as packed:
                said = json.dumps({"complete": complete}).encode()
                about = tarfile.TarInfo(f"{whole}/audit.json")
                about.size = len(said)
                packed.addfile(about, io.BytesIO(said))
            found = {f"{whole}/audit.json": archive, f"{whole}/run.json": archive}
            self.assertEqual(list(everything.half_made({"twist": twist}, {"twist": {"end": end}}, found)), expected)
        # All that begins with its states was packed, and its audit is complete.
        found.update({f"{twist.folder}/{job.name}/run.json": archive for job in twist.jobs})
        self.assertEqual(list(everything.half_made({"twist": twist}, {}, found)), [])

    def test_a_run_is_kept_if_the_frames_with_which_the_rest_begins_were_packed(self):
        chain = (Job("first", ()), Job("second", (), ("first", -2)), Job("third", (), ("second", Step(4))))
        packed = dict.fromkeys(("f/first/run.json", "f/first/frames/frame_000003.h5", "f/second/run.json"))
        for last, frame, expected in ((2, "4", []), (2, "5", ["f/second/"]), (1, "5", ["f/first/", "f/second/"])):
            part = parts.Part("f", (chain,), frames=0, last=last)
            found = {**packed, f"f/second/frames/frame_00000{frame}.h5": None}
            self.assertEqual(list(everything.half_made({"p": part}, {}, found)), expected)

    def test_archives_of_another_program_damaged_ones_and_an_empty_folder_are_refused(self):
        packed = self.folder / "packed"
        self.program()
        self.call("--pack", packed, "laws")
        self.move()
        self.program(commit="b" * 40)
        for change, words in ((lambda: None, f"of another program \\(commit {'a' * 40}\\)"),
                              (lambda: (packed / "runs_01.tar.gz").write_bytes(b"no archive"), "cut or damaged"),
                              ((packed / "runs_01.tar.gz").unlink, "has no runs_NN.tar.gz")):
            change()
            status, said = self.call("--unpack", packed, "laws")
            self.assertEqual(status, 2)
            self.assertRegex(said, words)

    def test_another_machine_makes_nothing_due(self):
        self.program()
        self.call("laws")
        stamp = self.out / everything.STAMP
        stamp.write_text(stamp.read_text().replace("3 threads", "64 threads"))
        os.utime(stamp, ns=(0, 0))
        self.assertRegex(self.call("laws")[1], r"laws .* s  kept")
        self.assertIn("3 threads", stamp.read_text())
        self.assertEqual(stamp.stat().st_mtime_ns, 0)
        with_device = stamp.read_text() + f"  {everything.ON_DEVICE} (H200)\n"
        stamp.write_text(with_device)
        self.call("laws")
        self.assertEqual(stamp.read_text(), with_device, "the device made what is there")


class Programs(unittest.TestCase):
    def test_a_changed_one_and_one_of_other_sources_are_refused(self):
        head, other = ("1",) * 4, ("2",) * 4
        commit = "a" * 40
        for said, trees, words in ((f"commit {commit}", head, None), (f"commit {commit}", other, "not those of HEAD"),
                                   (f"commit {commit} (dirty)", head, "commit, build, and call again"),
                                   ("commit unknown", head, "is of 'unknown'")):
            with mock.patch.object(contents, "of_history", return_value={commit: trees}), \
                    mock.patch.object(contents, "of_head", return_value=head):
                if words:
                    self.assertRaisesRegex(everything.PlanError, words, everything.check_program, said)
                else:
                    everything.check_program(said)

    def test_where_there_is_no_repository_a_commit_is_enough(self):
        with mock.patch.object(contents, "of_history", side_effect=contents.ContentsError("none")):
            everything.check_program(f"commit {'a' * 40}")


class Plans(unittest.TestCase):
    def plan(self, where, scale, backend):
        return everything.plan(where, parts.Wanted(scale=scale, backend=backend), STUDIES)

    def test_everything_of_the_runner_is_in_both_and_windows_come_last(self):
        for where, scale, backend in (("gpu", "paper", "cuda"), ("cores", "small", "cpu")):
            found = self.plan(where, scale, backend)
            book = parts.book(parts.Wanted(scale=scale, backend=backend))
            self.assertLessEqual(set(book), set(found))
            self.assertLessEqual({"judge", "determinism", "laws", "jittered", "ablation_x"}, set(found))
            names = list(found)
            first = next(place for place, name in enumerate(names) if name.startswith("windows_"))
            self.assertTrue(all(name.startswith("windows_") for name in names[first:]))
        self.assertLessEqual({"illustrations", *everything.MEASURED}, set(self.plan("cores", "small", "cpu")))
        self.assertNotIn("illustrations", self.plan("gpu", "paper", "cuda"))

    def test_a_program_is_asked_about_a_device_that_is_named_several_times_once(self):
        with tempfile.TemporaryDirectory() as folder:
            asked = Path(folder) / "ogc"
            asked.write_text('#!/bin/sh\necho "devices $CUDA_VISIBLE_DEVICES"\n')
            asked.chmod(0o755)
            for named, said in (("0,0,0", "0"), ("1,0,1", "1,0"), ("", "")):
                with mock.patch.dict(everything.os.environ, {"CUDA_VISIBLE_DEVICES": named}):
                    self.assertEqual(everything.said_by(str(asked)), f"devices {said}\n")

    def test_a_device_makes_no_study_of_a_solver_that_knows_processors_alone(self):
        asked = {backend: {"twist": ["ablate", "twist", "--solver", "reference_vbd"]} for backend in ("cpu", "cuda")}
        of_reference = {"ablation_y": dict.fromkeys(("smoke", "small", "paper"), asked)}
        for where, scale, backend, there in (("gpu", "paper", "cuda", False), ("cores", "small", "cpu", True)):
            with mock.patch.dict(STUDIES, of_reference):
                self.assertEqual("ablation_y" in self.plan(where, scale, backend), there, where)

    def test_the_ablations_are_at_smoke_on_two_cores(self):
        for where, scale, backend, folder in (("gpu", "paper", "cuda", "ablation_x-paper-cuda"),
                                              ("cores", "small", "cpu", "ablation_x-smoke-cpu")):
            self.assertEqual(self.plan(where, scale, backend)["ablation_x"].folder, folder)

    def test_each_measured_study_is_a_program_with_the_options_that_it_gets(self):
        for name, has_scales in {**everything.MEASURED, **dict.fromkeys(everything.MEASURED_ON_DEVICE, True)}.items():
            text = (SOURCE / f"paper_figures/figures/measured/{name}.py").read_text()
            (said,) = re.findall(r"parser_of_figure\(__doc__\.splitlines\(\)\[0\](.*)\)", text)
            self.assertEqual(bool(re.match(r", [A-Z(]", said)), has_scales, name)
            of_cpu = ("activation_load", "falling", "left_forces", "radius")
            self.assertEqual("has_backend=False" in said, name in of_cpu, name)

    def test_what_needs_numpy_is_left_out_in_words_where_it_is_missing(self):
        options = everything.arguments().parse_args(["gpu", "--no-studies"])
        for there in (True, False):
            said = io.StringIO()
            with mock.patch.object(everything, "find_spec", return_value=there or None), redirect_stderr(said):
                chosen, _ = everything.prepared(options)
            self.assertEqual("mat_volumes" in chosen, there)
            self.assertEqual("left out, as NumPy is missing: mat_volumes" in said.getvalue(), not there)

    def test_groups_are_everything_once_and_keep_together_what_shares_a_run(self):
        chosen = self.plan("gpu", "paper", "cuda")
        groups = everything.groups(chosen)
        self.assertEqual(sorted(name for group in groups for name in group), sorted(chosen))
        runs = [{f"{chosen[name].folder}/{job.name}" for name in group for job in chosen[name].jobs}
                for group in groups]
        self.assertEqual(sum(map(len, runs)), len(set().union(*runs)))
        self.assertGreater(len(groups), 1)


class Commands(Scratch):
    def test_one_that_was_cut_off_is_called_again_in_its_folder(self):
        everything.stamp(self.out, "commit a")
        self.addCleanup(os.environ.pop, "OGC_STAMP")
        job = everything.Command("c", (everything.Command.PYTHON, "-c", "import pathlib, sys, time\n"
                                       "there = pathlib.Path(sys.argv[1]) / 'half'\n"
                                       "first = not there.exists()\nthere.touch()\n"
                                       "time.sleep(600 if first else 0)", everything.Command.FOLDER), ("half",))
        self.assertEqual(job.make("ogc", self.out, Limit(0)), STOPPED)
        self.assertEqual(job.make("ogc", self.out, Limit(2)), STOPPED)
        self.assertEqual(list(job.results(self.out, 0, 0)), [])
        self.assertEqual(job.make("ogc", self.out, Limit(60)), FINISHED)
        self.assertEqual({path.name for path in job.results(self.out, 0, 0)}, {"made.json", "said.txt", "half"})
        self.assertEqual(job.make("ogc", self.out), KEPT)

    def test_one_that_fails_says_its_last_lines(self):
        everything.stamp(self.out, "commit a")
        self.addCleanup(os.environ.pop, "OGC_STAMP")
        job = everything.Command("c", (everything.Command.PYTHON, "-c", "import sys; sys.exit('it is broken')"))
        self.assertEqual(job.make("ogc", self.out), FINISHED, "1: a check failed")
        job = everything.Command("d", (everything.Command.PYTHON, "-c", "import sys; print('it is broken', "
                                                                        "file=sys.stderr); sys.exit(3)"))
        with self.assertRaisesRegex(RunFailure, "exit status 3\n  it is broken"):
            job.make("ogc", self.out)


if __name__ == "__main__":
    unittest.main()
