"""How far Vertex Block Descent in single precision ends from where Newton's method in double ends: the same step of the
same state by both, each until nothing moves, of three scenes. Both detect contacts during the step. If only one of them
has a contact, or their lagged friction differs, this adds to the distance. Not in the paper.
"""

import csv
import sys

import numpy as np

from paper_figures.workflow import commands
from paper_figures.workflow.jobs import RunFailure, parser_of_figure
from plots import style
from ogc_testbed.runs import Run

TITLE = "How far a step by VBD in single precision ends from Newton's in double"
ALT = ("Dots on a logarithmic axis for three scenes: the largest and the mean distance between the vertices of both "
       "ends, and half of the spacing of single-precision numbers there.")
DISTANCES = {"largest_distance [m]": "largest distance of a vertex", "rms_distance [m]": "root mean square",
             "rounding [m]": "half of a float's spacing"}


def row_of(folder, scene):
    """Returns the table's row of two finished runs of one step."""
    by_vbd, by_newton = (Run(folder / f"{scene}_{solver}") for solver in ("vbd", "newton"))
    ends = [run.frame(run.frames[-1]).positions.astype(float) for run in (by_vbd, by_newton)]
    apart = np.linalg.norm(ends[0] - ends[1], axis=1)
    return {"scene": scene, "step [1]": int(by_vbd.column("step")[-1]), "backend": by_vbd.manifest["backend"],
            "vertices [1]": len(apart), "residual [1]": by_vbd.column("residual")[-1],
            "newton_residual [1]": by_newton.column("residual")[-1], "largest_distance [m]": apart.max(),
            "rms_distance [m]": np.sqrt(np.mean(apart**2)),
            "rounding [m]": np.spacing(np.float32(abs(ends[0]).max())) / 2,
            "device": by_vbd.manifest["device"], "commit": by_vbd.manifest["commit"][:10]}


def draw(rows, scale, out):
    style.use()
    below = f"scale {scale}; VBD on {rows[0]['backend']}, {rows[0]['device']}; Newton's method in double on the CPU"
    figure, ((axes,),) = style.page([(1.2 + 0.5 * len(rows), [(1.0, "plot")])], TITLE, below)
    colours = (style.OURS, style.COLOURS[1], style.PAPER)
    for (column, label), marker, colour in zip(DISTANCES.items(), "oD|", colours):
        axes.plot([row[column] for row in rows], range(len(rows)), marker, label=label, color=colour,
                  linestyle="none", markersize=8, markeredgewidth=2 if marker == "|" else 1)
    names = [f"{row['scene'].replace('_', ' ')}, step {row['step [1]']}\n{int(row['vertices [1]']):,} vertices"
             for row in rows]
    axes.set(xscale="log", ylim=(len(rows) - 0.5, -0.5), yticks=range(len(rows)), yticklabels=names,
             xlabel="distance between the ends of both steps [m]")
    place = axes.get_position()
    axes.set_position([0.2, place.y0, 0.55, place.height])
    axes.legend(loc="center left", bbox_to_anchor=(1.02, 0.5))
    style.save(figure, out, TITLE, ALT, ", ".join(sorted({row["commit"] for row in rows})))


def main():
    options = parser_of_figure(__doc__.splitlines()[0], commands.MINIMISER_STEPS).parse_args()
    try:
        for job in commands.minimiser(options.scale, options.backend):
            job.make(options.ogc, options.folder)
    except RunFailure as error:
        sys.exit(f"minimiser: {error}")
    rows = [row_of(options.folder, scene) for scene in commands.MINIMISER_STEPS[options.scale]]
    with (options.folder / "minimiser.csv").open("w", newline="") as file:
        table = csv.DictWriter(file, rows[0])
        table.writeheader()
        table.writerows(rows)
    print(options.folder / "minimiser.csv")
    draw(rows, options.scale, options.folder / "minimiser.png")


if __name__ == "__main__":
    main()
