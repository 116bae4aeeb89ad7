"""Names the parts whose runs vary what claims leave open before they are called refuted, and the parts that measure
times by repetition: each is a command of `experiments/evidence`. Needs only Python's own library.

  steady_ROW       whole runs on a quiet device, repeated (steady.py): the other membrane, the dress without the rule
                   that deep vertices cause detections, and the mat thicker or nearly incompressible among them, and
                   with `--data` the published dress
  fig17_printed    one step of Fig. 17 with the printed γ_e at each of several steps
  fig17_share      that of the figure with the time of each stage, and without, in a process that is warm
  fig17_membrane   the figure's step with the other membrane; fig17_membrane_newton by Newton's method
  fig02_neighbours, fig02_wide   Fig. 2 at r of one edge and of ten, with k_c and the neighbours left out varied
  yarn_return      Fig. 16's return, with a chain for each of thirty cases, ten starts among them

Each part of Fig. 17 ends with its table. Expected seconds are of one H200, or of two cores where the name ends in
`newton`, estimated from runs of the same length until a call has measured them.
"""

import csv
import math
import subprocess
from dataclasses import dataclass, replace

from paper_figures.workflow import commands, half_turn, yarn_cases
from paper_figures.workflow.evidence import command_of, manifest_at, membranes_of
from paper_figures.workflow.jobs import KEPT, Job, Limit, Step, manifest_of
from paper_figures.workflow.parts import Part
from paper_figures.workflow.steady import Repeated, as_csv, rows_in, write_changed

ST_VENANT, THREE_CLOTHS = commands.ST_VENANT, commands.THREE_CLOTHS
STEADY, FIG17, FIG02 = "steady", "fig17_varied", "fig02_varied"  # folders of runs
REPEATS = commands.REPEATS
PRINTED_AT = {"smoke": (10, 20), "small": (10, 20, 30, 40), "paper": (10, 20, 30, 40, 50, 60, 70)}  # steps of Fig. 17
ROUNDS = (16, 1)  # of the guess loop: the scene's at most, and Eq. 28 as printed
THICKER = 2  # times
EXPECTED = {"steady_cloth_on_sphere": 15, "steady_twist": 60, "steady_knot": 220, "steady_knot_st_venant": 200,
            "steady_fifty_layers": 270,
            "steady_fifty_layers_1m": 780, "steady_fifty_layers_1m_st_venant": 780, "steady_dress_volumes": 45,
            "steady_dress_volumes_st_venant": 45, "steady_dress_volumes_shallow": 35,
            "steady_dress_volumes_published": 60, "steady_robot_shirt_volumes": 40,
            "steady_robot_shirt_volumes_st_venant": 40, "steady_mat_twist_planes": 220,
            "steady_mat_twist_planes_poisson": 220, "steady_mat_twist_planes_thicker": 220, "steady_yarn_stretch": 45,
            "steady_yarn_twist": 70, "fig17_printed": 900, "fig17_share": 30, "fig17_membrane": 350,
            "fig17_membrane_newton": 3600, "fig02_neighbours": 240, "fig02_wide": 600, "yarn_return": 4500}


@dataclass(frozen=True)
class Thicker:
    """Holds the mat with another thickness: the scene's mesh, stretched along y (jobs.Job)."""

    scale: str
    times: float

    @property
    def path(self):
        return f"scenes/thicker_{self.scale}_{self.times:g}/{commands.MAT}.json"

    def write(self, program, root):
        """Writes the scene if it is missing."""
        path = root / self.path
        if path.is_file():
            return
        subprocess.run([str(program), "scenes", commands.MAT, "--scale", self.scale, "--write", str(path.parent)],
                       check=True, stdout=subprocess.DEVNULL)
        for mesh in path.parent.glob("*.msh"):
            mesh.write_text(stretched(mesh.read_text(), self.times))


def stretched(mesh, times):
    """Returns the text of a Gmsh mesh with all y multiplied."""
    lines, inside = mesh.splitlines(), False
    for i, line in enumerate(lines):
        inside = line == "$Nodes" or inside and line != "$EndNodes"
        words = line.split()
        if inside and len(words) == 3:  # the lines of entities have four words, those of numbers one
            lines[i] = f"{words[0]} {float(words[1]) * times!r} {words[2]}"
    return "\n".join(lines) + "\n"


def repeated(scale, backend, data=""):
    """Returns what is repeated; on processors the sphere alone. `data`: the folder of the published dress."""
    if backend == "cpu":
        return (Repeated("cloth_on_sphere"),)
    mat = Repeated(commands.MAT_PLANES)
    dress, shirt, million = (Repeated(row) for row in ("dress_volumes", "robot_shirt_volumes", "fifty_layers_1m"))
    knot, million = Repeated("knot"), replace(million, runs=3)
    other = lambda row: replace(row, suffix="_st_venant", options=ST_VENANT)  # noqa: E731
    return (*map(Repeated, ("cloth_on_sphere", "yarn_twist", "yarn_stretch", "twist")), shirt, other(shirt), dress,
            other(dress),
            replace(dress, suffix="_shallow", options=("--set", "detection_deep=0"), choice="detection_deep=0"),
            *([replace(dress, suffix="_published", options=("--set", f"data={data}"), choice="the published dress")]
              if data else []),
            Repeated("fifty_layers", runs=3), mat,
            replace(mat, suffix="_poisson", options=("--set", "solid_poisson=0.49"), runs=3, choice="ν = 0.49"),
            replace(mat, suffix="_thicker", scene=Thicker(scale, THICKER), runs=3, choice="twice as thick"),
            knot, other(replace(knot, runs=3)), million, other(million))


