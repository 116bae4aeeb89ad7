"""Fig. 19: the twisted mat. Time a step of VBD-OGC with balls and with planes; without friction beside GIPC's times
over the same steps; windows on the CPU beside IPC's; the distance of one step from Newton's converged one; lag of the
ends.

GIPC's times were measured on one H200; its known settings are in paper_figures/results/h200/README.md. They end after
2,303 steps, so that no curve or average extends beyond them. Below the paper's size there are none.
"""

import csv
import statistics
import sys
from pathlib import Path

import numpy as np
from matplotlib.ticker import NullFormatter, ScalarFormatter

from paper_figures.figures.table1 import contacts, times
from paper_figures.workflow import commands
from paper_figures.workflow.common import baseline_arguments, label
from paper_figures.workflow.evidence import RESULTS
from paper_figures.workflow.jobs import ENDED_BY_TIME, Job, Limit, RunFailure
from paper_figures.workflow.runs import provenance, write_table
from plots import style
from plots.movie import camera_of
from ogc_testbed.runs import Run, RunError, commits_in_words
from plots.scene_figure import draw_movie

GIPC, GIPC_DEVICE = RESULTS / "h200" / "gipc_mat.csv", "NVIDIA H200"
# The paper's times over the whole run [ms]: average, and maximum if given.
PAPER = {"cuda": (5.5, 8.5), "cpu": (540.0, None), "ipc": (61180.0, None)}
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
             "GIPC's time over ours [1]": "", "residual [1]": "", "iterations [1]": np.mean(run.column("iterations")),
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
    """Returns rows of the runs without friction, and GIPC's row. Ratios cover the steps that both measured."""
    rows = []
    for bounds in commands.MAT_BOUNDS:
        run = runs.get(f"{bounds}/free")
        if run is None:
            continue
        as_long = theirs is not None and len(run.column("wall")) == len(theirs)
        ratio = np.sum(theirs) / np.sum(run.column("wall")) if as_long else ""
        rows.append(row_of("without friction", run, **{"GIPC's time over ours [1]": ratio}))
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


def seconds(run):
    return run.setting("time_step") * run.column("step")


def draw_times(axes, runs, backend):
    for bounds, colour in zip(commands.MAT_BOUNDS, style.COLOURS):
        run = runs[f"{bounds}/whole"]
        axes.plot(seconds(run), run.column("wall"), color=colour, linewidth=0.7,
                  label=f"{label(run)}, {bounds} ({run.manifest['device']})")
    for value, dash in zip(PAPER[backend], (":", "--")):
        if value:
            axes.axhline(value, color="black", linestyle=dash, linewidth=0.8,
                         label=f"paper: {value:g} ms, {'average' if dash == ':' else 'maximum'} (another machine)")
    axes.set(xlabel="time [s]", ylabel="time a step [ms]", yscale="log", title="VBD-OGC, whole run")
    axes.legend(fontsize=6)


def draw_gipc(axes, runs, theirs):
    for bounds, colour in zip(commands.MAT_BOUNDS, style.COLOURS):
        run = runs.get(f"{bounds}/free")
        if run:
            axes.plot(seconds(run), run.column("wall"), color=colour, linewidth=0.7,
                      label=f"{bounds}, no friction ({run.manifest['device']})")
    if theirs is None:
        axes.set_title("No friction (GIPC's times are of the paper's size)")
    else:
        axes.plot(np.arange(1, len(theirs) + 1) / 240, theirs, color="black", linewidth=0.7,
                  label=f"GIPC, another program's times ({GIPC_DEVICE})")
        axes.set_title(f"No friction, the {len(theirs):,} steps that were measured of GIPC")
    axes.set(xlabel="time [s]", ylabel="time a step [ms]", yscale="log")
    if axes.get_legend_handles_labels()[0]:
        axes.legend(fontsize=6)


def draw_windows(axes, runs):
    axes.set(xlabel="time [s]", ylabel="time a step [ms]", yscale="log", title="CPU, windows of the run with planes")
    colours = {"vbd_ball": style.COLOURS[0], "vbd_planes": style.COLOURS[1], "ipc": style.COLOURS[3]}
    windows = {name: [runs[key] for share in commands.MAT_WINDOWS if (key := f"window_{share}/{name}") in runs]
               for name in colours}
    if not any(windows.values()):
        axes.text(0.5, 0.5, "not run", transform=axes.transAxes, ha="center")
        return
    for name, found in windows.items():
        for number, run in enumerate(found):
            axes.plot(seconds(run), run.column("wall"), ".-", color=colours[name], markersize=3, linewidth=0.7,
                      label=f"{label(run)} {bounds_of(run)} ({run.manifest['device']})" if number == 0 else None)
    for solver, words in (("cpu", "VBD-OGC"), ("ipc", "IPC")):
        axes.axhline(PAPER[solver][0], color="black", linestyle=":", linewidth=0.8)
        axes.annotate(f"paper, {words}: {PAPER[solver][0]:g} ms", (0, PAPER[solver][0]), fontsize=6)
    axes.legend(fontsize=6)


