"""Fig. 15 and 16: a knitted cloth of one yarn is pulled apart, or twisted and let go, by OGC and by the same sweep with
a quadratic force and without bounds (the baseline, the paper's "Newton"). Pictures at four moments, meetings of threads
and mean tension over time; runs, table, picture and movie.

Fig. 15's number is the tension at the first meeting over k_c r, the largest force of a quadratic contact. Fig. 16's
numbers are the meetings, the distance of each vertex of the twisted cloth from its start, and the distance of the
released cloth from the cloth that hangs untwisted. Steps whose meetings were not counted are ignored.
"""

import argparse
import csv
import sys
from itertools import chain
from pathlib import Path

import numpy as np

from paper_figures.workflow import commands
from paper_figures.workflow.first_meeting import FirstMeeting
from paper_figures.workflow.jobs import Limit, RunFailure
from paper_figures.workflow.runs import provenance, write_table
from plots import render, style  # noqa: F401  tests replace render.available
from plots.camera import around, densest, of_ends, view_of
from plots.render import View
from plots.scene_figure import MOVIE, audit_in_words, draw_movie, moment, show, source_of
from ogc_testbed.runs import Run, RunError

FIGURE = {commands.STRETCH: "fig15", commands.YARN_TWIST: "fig16"}
PICTURES = {commands.STRETCH: "fig15.png", commands.YARN_TWIST: "fig16.png"}
JOBS = {commands.STRETCH: commands.yarn_stretched, commands.YARN_TWIST: commands.yarn_twisted}
KINDS = {"ogc": "OGC", "baseline": "penalty"}
# Moments that are shown, as parts of the run, and of the one after it in which the cloth is let go.
SHOWN = {commands.STRETCH: (0, 0.3, 0.7, 1), commands.YARN_TWIST: (0, 0.36, 1)}
LET_GO = (0.2, 1)
AT_REST = 0.01  # m/s: a cloth with a smaller root mean square speed is at rest
FALLEN = 2.0  # m: what is farther than this from the middle has come off and is not waited for
SIZE = {commands.STRETCH: (800, 400), commands.YARN_TWIST: (560, 720)}
NEAR_SIZE, NEAR_REACH = (960, 480), 0.05
REST_SIZE = (800, 800)
AT_REST_SHOWN = {"released": "OGC, let go and braked", "released_frictionless": "the same, then without friction",
                 "hanging": "OGC, braked, never twisted"}
AT_REST_ALT = (" Three more renderings show the cloth after it was let go and braked, with friction and without, and a "
               "cloth that was never twisted.")
NEAR_VIEW = {commands.STRETCH: View((0.25, 1.0, 0.0), up=(1, 0, 0)), commands.YARN_TWIST: View((0.25, 0.1, 1.0))}
TITLES = {commands.STRETCH: "Fig. 15. Pulled apart, the knit holds with OGC and unravels with a penalty force",
          commands.YARN_TWIST: "Fig. 16. Twisted five turns and let go, the knit stays a knit with OGC and tangles "
                               "with a penalty force"}
ALTS = {commands.STRETCH: "Renderings of a knitted cloth of one yarn that is pulled to the left and right. With OGC "
                          "its loops become long and narrow and hold. With the penalty force threads pass through one "
                          "another and the cloth comes apart. Close views show the loops of both, a plot the tension "
                          "over time, and a table the number of pull-throughs.",
        commands.YARN_TWIST: "Renderings of a hanging knitted cloth of one yarn whose lower edge is turned five times "
                             "and then let go. With OGC it becomes a rope and, let go, hangs down as one, unbroken. "
                             "With the penalty force threads pass through one another, tangle, and the cloth comes "
                             "apart. Close views, a plot of the tension, and a table of pull-throughs."}

# These are for runs in which no threads passed through one another without bounds either.
HOLDS_TITLES = {commands.STRETCH: "Fig. 15. Pulled apart, the knit holds with OGC, and here with a penalty force, too",
                commands.YARN_TWIST: "Fig. 16. Twisted five turns and let go, the knit stays a knit with OGC, and here "
                                     "with a penalty force, too"}
HOLDS_ALT = ("Renderings of a knitted cloth of one yarn that is pulled apart, or twisted and let go, with OGC and with "
             "a penalty force; it stays whole with both. Close views, a plot of the tension, and a table of "
             "pull-throughs, of which there are none.")


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


