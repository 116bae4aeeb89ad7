"""Fig. 15 and 16: a knitted cloth of one yarn is pulled apart, or twisted and let go, by OGC and by the same sweep with
a quadratic force and without bounds (the baseline, the paper's "Newton"). Pictures at four moments, meetings of threads
and mean tension over time; runs, table, picture and movie.

Fig. 15's number is the tension at the first meeting over k_c r, the largest force of a quadratic contact. Fig. 16's
numbers are the meetings, the distance of each vertex of the twisted cloth from its start, and the distance of the
released cloth from the cloth that hangs untwisted. Steps whose meetings were not counted are ignored.
"""

import argparse
import sys
from itertools import chain
from pathlib import Path

import numpy as np

from paper_figures.workflow import commands
from paper_figures.workflow.first_meeting import FirstMeeting
from paper_figures.workflow.jobs import Limit, RunFailure
from paper_figures.workflow.runs import provenance, write_table
from plots import render, style
from ogc_testbed.runs import Run, RunError, commits_in_words
from plots.scene_figure import bodies_of, draw_movie

FIGURE = {commands.STRETCH: "fig15", commands.YARN_TWIST: "fig16"}
PICTURES = {commands.STRETCH: "fig15.png", commands.YARN_TWIST: "fig16.png"}
JOBS = {commands.STRETCH: commands.yarn_stretched, commands.YARN_TWIST: commands.yarn_twisted}
KINDS = {"ogc": "OGC", "baseline": "baseline"}
SHOWN = (0, 1 / 3, 2 / 3, 1)  # as parts of the run
# Position of the eye, and upward direction: from above, pulled from left to right; from the front, rotated about the
# vertical.
# vertical.
VIEWS = {commands.STRETCH: ((0, 1, 0), (1, 0, 0)), commands.YARN_TWIST: ((0.25, 0.1, 1), (0, 1, 0))}
AT_REST = 0.01  # m/s: a cloth with a smaller root mean square speed is at rest
MARGIN, ANGLE = 1.08, 30  # margin of a picture around the yarn; PyVista's angle of view [degrees]
SIZE = {commands.STRETCH: (640, 480), commands.YARN_TWIST: (640, 720)}


def runs_of(options):
    """Returns name -> Run with at least one step, and makes missing runs; with --made returns only existing ones."""
    folder, jobs = Path(options.folder), list(chain.from_iterable(JOBS[options.scene](options.scale, options.backend)))
    try:
        for job in () if options.made else jobs:
            job.make(options.ogc, folder, Limit(), True)
    except RunFailure as error:
        raise RunError(str(error)) from error
    searched = [window for job in jobs if isinstance(job, FirstMeeting) for window in job.made_below(folder)]
    found = {job.name: Run(folder / job.name) for job in (*jobs, *searched) if has_steps(folder / job.name)}
    main = [name for name in main_runs(options.scene).values() if name not in found]
    if main:
        raise RunError(f"{folder} lacks {' and '.join(main)}; leave --made out, and they are made")
    return found


def has_steps(folder):
    rows = folder / "steps.csv"
    return (folder / "run.json").is_file() and rows.is_file() and rows.read_text().count("\n") > 1


def main_runs(scene):
    """Returns kind -> name of the shown run."""
    return {kind: kind if scene == commands.YARN_TWIST else f"{kind}_{commands.YARN_STIFFNESS[0]}" for kind in KINDS}


def material(run):
    """Returns (k_s [N], k_c [N/m]) of the yarn."""
    found = run.manifest["scene"]["bodies"][0]["material"]
    return found["rod"]["stretch"]["value"], found["contact_stiffness"]["value"]


def kind_of(run):
    return "baseline" if run.setting("bounds") == "off" else "ogc"


def seconds(run):
    return run.setting("time_step") * run.column("step")


def tension(run):
    """Returns the mean tension of the segments [N]."""
    return material(run)[0] * run.column("mean_stretch")


def meetings(run):
    """Returns the number of meetings in each step; not-a-number if they were not counted."""
    return run.steps.get("meetings", np.full(len(run.column("step")), np.nan))


