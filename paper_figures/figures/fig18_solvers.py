"""Fig. 18: time and collision detections a step of IPC, Newton-OGC and VBD-OGC on one scene and the same cores, frames
of the first run, and the ratios beside the paper's, each with its threads and devices. VBD-OGC on CUDA is a fourth
curve if its run is in the folder (or with --cuda).
"""

import json
import sys
from pathlib import Path

import numpy as np

from paper_figures.workflow import commands
from paper_figures.workflow.common import baseline_arguments
from paper_figures.workflow.common import label as solver_of
from paper_figures.workflow.evidence import CLAIMS
from paper_figures.workflow.jobs import PROCESSOR_TIME
from paper_figures.workflow.runs import provenance, run_job, write_table
from plots import style
from ogc_testbed.runs import Run, RunError
from plots.camera import fitted
from plots.scene_figure import show, source_of

SCENE = "cloth_on_sphere"
TITLE = "Fig. 18. On the same cores a step of IPC takes far longer than one of VBD-OGC, and more detections"
ALT = ("Four renderings of IPC's states: a square cloth falls on a sphere, wraps it and hangs down in folds. Below, "
       "curves of time a step, linear and logarithmic, and of detections a step for each solver, and a table of means: "
       "{lines}.")


def label(run):
    """Returns the solver, its device, and its last step if it was stopped."""
    last, whole = int(run.column("step")[-1]), int(run.setting("steps"))
    return f"{solver_of(run)} ({run.manifest['device']})" + (f", first {last} of {whole} steps" if last < whole else "")


def detections(run):
    return run.column("discrete_detections") + run.column("continuous_detections")


def processor_ms(run):
    """Returns the program's processor time, including start and audit; not-a-number if it was not measured."""
    path = run.folder / PROCESSOR_TIME
    return 1e3 * sum(json.loads(path.read_text()).values()) if path.is_file() else np.nan


def processor_times(run):
    """Returns the processor time of each step [ms]: the processor time of the whole run, divided in proportion to the
    steps' times on the clock. Not-a-number if it was not measured."""
    wall = run.column("wall")
    return wall * processor_ms(run) / np.sum(wall)


def claimed(run):
    """Returns the paper's mean ratio of IPC's time to this run's, from its text beside Fig. 18. None if the paper gives
    no number, as for CUDA."""
    if run.manifest["backend"] != "cpu":
        return None
    claims = json.loads((CLAIMS / f"{SCENE}.json").read_text())["claims"]
    return next((claim["value"] for claim in claims if claim["id"] == f"{SCENE}.ipc_over_{run.manifest['solver']}"),
                None)


def ratios(runs):
    """Returns [(label, IPC's time over this run's, kind of time, the paper's claim or None)] over the steps that both
    runs have. Time on the clock means nothing on a busy machine. Processor time, where measured, means nothing for a
    GPU and little for threads that wait."""
    baseline = next((run for run in runs if run.manifest["solver"] == "ipc"), None)
    result = []
    for run in runs if baseline else []:
        if run is baseline:
            continue
        steps = min(len(run.column("step")), len(baseline.column("step")))
        times = {"time on the clock": (baseline.column("wall"), run.column("wall"))}
        if run.manifest["backend"] == "cpu":
            times["processor time"] = (processor_times(baseline), processor_times(run))
        for measured, (theirs, ours) in times.items():
            ratio = np.sum(theirs[:steps]) / np.sum(ours[:steps])
            if np.isfinite(ratio):
                result.append((label(run), ratio, f"{measured} of {steps} steps", claimed(run)))
    return result


def summary(runs):
    """Returns a line for each run, for the terminal and the title."""
    lines = []
    for run in runs:
        wall, found = run.column("wall"), detections(run)
        used = np.mean(processor_times(run))
        processor = f", {used:.4g} ms of processor time" if np.isfinite(used) else ""
        clock = f"{np.mean(wall):.4g} ms a step on the clock (median {np.median(wall):.4g}, worst {wall.max():.4g})"
        counts = f"{np.mean(run.column('iterations')):.3g} iterations, {np.mean(found):.3g} detections a step"
        lines.append(f"{label(run)}: {clock}{processor}, {counts}")
    baseline = next((label(run) for run in runs if run.manifest["solver"] == "ipc"), "")
    for name, ratio, measured, claim in ratios(runs):
        beside = f"paper: {claim:g}" if claim else "the paper has none"
        lines.append(f"{baseline} takes {ratio:.3g} times the {measured} that {name} takes ({beside})")
    return lines + unequal(runs)