def moments(scene, runs, kind):
    """Returns [(run, frame)] of the pictures of a kind: of its shown run, and of the cloth that is let go, whose frames
    are enough."""
    run = runs[main_runs(scene)[kind]]
    found = [(run, run.frame_at_step(round(share * run.column("step")[-1]))) for share in SHOWN[scene]]
    released = sorted((run.folder.parent / f"{kind}_released/frames").glob("frame_*.h5"))
    steps = [int(path.stem.removeprefix("frame_")) for path in released]
    for share in LET_GO if steps else ():
        wanted = run.column("step")[-1] + share * (steps[-1] - run.column("step")[-1])
        found.append((run, run.frame(released[int(np.argmin([abs(step - wanted) for step in steps]))])))
    return found


def draw_pictures(axes, scene, found, words):
    for (run, frame), place in zip(found, axes):
        points = frame.positions.astype(float)
        fallen = ~np.isfinite(points).all(axis=1)
        middle = np.median(points[~fallen], axis=0)
        near = np.linalg.norm(points - middle, axis=1) < FALLEN  # threads that have come off fall far
        camera = view_of(scene).fit(points[near], SIZE[scene])
        free = ", let go" if frame.step > run.column("step")[-1] else ""
        show(place, run, frame, camera, f"{words}, {moment(frame)}{free}", SIZE[scene])
    for place in axes[len(found):]:
        style.not_run(place)


def draw_near(place, scene, run, frame, words):
    """Draws a close view of where the yarn is densest."""
    points = frame.positions.astype(float)
    centre = densest(points, NEAR_REACH)
    show(place, run, frame, around(points, centre, NEAR_REACH, run, NEAR_VIEW[scene], NEAR_SIZE), words, NEAR_SIZE)


def label(run):
    return f"{KINDS[kind_of(run)]}, k_c = {material(run)[1]:g} N/m"


def drawn_over_time(runs):
    """Returns the runs of the scene that begin at its start."""
    return {name: run for name, run in runs.items()
            if commands.WINDOW_OF not in name and run.column("step")[0] == 1 and name != "hanging"}


def first_pull(name, run, runs, rows):
    """Returns (time [s], tension [N]) at the first meeting of a run, from itself and its windows or else from its row,
    if this is of the same program: another one's threads meet elsewhere. None if threads never met."""
    part, first = first_among([run, *windows_of(name, runs)])
    if first is not None:
        return seconds(part)[first], tension(part)[first]
    row = next((row for row in rows if row["run"] == name and row["first meeting at step"]
                and run.manifest["commit"].startswith(row["commit"])), None)
    return row and (run.setting("time_step") * int(row["first meeting at step"]), float(row["mean tension there [N]"]))


def draw_tension(axes, runs, rows):
    marked = False
    for name, run in drawn_over_time(runs).items():
        weaker = commands.YARN_STIFFNESS.index(round(material(run)[1]))
        colour = (style.OURS if kind_of(run) == "ogc" else style.BASELINE)
        axes.plot(seconds(run), tension(run), (style.DASHES)[weaker], color=colour, linewidth=1,
                  label=label(run).replace(", k_c = ", ",\n"))
        first = first_pull(name, run, runs, rows)
        if first:
            axes.plot(*first, "x", color=colour, markersize=8, markeredgewidth=2)
            marked = True
    axes.set(xlabel="time [s]", ylabel="k_s · mean stretch [N]", ylim=(0, None),
             title="Mean tension of the yarn" + ("; ×: threads pass through one another" if marked else ""))
    style.label_ends(axes)


def met_in_words(row):
    """Returns the number of meetings of a row; a dash where no step was asked."""
    return "–" if row["meetings [1]"] == "" else str(row["meetings [1]"])


def draw_rows(axes, scene, rows):
    """Draws the table's numbers: meetings, tension at the first one, and for twisted cloths how far they end."""
    axes.axis("off")
    short = lambda text: f"{float(text):.3g}" if text not in ("", None) else "–"  # noqa: E731
    if scene == commands.STRETCH:
        head = ["", "k_c [N/m]", "pull-throughs", "in steps", "tension / k_c r at the first"]
        body = [[KINDS[row["kind"]], row["k_c [N/m]"], met_in_words(row), row["steps asked [1]"],
                 short(row["tension over k_c r [1]"])] for row in rows]
    else:
        head = ["", "pull-throughs", "in steps", "from the hanging cloth [m]"]
        apart = ("distance, median [m]", "distance while it moves, median [m]")
        body = [[KINDS[row["kind"]] + (", let go" if "released" in row["run"] else ""), met_in_words(row),
                 str(row["steps asked [1]"]),
                 short(row[apart[0]] or row[apart[1]]) if "released" in row["run"] else "–"]
                for row in rows if row["run"] != "hanging"]
    style.table(axes, head, body)


