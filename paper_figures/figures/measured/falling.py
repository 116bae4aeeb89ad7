"""What falls fast beside something near (Fig. 22b): two triangles side by side, 10 mm apart, and a sheet beside a
sheet, with each kind of bounds and by IPC. Measures how far they fall in 0.2 s, relative to a free fall, and the
detections in each step. Runs, table and picture.

Nothing ever touches, so truncation caused any missing distance. A sheet is also limited by its own mesh: the nearest
facets without a common vertex are an edge away.
"""

import json
import sys
from array import array
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from paper_figures.workflow import layers
from paper_figures.workflow.jobs import Job, RunFailure, parser_of_figure
from paper_figures.workflow.runs import provenance, write_table
from plots import style
from ogc_testbed.runs import Run

NAME = "falling"
APART, RADIUS, GRAVITY = 0.01, 0.005, 9.81  # [m], [m], [m/s²]
TIME_STEP, STEPS = 0.01, 20  # [s]
SIDE, SPACING = 12, 1 / 69  # of a sheet [vertices], [m]
SPEEDS = (0, 1, 3, 10, 30)  # downwards at the start [m/s]
KINDS = ("triangles", "sheets")
LEFT = array("d", (-0.025, 0, 0, -0.005, 0, 0, -0.015, 0.015, 0))  # as in Fig. 22b
POLICIES = {"ball": (), "ball, one round": ("--set", "guess_rounds=1"), "planes": ("--set", "bounds=planes"),
            "planes, nothing slides": ("--set", "bounds=dat"), "off": ("--set", "bounds=off"),
            "ipc": ("--solver", "ipc")}
NAMES = {"ball": "balls", "ball, one round": "balls, one round", "planes": "planes",
         "planes, nothing slides": "planes, nothing slides", "off": "no bounds", "ipc": "IPC"}
KINDS_SAID = {"triangles": "Two triangles", "sheets": "Two sheets"}
TITLE = "Bounds hold back what falls fast beside something near; IPC's line search does not"
ALT = ("Plots over the speed of a fall, for several bounds: the way that is made over that of a free fall, "
       "and the detections a step.")


def mirrored(points):
    """Mirrors points at x = 0."""
    return array("d", (-value if i % 3 == 0 else value for i, value in enumerate(points)))


def left(kind):
    """Returns (positions, faces) of the body at negative x. Sheets lie in planes of constant x and fall within them."""
    if kind == "triangles":
        return LEFT, layers.face(0, 1, 2)
    level = layers.positions(SIDE, SPACING, 0.0)
    upright = array("d")
    for i in range(0, len(level), 3):
        upright.extend((-APART / 2, level[i], level[i + 2]))
    return upright, layers.triangles(SIDE)


@dataclass(frozen=True)
class Fall:
    """Holds the scene, written to a file below the folder of the runs (jobs.Job)."""

    kind: str
    speed: float

    @property
    def path(self):
        return f"scenes/{self.kind}_{self.speed:g}/falling.json"

    def write(self, program, root):
        """Writes the scene if it is missing."""
        path = root / self.path
        if path.is_file():
            return
        path.parent.mkdir(parents=True, exist_ok=True)
        points, faces = left(self.kind)
        layers.write_mesh(path.parent / "left.ply", points, faces)
        layers.write_mesh(path.parent / "right.ply", mirrored(points), faces)
        body = {"velocity": [0, -self.speed, 0], "material": {"density": 0.2, "friction": 0}}
        scene = {"format_version": 2, "name": NAME, "gravity": [0, -GRAVITY, 0],
                 "settings": {"time_step": TIME_STEP, "steps": STEPS, "iterations": 20, "contact_radius": RADIUS},
                 "bodies": [{"name": side, "mesh": f"{side}.ply", **body} for side in ("left", "right")]}
        path.write_text(json.dumps(scene, indent=1))


@dataclass(frozen=True)
class Case:
    kind: str
    speed: float
    policy: str

    @property
    def name(self):
        return f"{self.kind}_{self.speed:g}_{self.policy.replace(', ', '_').replace(' ', '_')}"

    @property
    def job(self):
        return Job(self.name, (*POLICIES[self.policy], "--audit", "end"), scene=Fall(self.kind, self.speed))

    @property
    def free_way(self):
        """Returns the distance of a free fall by backward Euler [m]. The n-th step moves by h (v + n h g)."""
        return TIME_STEP * sum(self.speed + n * TIME_STEP * GRAVITY for n in range(1, STEPS + 1))


CASES = [Case(kind, speed, policy) for kind in KINDS for speed in SPEEDS for policy in POLICIES]


def row_of(case, run):
    fallen = run.start_positions[:, 1].mean() - run.frame(run.frames[-1]).positions[:, 1].astype(float).mean()
    detections = run.column("discrete_detections") + run.column("continuous_detections")
    return {"what": case.kind, "speed at the start [m/s]": f"{case.speed:g}", "bounds": case.policy,
            "way over that of a free fall [1]": f"{fallen / case.free_way:.5g}",
            "detections a step [1]": f"{np.mean(detections):.4g}",
            "most detections of a step [1]": int(np.max(detections)),
            "intersections": {True: "none", False: "FOUND"}.get(run.manifest.get("guarantee_kept"), "not audited"),
            **provenance(run)}


def draw(rows, out):
    plt = style.use()
    below = (f"falls of {STEPS * TIME_STEP:g} s, {APART * 1e3:g} mm apart, r = {RADIUS * 1e3:g} mm; a way of 1 is that "
             "of a free fall")
    figure, grid = style.page([(2.5, [(0.5, "plot")] * len(KINDS))] * 2 + [(0.3, [(1.0, "picture")])], TITLE, below)
    for column, kind in enumerate(KINDS):
        for line, name in zip(grid, ("way over that of a free fall [1]", "detections a step [1]")):
            for number, policy in enumerate(POLICIES):
                mine = [row for row in rows if (row["what"], row["bounds"]) == (kind, policy)]
                speed, value = ([float(row[key]) for row in mine] for key in ("speed at the start [m/s]", name))
                line[column].plot(speed, value, "o^svDx"[number] + "-", color=style.COLOURS[number], alpha=0.7,
                                  label=NAMES[policy])
            line[column].set(xlabel="speed at the start [m/s]", xscale="symlog", ylabel=name.partition(" [")[0],
                             title=f"{KINDS_SAID[kind]}: {name.partition(' [')[0]}")
            line[column].xaxis.set_major_locator(plt.FixedLocator(SPEEDS))
            line[column].xaxis.set_major_formatter(lambda value, _: f"{value:g}")
        grid[1][column].set_yscale("log")
    grid[2][0].axis("off")
    handles, labels = grid[0][0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="lower center", ncols=len(labels))
    style.save(figure, out, TITLE, ALT, f"{NAME}; " + ", ".join(sorted({row["commit"] for row in rows})))


def main():
    options = parser_of_figure(__doc__.splitlines()[0], has_backend=False).parse_args()
    try:
        for case in CASES:
            case.job.make(options.ogc, options.folder, shown=True)
    except RunFailure as error:
        sys.exit(f"{NAME}: {error}")
    rows = [row_of(case, Run(options.folder / case.name)) for case in CASES]
    write_table(options.folder / f"{NAME}.csv", rows)
    draw(rows, options.folder / f"{NAME}.png")


if __name__ == "__main__":
    main()
