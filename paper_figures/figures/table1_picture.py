"""Table 1 as the paper prints it, with ours beside it: mean and longest time a step on the CPU and on the GPU, with
both bounds, from the accepted whole runs (whole_runs.csv) and windows on 16 CPU threads (cpu_windows_paper.csv). A cell
says "not run" where no run is behind it.

Usage: python3 -m paper_figures.figures.table1_picture OUT.png
"""

import csv
import json
import sys
from dataclasses import dataclass
from pathlib import Path

from paper_figures.workflow.evidence import CLAIMS, RESULTS, same_sources

MACHINE = RESULTS / "h200"
TITLE = "Table 1. Time a step, the paper's beside ours, mean / longest"
ALT = ("A table with a row for each experiment of the paper's Table 1: vertices, primitives, contact stiffness, "
       "friction, radius, time step, iterations, and the mean and longest time a step. For the CPU and for the GPU the "
       "paper's times stand beside ours with balls and with planes; blue cells are at most the paper's time, sand ones "
       "are slower, the darker the more. {summary}")
# The paper's first eight columns, and ours behind them: name of the row there, our rows with balls and with planes.
ROWS = (
    ("50 layers of cloth", "1M", "1.96M", "1e5", "0.2, 1e-2", "2", "1/1200", "40", "fifty_layers_1m"),
    ("50 layers, Fig. 10", "246K", "475K", "1e5", "0.2, 1e-2", "3", "1/1200", "40", "fifty_layers"),
    ("Tightening a knot", "48K", "92K", "1e5", "0.4, 1e-2", "2", "1/300", "50", "knot"),
    ("Twisting cloth", "10K", "19.6K", "1e5", "0.2, 1e-2", "2", "1/300", "10", "twist"),
    ("Cloth on body", "15.6K", "29K", "1e5", "0.5, 1e-2", "2", "1/200", "20", "dress_volumes"),
    ("Robot and T-shirt", "13.8K", "27.4K", "1e5", "0.5, 1e-2", "2", "1/600", "10", "robot_shirt_volumes"),
    ("Yarn stretch", "65K", "65K", "2e-3", "0.1, 1e-3", "1.5", "4e-4", "4", "yarn_stretch"),
    ("Yarn twist", "65K", "65K", "2e-3", "0.1, 1e-3", "1.5", "4e-4", "4", "yarn_twist"),
    ("1 layer on sphere", "4.9K", "9.5K", "1e4", "0.5, 1e-2", "5", "1/100", "40", "cloth_on_sphere"),
    ("Twisting mat", "15K", "46.8K", "1e5", "0.2, 1e-2", "2", "1/240", "20", "mat_twist"),
)
COLUMNS = ("experiment", "vert.", "prim.", "k_c", "μ_c, ε_v", "r [mm]", "h [s]", "it.", "paper", "balls", "planes",
           "paper", "balls", "planes")
WIDTHS = (1.55, 0.5, 0.55, 0.45, 0.75, 0.5, 0.6, 0.35, 0.95, 1.05, 1.05, 0.95, 1.05, 1.05)
GROUPS = ((8, 3, "CPU, 16 cores [ms]"), (11, 3, "GPU [ms]"))
HIGH = 0.31  # of a row [inches]
FASTER, SLOWER = "#C9DDF0", ("#FBF1DA", "#F3DCA4", "#E7BF63")  # cells; slower up to 2 times, up to 4, and more
STEPS = (2, 4)


@dataclass(frozen=True)
class Time:
    """Holds mean and longest time a step [ms]; `windows`: not of a whole run. None: not run, or not printed."""

    mean: float = None
    longest: float = None
    windows: bool = False

    @property
    def words(self):
        if self.mean is None:
            return "not run"
        number = lambda ms: f"{ms:,.0f}" if ms >= 100 else f"{ms:.3g}"  # noqa: E731
        longest = f" / {number(self.longest)}" if self.longest else ""
        return number(self.mean) + longest + ("*" if self.windows else "")


def rows_of(path):
    with path.open(newline="") as file:
        return list(csv.DictReader(file))


def on_gpu(row, machine=MACHINE):
    """Returns our time on the GPU; of several membranes the scenes' own. The longest step is that of the whole run, or,
    where it was repeated on a quiet device (steady.py), the longest of the steps' medians."""
    found = [r for r in rows_of(machine / "whole_runs.csv") if r["scene"] == row]
    found.sort(key=lambda r: r["membrane"] != "stable_neo_hookean")
    if not found:
        return Time()
    repeated = [r["largest median [ms]"] for r in rows_of(machine / "steady_paper.csv")
                if (r["variant"], r["membrane"]) == (row, found[0]["membrane"])]
    return Time(float(found[0]["mean [ms]"]), float((repeated or [found[0]["worst [ms]"]])[0]))


