"""Makes parts side by side on a machine with several devices. A job on a device has one of them for itself; all of
these jobs together have a quarter of the processors, with jobs of which the reference takes nearly all of the time, a
core each; as many jobs that need processors alone, as audits do, divide the rest. Of jobs that wait for a place, the
one whose part was named first gets it. Parts that time processors come last, one after the other, with the machine for
themselves. Python's own library is enough.
"""

import contextlib
import contextvars
import itertools
import os
import threading
import time
from concurrent.futures import ThreadPoolExecutor

from paper_figures.workflow.jobs import CORE, CORES, DEVICE, PLACE, Place, here
from paper_figures.workflow.runner import Runner

TIMED = ("windows_", "fig17_cpu", "fig18_solvers", "fig19_windows", "fig19_one_step", "growth_cpu", "threads")
LOOK = 0.2  # seconds between looks at the limit while a job waits for its place
PART = contextvars.ContextVar("part", default="")  # the part that this thread makes


def devices(number):
    """Returns the names of the first devices of those that the environment shows."""
    shown = os.environ.get("CUDA_VISIBLE_DEVICES")
    return (shown.split(",") if shown else list(map(str, range(number))))[:number]


def places(names, cores):
    """Returns what is needed -> places. Without four processors a device nothing is pinned."""
    quarter = len(cores) // 4 if len(cores) >= 4 * len(names) else 0
    each = (len(cores) - quarter) // len(names) if quarter else 0
    begins = range(quarter, quarter + each * len(names), each) if each else [0] * len(names)
    # A job on a device keeps two processors busy, as it writes its frames beside its steps.
    beside = max(len(names), quarter - 2 * len(names))
    return {DEVICE: [Place(name, tuple(cores[:quarter])) for name in names],
            CORES: [Place(name, tuple(cores[begin:begin + each])) for name, begin in zip(names, begins)],
            CORE: [Place(name, tuple(cores[:quarter])) for name in itertools.islice(itertools.cycle(names), beside)]}


class Places:
    """Hands out places of one kind, to the job of lowest rank first, of equal ranks to the one that came first."""

    def __init__(self, free):
        self.free, self.waiting, self.numbers = list(free), [], itertools.count()
        self.changed = threading.Condition()

    def take(self, rank, limit):
        """Returns a place, or None if the limit came first."""
        with self.changed:
            ticket = (rank, next(self.numbers))
            self.waiting.append(ticket)
            while not (self.free and min(self.waiting) == ticket) and limit.left() > 0:
                self.changed.wait(LOOK)
            self.waiting.remove(ticket)
            self.changed.notify_all()
            return self.free.pop(0) if self.free and limit.left() > 0 else None

    def give(self, place):
        with self.changed:
            self.free.append(place)
            self.changed.notify_all()


class SideBySide(Runner):
    """Makes parts of a book as Runner does, several at once."""

    def __init__(self, *arguments, cards, **more):
        super().__init__(*arguments, **more)
        found = places(devices(cards), sorted(os.sched_getaffinity(0)))
        self.free = {needed: Places(free) for needed, free in found.items()}
        # There are more workers than places, so that a part whose audit waits for processors keeps no device waiting.
        self.workers, self.alone, self.held = 4 * cards, False, []  # held: (part, seconds) of each job's place
        self.jobs, self.ranks = max(self.jobs, self.workers), {}

    @contextlib.contextmanager
    def place(self, job, limit):
        """Waits for a place, at most until the limit, and sets it for the commands of this thread."""
        needed = getattr(job, "needs", DEVICE if job.on_device else CORES)
        anywhere = job.on_device is None or self.alone and needed != DEVICE
        place = None if anywhere else self.free[needed].take(self.ranks.get(PART.get(), 0), limit)
        before, begun = PLACE.set(place or Place()), time.monotonic()
        try:
            yield
        finally:
            PLACE.reset(before)
            self.held.append((PART.get(), time.monotonic() - begun))
            if place:
                self.free[needed].give(place)

    def make_all(self, chosen, groups, ended):
        """Makes parts in their order, those of one of the `groups` (lists of names) never at once; calls
        `ended(name, end, seconds)` after each, with the time for which its jobs had their places."""
        timed, self.ranks = [name for name in chosen if name.startswith(TIMED)], dict(zip(chosen, itertools.count()))
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
