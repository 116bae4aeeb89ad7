"""Names the parts that the runner can make: the runs of a figure or a row of Table 1, as chains of jobs.

A chain's jobs are made one after the other; chains of one part may run at the same time. Folders below that of the runs
are those of the workflow (FIGURE-SCALE-BACKEND).
"""

import os
from dataclasses import dataclass

from paper_figures.workflow import commands, half_turn

# Rows of Table 1, the most wanted first: the figure drawn from the row, and the frames that are packed of it, so many
# that the moments of the figure are among them.
OF_SCENES = {"twist": ("", 2), "fifty_layers_1m": ("", 0), "cloth_on_sphere": ("fig18", 21),
             "fifty_layers": ("fig10", 21), "knot": ("", 2), "dress": ("", 2), "robot_shirt": ("", 2),
             commands.MAT: ("fig19", 17)}
DRAWN_OTHERWISE = {"twist_planes": ("fig12", 37), "knot_planes": ("fig11", 31), commands.MAT_PLANES: ("fig19", 17),
                   "dress_volumes": ("fig13", 19), "robot_shirt_volumes": ("fig14", 19)}
ROWS = {**OF_SCENES, **{row: ("", 2) for row in commands.ROWS if row not in OF_SCENES}, **DRAWN_OTHERWISE}
# The folder in which the figure of several runs looks for the row's run; a figure of one run looks for `run`.
SHOWN = {row: f"{bounds}/whole" for bounds, (row, _) in commands.MAT_BOUNDS.items()}
WINDOW = {"smoke": 20, "small": 20, "paper": 10}  # steps on the CPU


@dataclass(frozen=True)
class Part:
    """Holds a part. `recipe`: the figure of its runs. Of each run `frames` are packed, evenly over it, and the `last`
    ones. `shown_as`: the folder where the figure's workflow looks for the run of the part's first job."""

    folder: str
    chains: tuple
    recipe: str = ""
    frames: int = 4
    last: int = 0
    shown_as: str = ""

    @property
    def jobs(self):
        return [job for chain in self.chains for job in chain]


@dataclass(frozen=True)
class Wanted:
    """Holds the choices for all parts; `window`, `runs`, `steps`, `audit` and `data` concern Table 1, `window_seconds`
    Fig. 19."""

    scale: str = "paper"
    backend: str = "cuda"
    window: int = 0
    runs: int = 1
    steps: int = 0
    audit: str = "afterwards"
    data: str = ""
    window_seconds: float = 0

    @property
    def backends(self):
        return list(dict.fromkeys(["cpu", self.backend]))

    def folder(self, name, backend=None):
        return f"{name}-{self.scale}-{backend or self.backend}"


def book(wanted):
    """Returns name -> Part, the most wanted first. Parts that time a CPU, and so need the machine for themselves, come
    last."""
    figures, rows = of_figures(wanted), of_table(wanted)
    first = {name: figures.pop(name) for name in ("fig02", "fig20", "fig17")}
    return {"twist": rows.pop("twist"), **first, **rows, **of_growth(wanted), **figures, **whole_figures(wanted),
            **windows(wanted)}


def of_figures(wanted):
    """Returns the parts of figures that are made of several runs."""
    scale, backend, folder = wanted.scale, wanted.backend, wanted.folder
    single, double = commands.three_cloths(scale, wanted.backends)
    half_turns = half_turn.ogc(scale, backend)
    by_ipc = [] if scale == "paper" else half_turn.ipc(scale)
    drop, ipc = commands.beside_ipc(commands.ONE_ITERATION, scale, backend)
    on_cpu = tuple(job for job in single if "cpu" in job.name and backend != "cpu")
    on_device = tuple(job for job in single if job not in on_cpu)
    one_by_one = lambda jobs: tuple((job,) for job in jobs)  # noqa: E731
    solvers = tuple(commands.solvers(scale, cuda=backend == "cuda"))
    minimiser = tuple(commands.minimiser(scale, backend))
    return {
        "fig02": Part(folder("fig02"), one_by_one(half_turns), "fig02", frames=13),
        "fig20": Part(folder("fig20"), ((drop,),), "fig20", frames=25),
        "fig17": Part(folder("fig17"), (on_device,), "fig17", frames=0, last=1),
        "fig17_cpu": Part(folder("fig17"), (on_cpu,), "fig17", frames=0, last=1),
        "fig21": Part(folder("fig21"), tuple(map(tuple, commands.activations(scale, backend))), "fig21", frames=0,
                      last=2),
        **({"fig02_ipc": Part(folder("fig02"), one_by_one(by_ipc), "fig02", frames=13)} if by_ipc else {}),
        "fig20_ipc": Part(folder("fig20"), ((ipc,),), "fig20", frames=25),
        "fig17_double": Part(folder("fig17"), one_by_one(double), "fig17", frames=0, last=1),
        # For a figure on the CPU, as its recipe states: its ratios are of the same cores, with nothing running beside.
        "fig18_solvers": Part(folder("fig18_solvers", "cpu"), (solvers,), "fig18_solvers", frames=21),
        **of_mat(wanted),
        "minimiser": Part(folder("minimiser"), (minimiser,), "minimiser", frames=0, last=1),
        **of_quality(wanted),
        "fig15": Part(folder("fig15"), tuple(commands.yarn_stretched(scale, backend)), "fig15", frames=13, last=1),
        "fig16": Part(folder("fig16"), tuple(commands.yarn_twisted(scale, backend)), "fig16", frames=13, last=1),
        "fig16_rest": Part(folder("fig16_rest"), tuple(commands.yarn_at_rest(scale, backend)), "fig16_rest", frames=0,
                           last=3),  # of the last second
    }


