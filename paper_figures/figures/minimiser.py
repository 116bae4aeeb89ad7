"""How far Vertex Block Descent in single precision ends from the minimiser that Newton's method in double finds of the
same energy, contacts and friction fixed: three scenes, each from a state of its own run by the same backend
(`ogc minimise --help` says what is measured). Not in the paper.

Runs and table need Python's own library alone; the picture needs matplotlib and is left out with --no-picture.
"""

import csv
import sys

from paper_figures.workflow import commands
from paper_figures.workflow.jobs import RunFailure, options_of_figure

DISTANCES = {"bound_by_gradient [m]": "bound by ‖∇E‖/λ", "bound_by_energy [m]": "bound by √(2 ΔE/λ)",
             "largest_distance [m]": "largest distance of a vertex", "rms_distance [m]": "root mean square",
             "rounding [m]": "half of a float's spacing"}


def rows_of(table):
    with table.open(newline="") as file:
        return list(csv.DictReader(file))


def draw(rows, scale, out):
    from plots import style  # here, so that runs and table need no matplotlib
    plt = style.use()
    figure, axes = plt.subplots(figsize=(7, 4))
    places = range(len(rows))
    for (column, label), marker in zip(DISTANCES.items(), ("_", "_", "o", "x", ".")):
        axes.plot(places, [float(row[column]) for row in rows], marker, label=label, linestyle="none", markersize=8)
    names = [f"{row['scene']}\nstep {row['step [1]']}, {row['free_vertices [1]']} free vertices" for row in rows]
    axes.set(yscale="log", xlim=(-0.5, len(rows) - 0.5), xticks=places, xticklabels=names, ylabel="distance [m]")
    axes.tick_params(axis="x", labelsize=7)
    axes.legend(fontsize=7, loc="center left", bbox_to_anchor=(1, 0.5))
    commits = ", ".join(sorted({row["commit"] for row in rows}))
    where = f"{rows[0]['backend']}, {rows[0]['device']}"
    figure.suptitle(f"VBD in single precision ({where}) at its floor against Newton's minimiser\n"
                    f"{scale}, commit {commits}", fontsize=8)
    style.save(figure, out)


def main():
    options = options_of_figure(__doc__.splitlines()[0], commands.MINIMISER_STEPS)
    try:
        for job in commands.minimiser(options.scale, options.backend):
            job.make(options.ogc, options.folder)
        print(options.folder / "minimiser.csv")
    except RunFailure as error:
        sys.exit(f"minimiser: {error}")
    if not options.no_picture:
        draw(rows_of(options.folder / "minimiser.csv"), options.scale, options.folder / "minimiser.png")


if __name__ == "__main__":
    main()
