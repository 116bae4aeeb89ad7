"""Makes the jobs of all parts at the same time, each on cores of its own: the runner's --cores. A job begins when the
runs are there from whose states it begins; jobs after which most follows, counted in seconds, go first, and smaller
ones fill the cores that a large one does not find. Such runs are timed beside other runs. Needs only Python's own
library.
"""

import json
import os
import threading
import time
from dataclasses import dataclass, field
from pathlib import Path

from paper_figures.workflow.jobs import ENDED_BY_TIME, FAILED, STOPPED, RunFailure, failed_in_step, manifest_of

TIMES = "times.json"  # beside the runs: run -> how many cores had it, for how many seconds, and how it ended
USUAL_CORES, USUAL_SECONDS = 2, 20.0  # of a job that nobody measured
PATIENCE = 60.0  # after so many seconds without room for the first job, nothing smaller begins before it
LOOK = 0.1  # seconds between looks at the limit


@dataclass
class Task:
    """Holds a job of parts. `name`: of its run, below the folder of all runs; `needs`: names of those from which it
    begins; `follows`: seconds of the longest chain that begins with it. It runs on `cores`, or on a third of them."""

    name: str
    root: Path
    job: object
    needs: set
    parts: list
    cores: int = USUAL_CORES
    seconds: float = USUAL_SECONDS
    follows: float = 0.0
    cpus: set = field(default_factory=set)
    begun: float = 0.0

    @property
    def least(self):
        return -(-self.cores // 3)


def names_needed(job):
    """Returns the names of the jobs of its part that must be made before this one."""
    state, audited = getattr(job, "state", ()), getattr(job, "of", "")
    return [*state[:1], *([audited] if audited else []), *(window.name for window in getattr(job, "windows", ()))]


def tasks_of(book, out, known=None):
    """Returns name -> Task of all jobs of the parts in `book`, each run once. `known`: name -> {"cores", "seconds"} of
    those that were measured."""
    shown = {part.shown_as: f"{part.folder}/{part.chains[0][0].name}" for part in book.values() if part.shown_as}

    def name_in(folder, job_name):
        path = f"{folder}/{job_name}"
        begin = next((place for place in shown if path == place or path.startswith(f"{place}_")), None)
        return shown[begin] + path[len(begin):] if begin else path

    tasks = {}
    for part_name, part in sorted(book.items(), key=lambda item: not item[1].shown_as):
        for job in part.jobs:
            name = name_in(part.folder, job.name)
            if name not in tasks:
                needs = {name_in(part.folder, needed) for needed in names_needed(job)}
                tasks[name] = Task(name, out / part.folder, job, needs, [])
            tasks[name].parts.append(part_name)
    for name, task in tasks.items():
        task.needs &= set(tasks) - {name}
        limit = getattr(task.job, "seconds", 0)
        measured = (known or {}).get(name, {"seconds": limit} if limit else {})
        task.cores, task.seconds = measured.get("cores", USUAL_CORES), measured.get("seconds", USUAL_SECONDS)
    rank(tasks)
    return tasks


def rank(tasks):
    """Sets how many seconds follow each task, itself included."""
    after = {name: [] for name in tasks}
    for name, task in tasks.items():
        for needed in task.needs:
            after[needed].append(name)
    found = {}

    def seconds(name):
        if name not in found:
            found[name] = tasks[name].seconds + max(map(seconds, after[name]), default=0.0)
        return found[name]

    for name, task in tasks.items():
        task.follows = seconds(name)


def longest_chain(tasks):
    """Returns the tasks of the chain that takes longest, in their order."""
    chain, at = [], max(tasks.values(), key=lambda task: task.follows, default=None)
    while at:
        chain.append(at)
        at = max((task for task in tasks.values() if at.name in task.needs), key=lambda task: task.follows,
                 default=None)
    return chain


class Schedule:
    """Decides which task begins on which cores; `clock` returns seconds."""

    def __init__(self, tasks, cpus, clock=time.monotonic):
        self.tasks, self.free, self.clock = tasks, set(cpus), clock
        self.waiting, self.running, self.ends, self.blocked = dict(tasks), {}, {}, {}
        for task in tasks.values():
            task.cores = min(task.cores, len(self.free))

    def ready(self):
        """Returns the tasks that could begin, those first after which most follows."""
        ended = set(self.ends)
        return sorted((task for task in self.waiting.values() if task.needs <= ended), key=lambda task: -task.follows)

    def next(self, left=float("inf")):
        """Returns a task that begins now on its `cpus`, or None; a task that would not end in the `left` seconds comes
        after those that would."""
        now, found = self.clock(), None
        ready = sorted(self.ready(), key=lambda task: task.seconds > left)
        for task in ready:
            if task.least <= len(self.free):
                found = task
                break
            if now - self.blocked.setdefault(task.name, now) >= PATIENCE:
                return None
        if found:
            found.cpus = set(sorted(self.free)[:found.cores])
            self.free -= found.cpus
            self.running[found.name] = self.waiting.pop(found.name)
            self.blocked.pop(found.name, None)
            found.begun = now
        return found

    def ended(self, name, end):
        """Takes a task's cores back. What begins with the states of a run that failed is left out."""
        self.free |= self.running.pop(name).cpus
        self.ends[name] = end
        if end == FAILED:
            self.leave_out(name)

    def leave_out(self, name):
        for task in [task for task in self.waiting.values() if name in task.needs]:
            self.ends[self.waiting.pop(task.name).name] = "left out"
            self.leave_out(task.name)


def cut_by_time(task, seconds):
    """Makes a run that the call's limit stopped a run that its own limit ended, if it has one and the steps that it
    needs; returns whether it has."""
    least, folder = getattr(task.job, "least", 0), task.root / task.job.name
    rows = folder / "steps.csv"
    steps = rows.read_text().count("\n") - 1 if rows.is_file() else 0
    if not getattr(task.job, "seconds", 0) or steps < least or not manifest_of(folder):
        return False
    (folder / ENDED_BY_TIME).write_text(json.dumps({"seconds": round(seconds, 1), "steps": steps}) + "\n")
    return True


def failed_run(task):
    """Returns whether the run of this task is there and failed, which can be a result."""
    return bool(getattr(task.job, "may_fail", False)) and failed_in_step(
        manifest_of(task.root / task.job.name).get("status", ""))


class Maker:
    """Makes tasks with threads, one a task, which have the cores of their tasks; `last`: no call follows this one, so
    that runs which a limit of their own ends are complete where this call's limit stops them."""

    def __init__(self, program, out, limit, last=False):
        self.program, self.out, self.limit, self.last = program, out, limit, last
        self.writes, self.done, self.began = threading.Lock(), [], time.monotonic()

    def work(self, task):
        """Makes a task, in a thread of its own; its program inherits the thread's cores."""
        os.sched_setaffinity(0, task.cpus)
        words = ""
        try:
            if getattr(task.job, "scene", None):
                with self.writes:  # several tasks share a scene's file
                    task.job.scene.write(self.program, task.root)
            end = task.job.make(self.program, task.root, self.limit)
        except RunFailure as problem:
            end, words = FAILED, f"\n  {problem}"
        except Exception as problem:  # noqa: BLE001: a thread's exceptions would be lost
            end, words = FAILED, f"\n  {type(problem).__name__}: {problem}"
        self.done.append((task, FAILED if failed_run(task) else end, words))

    def make(self, tasks, cpus, after=lambda task, end: None):
        """Makes the tasks and returns name -> how each ended; calls `after` in this thread when one has."""
        schedule = Schedule(tasks, cpus)
        while schedule.running or (schedule.waiting and self.limit.left() > 0):
            while self.limit.left() > 0 and (task := schedule.next(self.limit.left())):
                threading.Thread(target=self.work, args=(task,)).start()
            while self.done:
                task, end, words = self.done.pop(0)
                seconds = time.monotonic() - task.begun
                if end == STOPPED and self.last and cut_by_time(task, seconds):
                    end = "ended by time"
                schedule.ended(task.name, end)
                self.note(task, seconds, end)
                print(f"{time.monotonic() - self.began:8.1f} {seconds:8.1f} s on {len(task.cpus):2} cores  "
                      f"{task.name}  {end}{words}; {len(schedule.running)} run, {len(schedule.waiting)} wait, "
                      f"{len(schedule.free)} cores are free", flush=True)
                after(task, end)
            time.sleep(LOOK)
        return {**dict.fromkeys(schedule.waiting, STOPPED), **schedule.ends}

    def note(self, task, seconds, end):
        times = known_in(self.out / TIMES)
        times[task.name] = {"cores": len(task.cpus), "seconds": round(seconds, 1), "end": end}
        (self.out / TIMES).write_text(json.dumps(times, indent=1) + "\n")


def known_in(path):
    return json.loads(path.read_text()) if path and path.is_file() else {}
