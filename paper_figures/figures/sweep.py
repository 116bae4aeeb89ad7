"""Makes one table and one picture of a sweep from the rows that `ogc ablate` wrote for each of its points. Usage:
python3 -m paper_figures.figures.sweep FOLDER OUT.png; the table lies beside the picture."""

import csv
import sys
from pathlib import Path

from paper_figures.workflow.evidence import EvidenceError
from paper_figures.workflow.runs import write_table
from plots import style

# Drawn over the first key, with a colour for each value of the second and a dash for each value of the third.
KEYS = ("iterations", "bounds_relaxation", "detection_fraction")
PANELS = (("detections_a_step [1]", "detections a step"), ("median_step [ms]", "median time a step [ms]"),
          ("smallest_distance [m]", "smallest distance [m]"))


def gather(folder):
    """Returns the rows of all points. The folder's path is left out, because its name tells the point. Throws
    EvidenceError if there is none."""
    rows = []
    for path in sorted(Path(folder).glob("*/ablation.csv")):
        with path.open(newline="") as file:
            rows += [{key: value for key, value in row.items() if key != "folder"} for row in csv.DictReader(file)]
    if not rows:
        raise EvidenceError(f"{folder} holds no point of a sweep (POINT/ablation.csv)")
    return rows


def curves(rows):
    """Returns {(second key, third key): its rows, ascending in the first}."""
    found = {}
    for row in sorted(rows, key=lambda row: float(row[KEYS[0]])):
        found.setdefault((row[KEYS[1]], row[KEYS[2]]), []).append(row)
    return dict(sorted(found.items()))


def draw(rows, out):
    """Draws the rows. Throws EvidenceError if one lacks a drawn column."""
    missing = [name for name in (*KEYS, *(name for name, _ in PANELS)) if name not in rows[0]]
    if missing:
        raise EvidenceError(f"the sweep has no column {', '.join(missing)}; it has: {', '.join(rows[0])}")
    plt = style.use()
    figure, grid = plt.subplots(1, len(PANELS), figsize=(11, 4.2))
    lines = curves(rows)
    first, second = (sorted({key[i] for key in lines}, key=float) for i in (0, 1))
    for (name, label), axes in zip(PANELS, grid):
        for (a, b), points in lines.items():
            axes.plot([float(row[KEYS[0]]) for row in points], [float(row[name]) for row in points],
                      color=style.COLOURS[first.index(a)], linestyle=style.DASHES[second.index(b)],
                      marker=".", label=f"γ_p = {a}, γ_e = {b}")
        axes.set(xlabel="iterations a step", ylabel=label, ylim=(0, None))
    grid[-1].legend(fontsize=7, ncols=2, loc="lower center")
    lost = sum(row["guarantee_kept"] != "yes" for row in rows)
    figure.suptitle(f"{len(rows)} runs, {lost} of which lost the guarantee at their end", fontsize=9)
    style.save(figure, out)


if __name__ == "__main__":
    try:
        table = gather(sys.argv[1])
        write_table(Path(sys.argv[2]).with_suffix(".csv"), table)
        draw(table, sys.argv[2])
    except EvidenceError as error:
        sys.exit(f"sweep: {error}")
