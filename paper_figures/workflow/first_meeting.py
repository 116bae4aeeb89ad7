"""In which step of a run threads first met, where not every step was asked. Windows that are far apart say between
which of them that was; halves of what lies between are asked next, down to the steps between two stored states.

That threads which met once go on to meet is supposed; where they do not, the meeting that is found is a later one, and
the table's number of steps asked says how much was looked at. Python's own library is enough.
"""

import csv
from collections.abc import Callable
from dataclasses import dataclass

from paper_figures.workflow.jobs import FINISHED, KEPT, STOPPED, Limit


def met_at(run):
    """(first step at which a window's threads met or None, its first step, its last one); None of a window without
    rows."""
    rows = run / "steps.csv"
    if not rows.is_file():
        return None
    with rows.open() as lines:
        asked = [(int(row["step [1]"]), float(row.get("meetings [1]") or "nan")) for row in csv.DictReader(lines)]
    if not asked:
        return None
    return next((step for step, met in asked if met > 0), None), asked[0][0], asked[-1][0]


@dataclass(frozen=True)
class FirstMeeting:
    """A job of jobs. `windows` are far apart, and made before; `window_after(step)` is the job of the `every` steps
    after a stored state."""

    name: str
    windows: tuple
    window_after: Callable
    every: int

    @property
    def on_device(self):
        return self.windows[0].on_device

    def between(self, root):
        """The stored states after which the first meeting may be; none where threads did not meet in a window."""
        low = 0
        for found in filter(None, (met_at(root / window.name) for window in self.windows)):
            first_met, _, last = found
            if first_met is not None:
                return range(low // self.every * self.every, first_met, self.every)
            low = last
        return range(0)

    def made_below(self, root):
        """Windows that there are, by step."""
        return [window for window in map(self.window_after, self.between(root)) if (root / window.name).is_dir()]

    def done(self, root):
        ahead = self.between(root)
        while len(ahead) > 1:
            middle = len(ahead) // 2 - 1
            window = self.window_after(ahead[middle])
            if not window.done(root):
                return False
            ahead = self.half(root, ahead, middle)
        return not ahead or self.window_after(ahead[0]).done(root)

    def half(self, root, ahead, middle):
        """What is left of `ahead` after the window that begins at its item `middle`."""
        found = met_at(root / self.window_after(ahead[middle]).name)
        return ahead[:middle + 1] if found and found[0] is not None else ahead[middle + 1:]

    def make(self, program, root, limit=Limit(), shown=False):
        ahead, ends = self.between(root), [KEPT]
        while ahead:
            middle = max(0, len(ahead) // 2 - 1)
            ends.append(self.window_after(ahead[middle]).make(program, root, limit, shown))
            if ends[-1] == STOPPED:
                return STOPPED
            if len(ahead) == 1:
                break
            ahead = self.half(root, ahead, middle)
        return FINISHED if FINISHED in ends else KEPT

    def results(self, root, frames, last):
        for window in self.made_below(root):
            yield from window.results(root, frames, last)
