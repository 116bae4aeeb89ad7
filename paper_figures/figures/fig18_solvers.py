"""Fig. 18: time and collision detections a step of IPC, Newton-OGC and VBD-OGC on one scene and the same cores, frames of
the first run, and the ratios beside the paper's, each with the threads and devices that it is of.

VBD-OGC on CUDA is a fourth curve where its run lies in the folder (or with --cuda). Where a command may last so long only, the runs are made in parts:

    python3 -m paper_figures.workflow.device_runs --program bundle/ogc --out runs --seconds 300 fig18_solvers     # there; again until it says finished
    python3 -m paper_figures.figures.fig18_solvers runs/fig18_solvers-paper-cpu --scale paper                    # at home, after --unpack: draws them
    python3 -m paper_figures.workflow.accept h200 fig18_solvers --scale paper --runs runs
"""

import json
import sys
from pathlib import Path

import numpy as np

from paper_figures.workflow import in_time
from paper_figures.workflow.common import baseline_arguments, options_of
from paper_figures.workflow.common import label as solver_of
from paper_figures.figures.fig18_cloth_on_sphere import CAMERA
from paper_figures.workflow.evidence import CLAIMS
from paper_figures.workflow.runs import provenance, run_once, write_table
from plots import style
from plots.run_folder import Run, RunError, commits_in_words
from plots.scene_figure import draw_frames

SCENE = "cloth_on_sphere"


class Joined(Run):
    """Parts of one run (paper_figures.workflow.in_time) as one run: steps that a later part made again are the later part's."""

    def __init__(self, folders):
        super().__init__(folders[0])
        frames = {path.name: path for path in self.frames}
        for folder in folders[1:]:
            part = Run(folder)
            keep = self.steps["step"] < part.steps["step"][0]
            self.steps = {name: np.concatenate([values[keep], part.steps[name]]) for name, values in self.steps.items()}
            frames.update({path.name: path for path in part.frames})
            self.manifest["status"] = part.status
        self.frames = [frames[name] for name in sorted(frames)]
        used = [json.loads((folder / in_time.PROCESSOR_TIME).read_text()) for folder in folders if (folder / in_time.PROCESSOR_TIME).is_file()]
        if len(used) == len(folders):
            self.processor_ms = 1e3 * sum(sum(part.values()) for part in used)  # of the program, start and audit included


def label(run):
    """The solver, what it ran on, and how far it came where it was stopped."""
    last, whole = int(run.column("step")[-1]), int(run.setting("steps"))
    return f"{solver_of(run)} ({run.manifest['device']})" + (f", first {last} of {whole} steps" if last < whole else "")


def detections(run):
    return run.column("discrete_detections") + run.column("continuous_detections")


def processor_times(run):
    """Of each step [ms]: the whole run's, where it was measured, shared out by time on the clock. Else not-a-number."""
    wall = run.column("wall")
    return wall * getattr(run, "processor_ms", np.nan) / np.sum(wall)


def claimed(run):
    """How much longer than this run IPC takes on average, as the paper says in the text beside Fig. 18; None where it says nothing, as of CUDA."""
    if run.manifest["backend"] != "cpu":
        return None
    claims = json.loads((CLAIMS / f"{SCENE}.json").read_text())["claims"]
    return next((claim["value"] for claim in claims if claim["id"] == f"{SCENE}.ipc_over_{run.manifest['solver']}"), None)


def ratios(runs):
    """[(label, IPC's time a step over this run's, what was measured, the paper's claim or None)] over the steps that both have: on the clock, which says nothing
    where the machine does other work, and where it was measured of processor time, which says nothing of a GPU and little of threads that wait."""
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
    """A line a run, for the terminal and the title."""
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
    """A warning where solvers of the CPU ran on different numbers of threads; none where they ran on the same."""
    threads = sorted({run.manifest["device"] for run in runs if run.manifest["backend"] == "cpu"})
    warning = f"NOT ON THE SAME CORES ({', '.join(threads)}): a ratio of these says little about the methods"
    return [warning] if len(threads) > 1 else []


