"""Fig. 16's last claim: how far each vertex of the cloth that was twisted and let go is from the cloth that hangs as it
is, both at rest. Runs, table and picture.

A cloth is at rest if half of its vertices moved no farther in the last second than ε_v allows. Friction between threads
grows with their speed up to ε_v, so threads that friction holds still creep. Speeds of single steps are no criterion,
because contacts that open and close every few steps shake threads by micrometres. Damping does not affect where a cloth
comes to rest. Friction does: it holds threads that slip along each other, so that the place depends on the path. Both
cloths therefore continue without friction; their distance then is that of two states that sweeps leave unchanged.

A cloth that hangs folded is far from a cloth that hangs flat, although the knit is the same. So the table also counts
how many vertices that touch another thread in the untwisted cloth have the same thread near them in the other cloth.
"""

import sys
from itertools import chain, product
from pathlib import Path

import numpy as np

from paper_figures.figures.measured.yarn import distances
from paper_figures.workflow import commands
from paper_figures.workflow.jobs import Limit, RunFailure, parser_of_figure
from paper_figures.workflow.runs import provenance, write_table
from plots import style
from ogc_testbed.runs import Run, RunError

NAME, PICTURE = "fig16_rest", "fig16_rest.png"
LAST = 1.0  # s
SHARES = {"median": 50, "nine vertices in ten within": 90, "largest": 100}  # of the vertices [%]
STILL = 50  # percentage of the vertices; sweeps that circulate move loops at the rim by a millimetre about their places
THREAD = 12  # vertices that are farther apart along the yarn belong to different threads
TOUCHING, HALF_ROW = 3.5e-3, 5e-3  # [m] between centre lines: the yarn is 3 mm thick, rows are 10 mm apart
FRICTIONLESS = commands.FRICTIONLESS
ALT = ("A plot of how far vertices of the hanging knit that was twisted end from the knit that was never twisted, with "
       "and without friction between threads: their median, nine in ten, and the largest.")


def runs_of(options):
    """Returns name -> finished Run of the last jobs, and makes missing runs; with --made returns only existing ones."""
    folder = Path(options.folder)
    jobs = list(chain.from_iterable(commands.yarn_at_rest(options.scale, options.backend)))
    try:
        for job in () if options.made else jobs:
            job.make(options.ogc, folder, Limit(), True)
    except RunFailure as error:
        raise RunError(str(error)) from error
    names = list(chain(*commands.AT_REST.items()))
    missing = [name for name in names if not (folder / name / "run.json").is_file()]
    if missing:
        raise RunError(f"{folder} lacks {', '.join(missing)}; leave --made out, and they are made")
    found = {name: Run(folder / name) for name in names}
    for run in found.values():
        run.require_finished()
    return found


def last_frame(run):
    return run.frame(run.frames[-1])


def way(run):
    """Returns (largest distance of half of the vertices from where they end [m], duration [s]), from the frames of the
    last second."""
    last, step = last_frame(run), run.setting("time_step")
    late = [frame for frame in map(run.frame, run.frames[:-1]) if frame.time > last.time - LAST - step]
    apart = [np.percentile(np.linalg.norm(frame.positions.astype(float) - last.positions, axis=1), STILL)
             for frame in late]
    return max(apart, default=0.0), max((last.time - frame.time for frame in late), default=0.0)


def near(positions, within):
    """Returns pairs of points closer than `within`, found by cells of that size."""
    cells = np.floor((positions - positions.min(axis=0)) / within).astype(np.int64) + 1
    _, columns, layers = cells.max(axis=0) + 2
    key = (cells[:, 0] * columns + cells[:, 1]) * layers + cells[:, 2]
    order = np.argsort(key, kind="stable")
    found = []
    for x, y, z in product((-1, 0, 1), repeat=3):
        beside = key + (x * columns + y) * layers + z
        begin, end = (np.searchsorted(key[order], beside, side=side) for side in ("left", "right"))
        count = end - begin
        first = np.repeat(np.arange(len(positions)), count)
        place = np.arange(count.sum()) + np.repeat(begin - (np.cumsum(count) - count), count)
        pairs = np.stack((first, order[place]), axis=1)[first < order[place]]
        apart = np.linalg.norm(positions[pairs[:, 0]] - positions[pairs[:, 1]], axis=1)
        found.append(pairs[apart < within])
    return np.concatenate(found)


def kept_threads(run, beside):
    """Returns which share of the pairs of vertices that touch in `beside` are within half a row in `run` [1]. Only
    pairs of two threads count."""
    here, there = (last_frame(one).positions.astype(float) for one in (run, beside))
    pairs = near(there, TOUCHING)
    pairs = pairs[np.abs(pairs[:, 0] - pairs[:, 1]) > THREAD]
    if not len(pairs):
        return None
    return float(np.mean(np.linalg.norm(here[pairs[:, 0]] - here[pairs[:, 1]], axis=1) < HALF_ROW))


def speed(run):
    """Returns the root mean square speed of the vertices at the end [m/s]."""
    return float(np.sqrt(np.mean(np.sum(last_frame(run).velocities.astype(float)**2, axis=1))))


