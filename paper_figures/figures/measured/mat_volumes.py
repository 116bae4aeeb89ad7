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
from plots import camera, render, style
from plots.scene_figure import MOVIE, source_of
from ogc_testbed.runs import Run, RunError
from plots.bodies import bodies_of

NAME = "mat_volumes"
ROWS = {commands.MAT_VOLUMES: "volume", commands.MAT: "balls", commands.MAT_PLANES: "planes"}
SHARES = (25, 50, 75, 100)  # of the run [%]
EARLY = 2.75  # [s]: before this time few vertices are inside
FROM_AUDIT = {"most vertices inside [1]": "most_vertices_inside", "deepest [m]": "deepest_m",
              "most edges through [1]": "most_edges_meeting_volumes"}
ALT = ("Plots of the time a step and of vertices inside their own body over time, and renderings of the "
       "twisted mat as a volume, with balls and with planes at several moments.")


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


def frame_at(run, share):
    """Returns the stored state nearest to this percentage of the run's steps."""
    wanted = share * int(run.column("step")[-1]) / 100
    return min(run.frames, key=lambda path: abs(int(path.stem.removeprefix("frame_")) - wanted))


def draw(runs, out):
    plt = style.use()
    figure, grid = plt.subplots(1 + len(ROWS), len(SHARES), figsize=(13, 3 * (1 + len(ROWS))))
    over_time, inside, depth, inverted = grid[0]
    for number, (row, kind) in enumerate(ROWS.items()):
        run = runs[row]
        seconds, colour = run.setting("time_step") * run.column("step"), style.COLOURS[number]
        over_time.plot(seconds, run.column("wall"), color=colour, linewidth=0.6, label=kind)
        inverted.plot(seconds, run.column("inverted_tetrahedra"), color=colour, linewidth=0.8, label=kind)
        if kind == "volume":
            inside.plot(seconds, run.column("vertices_inside"), color=colour, linewidth=0.8)
            depth.plot(seconds, 1e3 * run.column("deepest"), color=colour, linewidth=0.8)
    over_time.set(title="time a step [ms]", yscale="log", xlabel="time [s]")
    inside.set(title="vertices inside, by the solver", xlabel="time [s]")
    depth.set(title="deepest [mm], by the solver", xlabel="time [s]")
    inverted.set(title="inverted tetrahedra", xlabel="time [s]")
    for axes in (over_time, inverted):
        axes.legend(fontsize=7)
    usable, reason = render.available()
    for line, (row, kind) in zip(grid[1:], ROWS.items()):
        run = runs[row]
        for axes, share in zip(line, SHARES):
            axes.axis("off")
            frame = run.frame(frame_at(run, share))
            axes.set_title(f"{kind}, {frame.time:.3g} s")
            if usable:
                axes.imshow(render.picture(bodies_of(run, frame), camera.of_ends(run, MOVIE)))
            else:
                axes.text(0.5, 0.5, reason, ha="center", va="center", wrap=True, transform=axes.transAxes)
    about = runs[commands.MAT].manifest
    title = "A mat that is a volume lets itself be entered where bounds hold it apart"
    figure.suptitle(f"{title} ({about['scale']}, {about['device']})", fontsize=9)
    style.save(figure, out, title, ALT, source_of(list(runs.values())))


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