@dataclass(frozen=True)
class Table:
    """Makes a table from finished runs: a row for each of `jobs`. As a job it costs nothing, and is made anew in each
    call, and when its part is packed, as a limit may come before it. `row_of`: returns the cells of a run folder."""

    name: str
    jobs: tuple
    row_of: object
    on_device = False

    def done(self, _root):
        return False

    def make(self, _program, root, _limit=Limit(), _shown=False):
        rows = [{**self.row_of(root / job.name), **provenance(root / job.name)} for job in self.jobs if job.done(root)]
        if rows:
            write_changed(root / f"{self.name}.csv", as_csv(list(rows[0]), rows).encode())
        return KEPT

    def results(self, root, _frames, _last):
        self.make("", root)
        yield from (path for path in [root / f"{self.name}.csv"] if path.is_file())


def provenance(folder):
    """Returns the provenance that a row of an accepted result must have."""
    m = manifest_at(folder / "run.json")
    return {"solver": m["solver"], "backend": m["backend"], "device": m["device"],
            "commit": m["commit"][:10] + (" (dirty)" if m.get("dirty") else ""),
            "membrane": " and ".join(sorted(membranes_of(m))), "ended": m["ended"], "command": command_of(m)}


def iterations_in(folder, step):
    """Returns the columns of a step's iterations, without units."""
    with (folder / "iterations.csv").open(newline="") as file:
        rows = [row for row in csv.DictReader(file) if int(row["step [1]"]) == step]
    return {title.partition(" [")[0]: [float(row[title]) for row in rows] for title in rows[0]}


def label_of(folder):
    """Returns a curve's name as in Fig. 17's table, and its step."""
    m, last = manifest_of(folder), int(rows_in(folder)[-1]["step [1]"])
    kind = f"VBD, single, {m['backend']}" if m["solver"] == "vbd" else "Newton, double"
    return kind + (", γ_e = 0" if m["settings"]["detection_fraction"]["value"] == 0 else ""), last


def share_of_detection(row):
    stages = {title: float(text) for title, text in row.items() if title.startswith("stage_")}
    return stages["stage_detection [ms]"] / sum(stages.values())


def curve(folder):
    """Returns the cells of a step that was solved with a row for each iteration: those of Fig. 17's table about
    residuals."""
    (label, step), row = label_of(folder), rows_in(folder)[-1]
    found = iterations_in(folder, step)
    lefts = list(zip(found["iteration"], found["residual"]))
    smallest = lambda most: min(left for k, left in lefts if k <= most)  # noqa: E731
    first = next((k for k, left in lefts if left <= 1e-4), math.nan)
    return {"curve": label, "step [1]": step, "iterations [1]": int(found["iteration"][-1]),
            **{f"smallest_residual{end} [1]": f"{smallest(most):.3g}"
               for end, most in (("", math.inf), ("_in_50", 50), ("_in_500", 500))},
            "residual_contacts_of_the_end [1]": row["residual [1]"], "iterations_to_1e-4 [1]": first,
            "step [ms]": f"{float(row['wall [ms]']):.4g}", "detections [1]": row["discrete_detections [1]"],
            "detection_share_of_time [1]": f"{share_of_detection(row):.3g}"}


def share(folder):
    """Returns the cells of a step with the time of each stage, and of the same step without, which a device replays."""
    row, whole = rows_in(folder)[-1], rows_in(folder.with_name(folder.name.replace("share", "whole")))[-1]
    settings = manifest_of(folder)["settings"]
    count = int(row["iterations [1]"])
    return {"curve": label_of(folder)[0], "iterations [1]": count,
            "guess_rounds [1]": settings["guess_rounds"]["value"], "repeats [1]": REPEATS,
            "detections [1]": row["discrete_detections [1]"],
            "detection [ms]": f"{float(row['stage_detection [ms]']):.5g}",
            "step_by_stages [ms]": f"{float(row['wall [ms]']):.5g}",
            "step [ms]": f"{float(whole['wall [ms]']):.5g}",
            "detection_share_of_time [1]": f"{share_of_detection(row):.4g}"}


def solved(scale, backend):
    """Returns the words of a solved step of Fig. 17 by VBD in single precision."""
    return (THREE_CLOTHS, "--scale", scale, "--audit", "end", "--backend", backend)


def start(scale, backend, name="each", more=()):
    """Returns the run of all steps before the last that is asked, each solved to convergence; it stores every state."""
    iterations = commands.THREE_CLOTHS_ITERATIONS[scale]["vbd"]
    last = max(*PRINTED_AT[scale], commands.THREE_CLOTHS_STEP[scale]) - 1
    return Job(f"start_{name}", (*solved(scale, backend), "--steps", last, *commands.ANY, *more, "--set",
                                 f"iterations={iterations}", "--set", "frame_steps=1"), pictured=False)


