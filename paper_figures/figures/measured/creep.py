"""A sheet on a slope for ten seconds, with friction below, at and above the tangent of the slope's angle, for three
ε_v: how far it slides, and how fast it creeps; and the effect of few iterations and of a stiff contact. Runs, table and
picture.

Friction grows with the speed up to ε_v, so nothing ever sticks: a sheet that static friction would hold creeps at the
speed at which friction balances its weight. With f(x) = 2x − x² of Eq. 24 this speed is v = ε_v (1 − √(1 − tan α/μ))
for μ ≥ tan α. For smaller μ the sheet accelerates by g (sin α − μ cos α). Measured is the mean speed of the sheet's
centre over the second half of the time.
"""

import json
import math
import sys
from array import array
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from paper_figures.workflow import layers, slide
from paper_figures.workflow.jobs import Job, RunFailure, manifest_of, parser_of_figure
from paper_figures.workflow.runs import provenance, write_table
from plots import style
from ogc_testbed.runs import Run

SIDE = 12  # vertices along a side of the sheet
STEPS = {"smoke": 300, "small": 3000, "paper": 3000}  # 1 s and 10 s
FRAMES = 30
OVER_TANGENT = (0.5, 0.9, 1, 1.1, 2)  # friction over tan α
VELOCITIES = (1e-2, 1e-3, 1e-4)  # ε_v [m/s]: as printed, and in cm/s
BEHIND, AHEAD, BROAD = 1, 20, 1  # cells of 1 m of the plane


def plane():
    """Returns (positions, faces) of a rectangle of cells of 1 m."""
    rows, columns = BEHIND + AHEAD + 1, 2 * BROAD + 1
    points = array("d")
    for i in range(rows):
        for j in range(columns):
            points.extend((i - BEHIND, 0.0, j - BROAD))
    faces = bytearray()
    for i in range(rows - 1):
        for j in range(columns - 1):
            a, b = i * columns + j, i * columns + j + 1
            c, d = b + columns, a + columns
            faces += layers.face(a, b, c) + layers.face(a, c, d)
    return points, bytes(faces)


@dataclass(frozen=True)
class Slope:
    """Holds the scene, written to a file below the folder of the runs (jobs.Job)."""

    steps: int

    @property
    def path(self):
        return f"scenes/slope_{self.steps}/slope.json"

    def write(self, program, root):
        """Writes the scene if it is missing."""
        path = root / self.path
        if path.is_file():
            return
        slide.write(path.parent, SIDE, self.steps, plane())
        (path.parent / "slide.json").rename(path)
        scene = json.loads(path.read_text())
        path.write_text(json.dumps(scene | {"name": "slope"}, indent=1))


@dataclass(frozen=True)
class Case:
    """Holds one case. `stiffness`: k_c [N/m]. With k_c = 2 a vertex rests 0.2 mm below r; with 100, much stiffer than
    m/h² = 3.8 N/m, 4 µm."""

    over: float
    velocity: float
    stiffness: float = 2
    iterations: int = 200
    solver: str = "vbd"

    @property
    def name(self):
        kind = "" if self == Case(self.over, self.velocity) else \
            f"_{self.solver}_stiffness_{self.stiffness:g}_iterations_{self.iterations}"
        return f"friction_{self.over:g}_velocity_{self.velocity:g}{kind}"

    def steps(self, scale):
        """Returns the number of steps. Newton has fewer, because a step takes a hundred times as long."""
        return NEWTON_STEPS if self.solver == "newton" else STEPS[scale]

    def words(self, backend):
        solver = ("--solver", "newton", "--set", "newton_friction_solves=20") if self.solver == "newton" else \
            ("--backend", backend, "--set", f"iterations={self.iterations}")
        return (*solver, "--set", f"contact_stiffness={self.stiffness:g}", "--set",
                f"friction={self.over * math.tan(slide.ANGLE):.7g}", "--set", f"friction_velocity={self.velocity:g}")


NEWTON_STEPS = 90
CREEPING = tuple(Case(over, velocity) for over in OVER_TANGENT for velocity in VELOCITIES)
CASES = (*CREEPING, *(Case(over, VELOCITIES[0], *kind) for over in (0, 0.5, 1.1)
                      for kind in ((2, 20), (100, 20), (100, 200), (100, 0, "newton"))))


