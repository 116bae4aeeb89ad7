"""Fig. 19: the twisted mat. Time a step of VBD-OGC with balls and with planes; without friction beside GIPC's times;
windows on the CPU beside IPC's; the distance of one step from Newton's converged one; lag of the
ends.

GIPC's times were measured on one H200; its settings are in paper_figures/results/h200/README.md. They end before ours;
measured/gipc.py compares the steps of both. Below the paper's size there are none.
"""

import csv
import statistics
import sys
from pathlib import Path

import numpy as np

from paper_figures.figures.table1 import contacts, times
from paper_figures.workflow import commands
from paper_figures.workflow.common import baseline_arguments
from paper_figures.workflow.evidence import RESULTS
from paper_figures.workflow.jobs import ENDED_BY_TIME, Job, Limit, RunFailure
from paper_figures.workflow.runs import provenance, write_table
from plots import style
from plots.camera import fitted
from plots.scene_figure import audit_in_words, draw_movie, frames_at, moment, show, source_of
from ogc_testbed.runs import Run, RunError

GIPC, GIPC_DEVICE = RESULTS / "h200" / "gipc_mat.csv", "NVIDIA H200"
# The paper's times over the whole run [ms]: average, and maximum if given.
PAPER = {"cuda": (5.5, 8.5), "cpu": (540.0, None), "ipc": (61180.0, None)}
PAPER_GIPC = 1893  # ms a step, average
TITLE = "Fig. 19. A twisted mat costs VBD-OGC milliseconds a step, GIPC hundreds, IPC tens of thousands"
ALT = ("Four renderings of a blue mat whose two ends turn against each other, at 0, 4, 8 and 12 s: it winds into a "
       "thick rope. Curves over time: on the GPU our step takes a few milliseconds and GIPC's a hundred to thousands; "
       "on the CPU ours takes tens to hundreds of milliseconds and IPC's seconds to tens of seconds. A table has mean "
       "and longest step of each method beside the paper's.")
HALF = 8.0  # [s]: half of the paper's 16 s, the duration if the paper's π/2 is the relative rate of the ends


def runs_of(arguments):
    """Returns name -> Run, and makes missing runs; with --made returns only existing ones."""
    scale, folder = arguments.scale, Path(arguments.folder)
    jobs = [*commands.mat_whole(scale, arguments.backend), *commands.mat_without_friction(scale, arguments.backend),
            *commands.mat_windows(scale), *commands.mat_one_step(scale)]
    names = [job.name for job in jobs if isinstance(job, Job)]
    try:
        for job in () if arguments.made else jobs:
            job.make(arguments.ogc, folder, Limit(), True)
    except RunFailure as error:
        raise RunError(str(error)) from error
    found = {name: Run(folder / name) for name in names if has_steps(folder / name)}
    if not {"ball/whole", "planes/whole"} <= set(found):
        raise RunError(f"{folder} lacks the whole runs, ball/whole and planes/whole; leave --made out, and they are "
                       "made")
    return found


def has_steps(run):
    """Returns whether the run has a step; an abandoned run may have none."""
    rows = run / "steps.csv"
    return (run / "run.json").is_file() and rows.is_file() and rows.read_text().count("\n") > 1


def gipc_times(scale):
    """Returns GIPC's time of each step [ms]; None below the paper's size."""
    if scale != "paper":
        return None
    with GIPC.open(newline="") as file:
        return np.array([float(row["wall [ms]"]) for row in csv.DictReader(file)])


def bounds_of(run):
    return run.manifest["settings"]["bounds"]["value"] if run.manifest["solver"] == "vbd" else ""