def asked_of(parts):
    """Returns (times [s], meetings) of the steps, in order and each once, in which meetings were counted in a run or
    its windows."""
    found = {step: (time, met) for part in parts
             for step, time, met in zip(part.column("step"), seconds(part), meetings(part)) if np.isfinite(met)}
    return np.array([found[step] for step in sorted(found)]).reshape(-1, 2).T


def first_meeting(run):
    """Returns the row of the first step in which threads met, or None."""
    met = np.flatnonzero(meetings(run) > 0)
    return int(met[0]) if len(met) else None


def windows_of(name, runs):
    """Returns the windows of a run in which meetings were counted, ordered by step."""
    found = [run for other, run in runs.items() if other.startswith(name + commands.WINDOW_OF)]
    return sorted(found, key=lambda run: run.column("step")[0])


def first_among(parts):
    """Returns (part, row) of the first meeting in a run or its windows; (the run, None) if no threads met."""
    return next(((part, row) for part in parts if (row := first_meeting(part)) is not None), (parts[0], None))


def row_of(name, run, windows=()):
    stretch, stiffness = material(run)
    parts, pull = [run, *windows], tension(run)
    most, (_, asked) = stiffness * run.setting("contact_radius"), asked_of(parts)
    part, first = first_among(parts)
    cell = lambda value: "" if value is None else f"{value:.6g}"  # noqa: E731
    at = lambda values: None if first is None else values[first]  # noqa: E731
    return {"run": name, "kind": kind_of(run), "k_c [N/m]": f"{stiffness:g}", "k_s [N]": f"{stretch:g}",
            "first step": int(run.column("step")[0]), "last step": int(run.column("step")[-1]),
            "steps asked [1]": len(asked),
            "meetings [1]": int(asked.sum()) if len(asked) else "",
            "first meeting at step": "" if first is None else int(part.column("step")[first]),
            "mean stretch there [1]": cell(at(part.column("mean_stretch"))),
            "mean tension there [N]": cell(at(tension(part))),
            "tension over k_c r [1]": cell(at(tension(part) / most)),
            "largest mean tension [N]": cell(np.nanmax(pull)),
            "largest mean tension over k_c r [1]": cell(np.nanmax(pull) / most),
            "largest stretch [1]": cell(np.nanmax(run.column("largest_stretch"))),
            "smallest contact distance [m]": cell(np.nanmin(run.column("smallest_contact_distance"), initial=np.inf)),
            "mean [ms]": cell(np.mean(run.column("wall"))), "worst [ms]": cell(np.max(run.column("wall"))),
            "scale": run.manifest["scale"], "status": run.manifest["status"].splitlines()[0],
            "ended": run.manifest["ended"], **provenance(run)}


def distances(run, to):
    """Returns the distance of each vertex of the last frame from the positions `to` [m]."""
    return np.linalg.norm(run.frame(run.frames[-1]).positions.astype(float) - to.astype(float), axis=1)


def speed(run):
    """Returns the root mean square speed of the yarn at the end, weighted by mass [m/s]. Its vertices are in the order
    of the rod."""
    rod = run.manifest["scene"]["bodies"][0]["material"]["rod"]
    length = np.linalg.norm(np.diff(run.start_positions.astype(float), axis=0), axis=1).sum()
    return float(np.sqrt(2 * run.column("kinetic_energy")[-1] / (rod["density"]["value"] * length)))


def far(runs):
    """Returns name -> distances [m] of Fig. 16: for twisted cloths from their start, for released cloths from the cloth
    that hangs untwisted."""
    found = {}
    for kind in KINDS:
        if kind in runs:
            found[kind] = distances(runs[kind], runs[kind].start_positions)
        if f"{kind}_released" in runs and "hanging" in runs:
            hanging = runs["hanging"]
            found[f"{kind}_released"] = distances(runs[f"{kind}_released"], hanging.frame(hanging.frames[-1]).positions)
    return found