def at_rest_of(folder):
    """Returns [(run, words)] of the cloths of Fig. 16 that were braked, from the folder of fig16_rest; none without
    one. Throws RunError if one is missing."""
    if not folder:
        return []
    found = [(Run(Path(folder) / name), words) for name, words in AT_REST_SHOWN.items()]
    lacking = [run.folder.name for run, _ in found if not run.frames]
    if lacking:
        raise RunError(f"{folder} has no states of {', '.join(lacking)}; make fig16_rest, or leave --rest out")
    return found


def draw_at_rest(axes, scene, found):
    """Draws the last states of braked cloths, all by one camera."""
    frames = [run.frame(run.frames[-1]) for run, _ in found]
    camera = view_of(scene).fit(np.concatenate([frame.positions for frame in frames]).astype(float), REST_SIZE)
    for place, (run, words), frame in zip(axes, found, frames):
        show(place, run, frame, camera, words, REST_SIZE)


def titled(scene, rows):
    """Returns title and text of the picture, by what happened without bounds."""
    pulled = any(row["kind"] != "ogc" and row["meetings [1]"] not in ("", 0, "0") for row in rows)
    return (TITLES[scene], ALTS[scene]) if pulled else (HOLDS_TITLES[scene], HOLDS_ALT)


def draw(scene, runs, rows, out, rested=()):
    """Draws pictures of our run and of the baseline, both from near, the tension, and the numbers of the table.
    `rested`: runs and words of more cloths, whose last states are shown (at_rest_of)."""
    style.use()
    ours = runs[main_runs(scene)["ogc"]]
    pictures = {kind: moments(scene, runs, kind) for kind in KINDS}
    count = max(map(len, pictures.values()))
    where = "" if ours.manifest["scale"] == "paper" else f"scale {ours.manifest['scale']}; "
    below = (f"{where}one yarn of {ours.manifest['scene']['vertices']:,} vertices, {audit_in_words(ours)}; "
             f"{ours.manifest['device']}; “penalty” (the paper's Newton): the same sweep with a quadratic force, no "
             "bounds")
    page = [*[style.pictures(count, SIZE[scene])] * 2, style.pictures(2, NEAR_SIZE),
            (2.5, [(0.5, "plot"), (0.5, "picture")]), *([style.pictures(len(rested), REST_SIZE)] if rested else [])]
    title, alt = titled(scene, rows)
    figure, axes = style.page(page, title, below)
    for row, (kind, found) in zip(axes, pictures.items()):
        draw_pictures(row, scene, found, KINDS[kind])
    for place, (kind, found) in zip(axes[2], pictures.items()):
        run, frame = found[len(SHOWN[scene]) - 1]
        draw_near(place, scene, run, frame, f"{KINDS[kind]}, {moment(frame)}, from near")
    draw_tension(axes[3][0], runs, rows)
    draw_rows(axes[3][1], scene, rows)
    if rested:
        draw_at_rest(axes[4], scene, rested)
    alt += AT_REST_ALT if rested else ""
    style.save(figure, out, title, alt, source_of([runs[name] for name in main_runs(scene).values()]))


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", help="where the runs are, or go, and table and picture")
    parser.add_argument("--ogc", default="build/default/ogc", help="the program")
    parser.add_argument("--scene", default=commands.STRETCH, choices=list(FIGURE))
    parser.add_argument("--scale", default="small", choices=("smoke", "small", "paper"))
    parser.add_argument("--backend", default="cpu", choices=("cpu", "cuda"), help="of all runs")
    parser.add_argument("--made", action="store_true", help="draw the runs that there are, and make none")
    parser.add_argument("--rows", metavar="CSV", help="kept table, whose numbers are shown, not those of the runs")
    parser.add_argument("--rest", metavar="FOLDER", help="runs of fig16_rest, whose last states are shown, too")
    parser.add_argument("--movie", help="MP4 to write instead, of our finished run")
    return parser.parse_args()


def make(options):
    scene, folder = options.scene, Path(options.folder)
    if options.movie:
        run = Run(folder / main_runs(scene)["ogc"])
        return draw_movie(run, options.movie, of_ends(run, MOVIE))
    runs = runs_of(options)
    if options.rows:
        with open(options.rows, newline="", encoding="utf-8") as file:
            return draw(scene, runs, list(csv.DictReader(file)), folder / PICTURES[scene], at_rest_of(options.rest))
    rows = table(runs, far(runs) if scene == commands.YARN_TWIST else {})
    write_table(folder / f"{FIGURE[scene]}.csv", rows)
    return draw(scene, runs, rows, folder / PICTURES[scene], at_rest_of(options.rest))


if __name__ == "__main__":
    chosen = arguments()
    try:
        make(chosen)
    except RunError as error:
        sys.exit(f"{FIGURE[chosen.scene]}: {error}")
