"""The twisted mat as a volume (§3.9's faster variant: what enters is pushed out again) beside the mat that bounds keep
from entering itself: time a step, the vertices inside and their depth, and the mat at four times. Runs, table and
picture.

The mat is one body of tetrahedra. As a surface its boundary has balls or planes. As a volume it has no bounds, and its
boundary vertices are tested against its own tetrahedra. The audit counts vertices inside, at `paper` in states a sixth
of a second apart.
"""

import sys
from pathlib import Path

import numpy as np

from paper_figures.figures.table1 import contacts, times
from paper_figures.workflow import commands
from paper_figures.workflow.jobs import Limit, RunFailure, parser_of_figure
from paper_figures.workflow.runs import provenance, write_table
from plots import style
from plots.camera import fitted
from plots.scene_figure import moment, show, source_of
from ogc_testbed.runs import Run, RunError

NAME = "mat_volumes"
ROWS = {commands.MAT_VOLUMES: "volume", commands.MAT: "balls", commands.MAT_PLANES: "planes"}
SHARES = (25, 50, 75, 100)  # of the run [%]
EARLY = 2.75  # [s]: before this time few vertices are inside
FROM_AUDIT = {"most vertices inside [1]": "most_vertices_inside", "deepest [m]": "deepest_m",
              "most edges through [1]": "most_edges_meeting_volumes"}
COLOURS = {"volume": style.BASELINE, "balls": style.COLOURS[4], "planes": style.OURS}
SIZE = (640, 400)  # pixels
TITLE = "A mat that is a volume lets itself be entered where bounds hold it apart"
ALT = ("Renderings of the twisted mat as a volume, with balls and with planes, at the same four moments; curves over "
       "time of the time a step, the vertices inside their own body, and the inverted tetrahedra.")


def runs_of(options):
    """Returns row -> Run. Throws RunError."""
    try:
        for job in () if options.made else commands.mat_as_volume(options.scale, options.backend):
            job.make(options.ogc, options.folder, Limit(), True)
    except RunFailure as error:
        raise RunError(str(error)) from error
    return {row: Run(options.folder / row / "begin") for row in ROWS}


def row_of(kind, run):
    mean, worst, repeated = times(run)
    early = run.column("wall")[run.setting("time_step") * run.column("step") <= EARLY]
    audited = int(run.manifest.get("audited_states", 0))
    kept = run.manifest.get("guarantee_kept") if audited else None
    found = {name: run.manifest.get(key, "") if kind == "volume" and audited else "" for name, key in
             FROM_AUDIT.items()}
    return {"mat": kind, "steps [1]": len(run.column("step")), "mean [ms]": f"{mean:.4g}", "worst [ms]": f"{worst:.4g}",
            "repeated steps [1]": repeated, "mean up to 2.75 s [ms]": f"{np.mean(early):.4g}",
            "worst up to 2.75 s [ms]": f"{np.max(early):.4g}",
            "detections a step [1]": f"{np.mean(run.column('discrete_detections')):.4g}",
            "contacts, mean [1]": f"{np.mean(contacts(run)):.5g}",
            "largest lag [m]": f"{np.max(run.column('largest_lag')):.4g}",
            "inverted tetrahedra, most [1]": int(np.max(run.column("inverted_tetrahedra"))), **found,
            "audited states [1]": audited,
            "intersections of surfaces": {True: "none", False: "FOUND", None: "not audited"}[kept],
            "status": run.status, **provenance(run)}


def frame_at(run, step):
    """Returns the stored state nearest to this step."""
    return min(run.frames, key=lambda path: abs(int(path.stem.removeprefix("frame_")) - step))


def draw_curves(panels, runs):
    over_time, inside, inverted = panels
    for row, kind in ROWS.items():
        run, colour = runs[row], COLOURS[kind]
        seconds = run.setting("time_step") * run.column("step")
        over_time.plot(seconds, run.column("wall"), color=colour, linewidth=0.6, label=kind)
        inverted.plot(seconds, run.column("inverted_tetrahedra"), color=colour, linewidth=1, label=kind)
        if kind == "volume":
            inside.plot(seconds, run.column("vertices_inside"), color=colour, linewidth=1, label=kind)
        else:
            inside.plot(seconds, 0 * seconds, color=colour, linewidth=1, label=f"{kind}: none")
    over_time.set(title="Time a step", ylabel="time [ms]", yscale="log")
    inside.set(title="Vertices inside their own body", ylabel="vertices")
    inverted.set(title="Inverted tetrahedra", ylabel="tetrahedra")
    for axes in panels:
        axes.set_xlabel("time [s]")
        style.label_ends(axes)


def draw(runs, out):
    """Draws the mat with each kind of contact at the same four moments, and curves."""
    style.use()
    last = min(int(run.column("step")[-1]) for run in runs.values())
    below = f"scale {runs[commands.MAT].manifest['scale']}, {runs[commands.MAT].manifest['device']}"
    rows = [*[style.pictures(len(SHARES), SIZE)] * len(ROWS), (2.4, [(1 / 3, "plot")] * 3)]
    figure, axes = style.page(rows, TITLE, below)
    for line, (row, kind) in zip(axes, ROWS.items()):
        run = runs[row]
        for place, share in zip(line, SHARES):
            frame = run.frame(frame_at(run, share * last / 100))
            show(place, run, frame, fitted(run, [frame], SIZE), f"{kind}, {moment(frame)}", SIZE)
    draw_curves(axes[-1], runs)
    style.save(figure, out, TITLE, ALT, source_of(list(runs.values())))


def arguments():
    parser = parser_of_figure(__doc__.splitlines()[0], ("smoke", "small", "paper"), "smoke")
    parser.add_argument("--made", action="store_true", help="draw the runs that there are, and make none")
    return parser.parse_args()


def main():
    options = arguments()
    try:
        runs = runs_of(options)
    except RunError as error:
        sys.exit(f"{NAME}: {error}")
    write_table(options.folder / f"{NAME}.csv", [row_of(kind, runs[row]) for row, kind in ROWS.items()])
    draw(runs, options.folder / f"{NAME}.png")


if __name__ == "__main__":
    main()
