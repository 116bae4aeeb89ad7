"""Draws the results of `ogc ablate`: a panel for each metric, and in it a row for each setting with the median and the
range of its runs. Usage: python3 -m plots.ablation FOLDER [OUT.png]. The folder contains ablation_medians.csv; by
default the picture is written there."""

import csv
import math
import sys
from pathlib import Path

from plots import style

TABLE = "ablation_medians.csv"
AFTER_AXES = "unit"  # columns before this one: the metric, and the varied settings
COLUMNS = 3


class AblationError(Exception):
    """Raised for a folder that can't be drawn; the message names what is missing."""


def read(folder):
    """Returns {metric: (unit, {setting: (median, smallest, largest)})} in the order of the table. Throws
    AblationError."""
    path = Path(folder) / TABLE
    if not path.is_file():
        raise AblationError(f"{path} is missing: make it with ogc ablate SCENE --vary key=a,b --repeat 10 "
                            f"--jitter 1e-6 --out {folder}")
    metrics = {}
    with path.open(newline="") as file:
        reader = csv.DictReader(file)
        varied = reader.fieldnames[1:reader.fieldnames.index(AFTER_AXES)]
        for row in reader:
            setting = ", ".join(f"{key}={row[key]}" for key in varied if row[key]) or "default"
            numbers = tuple(float(row[name]) for name in ("median", "smallest", "largest"))
            metrics.setdefault(row["metric"], (row["unit"], {}))[1][setting] = numbers
    if not metrics:
        raise AblationError(f"{path} has no row: no run of the grid finished")
    return metrics


def differing(metrics):
    """Returns the metrics whose values differ between runs."""
    return {name: (unit, settings) for name, (unit, settings) in metrics.items()
            if len({number for numbers in settings.values() for number in numbers}) > 1}


def draw_metric(axes, name, unit, settings, has_names):
    """Draws the settings from top to bottom and shades the first one's range: a range that overlaps it shows no
    difference."""
    for place, (median, smallest, largest) in enumerate(settings.values()):
        colour = style.COLOURS[place % len(style.COLOURS)]
        axes.plot([smallest, largest], [place, place], color=colour, linewidth=2)
        axes.plot([median], [place], color=colour, marker="o")
    _, smallest, largest = next(iter(settings.values()))
    axes.axvspan(smallest, largest, color="0.85", zorder=0)
    axes.set(title=f"{name.replace('_', ' ')} [{unit}]", yticks=range(len(settings)), ylim=(len(settings) - 0.5, -0.5))
    axes.set_yticklabels(settings if has_names else [], fontsize=7)
    axes.locator_params(axis="x", nbins=4)


def draw(metrics, out, title=""):
    """Draws one picture, PNG and PDF. Throws AblationError if no metric differs."""
    shown = differing(metrics)
    if not shown:
        raise AblationError("no metric differs between any two runs: there is nothing to draw")
    plt = style.use()
    most = max(len(settings) for _, settings in shown.values())
    rows = math.ceil(len(shown) / COLUMNS)
    figure, grid = plt.subplots(rows, COLUMNS, figsize=(12, rows * (0.9 + 0.22 * most)), squeeze=False)
    for place, (axes, (name, (unit, settings))) in enumerate(zip(grid.flat, shown.items())):
        draw_metric(axes, name, unit, settings, has_names=place % COLUMNS == 0)
    for axes in grid.flat[len(shown):]:
        axes.set_axis_off()
    figure.suptitle(title or "point: median of the runs; line: their range; shaded: that of the first setting",
                    fontsize=9)
    style.save(figure, out)


if __name__ == "__main__":
    try:
        picture = sys.argv[2] if len(sys.argv) > 2 else Path(sys.argv[1]) / "ablation.png"
        draw(read(sys.argv[1]), picture)
        print(picture)
    except (AblationError, OSError) as error:
        sys.exit(f"ablation: {error}")