def table(runs, how_far):
    """Returns a row for each run with its windows. Cells without a value are empty. The distance from the hanging cloth
    is given only if both cloths are at rest."""
    shares = {"median": 50, "nine vertices in ten within": 90, "largest": 100}
    rows, speeds = [], {name: speed(runs[name]) for name in how_far.keys() | ({"hanging"} & runs.keys())}
    for name, run in runs.items():
        if commands.WINDOW_OF in name:
            continue
        of, moves = how_far.get(name), max(speeds.get(name, 0), speeds.get("hanging", 0)) > AT_REST
        counts = of is not None and not (moves and name.endswith("_released"))
        cells = {words: "" if of is None else f"{np.percentile(of, k):.6g}" for words, k in shares.items()}
        rows.append(row_of(name, run, windows_of(name, runs)) |
                    {f"distance, {words} [m]": cell if counts else "" for words, cell in cells.items()} |
                    {f"distance while it moves, {words} [m]": "" if counts else cell for words, cell in cells.items()} |
                    {"speed at the end [m/s]": f"{speeds[name]:.6g}" if name in speeds else ""})
    return rows


def camera_of(scene, points, size):
    """Returns (eye, target, up) of a camera for which all `points` fill the picture."""
    back, up = (np.array(v, float) / np.linalg.norm(v) for v in VIEWS[scene])
    right = np.cross(up, back) / np.linalg.norm(np.cross(up, back))
    axes = np.stack([right, np.cross(back, right), back])
    seen = points.astype(float) @ axes.T
    low, high = seen.min(axis=0), seen.max(axis=0)
    half = np.max((high - low)[:2] / 2 * MARGIN * np.array([size[1] / size[0], 1]))
    target = (low + high) / 2
    eye = target + np.array([0, 0, half / np.tan(np.radians(ANGLE / 2)) + (high - low)[2] / 2])
    return tuple(eye @ axes), tuple(target @ axes), tuple(up)


def draw_pictures(figure, places, scene, run, words):
    usable, reason = render.available()
    for share, place in zip(SHOWN, places):
        axes = figure.add_subplot(place)
        axes.axis("off")
        frame = run.frame_at_step(round(share * run.column("step")[-1]))
        axes.set_title(f"{words}, t = {frame.time:.3g} s")
        if usable:
            camera = camera_of(scene, frame.positions, SIZE[scene])
            axes.imshow(render.picture(bodies_of(run, frame), camera, SIZE[scene]))
        else:
            axes.text(0.5, 0.5, reason, ha="center", va="center", wrap=True, transform=axes.transAxes)


def label(run):
    return f"{KINDS[kind_of(run)]}, k_c = {material(run)[1]:g} N/m"


def drawn_over_time(runs):
    """Returns the runs of the scene that begin at its start."""
    return {name: run for name, run in runs.items()
            if commands.WINDOW_OF not in name and run.column("step")[0] == 1 and name != "hanging"}


def draw_over_time(axes_of_tension, axes_of_meetings, runs):
    for name, run in drawn_over_time(runs).items():
        weaker = commands.YARN_STIFFNESS.index(round(material(run)[1]))
        colour, dash = style.COLOURS[weaker], style.DASHES[kind_of(run) == "baseline"]
        axes_of_tension.plot(seconds(run), tension(run), dash, color=colour, linewidth=1, label=label(run))
        parts = [run, *windows_of(name, runs)]
        part, first = first_among(parts)
        if first is not None:
            axes_of_tension.plot(seconds(part)[first], tension(part)[first], "x", color=colour)
        time, asked = asked_of(parts)
        if len(asked):
            axes_of_meetings.plot(time, np.cumsum(asked), dash, color=colour, linewidth=1,
                                  label=label(run))
    axes_of_tension.set(xlabel="time [s]", ylabel="k_s · mean stretch [N]",
                        title="Mean tension; ×: the first meeting")
    axes_of_meetings.set(xlabel="time [s]", ylabel="meetings so far", title="Threads that met on the way of a step",
                         ylim=(0, None))
    axes_of_meetings.set_yscale("symlog")
    for axes in (axes_of_tension, axes_of_meetings):
        if axes.get_legend_handles_labels()[0]:
            axes.legend(fontsize=6)