def printed(scale, backend):
    """Returns the steps with the printed γ_e, and their table."""
    before, iterations = start(scale, backend), commands.THREE_CLOTHS_ITERATIONS[scale]["vbd"]
    timed = ("--iterations", "--profile", "--repeats", REPEATS, "--set", f"iterations={iterations}")
    jobs = tuple(Job(f"vbd_{backend}_at_{step}", (*solved(scale, backend), *timed, "--steps", step),
                     (before.name, Step(step - 1)), pictured=False) for step in PRINTED_AT[scale])
    return (before, *jobs, Table("fig17_printed", jobs, curve))


def shares(scale, backend):
    """Returns the figure's step in a warm process: with and without the times of stages, half of its iterations (as
    many as the paper draws) and all, with both numbers of rounds; and the table."""
    before, step = start(scale, backend), commands.THREE_CLOTHS_STEP[scale]
    whole = commands.THREE_CLOTHS_ITERATIONS[scale]["vbd"]

    def one(kind, more, count, rounds):
        words = ("--repeats", REPEATS, "--set", f"iterations={count}", "--set", f"guess_rounds={rounds}", *more)
        return Job(f"{kind}_{count}_{rounds}", (*solved(scale, backend), *words, "--steps", step),
                   (before.name, Step(step - 1)), pictured=False)

    choices = [(count, rounds) for count in sorted({min(500, whole), whole}) for rounds in ROUNDS]
    clocks = tuple(one("whole", (), *choice) for choice in choices)
    profiles = tuple(one("share", ("--profile",), *choice) for choice in choices)
    return (before, *clocks, *profiles, Table("fig17_share", profiles, share))


def other_membrane(scale, backend):
    """Returns the figure's step with the other membrane, by VBD with both γ_e, and the table."""
    before, step = start(scale, backend, "st_venant", ST_VENANT), commands.THREE_CLOTHS_STEP[scale]
    count = commands.THREE_CLOTHS_ITERATIONS[scale]["vbd"]
    timed = ("--iterations", "--profile", "--repeats", REPEATS, *ST_VENANT, "--set", f"iterations={count}")
    jobs = tuple(Job(f"vbd_{backend}{end}_st_venant", (*solved(scale, backend), *timed, *more, "--steps", step),
                     (before.name, Step(step - 1)), pictured=False)
                 for end, more in (("", ()), ("_any", commands.ANY)))
    return (before, *jobs, Table("fig17_membrane", jobs, curve))


def other_membrane_by_newton(scale, backend):
    """Returns the same by Newton's method on the CPU: two chains, as each step takes long, and the table at the end of
    each."""
    before, step = start(scale, backend, "st_venant", ST_VENANT), commands.THREE_CLOTHS_STEP[scale]
    count = commands.THREE_CLOTHS_ITERATIONS[scale]["newton"]
    words = (THREE_CLOTHS, "--scale", scale, "--audit", "end", "--iterations", "--profile", *commands.NEWTON,
             *ST_VENANT, "--set", f"newton_iterations={count}")
    jobs = tuple(Job(f"newton{end}_st_venant", (*words, *more, "--steps", step), (before.name, Step(step - 1)),
                     pictured=False) for end, more in (("", ()), ("_any", commands.ANY)))
    return (before, *jobs, Table("fig17_newton_membrane", jobs, curve))


FIG17_TABLES = {"fig17_share": "fig17_share", "fig17_printed": "fig17_printed", "fig17_membrane": "fig17_membrane",
                "fig17_newton_membrane": "fig17_membrane_newton"}  # table -> part
FIG17_PARTS = {"fig17_share": shares, "fig17_printed": printed, "fig17_membrane": other_membrane,
               "fig17_membrane_newton": other_membrane_by_newton}


def parts_of(where, wanted):
    """Returns name -> Part of all of this on a machine of this kind; times and `steady` come first, as they want the
    machine for themselves."""
    scale, backend, folder = wanted.scale, wanted.backend, wanted.folder
    found = {f"steady_{each.name}": Part(folder(STEADY), (each.jobs(scale, backend),), frames=0)
             for each in repeated(scale, backend, wanted.data)}
    found |= {name: Part(folder(FIG17), (jobs(scale, backend),), frames=0) for name, jobs in FIG17_PARTS.items()
              if where == "cores" or not name.endswith("newton")}
    if where == "cores":
        return found
    one_by_one = lambda jobs: tuple((job,) for job in jobs)  # noqa: E731
    fig02 = {"fig02_neighbours": half_turn.neighbours, "fig02_wide": half_turn.wide_softer}
    return {**found, **{name: Part(folder(FIG02), one_by_one(jobs(scale, backend)), frames=2)
                        for name, jobs in fig02.items()},
            "yarn_return": Part(folder("yarn_return"), yarn_cases.chains(scale, backend), frames=0, last=2)}
