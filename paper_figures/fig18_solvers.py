"""Fig. 18: time and collision detections a step of IPC, Newton-OGC and VBD-OGC on one scene, frames of the first run, and the ratios beside the paper's."""

import json
import sys
from pathlib import Path

import numpy as np

from paper_figures import in_time
from paper_figures.common import baseline_arguments, options_of
from paper_figures.common import label as solver_of
from paper_figures.fig18_cloth_on_sphere import CAMERA
from paper_figures.runs import provenance, run_once, write_table
from plots import style
from plots.run_folder import Run, RunError, commits_in_words
from plots.scene_figure import draw_frames

# How much slower IPC is on average (CPU), as the paper says in the text beside Fig. 18.
CLAIMS = {"newton": 9.2, "vbd": 128.0}


SCENE = "cloth_on_sphere"


class Joined(Run):
    """Parts of one run (paper_figures.in_time) as one run: steps that a later part made again are the later part's."""

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
    """The solver, and how far it came where it was stopped."""
    last, whole = int(run.column("step")[-1]), int(run.setting("steps"))
    return solver_of(run) + (f", first {last} of {whole} steps" if last < whole else "")


def detections(run):
    return run.column("discrete_detections") + run.column("continuous_detections")


def processor_times(run):
    """Of each step [ms]: the whole run's, where it was measured, shared out by time on the clock. Else not-a-number."""
    wall = run.column("wall")
    return wall * getattr(run, "processor_ms", np.nan) / np.sum(wall)


def ratios(runs):
    """[(label, IPC's time a step over this run's, what was measured, the paper's claim or None)] over the steps that both have. Processor time if there is one:
    on a machine that does other work the clock says nothing."""
    baseline = next((run for run in runs if run.manifest["solver"] == "ipc"), None)
    if baseline is None:
        return []
    result = []
    for run in runs:
        if run is baseline:
            continue
        steps = min(len(run.column("step")), len(baseline.column("step")))
        ratio, unit = np.sum(processor_times(baseline)[:steps]) / np.sum(processor_times(run)[:steps]), "processor time"
        if not np.isfinite(ratio) or run.manifest["backend"] != "cpu":
            ratio, unit = np.mean(baseline.column("wall")[:steps]) / np.mean(run.column("wall")[:steps]), "time on the clock"
        result.append((label(run), ratio, f"{unit} of {steps} steps", CLAIMS.get(run.manifest["solver"]) if run.manifest["backend"] == "cpu" else None))
    return result


def summary(runs):
    """A line a run, for the terminal and the title."""
    lines = []
    for run in runs:
        wall, found = run.column("wall"), detections(run)
        used = np.mean(processor_times(run))
        processor = f", {used:.4g} ms of processor time" if np.isfinite(used) else ""
        lines.append(f"{label(run)}: {np.mean(wall):.4g} ms a step on the clock (median {np.median(wall):.4g}, worst {wall.max():.4g}){processor}, "
                     f"{np.mean(run.column('iterations')):.3g} iterations, {np.mean(found):.3g} detections a step")
    for name, ratio, measured, claim in ratios(runs):
        lines.append(f"IPC takes {ratio:.3g} times the {measured} that {name} takes" + (f" (paper: {claim:g})" if claim else ""))
    return lines


def rows(runs):
    """A row a run: where it comes from, and its means and shares."""
    result = []
    for run in runs:
        wall = run.column("wall")
        row = {**provenance(run), "steps": len(wall), "mean [ms]": float(np.mean(wall)), "median [ms]": float(np.median(wall)), "worst [ms]": float(wall.max()),
               "processor time [ms]": getattr(run, "processor_ms", np.nan) / len(wall), "iterations a step": float(np.mean(run.column("iterations")))}
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
    for axes in (linear, logarithmic, counts):
        axes.legend()
    words = figure.add_subplot(grid[2, 2:])
    words.axis("off")
    words.text(0, 1, "\n\n".join(summary(runs)), va="top", wrap=True, fontsize=8.5)
    figure.suptitle(f"{SCENE} ({runs[0].manifest['scale']}); {commits_in_words(runs)}", fontsize=9)
    style.save(figure, out)


def runs_of(arguments):
    """IPC's run first; each is done once, or taken from the parts that there are."""
    folder, base = Path(arguments.folder), [SCENE, *options_of(arguments), "--audit", "end"]
    if arguments.parts:
        found = [Joined(in_time.parts(folder / name)) for name in in_time.SOLVERS if in_time.parts(folder / name)]
        if not found:
            raise RunError(f"{folder} has no parts; make them with: python3 -m paper_figures.in_time {folder}")
        return found
    return [run_once(arguments.ogc, [*base, *more], folder / name) for name, more in in_time.SOLVERS.items() if name != "vbd_cuda" or arguments.cuda]


if __name__ == "__main__":
    parser = baseline_arguments(__doc__.splitlines()[0])
    parser.add_argument("--cuda", action="store_true", help="VBD-OGC on CUDA, too")
    parser.add_argument("--parts", action="store_true", help="draw what paper_figures.in_time has made in the folder, and run nothing")
    options = parser.parse_args()
    try:
        found = runs_of(options)
        write_table(Path(options.folder) / "fig18.csv", rows(found))
        draw(found, Path(options.folder) / "fig18_solvers.png")
        print("\n".join(summary(found)))
    except RunError as error:
        sys.exit(f"{Path(sys.argv[0]).name}: {error}")