def of_quality(wanted):
    """Returns three parts for each scene: whole runs and timed steps; residuals of steps from their states; minima from
    the same states, which are packed. The last two need only processors."""
    scale, data, folder = wanted.scale, wanted.data, wanted.folder("table1")

    def part(scene, jobs_of):
        jobs = tuple(job for row in commands.quality_rows(scene) for job in jobs_of(row))
        return Part(folder, (jobs,), "quality", frames=0)

    kinds = {"quality": lambda row: commands.timed(row, scale, wanted.backend, wanted.steps, data),
             "left": lambda row: commands.left(row, scale, data),
             "minimum": lambda row: commands.minimum(row, scale, data)}
    return {f"{kind}_{scene}": part(scene, jobs_of) for kind, jobs_of in kinds.items()
            for scene in (commands.MINIMUM_SCENES if kind == "minimum" else commands.QUALITY_ITERATIONS)}


def of_mat(wanted):
    """Returns Fig. 19 after Table 1's whole runs of the mat, from whose states it begins."""
    folder, whole_mat = wanted.folder("fig19"), tuple(commands.mat_whole(wanted.scale, wanted.backend))
    free = tuple(commands.mat_without_friction(wanted.scale, wanted.backend))
    return {"fig19": Part(folder, (whole_mat,), "fig19", frames=17),
            "fig19_free": Part(folder, (free,), "fig19"),
            "fig19_windows": Part(folder, (tuple(commands.mat_windows(wanted.scale, wanted.window_seconds)),),
                                  "fig19", frames=2),
            "fig19_one_step": Part(folder, (tuple(commands.mat_one_step(wanted.scale, wanted.window_seconds)),),
                                   "fig19", frames=0, last=1)}


def whole(row, wanted):
    return commands.whole_runs(row, wanted.scale, wanted.backend, wanted.runs, wanted.steps, wanted.audit, wanted.data)


def of_table(wanted):
    """Returns a row's whole runs, and one step from their states."""
    jobs = {row: (*whole(row, wanted), *commands.residuals(row, wanted.scale, wanted.backend, wanted.data))
            for row in ROWS}
    folder = wanted.folder("table1")
    shown = {row: f"{wanted.folder(ROWS[row][0])}/{place}" for row, place in SHOWN.items()}
    return {row: Part(folder, (jobs[row],), "table1", frames, shown_as=shown.get(row, ""))
            for row, (_, frames) in ROWS.items()}


def whole_figures(wanted):
    """Returns the figures of a row's scene that are drawn from the row's whole run."""
    folder = wanted.folder("table1")
    return {figure: Part(folder, (tuple(whole(row, wanted)),), figure, frames, shown_as=f"{wanted.folder(figure)}/run")
            for row, (figure, frames) in ROWS.items() if figure and row not in SHOWN}


def windows(wanted):
    """Returns steps on the CPU from states of whole runs; the million vertices come last."""
    steps, folder = wanted.window or WINDOW[wanted.scale], wanted.folder("table1")
    rows = sorted(ROWS, key=lambda row: commands.scene_of(row) == "fifty_layers_1m")
    return {f"windows_{row}": Part(folder, (tuple(commands.cpu_windows(row, steps, wanted.scale, wanted.data)),),
                                   "table1")
            for row in rows}


def of_growth(wanted):
    over = {f"growth_{backend}": commands.sizes(wanted.scale, backend) for backend in reversed(wanted.backends)}
    over["contacts"] = commands.many_contacts(wanted.scale, wanted.backend)
    over["threads"] = commands.threads(wanted.scale, os.cpu_count() or 1)
    return {name: Part(wanted.folder("growth"), (tuple(jobs),), "growth", frames=0) for name, jobs in over.items()}


def chosen(parts, names=(), figures=()):
    """Returns the parts of these names, then those of these figures; without both, those of all figures. Throws
    KeyError with a name that is neither."""
    there = {part.recipe for part in parts.values()}
    for name in [*(name for name in names if name not in parts), *(name for name in figures if name not in there)]:
        raise KeyError(name)
    of_figures = {name: part for name, part in parts.items() if part.recipe in (figures or there - {""})}
    return {**{name: parts[name] for name in names}, **(of_figures if figures or not names else {})}