def jobs(scale, backend):
    for case in CASES:
        scene = Slope(case.steps(scale))
        yield Job(case.name, (*case.words(backend), "--audit", "end", "--set",
                              f"frame_steps={scene.steps // FRAMES}"), scene=scene)


def ways(run):
    """Returns (times [s], distances by which the sheet's centre slid down the slope [m]) of the stored states."""
    frames = [run.frame(path) for path in run.frames]
    sheet = slice(0, SIDE * SIDE)
    start = run.start_positions[sheet, 0].mean()
    return np.array([frame.time for frame in frames]), \
        np.array([frame.positions[sheet, 0].astype(float).mean() - start for frame in frames])


def predicted(over, velocity, begin, end):
    """Returns the mean speed between two times [m/s]."""
    if over < 1:
        return slide.ALONG * (1 - over) * (begin + end) / 2
    return velocity * (1 - math.sqrt(1 - 1 / over))


def finished(folder):
    """Returns case -> Run of the finished runs."""
    return {case: Run(folder / case.name) for case in CASES
            if manifest_of(folder / case.name).get("status") == "finished"}


def speed(run):
    """Returns (mean speed of the centre in the second half of the time [m/s], begin and end of that half [s])."""
    times, way = ways(run)
    half = len(times) // 2
    return (way[-1] - way[half]) / (times[-1] - times[half]), times[half], times[-1]


def row_of(case, run):
    found, begin, end = speed(run)
    expected = predicted(case.over, case.velocity, begin, end)
    return {"solver": case.solver, "friction over tan α [1]": f"{case.over:g}", "ε_v [m/s]": f"{case.velocity:g}",
            "k_c [N/m]": f"{case.stiffness:g}", "iterations": case.iterations or "", "seconds": f"{end:.4g}",
            "way [m]": f"{ways(run)[1][-1]:.6g}", "speed in the second half [m/s]": f"{found:.6g}",
            "predicted [m/s]": f"{expected:.6g}", "over predicted [1]": f"{found / expected:.4g}", **provenance(run)}


def draw(runs, out):
    plt = style.use()
    figure, (over_time, creep, other) = plt.subplots(1, 3, figsize=(13, 4))
    for case in filter(runs.get, CREEPING):
        colour, dash = OVER_TANGENT.index(case.over), VELOCITIES.index(case.velocity)
        over_time.plot(*ways(runs[case]), style.DASHES[dash], linewidth=1, color=style.COLOURS[colour],
                       label=f"μ = {case.over:g} tan α, ε_v = {case.velocity:g} m/s")
    over_time.set(xlabel="time [s]", ylabel="way of the centre [m]", yscale="log", title="A sheet on a slope")
    kinds = {"k_c = 2 N/m, 200 iterations": CREEPING}
    for case in CASES[len(CREEPING):]:
        words = "Newton" if case.solver == "newton" else f"{case.iterations} iterations"
        kinds.setdefault(f"k_c = {case.stiffness:g} N/m, {words}", []).append(case)
    for number, (label, cases) in enumerate(kinds.items()):
        axes = other if number else creep
        points = [(predicted(case.over, case.velocity, *speed(runs[case])[1:]), speed(runs[case])[0])
                  for case in cases if case in runs]
        axes.plot(*zip(*points), "o^svD"[number], color=style.COLOURS[number], label=label, alpha=0.7)
    for axes, title in ((creep, "On the line: the law of friction"), (other, "Few iterations, stiff contact")):
        axes.axline((1e-4, 1e-4), (1e-2, 1e-2), color="black", linewidth=0.5)
        axes.set(xscale="log", yscale="log", xlabel="predicted [m/s]", ylabel="speed in the second half [m/s]",
                 title=title)
    for axes in (over_time, creep, other):
        axes.legend(fontsize=5, loc="lower right")
    style.save(figure, out)


def main():
    options = parser_of_figure(__doc__.splitlines()[0], STEPS).parse_args()
    try:
        for job in jobs(options.scale, options.backend):
            job.make(options.ogc, options.folder, shown=True)
    except RunFailure as error:
        sys.exit(f"creep: {error}")
    runs = finished(options.folder)
    write_table(options.folder / "creep.csv", [row_of(*item) for item in runs.items()])
    draw(runs, options.folder / "creep.png")


if __name__ == "__main__":
    main()