def unequal(runs):
    """Returns a warning if CPU solvers ran on different numbers of threads; otherwise an empty text."""
    threads = sorted({run.manifest["device"] for run in runs if run.manifest["backend"] == "cpu"})
    warning = f"NOT ON THE SAME CORES ({', '.join(threads)}): a ratio of these says little about the methods"
    return [warning] if len(threads) > 1 else []


def rows(runs):
    """Returns a row for each run: its provenance, means and shares."""
    result = []
    for run in runs:
        wall = run.column("wall")
        row = {**provenance(run), "steps": len(wall), "of steps": int(run.setting("steps")),
               "mean [ms]": float(np.mean(wall)), "median [ms]": float(np.median(wall)),
               "worst [ms]": float(wall.max()),
               "processor time [ms]": processor_ms(run) / len(wall),
               "iterations a step": float(np.mean(run.column("iterations"))),
               "detections an iteration": float(np.sum(detections(run)) / np.sum(run.column("iterations")))}
        for kind in ("vertex_facet_contacts", "edge_edge_contacts", "broad_phases", "discrete_detections",
                     "continuous_detections"):
            row[f"{kind.replace('_', ' ')} a step"] = float(np.mean(run.column(kind)))
        row["stages [% of the time]"] = "; ".join(f"{name} {100 * np.sum(times) / np.sum(wall):.3g}"
                                                  for name, times in run.stage_columns().items())
        result.append(row)
    return result


def cells(runs):
    """Returns the table's head and rows, of texts: time a step, longest step, iterations and detections a step, and
    IPC's time over the run's, each with the paper's number in brackets where it prints one."""
    baseline = next((run for run in runs if run.manifest["solver"] == "ipc"), None)
    scene = {claim["id"]: claim["value"] for claim in
             json.loads((CLAIMS / f"{SCENE}.json").read_text())["claims"]}
    whole = runs[0].manifest.get("scale") == "paper"
    body = []
    for run in runs:
        solver, backend = run.manifest["solver"], run.manifest["backend"]
        beside = [scene.get(f"{SCENE}.{backend}_{kind}") if solver == "vbd" and whole else None
                  for kind in ("average", "maximum")]
        printed = lambda value: f" ({value:g})" if value else ""  # noqa: E731
        steps = min(len(run.column("step")), len(baseline.column("step"))) if baseline else 0
        ratio = (f"{np.sum(baseline.column('wall')[:steps]) / np.sum(run.column('wall')[:steps]):.3g}"
                 if baseline and run is not baseline else "–")
        wall = run.column("wall")
        number = lambda ms: f"{ms:,.0f}" if ms >= 100 else f"{ms:.3g}"  # noqa: E731
        body.append([solver_of(run).replace(", CUDA", ", GPU"), number(np.mean(wall)) + printed(beside[0]),
                     number(wall.max()) + printed(beside[1]), f"{np.mean(run.column('iterations')):.3g}",
                     f"{np.mean(detections(run)):.3g}", ratio + printed(claimed(run))])
    return ["", "mean [ms]", "longest [ms]", "iterations", "detections", "IPC's time over it"], body


def draw_table(axes, runs):
    """Draws `cells` as a table; a column is as wide as its longest text."""
    axes.axis("off")
    head, body = cells(runs)
    style.table(axes, head, body)
    axes.set_title("a step on average; in brackets the paper's number")


def states_of(folder):
    """Returns the run whose states are shown. Throws RunError if it is no run of the scene."""
    run = Run(folder)
    if run.manifest["scene"]["name"] != SCENE:
        raise RunError(f"{folder} is a run of '{run.manifest['scene']['name']}', not of '{SCENE}'")
    return run