def row_of(what, run, **more):
    """Returns one run as a row of the table."""
    mean, worst, repeated = times(run)
    half = run.column("wall")[run.setting("time_step") * run.column("step") <= HALF]
    begins = run.column("step")[0] == 1
    cells = {"what": what, "solver": run.manifest["solver"], "bounds": bounds_of(run),
             "friction [1]": run.manifest["scene"]["bodies"][0]["material"]["friction"]["value"],
             "first step [1]": int(run.column("step")[0]), "steps [1]": len(run.column("step")),
             "mean [ms]": mean, "worst [ms]": worst, "repeated steps [1]": repeated,
             "mean up to 8 s [ms]": np.mean(half) if begins else "",
             "worst up to 8 s [ms]": np.max(half) if begins else "",
             "detections a step [1]": np.mean(run.column("discrete_detections") + run.column("continuous_detections")),
             "contacts, mean [1]": statistics.fmean(contacts(run)),
             "largest lag [m]": np.max(run.column("largest_lag")),
             "inverted tetrahedra, most [1]": int(np.max(run.column("inverted_tetrahedra"))),
             "audited states [1]": run.manifest.get("audited_states", 0),
             "intersections": {True: "none", False: "FOUND", None: "not audited"}[
                 run.manifest.get("guarantee_kept") if int(run.manifest.get("audited_states", 0)) else None],
             "residual [1]": "", "iterations [1]": np.mean(run.column("iterations")),
             "rms distance to Newton [m]": "", "largest distance to Newton [m]": "", "rms motion of the step [m]": "",
             "status": "ended by time" if (run.folder / ENDED_BY_TIME).is_file() else run.status}
    return {**cells, **more, **provenance(run)}


def ends_of(run, step):
    """Returns the positions after this step; None if the run did not reach it."""
    frames = [frame for frame in run.frames if int(frame.stem.removeprefix("frame_")) == step]
    return run.frame(frames[0]).positions.astype(float) if frames and not run.status.startswith("failed") else None


def distances(runs):
    """Yields (share, run, cells) for the runs at each window; the cells contain the distance of the run's first step
    from Newton's converged one."""
    for share in commands.MAT_WINDOWS:
        newton = runs.get(f"window_{share}/newton")
        beside = [runs.get(f"window_{share}/{name}") for name in ("step_" + str(n) for n in one_step_iterations(runs))]
        for run in filter(None, (newton, *beside, runs.get(f"window_{share}/ipc"))):
            yield share, run, cells_of_distance(run, newton, runs["planes/whole"])


def one_step_iterations(runs):
    return sorted({int(name.rpartition("_")[2]) for name in runs if "/step_" in name})


def cells_of_distance(run, newton, whole):
    first = int(run.column("step")[0])
    own = run.manifest["solver"] == "ipc"  # IPC's residual is another quantity
    residual = np.nan if own or "residual" not in run.steps else run.column("residual")[0]
    cells = {"residual [1]": residual if np.isfinite(residual) else ""}
    begin, end, least = ends_of(whole, first - 1), ends_of(run, first), ends_of(newton, first) if newton else None
    if begin is None or end is None or least is None:
        return cells
    apart, moved = np.linalg.norm(end - least, axis=1), np.linalg.norm(least - begin, axis=1)
    rms = lambda values: float(np.sqrt(np.mean(values**2)))  # noqa: E731
    return {**cells, "rms distance to Newton [m]": rms(apart), "largest distance to Newton [m]": float(np.max(apart)),
            "rms motion of the step [m]": rms(moved)}


def mean_of_windows(rows):
    """Averages windows with equal weights."""
    first = rows[0]
    each = [row["mean [ms]"] for row in rows]
    return {**dict.fromkeys(first, ""), "what": "windows", "solver": first["solver"], "bounds": first["bounds"],
            "steps [1]": sum(row["steps [1]"] for row in rows), "mean [ms]": statistics.fmean(each),
            "worst [ms]": max(row["worst [ms]"] for row in rows), "status": f"{len(rows)} windows",
            **{key: first[key] for key in ("backend", "device", "commit", "friction [1]")}}


def without_friction(runs, theirs):
    """Returns rows of the runs without friction, and GIPC's row."""
    rows = []
    for bounds in commands.MAT_BOUNDS:
        run = runs.get(f"{bounds}/free")
        if run is None:
            continue
        rows.append(row_of("without friction", run))
    if theirs is not None and rows:
        rows.append({**dict.fromkeys(rows[0], ""), "what": "without friction", "solver": "gipc", "friction [1]": 0,
                     "first step [1]": 1, "steps [1]": len(theirs), "mean [ms]": np.mean(theirs),
                     "worst [ms]": np.max(theirs), "status": "external", "backend": "cuda", "device": GIPC_DEVICE,
                     "commit": "-"})
    return rows


