"""Runs for a lent machine: what is finished is kept, what was cut off goes on, what is packed and unpacked is what the figures' scripts want to find.

Usage: device_runs.py SOURCE_DIR OGC. The standard library is enough.
"""

import json
import os
import subprocess
import sys
import tempfile
import time
import unittest
import unittest.mock
from pathlib import Path

SOURCE, OGC = Path(sys.argv[1]).resolve(), str(Path(sys.argv[2]).resolve())
del sys.argv[1:3]
sys.path.insert(0, str(SOURCE))
from paper_figures.figures import growth, table1  # noqa: E402
from paper_figures.workflow import commands, device_memory, device_runs, layers, timed_runs  # noqa: E402
from paper_figures.workflow.timed_runs import Job, Limit, Step  # noqa: E402


class Scratch(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = Path(holder.name)


class OneRun(Scratch):
    LONG = Job("long", ("twist", "--scale", "smoke", "--steps", "150",
                        "--set", "iterations=60", "--checkpoint", "0", "--audit", "end"))

    def make(self, job, seconds=None):
        return timed_runs.make(OGC, job, self.folder, Limit(seconds))

    def test_a_run_stopped_at_the_limit_goes_on_and_is_then_kept(self):
        self.assertEqual(self.make(self.LONG, 0.2), timed_runs.STOPPED)
        self.assertIn(timed_runs.manifest_of(self.folder / "long")["status"], ("interrupted", "running"))
        self.assertEqual([self.make(self.LONG), self.make(self.LONG)], [timed_runs.FINISHED, timed_runs.KEPT])
        self.assertEqual(len((self.folder / "long/steps.csv").read_text().splitlines()), 151)

    def test_another_command_in_the_same_folder_is_run_anew(self):
        short = Job("run", ("cloth_on_sphere", "--scale", "smoke", "--steps", "2"))
        longer = Job("run", ("cloth_on_sphere", "--scale", "smoke", "--steps", "3"))
        self.assertEqual([self.make(job) for job in (short, short, longer)], [timed_runs.FINISHED, timed_runs.KEPT, timed_runs.FINISHED])

    def test_a_run_that_cannot_go_on_begins_anew(self):
        self.assertEqual(self.make(self.LONG, 0.2), timed_runs.STOPPED)
        manifest = self.folder / "long/run.json"
        manifest.write_text(manifest.read_text().replace('"commit": "', '"commit": "0'))  # another program's
        self.assertEqual(self.make(self.LONG), timed_runs.FINISHED)
        self.assertNotIn("resumed", timed_runs.manifest_of(self.folder / "long"))

    def test_a_run_begins_with_the_frame_after_a_step_if_there_is_one(self):
        job = Job("run", ("cloth_on_sphere", "--scale", "smoke", "--steps", "6", "--set", "frame_steps=2"))
        self.assertEqual(self.make(job), timed_runs.FINISHED)
        window, none = (Job("window", ("cloth_on_sphere", "--scale", "smoke", "--steps", "7"), ("run", Step(step))) for step in (4, 5))
        self.assertEqual(self.make(window), timed_runs.FINISHED)
        self.assertTrue((self.folder / "window/steps.csv").read_text().splitlines()[1].startswith("5,"))
        with self.assertRaisesRegex(timed_runs.RunFailure, "begins with a frame of .*, which does not have it"):
            self.make(none)

    def test_a_failure_has_its_command_and_last_words(self):
        with self.assertRaisesRegex(timed_runs.RunFailure, "(?s)run no_scene .*exit status 2.*no_scene"):
            self.make(Job("run", ("no_scene",)))
        with self.assertRaisesRegex(timed_runs.RunFailure, "begins with a frame of .*, which does not have it"):
            self.make(Job("run", ("twist",), ("first", -1)))


class Parts(Scratch):
    WANTED = ["fig20", "cloth_on_sphere", "windows_cloth_on_sphere"]
    OPTIONS = ["--scale", "smoke", "--backend", "cpu", "--window", "3"]

    def say(self, out, *words):
        command = [sys.executable, "-m", "paper_figures.workflow.device_runs", "--out", str(out), "--program", OGC, *map(str, words)]
        done = subprocess.run(command, cwd=SOURCE, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return done.stdout.splitlines()

    def test_made_kept_packed_unpacked_and_found_finished(self):
        there, home = self.folder / "there", self.folder / "home"
        self.assertEqual([line.split()[3] for line in self.say(there, *self.OPTIONS, *self.WANTED)], ["finished"] * 3)
        self.assertEqual([line.split()[3] for line in self.say(there, *self.OPTIONS, *self.WANTED)], ["kept"] * 3)
        packed = self.say(there, *self.OPTIONS, "--pack", self.folder / "pieces")
        self.assertEqual({line.split()[0] for line in packed[:-1]}, {"fig20:", "cloth_on_sphere:", "windows_cloth_on_sphere:"})
        sizes = [float(line.split()[3]) for line in packed[:-1]]
        self.assertEqual(sizes, sorted(sizes))  # what is lost with the last piece is little
        self.assertEqual(len(self.say(there, *self.OPTIONS, "--pack", self.folder / "again")), 1)
        self.assertEqual(len(self.say(home, "--unpack", self.folder / "pieces")), 12)
        part = device_runs.parts("smoke", "cpu")["fig20"]
        job = part.chains[0][0]
        self.assertTrue(timed_runs.usable(home / part.folder / job.name, job.command("elsewhere/ogc", home / part.folder)))
        frames = [len(list((place / part.folder / job.name / "frames").iterdir())) for place in (there, home)]
        self.assertEqual(frames[1], min(25, frames[0]))
        for path in (home / part.folder / job.name, home / "fig18-smoke-cpu/run"):
            self.assertTrue((path / "trajectory.vtkhdf").is_file() and not path.is_symlink(), path)
        rows = table1.rows_of(home / "table1-smoke-cpu")
        self.assertEqual([(row["scene"], row["backend"]) for row in rows], [("cloth_on_sphere", "cpu")] * 2)
        self.assertEqual(rows[0]["audited states"], "31, no intersection", "all, though not all frames came along")

    def test_solvers_side_by_side_in_parts_are_kept_and_packed_with_their_processor_time(self):
        there, home = self.folder / "there", self.folder / "home"
        for word in ("finished", "kept"):
            self.assertEqual(self.say(there, *self.OPTIONS, "fig18_solvers")[0].split()[3], word)
        self.say(there, *self.OPTIONS, "--pack", self.folder / "pieces")
        self.say(home, "--unpack", self.folder / "pieces")
        for name in ("ipc", "newton", "vbd"):
            part = home / "fig18_solvers-smoke-cpu" / name / "part_00"
            self.assertEqual(timed_runs.manifest_of(part)["solver"], name)
            self.assertGreater(json.loads((part / "processor_time.json").read_text())["user [s]"], 0)
            self.assertTrue((part / "trajectory.vtkhdf").is_file())
            self.assertEqual(timed_runs.manifest_of(part)["device"], f"{len(os.sched_getaffinity(0))} threads")

    def test_each_part_is_packed_as_soon_as_it_is_finished(self):
        """A machine that was taken away in the second part must have left the first."""
        there, home, pieces = self.folder / "there", self.folder / "home", self.folder / "pieces"
        code = ("import sys\nfrom paper_figures.workflow import device_runs\ndo = device_runs.Machine.do\n"
                "device_runs.Machine.do = lambda self, name: do(self, name) if name == 'fig20' else sys.exit(9)\ndevice_runs.main()")
        command = [sys.executable, "-c", code, "--out", there, "--program", OGC, *self.OPTIONS, "--keep", pieces, "fig20", "cloth_on_sphere"]
        self.assertEqual(subprocess.run(list(map(str, command)), cwd=SOURCE, capture_output=True, check=False).returncode, 9)
        self.assertEqual(self.say(home, "--unpack", pieces), [str(home / "fig20-smoke-cpu/vbd")])
        done = self.say(there, *self.OPTIONS, "--keep", pieces, "cloth_on_sphere")  # of this call alone
        self.assertEqual(done[0].split()[3], "finished")
        self.assertTrue(all("table1" in line or "fig18" in line for line in self.say(self.folder / "other", "--unpack", pieces)))
        code = "from paper_figures.workflow import device_runs\ndevice_runs.TOTAL = 1000\ndevice_runs.main()"
        command = [sys.executable, "-c", code, "--out", there, "--program", OGC, *self.OPTIONS, "--keep", self.folder / "small", "cloth_on_sphere"]
        (there / "packed.json").unlink()
        said = subprocess.run(list(map(str, command)), cwd=SOURCE, capture_output=True, text=True, check=False)
        self.assertEqual((said.returncode, "cloth_on_sphere: " in said.stdout and "did not fit" in said.stdout), (1, True), said.stdout)
        last = sorted(pieces.glob("runs_*"))[-1]
        last.write_bytes(last.read_bytes()[:-2000])
        command = [sys.executable, "-m", "paper_figures.workflow.device_runs", "--program", OGC, "--out", self.folder / "cut", "--unpack", pieces]
        said = subprocess.run(list(map(str, command)), cwd=SOURCE, capture_output=True, text=True, check=False)
        self.assertEqual((said.returncode, "end in the middle" in said.stderr, [path.name for path in (self.folder / "cut").iterdir()]), (1, True, []))

    def test_solvers_of_fig_18_run_one_after_the_other_on_all_cores_and_none_begins_without_time(self):
        machine = device_runs.Machine(device_runs.arguments().parse_args(["--out", str(self.folder), "--program", OGC, "--scale", "smoke"]))
        begun, ended = [], set()
        machine.in_time = lambda folder, name, part, limit: begun.append(name)
        part = machine.book["fig18_solvers"]
        self.assertEqual(machine.in_parts(part, Limit()), timed_runs.STOPPED)  # IPC has not reached its end
        self.assertEqual(machine.in_parts(part, Limit(1e-9)), timed_runs.STOPPED)
        self.assertEqual(begun, ["ipc"])
        with unittest.mock.patch.object(device_runs.in_time, "ended", lambda folder: folder.name in ended):
            machine.in_time = lambda folder, name, part, limit: (begun.append(name), ended.add(name))
            self.assertEqual([machine.in_parts(part, Limit()) for _ in "ab"], [timed_runs.FINISHED, timed_runs.KEPT])
        self.assertEqual(begun[1:], ["ipc", "newton", "vbd", "vbd_cuda"])

    def test_fewer_iterations_before_the_step_of_fig_17_change_its_start_alone(self):
        whole, fewer = commands.three_cloths("paper", ["cpu"]), commands.three_cloths("paper", ["cpu"], 40)
        self.assertEqual(fewer[0][0].arguments, (*whole[0][0].arguments[:-1], "iterations=40"))
        self.assertEqual((fewer[0][1:], fewer[1]), (whole[0][1:], whole[1]))

    def test_what_lies_beside_all_rows_of_a_table_is_packed_once(self):
        there, home = self.folder / "there", self.folder / "home"
        book = {row: device_runs.Part("table1", row=row, frames=0) for row in ("twist", "knot")}
        for row in book:
            (there / "table1" / row / "whole").mkdir(parents=True)
            (there / "table1" / row / "whole/run.json").write_text('{"status": "finished"}')
            (there / "table1" / f"{row}_device_memory.json").write_text("{}")
        device_runs.pack(there, book, self.folder / "pieces")
        device_runs.unpack(self.folder / "pieces", home, OGC)
        self.assertEqual(len(list((home / "table1").glob("*_device_memory.json"))), 2)

    def test_frames_are_the_first_evenly_on_to_the_last(self):
        (self.folder / "frames").mkdir()
        for step in range(0, 105, 5):
            (self.folder / f"frames/frame_{step:06d}.h5").touch()
        for part, steps in ((device_runs.Part(""), [0, 35, 65, 100]), (device_runs.Part("", frames=0), []), (device_runs.Part("", frames=2, last=2), [0, 95, 100])):
            self.assertEqual([int(path.stem[-6:]) for path in device_runs.chosen_frames(self.folder, part)], steps)

    def test_rows_are_those_of_the_table_and_the_largest_is_last_on_the_cpu(self):
        self.assertEqual(set(device_runs.ROWS), set(table1.ROWS))
        self.assertEqual(list(device_runs.parts("paper", "cuda"))[-1], "windows_fifty_layers_1m")

    def test_memory_is_sampled_while_a_run_goes_on_and_kept_over_the_next(self):
        for samples in ("100 700", "90 300"):
            with device_memory.DeviceMemory(self.folder / "x.json", True, ("sh", "-c", f"printf '%s\\n' {samples} none; exec sleep 9")):
                time.sleep(0.2)
        self.assertEqual(json.loads((self.folder / "x.json").read_text()), {"before [MiB]": 90, "largest [MiB]": 700, "samples": 2})
        with device_memory.DeviceMemory(self.folder / "y.json", True, ("no such program",)):
            pass
        self.assertFalse((self.folder / "y.json").exists())

    def test_the_memory_of_a_row_is_what_it_took_beyond_what_was_in_use(self):
        (self.folder / "twist_device_memory.json").write_text(json.dumps({"before [MiB]": 500, "largest [MiB]": 2500, "samples": 3}))
        (self.folder / "short_device_memory.json").write_text(json.dumps({"before [MiB]": 0, "largest [MiB]": 0, "samples": 1}))
        self.assertEqual([device_memory.taken(self.folder / f"{row}_device_memory.json") for row in ("twist", "knot", "short")], [2000, "", ""])


class Growth(Scratch):
    def contacts(self, side):
        """A vertex, after the first step."""
        layers.write(OGC, self.folder / f"scene_{side}", side, 1)
        timed_runs.make(OGC, Job(f"run_{side}", ("--audit", "end"), scene=f"scene_{side}/scene.json"), self.folder, Limit())
        run = growth.run_at(self.folder / f"run_{side}")
        self.assertTrue(run.manifest["guarantee_kept"])
        self.assertEqual(sum(body["vertex_count"] for body in run.manifest["scene"]["bodies"] if not body["fixed"]), layers.vertices(side))
        return table1.contacts(run)[0] / layers.vertices(side)

    def test_stacks_of_two_sizes_differ_in_density_by_their_rim_alone(self):
        """Of side² vertices of a sheet less than 4 side lie at the rim, and a rim vertex has at least half the contacts of an inner one: it loses one side of its
        neighbourhood. So density (1 - 2/side) D at least, and at most D."""
        small, large = self.contacts(10), self.contacts(20)
        self.assertGreater(large, small)
        self.assertLess(large, small / (1 - 2 / 10))
        self.assertGreater(small, 5)  # pairs of neighbouring sheets, not of the ground alone

    def test_a_power_law_and_its_words(self):
        rows = [{"over": "vertices", "backend": "cuda", "vertices": n, "median [ms]": 2e-3 * n**1.25, "contacts a vertex": 7} for n in (10**4, 10**5, 10**6)]
        rows += [{"over": "threads", "backend": "cpu", "vertices": 9, "threads": n, "median [ms]": 8 / n, "final_hash": bits} for n, bits in ((1, "a"), (4, "b"))]
        slope, factor = growth.exponent(rows[:3])
        self.assertAlmostEqual(slope, 1.25)
        self.assertAlmostEqual(factor, 2e-3)
        self.assertEqual(growth.in_words(rows), ["cuda: time ∝ vertices^1.250 from 10,000 to 1,000,000, ^1.250 from 10,000 on; 7 to 7 contacts a vertex",
                                                 "4 threads are 4 times as fast as 1 (9 vertices), NOT with the same bits"])

    def test_threads_are_powers_of_two_and_all_cores(self):
        for cores, numbers in ((1, [1]), (6, [1, 2, 4, 6]), (16, [1, 2, 4, 8, 16])):
            self.assertEqual([int(job.name.rpartition("_")[2]) for job in growth.threads("paper", cores)], numbers)


if __name__ == "__main__":
    unittest.main()
