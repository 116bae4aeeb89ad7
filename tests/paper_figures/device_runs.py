"""Runs for a lent machine: what is finished is kept, what was cut off goes on, what is packed and unpacked is what the figures' scripts want to find.

Usage: device_runs.py SOURCE_DIR OGC. The standard library is enough.
"""

import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SOURCE, OGC = Path(sys.argv[1]).resolve(), str(Path(sys.argv[2]).resolve())
del sys.argv[1:3]
sys.path.insert(0, str(SOURCE))
from paper_figures import device_runs, table1, timed_runs  # noqa: E402
from paper_figures.timed_runs import Job, Limit  # noqa: E402


class Scratch(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = Path(holder.name)


class OneRun(Scratch):
    LONG = Job("long", ("twist", "--scale", "smoke", "--set", "iterations=60", "--checkpoint", "0", "--audit", "end"))

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

    def test_a_failure_has_its_command_and_last_words(self):
        with self.assertRaisesRegex(timed_runs.RunFailure, "(?s)run no_scene .*exit status 2.*no_scene"):
            self.make(Job("run", ("no_scene",)))
        with self.assertRaisesRegex(timed_runs.RunFailure, "begins with a frame of .*first, which has none"):
            self.make(Job("run", ("twist",), ("first", -1)))


class Parts(Scratch):
    WANTED = ["fig20", "cloth_on_sphere", "windows_cloth_on_sphere"]
    OPTIONS = ["--scale", "smoke", "--backend", "cpu", "--window", "3"]

    def say(self, out, *words):
        done = subprocess.run([sys.executable, "-m", "paper_figures.device_runs", "--out", str(out), "--program", OGC, *map(str, words)], cwd=SOURCE, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return done.stdout.splitlines()

    def test_made_kept_packed_unpacked_and_found_finished(self):
        there, home = self.folder / "there", self.folder / "home"
        self.assertEqual([line.split()[3] for line in self.say(there, *self.OPTIONS, *self.WANTED)], ["finished"] * 3)
        self.assertEqual([line.split()[3] for line in self.say(there, *self.OPTIONS, *self.WANTED)], ["kept"] * 3)
        self.assertEqual([line.split()[0] for line in self.say(there, *self.OPTIONS, "--pack", self.folder / "pieces")][:-1], ["fig20:", "cloth_on_sphere:", "windows_cloth_on_sphere:"])
        self.assertEqual(len(self.say(there, *self.OPTIONS, "--pack", self.folder / "again")), 1)
        self.assertEqual(len(self.say(home, "--unpack", self.folder / "pieces")), 7)
        part = device_runs.parts("smoke", "cpu")["fig20"]
        job = part.chains[0][0]
        self.assertTrue(timed_runs.usable(home / part.folder / job.name, job.command("elsewhere/ogc", home / part.folder)))
        self.assertEqual(len(list((home / part.folder / job.name / "frames").iterdir())), min(25, len(list((there / part.folder / job.name / "frames").iterdir()))))
        for path in (home / part.folder / job.name, home / "fig18-smoke-cpu/run"):
            self.assertTrue((path / "trajectory.vtkhdf").is_file() and not path.is_symlink(), path)
        self.assertEqual([(row["scene"], row["backend"]) for row in table1.rows_of(home / "table1-smoke-cpu")], [("cloth_on_sphere", "cpu")] * 2)

    def test_frames_are_the_first_evenly_on_to_the_last(self):
        (self.folder / "frames").mkdir()
        for step in range(0, 105, 5):
            (self.folder / f"frames/frame_{step:06d}.h5").touch()
        for part, steps in ((device_runs.Part(""), [0, 35, 65, 100]), (device_runs.Part("", frames=0), []), (device_runs.Part("", frames=2, last=2), [0, 95, 100])):
            self.assertEqual([int(path.stem[-6:]) for path in device_runs.chosen_frames(self.folder, part)], steps)

    def test_rows_are_those_of_the_table_and_the_largest_is_last_on_the_cpu(self):
        self.assertEqual(set(device_runs.ROWS), set(table1.ROWS))
        self.assertEqual(list(device_runs.parts("paper", "cuda"))[-1], "windows_fifty_layers_1m")

    def test_the_memory_of_a_row_is_what_it_took_beyond_what_was_in_use(self):
        (self.folder / "twist_device_memory.json").write_text(json.dumps({"before [MiB]": 500, "largest [MiB]": 2500, "samples": 3}))
        self.assertEqual((table1.device_memory(self.folder, "twist"), table1.device_memory(self.folder, "knot")), (2000, ""))


if __name__ == "__main__":
    unittest.main()