def at_rest(run):
    farthest, time = way(run)
    return 0 < time and farthest <= run.setting("friction_velocity") * time


def row_of(name, runs):
    """Returns a row. Cells of distances are empty if there is no other cloth, or if one of the two is not at rest."""
    run, beside = runs[name], commands.AT_REST.get(name, "")
    counts = bool(beside) and at_rest(run) and at_rest(runs[beside])
    kept = kept_threads(run, runs[beside]) if beside else None
    of = distances(run, last_frame(runs[beside]).positions) if beside else None
    cells = {words: "" if of is None else f"{np.percentile(of, share):.6g}" for words, share in SHARES.items()}
    return {"run": name, "beside": beside, "first step": int(run.column("step")[0]),
            "last step": int(run.column("step")[-1]), "at rest": "yes" if at_rest(run) else "no",
            "way in the last second, median [m]": f"{way(run)[0]:.6g}",
            "speed at the end [m/s]": f"{speed(run):.6g}",
            **{f"distance, {words} [m]": cell if counts else "" for words, cell in cells.items()},
            **{f"distance while it moves, {words} [m]": "" if counts else cell for words, cell in cells.items()},
            "touching threads within half a row still [1]": "" if not beside or kept is None else f"{kept:.6g}",
            "smallest contact distance [m]": f"{np.nanmin(run.column('smallest_contact_distance')):.6g}",
            "status": run.manifest["status"].splitlines()[0],
            "audited states": run.manifest.get("audited_states", 0), "ended": run.manifest["ended"],
            **provenance(run)}


def cell_of(row, words):
    """Returns a distance of a row [m], of cloths at rest or, if they are not, while one moves; not-a-number without
    one."""
    return float(row[f"distance, {words} [m]"] or row.get(f"distance while it moves, {words} [m]", "") or "nan")


def draw_distances(axes, rows, names):
    """Draws a line for each row: the median of the vertices' distances, and ranges up to nine in ten and the
    largest."""
    for place, row in enumerate(rows):
        median, ninth, largest = (1e3 * cell_of(row, words) for words in SHARES)
        rests = row["at rest"] == "yes"
        colour = style.OURS if rests else "0.6"
        axes.plot([median, largest], [place] * 2, color=colour, linewidth=1.2)
        axes.plot([median, ninth], [place] * 2, color=colour, linewidth=5, alpha=0.45, solid_capstyle="butt")
        axes.plot([median], [place], "o", color=colour, markersize=5)
        if not rests:
            axes.annotate("still moves", (largest, place), xytext=(5, -2.5), textcoords="offset points", fontsize=7,
                          color="0.4")
    for at, words in ((3, "yarn's\nthickness"), (10, "a row")):
        axes.axvline(at, color=style.PAPER, linewidth=0.8, linestyle=":")
        axes.annotate(words, (at, 1.0), xycoords=("data", "axes fraction"), xytext=(3, -2), fontsize=7, va="top",
                      textcoords="offset points")
    axes.set(xscale="log", yticks=range(len(rows)), yticklabels=names, ylim=(len(rows) - 0.5, -1.2),
             xlabel="distance from the cloth that was never twisted [mm]")


def title_of(rows):
    """Returns the title: how far the cloth without friction ends from its place."""
    row = next(row for row in rows if row["run"] == f"released{FRICTIONLESS}")
    far = 1e3 * cell_of(row, "nine vertices in ten within")
    return f"Let go and braked, nine in ten vertices of the twisted knit end within {far:.2g} mm of the untwisted one"


def draw(rows, out):
    style.use()
    shown = [row for row in rows if row["beside"]]
    rested = {row["run"]: row for row in rows}
    names = ["without friction" if FRICTIONLESS in row["run"] else "with friction" for row in shown]
    stills = "; ".join(f"{name}: {'both' if row['at rest'] == rested[row['beside']]['at rest'] == 'yes' else 'not'} "
                       "at rest" for name, row in zip(names, shown))
    below = f"dot: median of the vertices; bar: up to nine in ten; line: up to the largest; {stills}"
    title = title_of(rows)
    figure, ((axes,),) = style.page([(0.9 + 0.45 * len(shown), [(1.0, "plot")])], title, below)
    draw_distances(axes, shown, names)
    left = axes.get_position()
    axes.set_position([0.13, left.y0, 0.83, left.height])
    style.save(figure, out, title, ALT, ", ".join(sorted({row["commit"] for row in rows})))


def arguments():
    parser = parser_of_figure(__doc__.splitlines()[0], ("smoke", "small", "paper"))
    parser.add_argument("--made", action="store_true", help="draw the runs that there are, and make none")
    return parser.parse_args()


def make(options):
    runs = runs_of(options)
    rows = [row_of(name, runs) for name in runs]
    write_table(options.folder / f"{NAME}.csv", rows)
    draw(rows, options.folder / PICTURE)


if __name__ == "__main__":
    try:
        make(arguments())
    except RunError as error:
        sys.exit(f"{NAME}: {error}")