def draw_distances(axes, how_far):
    for number, (name, of) in enumerate(how_far.items()):
        kind, _, released = name.partition("_")
        words = "let go, from the cloth that hangs" if released else "twisted, from its start"
        axes.plot(np.sort(of), 100 * np.arange(1, len(of) + 1) / len(of), style.DASHES[number % 4],
                  label=f"{KINDS[kind]}, {words}")
    axes.set(xlabel="distance [m]", xscale="log", ylabel="vertices within [%]", title="Distance at the end")
    axes.legend(fontsize=6)


def draw_reached(axes, runs):
    """Draws the tension at the first meeting over k_c r, or, if no threads met, the largest tension."""
    chosen = drawn_over_time(runs)
    for place, (name, run) in enumerate(chosen.items()):
        parts = [run, *windows_of(name, runs)]
        part, first = first_among(parts)
        asked = len(asked_of(parts)[0]) > 0
        height = np.nanmax(tension(run)) if first is None else tension(part)[first]
        height /= material(run)[1] * run.setting("contact_radius")
        axes.bar(place, height, color=style.COLOURS[2 if first is None else 3])
        words = "" if first is not None else ", none" if asked else ", not asked"
        axes.annotate(f"{height:.2g}{words}", (place, height), ha="center", va="bottom", fontsize=6)
    axes.set_xticks(range(len(chosen)), [name.replace("_", "\n") for name in chosen], fontsize=6)
    axes.set(ylabel="tension over k_c r [1]", title="At the first meeting; none: at the most")


def draw(scene, runs, how_far, out):
    plt = style.use()
    figure = plt.figure(figsize=(13, 9))
    grid = figure.add_gridspec(3, 12, height_ratios=[1, 1, 0.9])
    for row, (kind, name) in enumerate(main_runs(scene).items()):
        draw_pictures(figure, [grid[row, 3 * k:3 * k + 3] for k in range(4)], scene, runs[name], KINDS[kind])
    panels = [figure.add_subplot(grid[2, 4 * k:4 * k + 4]) for k in range(3)]
    draw_over_time(*panels[:2], runs)
    if scene == commands.YARN_TWIST:
        draw_distances(panels[2], how_far)
    else:
        draw_reached(panels[2], runs)
    ours = runs[main_runs(scene)["ogc"]]
    figure.suptitle(f"{scene} ({ours.manifest['scale']}), {ours.manifest['backend']} ({ours.manifest['device']}), "
                    f"{commits_in_words(list(runs.values()))}; baseline: bounds=off, "
                    "contact_activation=quadratic", fontsize=8)
    style.save(figure, out)


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", help="where the runs are, or go, and table and picture")
    parser.add_argument("--ogc", default="build/default/ogc", help="the program")
    parser.add_argument("--scene", default=commands.STRETCH, choices=list(FIGURE))
    parser.add_argument("--scale", default="small", choices=("smoke", "small", "paper"))
    parser.add_argument("--backend", default="cpu", choices=("cpu", "cuda"), help="of all runs")
    parser.add_argument("--made", action="store_true", help="draw the runs that there are, and make none")
    parser.add_argument("--movie", help="MP4 to write instead, of our finished run")
    return parser.parse_args()


def make(options):
    scene, folder = options.scene, Path(options.folder)
    if options.movie:
        run = Run(folder / main_runs(scene)["ogc"])
        ends = np.concatenate([run.start_positions, run.frame(run.frames[-1]).positions])
        return draw_movie(run, camera_of(scene, ends, (640, 480)), options.movie)
    runs = runs_of(options)
    how_far = far(runs) if scene == commands.YARN_TWIST else {}
    write_table(folder / f"{FIGURE[scene]}.csv", table(runs, how_far))
    return draw(scene, runs, how_far, folder / PICTURES[scene])


if __name__ == "__main__":
    chosen = arguments()
    try:
        make(chosen)
    except RunError as error:
        sys.exit(f"{FIGURE[chosen.scene]}: {error}")