def on_cpu(row, machine=MACHINE):
    """Returns our time on 16 CPU threads, of the whole run if there is one, and it is not of other sources than the
    windows; else the mean of windows with equal weights, and the longest step among them."""
    found = [r for r in rows_of(machine / "cpu_windows_paper.csv") if r["row"] == row]
    for whole in (r for r in rows_of(machine / "whole_runs.csv") if r["scene"] == f"{row}_cpu"):
        if not found or same_sources(whole["commit"], found[0]["commit"]):
            return Time(float(whole["mean [ms]"]), float(whole["worst [ms]"]))
    if not found:
        return Time()
    means = [float(r["mean step [ms]"]) for r in found]
    return Time(sum(means) / len(means), max(float(r["worst step [ms]"]) for r in found), True)


def printed(row, backend):
    """Returns the paper's time, from the claims; None where it prints NA."""
    scene = row.replace("_volumes", "")
    claims = {c["id"]: c["value"] for c in json.loads((CLAIMS / f"{scene}.json").read_text())["claims"]}
    mean = claims.get(f"{scene}.{backend}_average")
    return Time(mean, claims.get(f"{scene}.{backend}_maximum")) if mean else None


def shade(ours, paper):
    """Returns a cell's colour by our mean over the paper's; white if one of them is missing."""
    if paper is None or ours.mean is None:
        return "white"
    ratio = ours.mean / paper.mean
    return FASTER if ratio <= 1 else SLOWER[sum(ratio > step for step in STEPS)]


def table():
    """Returns for each row the texts of its cells, and the colours of the last six."""
    for *first, row in ROWS:
        texts, colours = list(first), []
        for backend, ours in (("cpu", on_cpu), ("cuda", on_gpu)):
            paper = printed(row, backend)
            times = [ours(row), ours(f"{row}_planes")]
            texts += [paper.words if paper else "NA", *(time.words for time in times)]
            colours += ["#F1F2F4", *(shade(time, paper) for time in times)]
        yield texts, colours


def draw(out):
    from plots import style  # imported here, because it needs matplotlib

    plt, rows = style.use(), list(table())
    counts = [sum(colours[i] == FASTER for _, colours in rows for i in (4, 5)),
              sum(colours[i] != "white" for _, colours in rows for i in (4, 5))]
    summary = f"On the GPU {counts[0]} of our {counts[1]} cells are at most the paper's time."
    wide, places = sum(WIDTHS), [sum(WIDTHS[:i]) for i in range(len(WIDTHS))]
    notes = ("paper: RTX 4090 and Ryzen 7950X; ours: H200, and 16 threads of its host. Blue: at most the paper's mean; "
             "sand: slower, up to 2, up to 4 times, and more.\nLongest: of the steps' medians where quiet runs were "
             "repeated, else of one run. * mean and longest of windows from states of a whole run. Of “50 layers”\n"
             "the paper prints one pair of times for both sizes; at 1M vertices balls have the membrane of an earlier "
             "default. “Cloth on body”: ours is a stand-in for the dress.")
    with plt.rc_context({"figure.constrained_layout.use": False}):
        figure = plt.figure(figsize=(wide + 0.3, HIGH * (len(rows) + 2) + 1.2))
    axes = figure.add_axes((0.15 / (wide + 0.3), 0.6 / figure.get_figheight(), wide / (wide + 0.3),
                            HIGH * (len(rows) + 2) / figure.get_figheight()))
    axes.set(xlim=(0, wide), ylim=(len(rows) + 2, 0))
    axes.axis("off")
    for first, count, words in GROUPS:
        axes.text(places[first] + sum(WIDTHS[first:first + count]) / 2, 0.5, words, ha="center", va="center",
                  fontweight="bold")
        axes.plot([places[first] + 0.06, places[first] + sum(WIDTHS[first:first + count]) - 0.06], [0.95, 0.95],
                  color="0.3", linewidth=0.8)
    for number, (texts, colours) in enumerate([(COLUMNS, ["white"] * 6), *rows]):
        top = number + 1
        for column, text in enumerate(texts):
            if column >= 8:
                axes.add_patch(plt.Rectangle((places[column] + 0.02, top + 0.05), WIDTHS[column] - 0.04, 0.9,
                                             color=colours[column - 8], linewidth=0))
            left = column == 0
            axes.text(places[column] + (0.05 if left else WIDTHS[column] / 2), top + 0.5, text,
                      ha="left" if left else "center", va="center", fontsize=8.5 if number else 8,
                      color="0.5" if text in ("not run", "NA") else "black", fontweight=None if number else "bold")
        axes.plot([0, wide], [top + 1, top + 1], color="0.3" if number == 0 else "0.88", linewidth=0.8)
    figure.text(0.15 / (wide + 0.3), 1 - 0.08 / figure.get_figheight(), TITLE, va="top", fontsize=12, fontweight="bold")
    figure.text(0.15 / (wide + 0.3), 0.12 / figure.get_figheight(), notes, va="bottom", fontsize=7.5, color="0.3")
    commits = ", ".join(sorted({row["commit"] for row in rows_of(MACHINE / "whole_runs.csv")}))
    style.save(figure, out, TITLE, ALT.format(summary=summary),
               f"whole_runs.csv, cpu_windows_paper.csv; {commits}")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    draw(Path(sys.argv[1]))
    print(sys.argv[1])
