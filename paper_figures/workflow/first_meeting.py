"""Finds the step of a run in which threads first met, if not every step was checked. A window in which they met limits
the search; all steps before it are checked, from one stored state to the next. Needs only Python's own library.
"""

import csv
import os
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

from paper_figures.workflow.jobs import FINISHED, KEPT, PLACE, STOPPED, Limit, here


def met_at(run):
    """Returns the first step of a window on whose way threads met, or None."""
    rows = run / "steps.csv"
    if not rows.is_file():
        return None
    with rows.open(newline="") as lines:
        asked = [(int(row["step [1]"]), float(row.get("meetings [1]") or "nan")) for row in csv.DictReader(lines)]
    return next((step for step, met in asked if met > 0), None)


@dataclass(frozen=True)
class FirstMeeting:
    """Finds the first meeting as a job (jobs.py). `windows` are far apart, and made before; `window_after(step)` is the
    job of the `every` steps after a stored state."""

    name: str
    windows: tuple
    window_after: Callable
    every: int

    @property
    def on_device(self):
        return self.windows[0].on_device

    def before(self, root):
        """Returns the windows up to the first known meeting; none if there is no meeting."""
        known = [step for step in (met_at(root / window.name) for window in self.windows) if step is not None]
        return [self.window_after(step) for step in range(0, min(known, default=0), self.every)]

    def made_below(self, root):
        return [window for window in self.before(root) if (root / window.name).is_dir()]

    def done(self, root):
        return all(window.done(root) for window in self.before(root))

    def make(self, program, root, limit=Limit(), shown=False):
        cores = len(PLACE.get().cores) or os.cpu_count() or 1
        with ThreadPoolExecutor(max_workers=max(1, cores // 2)) as pool:
            tasks = [pool.submit(here(window.make, program, root, limit, shown)) for window in self.before(root)]
        ends = [task.result() for task in tasks]
        return next((end for end in (STOPPED, FINISHED) if end in ends), KEPT)

    def results(self, root, frames, last):
        for window in self.made_below(root):
            yield from window.results(root, frames, last)
