"""Whether a knit that is twisted returns, with all varied that the paper leaves open: how far and how fast it is
turned, how stiff the yarn is, how well the twist is solved, whether threads have friction while it is turned, whether
it swings before it is braked. `python3 -m paper_figures.figures.measured.yarn_return FOLDER --scale paper --backend
cuda`.

Finally all cloths are braked without friction until they are at rest (yarn_rest.py gives the reason). Each is then
compared with a cloth of the same yarn that was never twisted. Twisted cloths of stiffer yarn are braked longer: when
the others are at rest, half of their vertices still move faster than a millimetre a second.
"""

import sys
from pathlib import Path

import numpy as np

from paper_figures.figures.measured.yarn import distances
from paper_figures.figures.measured.yarn_rest import at_rest, draw_distances, kept_threads, last_frame, way
from paper_figures.workflow import commands
from paper_figures.workflow.jobs import Limit, RunFailure, parser_of_figure
from paper_figures.workflow.runs import provenance, write_table
from paper_figures.workflow.yarn_cases import cases
from plots import style
from ogc_testbed.runs import Run, RunError

NAME = "yarn_return"
STIFFNESS, PACE = "stiffness of the scene's yarn [1]", "pace of the scene's [1]"
ROW = 0.01  # m between two rows of the knit
ALT = ("A plot with a line for each variant of twist, yarn and start: how far the vertices of the hanging knit end "
       "from the knit that was never twisted, their median, nine in ten, and the largest.")


def runs_of(options, chosen):
    """Returns name -> finished Run of each case, and makes missing runs; with --made returns only existing ones."""
    folder = Path(options.folder)
    for case in () if options.made else chosen:
        try:
            for job in case.jobs(options.scale, options.backend):
                job.make(options.ogc, folder, Limit(), True)
        except RunFailure as error:
            raise RunError(str(error)) from error
    found = {case: Run(folder / case.name) for case in chosen if (folder / case.name / "run.json").is_file()}
    for run in found.values():
        run.require_finished()
    return found


def row_of(case, run, beside):
    """Returns a row. `beside`: the run of the cloth that was never twisted. Distances to it are given only if both
    cloths are at rest."""
    farthest, seconds = way(run)
    apart = distances(run, last_frame(beside).positions)
    kept = kept_threads(run, beside)
    return {"case": case.name, "turns [1]": f"{case.turns:g}", "pace of the scene's [1]": f"{case.pace:g}",
            "stiffness of the scene's yarn [1]": f"{case.stiffness:g}",
            "twisted with": " ".join(case.twist_settings[1::2]) if case.turns else "",
            "friction until it is braked": "yes" if case.friction else "no",
            "swings until it is braked": "yes" if case.swings else "no", "seed": case.seed,
            "springs of the first row [1]": run.manifest["scene"]["springs"],
            "at rest": "yes" if at_rest(run) and at_rest(beside) else "no",
            "way in the last second, median [m]": f"{farthest:.4g}", "of these [s]": f"{seconds:.4g}",
            "distance, median [m]": f"{np.median(apart):.4g}",
            "distance, nine vertices in ten within [m]": f"{np.percentile(apart, 90):.4g}",
            "distance, largest [m]": f"{apart.max():.4g}",
            "touching threads within half a row still [1]": "" if kept is None else f"{kept:.4g}",
            "mean stretch [1]": f"{run.column('mean_stretch')[-1]:.4g}",
            "status": run.manifest["status"].splitlines()[0], "ended": run.manifest["ended"], **provenance(run)}


def in_words(row):
    """Returns a case in words: how far it was turned, and what differs from the scene."""
    words = [f"{row['turns [1]']} turn{'' if row['turns [1]'] == '1' else 's'}"]
    words += ["small steps"] if row["twisted with"] == " ".join(commands.FINE[1::2]) else []
    words += [f"yarn {row[STIFFNESS]} times as stiff"] if row[STIFFNESS] != "1" else []
    words += [f"{row[PACE]} of the pace"] if row[PACE] != "1" else []
    words += ["no friction"] if row["friction until it is braked"] == "no" else []
    words += ["swings first"] if row["swings until it is braked"] == "yes" else []
    words += [f"jittered start {row['seed']}"] if str(row["seed"]) != "0" else []
    return ", ".join(words)


def draw(rows, out):
    """Draws how far the vertices of each twisted cloth end from their places in the untwisted one."""
    style.use()
    shown = sorted((row for row in rows if row["turns [1]"] != "0"),
                   key=lambda row: float(row["distance, nine vertices in ten within [m]"]))
    within = [row for row in shown if float(row["distance, nine vertices in ten within [m]"]) <= ROW]
    title = (f"In {len(within)} of {len(shown)} variants nine vertices in ten of the twisted knit return within a row, "
             "10 mm")
    below = ("dot: median of the vertices; bar: up to nine in ten; line: up to the largest; all are braked without "
             f"friction; {shown[0]['device']}")
    figure, ((axes,),) = style.page([(0.9 + 0.25 * len(shown), [(1.0, "plot")])], title, below)
    draw_distances(axes, shown, [in_words(row) for row in shown])
    place = axes.get_position()
    axes.set_position([0.3, place.y0, 0.62, place.height])
    style.save(figure, out, title, ALT, ", ".join(sorted({row["commit"] for row in rows})))


def arguments():
    parser = parser_of_figure(__doc__.splitlines()[0], ("smoke", "small", "paper"))
    parser.add_argument("--only", action="append", default=[], help="a case by name; repeated: several")
    parser.add_argument("--made", action="store_true", help="tabulate and draw the cases that there are, make none")
    parser.add_argument("--list", action="store_true", help="the cases' names, and nothing else")
    return parser.parse_args()


def make(options):
    there = list(cases(options.scale))
    if options.list:
        print("\n".join(case.name for case in there))
        return
    unknown = set(options.only) - {case.name for case in there}
    if unknown:
        raise RunError(f"there is no case {', '.join(sorted(unknown))}; --list has their names")
    runs = runs_of(options, [case for case in there if not options.only or case.name in options.only])
    if options.only:
        return
    named = {case.name: run for case, run in runs.items()}
    rows = [row_of(case, run, named[case.beside]) for case, run in runs.items() if case.beside in named]
    write_table(options.folder / f"{NAME}_{options.scale}.csv", rows)
    draw(rows, options.folder / f"{NAME}_{options.scale}.png")


if __name__ == "__main__":
    try:
        make(arguments())
    except RunError as error:
        sys.exit(f"{NAME}: {error}")
