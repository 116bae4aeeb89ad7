"""Makes parts side by side on a machine with several devices. A job on a device has one of them for itself; all of
these jobs together have a quarter of the processors, and as many jobs that need processors alone, as audits do, divide
the rest. Parts that time processors come last, one after the other, with the machine for themselves. Python's own
library is enough.
"""

import contextlib
import contextvars
import os
import queue
import threading
import time
from concurrent.futures import ThreadPoolExecutor

from paper_figures.workflow.jobs import PLACE, Place, here
from paper_figures.workflow.runner import Runner

TIMED = ("windows_", "fig17_cpu", "fig18_solvers", "fig19_windows", "fig19_one_step", "growth_cpu", "threads")
LOOK = 0.2  # seconds between looks at the limit while a job waits for its place
PART = contextvars.ContextVar("part", default="")  # the part that this thread makes


def devices(number):
    """Returns the names of the first devices of those that the environment shows."""
    shown = os.environ.get("CUDA_VISIBLE_DEVICES")
    return (shown.split(",") if shown else list(map(str, range(number))))[:number]


def places(names, cores):
    """Returns places on the devices, and places beside them. Without four processors a device nothing is pinned."""
    quarter = len(cores) // 4 if len(cores) >= 4 * len(names) else 0
    each = (len(cores) - quarter) // len(names) if quarter else 0
    begins = range(quarter, quarter + each * len(names), each) if each else [0] * len(names)
    return ([Place(name, tuple(cores[:quarter])) for name in names],
            [Place("", tuple(cores[begin:begin + each])) for begin in begins])


class SideBySide(Runner):
    """Makes parts of a book as Runner does, several at once."""

    def __init__(self, *arguments, cards, **more):
        super().__init__(*arguments, **more)
        self.free = {True: queue.Queue(), False: queue.Queue()}  # whether on a device -> places
        for on_device, found in zip((True, False), places(devices(cards), sorted(os.sched_getaffinity(0)))):
            for place in found:
                self.free[on_device].put(place)
        self.workers, self.alone, self.held = 2 * cards, False, []  # held: (part, seconds) of each job's place
        self.jobs = max(self.jobs, self.workers)

    @contextlib.contextmanager
    def place(self, on_device, limit):
        """Waits for a place, at most until the limit, and sets it for the commands of this thread."""
        place, anywhere = None, on_device is None or self.alone and not on_device
        while not (anywhere or place) and limit.left() > 0:
            with contextlib.suppress(queue.Empty):
                place = self.free[on_device].get(timeout=LOOK)
        before, begun = PLACE.set(place or Place()), time.monotonic()
        try:
            yield
        finally:
            PLACE.reset(before)
            self.held.append((PART.get(), time.monotonic() - begun))
            if place:
                self.free[on_device].put(place)

    def make_all(self, chosen, groups, ended):
        """Makes parts in their order, those of one of the `groups` (lists of names) never at once; calls
        `ended(name, end, seconds)` after each, with the time for which its jobs had their places."""
        timed = [name for name in chosen if name.startswith(TIMED)]
        turn = Turn([name for name in chosen if name not in timed], groups)

        def work():
            while (name := turn.next()) is not None:
                try:
                    self.one(name, chosen[name], ended)
                finally:
                    turn.over(name)

        with ThreadPoolExecutor(max_workers=self.workers) as pool:
            tasks = [pool.submit(here(work)) for _ in range(self.workers)]
        for task in tasks:
            task.result()
        self.alone, self.jobs = True, 1
        for name in timed:
            self.one(name, chosen[name], ended)

    def one(self, name, part, ended):
        PART.set(name)
        end = self.make(name, part)
        ended(name, end, sum(seconds for part_of, seconds in list(self.held) if part_of == name))


class Turn:
    """Hands out names in their order, never two of one group at once."""

    def __init__(self, names, groups):
        self.waiting, self.busy, self.changed = list(names), set(), threading.Condition()
        self.group = {name: number for number, names in enumerate(groups) for name in names}

    def next(self):
        """Returns the next name, as soon as there is one that may begin; None when all have begun."""
        with self.changed:
            while self.waiting:
                for name in self.waiting:
                    if self.group[name] not in self.busy:
                        self.waiting.remove(name)
                        self.busy.add(self.group[name])
                        return name
                self.changed.wait()
            return None

    def over(self, name):
        with self.changed:
            self.busy.discard(self.group[name])
            self.changed.notify_all()
