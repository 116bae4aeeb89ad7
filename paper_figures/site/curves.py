"""Draws a run's curves for its page: time, detections, contacts and smallest distance over its steps, each a file of
its own, so that a narrow screen shows them below one another."""

import math
from dataclasses import dataclass

import matplotlib

from plots import style

PANELS = (("wall", "time a step [ms]", 1), ("discrete_detections", "detections a step", 1),
          ("edge_edge_contacts", "edge–edge contacts", 1), ("smallest_distance", "smallest distance [mm]", 1e3))
FEWEST = 20  # steps; a curve of fewer says nothing
SIZE = (4.4, 2.2)  # inches
PIXELS = (422, 211)


@dataclass(frozen=True)
class Curve:
    src: str
    label: str
    alt: str


def are_drawn(run):
    """Returns whether a run's curves are worth drawing; those of a window or of a single step are not."""
    return run.step_count >= FEWEST and run.first_step == 1


class Drawing:
    """One pair of axes that is used for all curves: to make new ones takes most of the time of a drawing."""

    def __init__(self):
        self.figure = style.use().figure(figsize=SIZE, layout="none")
        self.axes = self.figure.add_axes((0.19, 0.21, 0.76, 0.74))
        (self.line,) = self.axes.plot([], [], linewidth=0.9)
        self.axes.set_xlabel("step")

    def draw(self, run, out, root):
        """Writes OUT_1.svg … below `root`; returns curves. `out`: path below the root, without its ending."""
        found = []
        for number, (name, label, factor) in enumerate(PANELS, 1):
            steps, values = run.course(name)
            values = [factor * value for value in values]
            path = root / f"{out}_{number}.svg"
            path.parent.mkdir(parents=True, exist_ok=True)
            self.line.set_data(steps, values)
            known = [value for value in values if math.isfinite(value)] or [0.0]
            self.axes.set(xlim=(0, steps[-1]), ylim=(0, 1.05 * max(known) or 1), ylabel=label)
            with matplotlib.rc_context({"svg.hashsalt": str(out), "figure.constrained_layout.use": False}):
                self.figure.savefig(path, metadata={"Date": None, "Creator": None})
            alt = f"{label[0].upper()}{label[1:]} over {len(steps)} points up to step {steps[-1]:g}: " \
                  f"from {min(known):.3g} to {max(known):.3g}, at the end {values[-1]:.3g}."
            found.append(Curve(path.relative_to(root).as_posix(), label, alt))
        return found
