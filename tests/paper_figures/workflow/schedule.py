"""The schedule of jobs side by side: what begins first, what fills cores that a large job does not find, what each job
needs, and which cores it has.

Usage: schedule.py SOURCE_DIR. The standard library is enough.
"""

import json
import os
import sys
import tempfile
import threading
import unittest
from contextlib import redirect_stdout
from dataclasses import dataclass, field
from io import StringIO
from pathlib import Path

SOURCE = Path(sys.argv[1]).resolve()
del sys.argv[1:2]
sys.path.insert(0, str(SOURCE))
from paper_figures.workflow import parts, schedule  # noqa: E402
from paper_figures.workflow.jobs import ENDED_BY_TIME, FAILED, FINISHED, STOPPED, Limit, RunFailure  # noqa: E402
from paper_figures.workflow.schedule import PATIENCE, Maker, Schedule, Task, longest_chain, rank  # noqa: E402


def tasks(**described):
    """Returns name -> Task of (cores, seconds, names needed)."""
    found = {name: Task(name, Path("nowhere"), None, set(needs), [], cores, seconds)
             for name, (cores, seconds, *needs) in described.items()}
    rank(found)
    return found


class Clock:
    def __init__(self):
        self.now = 0.0

    def __call__(self):
        return self.now


class WhatBegins(unittest.TestCase):
    def setUp(self):
        self.clock = Clock()

    def schedule(self, cores, **described):
        return Schedule(tasks(**described), range(cores), self.clock)

    def begun(self, made, left=float("inf")):
        """Returns name -> number of cores of everything that begins now."""
        found = {}
        while task := made.next(left):
            found[task.name] = len(task.cpus)
        return found

    def test_the_job_after_which_most_follows_comes_first(self):
        made = self.schedule(1, short=(1, 10), head=(1, 5), tail=(1, 20, "head"))
        self.assertEqual(self.begun(made), {"head": 1})
        made.ended("head", FINISHED)
        self.assertEqual(self.begun(made), {"tail": 1})
        made.ended("tail", FINISHED)
        self.assertEqual(self.begun(made), {"short": 1})

    def test_small_jobs_fill_the_cores_that_a_large_one_does_not_find(self):
        made = self.schedule(8, first=(7, 90), large=(6, 80), small=(1, 1))
        self.assertEqual(self.begun(made), {"first": 7, "small": 1})

    def test_a_job_begins_on_a_third_of_its_cores(self):
        made = self.schedule(8, first=(6, 90), large=(6, 80))
        self.assertEqual(self.begun(made), {"first": 6, "large": 2})

    def test_small_jobs_do_not_keep_a_large_one_from_its_cores_for_ever(self):
        made = self.schedule(4, first=(3, 90), large=(12, 80), **{f"small_{i}": (1, 1) for i in range(9)})
        self.assertEqual(self.begun(made), {"first": 3, "small_0": 1}, "four of twelve cores are not enough")
        self.clock.now = PATIENCE
        made.ended("small_0", FINISHED)
        self.assertEqual(self.begun(made), {}, "the large one has waited long enough")
        made.ended("first", FINISHED)
        self.assertEqual(self.begun(made), {"large": 4})

    def test_what_would_not_end_in_time_comes_last(self):
        made = self.schedule(1, long=(1, 100), short=(1, 10))
        self.assertEqual(self.begun(made, left=50), {"short": 1})

    def test_no_two_jobs_share_a_core(self):
        made = self.schedule(7, a=(3, 3), b=(2, 2), c=(2, 1))
        self.begun(made)
        used = [cpu for task in made.running.values() for cpu in task.cpus]
        self.assertEqual(sorted(used), list(range(7)))

    def test_what_begins_with_a_failed_run_is_left_out(self):
        made = self.schedule(2, run=(1, 1), step=(1, 1, "run"), search=(1, 1, "step"), other=(1, 1))
        self.begun(made)
        made.ended("run", FAILED)
        self.assertEqual(made.ends, {"run": FAILED, "step": "left out", "search": "left out"})

    def test_the_longest_chain_is_that_of_most_seconds(self):
        found = tasks(a=(1, 1), b=(1, 5, "a"), c=(1, 2, "a"), d=(1, 7))
        self.assertEqual([task.name for task in longest_chain(found)], ["d"])
        found = tasks(a=(1, 3), b=(1, 5, "a"), c=(1, 2, "a"), d=(1, 7))
        self.assertEqual([task.name for task in longest_chain(found)], ["a", "b"])