def draw(runs, out, states=None):
    """Draws states, times, detections and the table. `states`: the run of IPC whose states are shown, if not the first
    of `runs`; without frames its panels say so."""
    for run in runs:
        if run.status != "interrupted":
            run.require_finished()
    style.use()
    states = states or runs[0]
    size = (640, 480)
    below = f"{states.manifest['scale']} scale; " if states.manifest["scale"] != "paper" else "4,900 vertices; "
    below += "; ".join(f"{solver_of(run)}: {run.manifest['device']}" for run in runs)
    figure, axes = style.page([style.pictures(4, size), (2.4, [(0.5, "plot")] * 2),
                               (2.5, [(0.5, "plot"), (0.5, "picture")])], TITLE, below)
    steps = [round(share * runs[0].setting("steps")) for share in (0, 0.25, 0.5, 0.75)]
    if states.frames:
        frames = [states.frame_at_step(step) for step in steps]
        camera = fitted(states, frames[1:], size)
        for place, frame in zip(axes[0], frames):
            own = camera if frame is not frames[0] else fitted(states, [frame], size)
            show(place, states, frame, own, f"{solver_of(states)}, step {frame.step}", size)
    else:
        for place, step in zip(axes[0], steps):
            style.not_run(place, "the run's states were not kept")
            place.set_title(f"{solver_of(states)}, step {step}")
    (linear, logarithmic), (counts, table) = axes[1], axes[2]
    by_processor = all(run.manifest["backend"] == "cpu" and np.isfinite(processor_ms(run)) for run in runs)
    for run, colour, dash in zip(runs, (style.BASELINE, "#8C8C8C", style.OURS, style.COLOURS[2]), style.DASHES):
        line = {"color": colour, "linestyle": dash, "label": solver_of(run).replace(", CUDA", ",\nGPU")}
        for place in (linear, logarithmic):
            place.plot(run.column("step"), processor_times(run) if by_processor else run.column("wall"), **line)
        counts.step(run.column("step"), detections(run), where="mid", **line)
    time = "processor time" if by_processor else "time"
    linear.set(xlabel="step", ylabel=f"{time} [ms]", title=f"{time.capitalize()} a step", ylim=(0, None))
    logarithmic.set(xlabel="step", ylabel=f"{time} [ms]", title=f"{time.capitalize()} a step, logarithmic",
                    yscale="log")
    counts.set(xlabel="step", ylabel="detections", title="Detections a step, continuous and discrete", ylim=(0, None))
    for place in (linear, logarithmic, counts):
        style.label_ends(place)
    draw_table(table, runs)
    lines = "; ".join(f"{row[0]} {row[1]} ms, {row[4]} detections" for row in cells(runs)[1])
    style.save(figure, out, TITLE, ALT.format(lines=lines), source_of(runs))


def runs_of(arguments):
    """Returns the runs, IPC's first. VBD on CUDA is included if its run is in the folder or requested. With --made only
    existing runs are returned."""
    folder = Path(arguments.folder)
    made = [name for name in commands.SOLVERS if (folder / name / "run.json").is_file()]
    if arguments.made and not made:
        raise RunError(f"{folder} has no run; leave --made out, and they are made")
    if arguments.made:
        return [Run(folder / name) for name in made]
    jobs = commands.solvers(arguments.scale, arguments.cuda or "vbd_cuda" in made, arguments.membrane)
    return [run_job(arguments.ogc, job, folder) for job in jobs]


if __name__ == "__main__":
    parser = baseline_arguments(__doc__.splitlines()[0])
    parser.add_argument("--cuda", action="store_true", help="VBD-OGC on CUDA, too")
    parser.add_argument("--made", action="store_true", help="draw the runs that there are, whole or not, and make none")
    parser.add_argument("--states", metavar="RUN", help="run of IPC whose states are shown, if those of the folder "
                                                        "were not kept")
    options = parser.parse_args()
    try:
        found = runs_of(options)
        write_table(Path(options.folder) / "fig18_solvers.csv", rows(found))
        draw(found, Path(options.folder) / "fig18_solvers.png", states_of(options.states) if options.states else None)
        print("\n".join(summary(found)))
    except RunError as error:
        sys.exit(f"fig18_solvers: {error}")