def rows(runs):
    """A row a run: where it comes from, and its means and shares."""
    result = []
    for run in runs:
        wall = run.column("wall")
        row = {**provenance(run), "steps": len(wall), "of steps": int(run.setting("steps")),
               "mean [ms]": float(np.mean(wall)), "median [ms]": float(np.median(wall)), "worst [ms]": float(wall.max()),
               "processor time [ms]": getattr(run, "processor_ms", np.nan) / len(wall), "iterations a step": float(np.mean(run.column("iterations"))),
               "detections an iteration": float(np.sum(detections(run)) / np.sum(run.column("iterations")))}
        for kind in ("vertex_facet_contacts", "edge_edge_contacts", "broad_phases", "discrete_detections", "continuous_detections"):
            row[f"{kind.replace('_', ' ')} a step"] = float(np.mean(run.column(kind)))
        row["stages [% of the time]"] = "; ".join(f"{name} {100 * np.sum(times) / np.sum(wall):.3g}" for name, times in run.stage_columns().items())
        result.append(row)
    return result


def draw(runs, out):
    for run in runs:
        if run.status != "interrupted":
            run.require_finished()
    plt = style.use()
    figure = plt.figure(figsize=(11, 9))
    grid = figure.add_gridspec(3, 4, height_ratios=[0.9, 1, 1])
    draw_frames(figure, [grid[0, i] for i in range(4)], runs[0], [round(f * runs[0].setting("steps")) for f in (0, 0.25, 0.5, 0.75)], CAMERA)
    linear, logarithmic, counts = figure.add_subplot(grid[1, :2]), figure.add_subplot(grid[1, 2:]), figure.add_subplot(grid[2, :2])
    by_processor = all(run.manifest["backend"] == "cpu" and hasattr(run, "processor_ms") for run in runs)
    for run, dash in zip(runs, style.DASHES):
        for axes in (linear, logarithmic):
            axes.plot(run.column("step"), processor_times(run) if by_processor else run.column("wall"), dash, label=label(run))
        counts.step(run.column("step"), detections(run), where="mid", linestyle=dash, label=label(run))
    time = "processor time" if by_processor else "time"
    linear.set(xlabel="step", ylabel=f"{time} a step [ms]", title=time.capitalize(), ylim=(0, None))
    logarithmic.set(xlabel="step", ylabel=f"{time} a step [ms]", title=f"{time.capitalize()}, logarithmic", yscale="log")
    counts.set(xlabel="step", ylabel="detections a step", title="Detections, continuous and discrete", ylim=(0, None))
    for axes in (linear, counts):  # in the third it would lie on the curve of a GPU
        axes.legend()
    words = figure.add_subplot(grid[2, 2:])
    words.axis("off")
    words.text(0, 1, "\n\n".join(summary(runs)), va="top", wrap=True, fontsize=8.5)
    figure.suptitle(f"{SCENE} ({runs[0].manifest['scale']}); {commits_in_words(runs)}", fontsize=9)
    style.save(figure, out)


def run_of(folder, name, ogc, base):
    """The run of one solver: made in parts before, or made once now. Throws RunError where parts don't reach the end."""
    made = in_time.parts(folder / name)
    if not made:
        return run_once(ogc, [*base, *in_time.SOLVERS[name]], folder / name)
    if not in_time.ended(folder / name):
        raise RunError(f"{folder / name} has not reached its end: call paper_figures.workflow.in_time again to go on, or draw what there is with --parts")
    return Joined(made)


def runs_of(arguments):
    """IPC's run first; VBD's on CUDA where it lies in the folder or is asked for."""
    folder, base = Path(arguments.folder), [SCENE, *options_of(arguments), "--audit", "end"]
    if arguments.parts:
        found = [Joined(in_time.parts(folder / name)) for name in in_time.SOLVERS if in_time.parts(folder / name)]
        if not found:
            raise RunError(f"{folder} has no parts; make them with: python3 -m paper_figures.workflow.in_time {folder}")
        return found
    return [run_of(folder, name, arguments.ogc, base) for name in in_time.SOLVERS if name != "vbd_cuda" or arguments.cuda or (folder / name).is_dir()]


if __name__ == "__main__":
    parser = baseline_arguments(__doc__.splitlines()[0])
    parser.add_argument("--cuda", action="store_true", help="VBD-OGC on CUDA, too")
    parser.add_argument("--parts", action="store_true", help="draw what paper_figures.workflow.in_time has made in the folder, and run nothing")
    options = parser.parse_args()
    try:
        found = runs_of(options)
        write_table(Path(options.folder) / "fig18_solvers.csv", rows(found))
        draw(found, Path(options.folder) / "fig18_solvers.png")
        print("\n".join(summary(found)))
    except RunError as error:
        sys.exit(f"fig18_solvers: {error}")