def table(runs, theirs):
    rows = [row_of("whole", runs[f"{bounds}/whole"]) for bounds in commands.MAT_BOUNDS]
    rows += without_friction(runs, theirs)
    for name in ("vbd_ball", "vbd_planes", "ipc"):
        found = [runs[f"window_{share}/{name}"] for share in commands.MAT_WINDOWS if f"window_{share}/{name}" in runs]
        windows = [row_of("window", run) for run in found]
        rows += [*windows, *([mean_of_windows(windows)] if len(windows) == len(commands.MAT_WINDOWS) else [])]
    return rows + [row_of("one step", run, **cells) for _, run, cells in distances(runs)]


def rows_of(path):
    """Returns the rows of a kept table."""
    with Path(path).open(newline="") as file:
        return list(csv.DictReader(file))


def seconds(run):
    return run.setting("time_step") * run.column("step")


def number(ms):
    return f"{ms:,.0f}" if ms >= 100 else f"{ms:.3g}"


def draw_gpu(axes, runs, theirs, backend):
    """Draws the time of each step of our whole runs, and GIPC's, which ends earlier."""
    for bounds, colour in zip(commands.MAT_BOUNDS, (style.COLOURS[4], style.OURS)):
        run = runs[f"{bounds}/whole"]
        axes.plot(seconds(run), run.column("wall"), color=colour, linewidth=0.8, label=f"ours,\n{bounds}")
    if theirs is not None:
        axes.plot(np.arange(1, len(theirs) + 1) / 240, theirs, color=style.BASELINE, linewidth=0.8,
                  label=f"GIPC,\nto {len(theirs) / 240:.1f} s")
    if theirs is not None and PAPER[backend][0]:
        style.paper_line(axes, PAPER[backend][0], f"paper,\nours {PAPER[backend][0]:g}", ":")
        style.paper_line(axes, PAPER_GIPC, f"paper,\nGIPC {PAPER_GIPC:,}", "--")
    axes.set(xlabel="time [s]", ylabel="time a step [ms]", yscale="log",
             title="GPU" if backend == "cuda" else "CPU, whole runs")
    style.label_ends(axes)


def draw_cpu(axes, rows):
    """Draws the mean of each window on the CPU, by VBD and by IPC."""
    axes.set(xlabel="time [s]", ylabel="time a step [ms]", yscale="log", title="CPU, mean of windows from four states")
    kinds = {"ours,\nballs": ("vbd", "ball", style.COLOURS[4]), "ours,\nplanes": ("vbd", "planes", style.OURS),
             "IPC": ("ipc", "", style.BASELINE)}
    found = {name: [(row["first step [1]"], row["mean [ms]"]) for row in rows
                    if (row["what"], row["solver"], row["bounds"]) == ("window", solver, bounds)]
             for name, (solver, bounds, _) in kinds.items()}
    if not any(found.values()):
        style.not_run(axes)
        return
    for name, places in found.items():
        if places:
            steps, times_ms = np.array(places, float).T
            axes.plot((steps - 1) / 240, times_ms, "o-", color=kinds[name][2], linewidth=1, markersize=4, label=name)
    if rows[0].get("scale", "paper") == "paper":
        style.paper_line(axes, PAPER["cpu"][0], "paper,\nours 540", ":")
        style.paper_line(axes, PAPER["ipc"][0], "paper,\nIPC 61,180", "--")
    style.label_ends(axes)


def methods(rows, whole_scale=True):
    """Returns the rows of the table: method, mean and longest time a step, the paper's mean; "not run" for what no row
    is about."""
    def cell(what, solver, bounds):
        row = next((r for r in rows if (r["what"], r["solver"], r["bounds"]) == (what, solver, bounds)), None)
        return ["not run", ""] if row is None else [number(float(row["mean [ms]"])), number(float(row["worst [ms]"]))]

    printed = (lambda words: words) if whole_scale else (lambda words: "")
    return [["VBD-OGC, GPU, balls", *cell("whole", "vbd", "ball"), printed("5.5 / 8.5")],
            ["VBD-OGC, GPU, planes", *cell("whole", "vbd", "planes"), printed("5.5 / 8.5")],
            ["GIPC, GPU, no friction", *cell("without friction", "gipc", ""), printed("1,893 / 20,000")],
            ["  ours, no friction", *cell("without friction", "vbd", "planes"), ""],
            ["VBD-OGC, CPU, windows", *cell("windows", "vbd", "planes"), printed("540")],
            ["IPC, CPU, windows", *cell("windows", "ipc", ""), printed("61,180")]]