class OfParts(unittest.TestCase):
    """What the parts of all figures need."""

    @classmethod
    def setUpClass(cls):
        book = parts.chosen(parts.book(parts.Wanted(scale="small", backend="cpu")))
        cls.tasks = schedule.tasks_of(book, Path("runs"), {"fig16-small-cpu/ogc": {"cores": 4, "seconds": 99}})

    def test_a_run_needs_the_run_from_whose_state_it_begins_and_an_audit_its_run(self):
        self.assertEqual(self.tasks["fig16-small-cpu/ogc_released"].needs, {"fig16-small-cpu/ogc"})
        self.assertEqual(self.tasks["table1-small-cpu/twist/whole_audit.json"].needs, {"table1-small-cpu/twist/whole"})
        self.assertEqual(self.tasks["table1-small-cpu/twist/cpu_50"].needs, {"table1-small-cpu/twist/whole"})

    def test_a_run_that_two_parts_show_is_made_once(self):
        row = self.tasks["table1-small-cpu/mat_twist_planes/whole"]
        self.assertEqual(row.root, Path("runs/table1-small-cpu"))
        self.assertEqual(row.job.name, "mat_twist_planes/whole")
        self.assertLessEqual({"mat_twist_planes", "fig19"}, set(row.parts))
        self.assertFalse([name for name in self.tasks if name.startswith("fig19-small-cpu/planes/whole")])
        window = self.tasks["fig19-small-cpu/window_25/ipc"]
        self.assertEqual(window.needs, {"table1-small-cpu/mat_twist_planes/whole"})

    def test_every_job_can_begin_sometime(self):
        made = Schedule(self.tasks, range(10**6), lambda: 0.0)
        while made.waiting:
            begun = []
            while task := made.next():
                begun.append(task.name)
            self.assertTrue(begun, f"{len(made.waiting)} jobs wait for one another")
            for name in begun:
                made.ended(name, FINISHED)

    def test_known_times_and_limits_plan(self):
        known, limited = self.tasks["fig16-small-cpu/ogc"], self.tasks["fig02-small-cpu/pairs"]
        self.assertEqual((known.cores, known.seconds), (4, 99))
        self.assertEqual(limited.seconds, limited.job.seconds)


@dataclass(frozen=True)
class Noted:
    """A job that notes the cores on which it runs, and waits until others have begun."""

    name: str
    notes: dict = field(default_factory=dict, compare=False)
    gate: threading.Barrier = None
    fails: bool = False
    seconds: float = 0

    def make(self, _program, root, limit=Limit()):
        self.notes[self.name] = os.sched_getaffinity(0)
        if self.gate:
            self.gate.wait(10)
        if self.fails:
            raise RunFailure("it failed")
        if self.seconds:
            folder = root / self.name
            folder.mkdir()
            (folder / "run.json").write_text('{"status": "interrupted"}')
            (folder / "steps.csv").write_text("step\n1\n2\n")
            limit.stop()
            return STOPPED
        return FINISHED


class Made(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = Path(holder.name)

    def make(self, jobs, cpus, limit=Limit(), last=False):
        found = {job.name: Task(job.name, self.folder, job, set(), [], 1, 1.0) for job in jobs}
        rank(found)
        with redirect_stdout(StringIO()):
            return Maker("ogc", self.folder, limit, last).make(found, cpus)

    def test_jobs_run_side_by_side_on_cores_of_their_own(self):
        cpus = sorted(os.sched_getaffinity(0))[:2]
        if len(cpus) < 2:
            self.skipTest("one core")
        notes, gate = {}, threading.Barrier(2)
        ends = self.make([Noted(name, notes, gate) for name in "ab"], cpus)
        self.assertEqual(set(ends.values()), {FINISHED})
        self.assertEqual(sorted(map(tuple, notes.values())), [(cpu,) for cpu in cpus])
        self.assertEqual(os.sched_getaffinity(0) & set(cpus), set(cpus), "the caller keeps its cores")
        times = schedule.known_in(self.folder / schedule.TIMES)
        self.assertEqual({name: time["cores"] for name, time in times.items()}, {"a": 1, "b": 1})

    def test_a_failure_is_said_and_the_others_are_made(self):
        ends = self.make([Noted("bad", fails=True), Noted("good")], sorted(os.sched_getaffinity(0))[:1])
        self.assertEqual(ends, {"bad": FAILED, "good": FINISHED})

    def test_the_last_call_ends_runs_that_a_limit_of_their_own_ends(self):
        cpus = sorted(os.sched_getaffinity(0))[:1]
        self.assertEqual(self.make([Noted("cut", seconds=1e9)], cpus, Limit(60))["cut"], STOPPED)
        self.assertFalse((self.folder / "cut" / ENDED_BY_TIME).exists())
        ends = self.make([Noted("ended", seconds=1e9), Noted("never")], cpus, Limit(60), last=True)
        self.assertEqual(ends["ended"], "ended by time")
        self.assertEqual(json.loads((self.folder / "ended" / ENDED_BY_TIME).read_text())["steps"], 2)


if __name__ == "__main__":
    unittest.main()