def draw_distances(distance, residual, runs):
    for share, colour in zip(commands.MAT_WINDOWS, style.COLOURS):
        found = [(run, cells) for at, run, cells in distances(runs) if at == share]
        swept = [(np.mean(run.column("iterations")), cells) for run, cells in found if run.manifest["solver"] == "vbd"]
        name = f"{share} % of the run"
        of = lambda key: zip(*[(n, cells[key]) for n, cells in swept if cells.get(key, "") != ""])  # noqa: E731
        for axes, key in ((distance, "rms distance to Newton [m]"), (residual, "residual [1]")):
            points = list(of(key))
            if points:
                axes.plot(*points, "o-", color=colour, markersize=3, label=name)
        for run, cells in found:
            if run.manifest["solver"] == "ipc" and "rms distance to Newton [m]" in cells:
                distance.axhline(cells["rms distance to Newton [m]"], color=colour, linestyle="--", linewidth=0.8)
        motion = next((cells["rms motion of the step [m]"] for _, cells in found
                       if "rms motion of the step [m]" in cells), None)
        if motion:
            distance.axhline(motion, color=colour, linestyle=":", linewidth=0.6)
    distance.set(xlabel="iterations", ylabel="distance, rms [m]", xscale="log", yscale="log",
                 title="One step from Newton's (dashed: IPC; dotted: motion)")
    residual.set(xlabel="iterations", ylabel="residual (Eq. 29) [1]", xscale="log", yscale="log",
                 title="What one step leaves")
    for axes in (distance, residual):
        axes.set_xticks(sorted({n for numbers in commands.MAT_ITERATIONS.values() for n in numbers}))
        axes.xaxis.set_major_formatter(ScalarFormatter())
        axes.xaxis.set_minor_formatter(NullFormatter())
        if axes.get_legend_handles_labels()[0]:
            axes.legend(fontsize=6)


def draw_lag(axes, runs):
    beside = axes.twinx()
    for bounds, colour in zip(commands.MAT_BOUNDS, style.COLOURS):
        run = runs[f"{bounds}/whole"]
        axes.plot(seconds(run), run.column("largest_lag"), color=colour, label=f"lag, {bounds}")
        beside.plot(seconds(run), run.column("inverted_tetrahedra"), ":", color=colour, linewidth=0.8)
    axes.set(xlabel="time [s]", ylabel="largest lag of the ends [m]", title="Lag; dotted: inverted tetrahedra")
    beside.set(ylabel="inverted tetrahedra")
    beside.grid(False)
    axes.legend(fontsize=6)


def draw(runs, theirs, backend, out):
    plt = style.use()
    figure, axes = plt.subplots(2, 3, figsize=(14, 7.5))
    draw_times(axes[0, 0], runs, backend)
    draw_gipc(axes[0, 1], runs, theirs)
    draw_windows(axes[0, 2], runs)
    draw_distances(axes[1, 0], axes[1, 1], runs)
    draw_lag(axes[1, 2], runs)
    whole = [runs[f"{bounds}/whole"] for bounds in commands.MAT_BOUNDS]
    audited = ", ".join(f"{bounds}: {run.manifest.get('audited_states', 0)} states audited, intersections: "
                        f"{row_of('', run)['intersections']}" for bounds, run in zip(commands.MAT_BOUNDS, whole))
    figure.suptitle(f"mat_twist ({whole[0].manifest['scale']}), {audited}; {commits_in_words(list(runs.values()))}",
                    fontsize=8)
    style.save(figure, out)


if __name__ == "__main__":
    parser = baseline_arguments(__doc__.splitlines()[0], backends=("cpu", "cuda"))
    parser.add_argument("--made", action="store_true", help="draw the runs that there are, and make none")
    parser.add_argument("--movie", help="MP4 to write instead, of the finished whole run with planes")
    options = parser.parse_args()
    try:
        if options.movie:
            draw_movie(whole := Run(Path(options.folder) / "planes/whole"), camera_of(whole), options.movie)
            sys.exit()
        found_runs, external = runs_of(options), gipc_times(options.scale)
        write_table(Path(options.folder) / "fig19.csv", table(found_runs, external))
        draw(found_runs, external, options.backend, Path(options.folder) / "fig19.png")
    except RunError as error:
        sys.exit(f"fig19: {error}")