def draw_methods(axes, rows, whole_scale):
    axes.axis("off")
    body = methods(rows, whole_scale)
    drawn = axes.table(body, colLabels=["a step", "mean [ms]", "longest [ms]", "paper [ms]"],
                       colWidths=[0.4, 0.18, 0.2, 0.22], bbox=(0, 0, 1, 1), cellLoc="center", edges="horizontal")
    drawn.auto_set_font_size(False)
    drawn.set_fontsize(8)
    for (row, column), cell in drawn.get_celld().items():
        cell.set_edgecolor("0.85")
        cell.set_text_props(fontweight="bold" if row == 0 else None, ha="left" if column == 0 else "center")
    axes.set_title("all four methods")


def draw_lag(axes, runs):
    for bounds, colour in zip(commands.MAT_BOUNDS, (style.COLOURS[4], style.OURS)):
        run = runs[f"{bounds}/whole"]
        axes.plot(seconds(run), run.column("largest_lag"), color=colour, linewidth=0.9, label=f"{bounds}")
    axes.set(xlabel="time [s]", ylabel="lag [m]", title="Lag of the turned ends behind their motion", ylim=(0, None))
    style.label_ends(axes)


def draw(runs, theirs, backend, out, rows=None):
    """Draws four states of the run with planes, times on GPU and CPU, the table of methods, and the lag. `rows`: of the
    table (None: those of `runs`)."""
    style.use()
    rows = [*(row_of("whole", runs[f"{bounds}/whole"]) for bounds in commands.MAT_BOUNDS),
            *(row for row in (rows or table(runs, theirs)) if row["what"] != "whole")]
    whole = runs["planes/whole"]
    last = whole.column("step")[-1]
    frames = frames_at(whole, [round(share / 100 * last) for share in commands.MAT_WINDOWS])
    seen = [frame for frame in frames if frame] or [whole.frame(whole.frames[-1])]
    size = (640, 400)
    scale = whole.manifest["scale"]
    below = (f"15,312 vertices, planes: {audit_in_words(whole)}" if scale == "paper"
             else f"scale {scale}, not the paper's size; {audit_in_words(whole)}")
    below += ("; GIPC: its official code on one H200, IPC: ours, 16 cores; the paper says 343 times faster than GIPC "
              "and 133 times faster than IPC" if scale == "paper" else "")
    half = (0.5, "plot")
    rows_of_page = [style.pictures(4, size), (2.6, [half, half]), (2.2, [half, (0.5, "picture")])]
    figure, axes = style.page(rows_of_page, TITLE, below)
    for place, frame in zip(axes[0], frames):
        show(place, whole, frame, fitted(whole, seen, size), moment(frame), size)
    draw_gpu(axes[1][0], runs, theirs, backend)
    draw_cpu(axes[1][1], rows)
    draw_lag(axes[2][0], runs)
    draw_methods(axes[2][1], rows, scale == "paper")
    style.save(figure, out, TITLE, ALT, source_of([runs[f"{bounds}/whole"] for bounds in commands.MAT_BOUNDS]))


if __name__ == "__main__":
    parser = baseline_arguments(__doc__.splitlines()[0], backends=("cpu", "cuda"))
    parser.add_argument("--made", action="store_true", help="draw the runs that there are, and make none")
    parser.add_argument("--movie", help="MP4 to write instead, of the finished whole run with planes")
    parser.add_argument("--rows", metavar="CSV", help="kept table, for what has no run in the folder")
    options = parser.parse_args()
    try:
        if options.movie:
            draw_movie(Run(Path(options.folder) / "planes/whole"), options.movie)
            sys.exit()
        found_runs, external = runs_of(options), gipc_times(options.scale)
        kept = rows_of(options.rows) if options.rows else None
        if kept is None:
            write_table(Path(options.folder) / "fig19.csv", table(found_runs, external))
        draw(found_runs, external, options.backend, Path(options.folder) / "fig19.png", kept)
    except RunError as error:
        sys.exit(f"fig19: {error}")
