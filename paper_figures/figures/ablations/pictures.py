"""One picture for each study of the method's parts, from the accepted medians and ranges: a row of panels for each
scene at the largest size at which it was run, a panel for each metric of which the study's text speaks.

Usage: python3 -m paper_figures.figures.ablations.pictures OUT_FOLDER [STUDY …]
"""

import csv
import sys
from pathlib import Path

from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from paper_figures.workflow.ablation_tables import COLUMNS, FILES, SHOWN, largest_runs
from paper_figures.workflow.evidence import RESULTS, opened
from plots import style

MOST = 3  # panels in a row
WIDE = 20  # quotient of the largest and the smallest number from which an axis is logarithmic
TITLES = {
    "ablation_overhead": "With our rounds of guess bounds add two fifths to a step where layers land, else a tenth",
    "ablation_query_radius": "A query radius of r alone needs more detections; beyond our cap nothing changes",
    "ablation_policy": "Without bounds cloth goes through cloth; planes never lag, balls do",
    "ablation_redetection": "γ_e trades detections for convergence; one round of the guess loses momentum",
    "ablation_truncation": "Truncation at an update or after an iteration, single precision or double: all alike",
    "ablation_colours": "Which colours hardly matters; no colours at all (Jacobi) does",
    "ablation_iterations": "Where cloth falls, as many sweeps do more in smaller steps than in more iterations",
    "ablation_activation": "At equal stiffness IPC's logarithm keeps layers farther apart than OGC's activation",
    "ablation_small_radius": "A contact radius as small as IPC's needs many more detections",
    "ablation_membrane": "St. Venant–Kirchhoff cloth collapses in a twist; stable Neo-Hookean cloth hardly does",
    "ablation_frames": "Iterations decide how far yarn stretches, and its frames must turn with its segments",
}
METRICS = {"ablation_policy": ("guarantee_kept", "largest_lag", "detections_a_step"),
           "ablation_redetection": ("detections_a_step", "largest_momentum_lost_guess", "last_kinetic_energy")}
WORDS = {
    "default": "ours", "bounds": "bounds", "off": "none", "dat": "planes, nothing slides", "planes": "planes",
    "contact_radius": "r", "detection_radius_cap": "query radius up to", "detection_fraction": "γ_e",
    "bounds_relaxation": "γ_p", "guess_rounds": "rounds of guess", "guess": "guess by", "contact_activation": "",
    "ipc_log": "IPC's logarithm", "ogc_as_printed": "Eq. 19 as printed", "membrane": "",
    "stable_neo_hookean": "stable Neo-Hookean", "reference_vbd_colours": "colours", "vertex": "one a vertex",
    "together": "none (Jacobi)", "reference_vbd_contact_blocks": "blocks of contacts",
    "reference_vbd_cut_after": "cut after",
    "solver": "", "vbd": "single precision", "rod_orientation": "frames", "as_published": "as published",
    "rod_start": "frames at start", "kept": "kept", "time_step": "h", "steps": None,
}


def in_words(point):
    """Returns a point such as bounds=off,contact_radius=1.1e-5 in words."""
    parts = []
    for part in point.split(","):
        key, _, value = part.partition("=")
        name = WORDS.get(key, key.replace("_", " "))
        if name is None:
            continue
        value = WORDS.get(value, value)
        if key == "time_step":
            value = f"1/{1 / float(value):.0f} s"
        parts.append(f"{name} {value}".strip() if value else name)
    return ", ".join(parts)


def shown(study, points):
    """Returns the metrics that are drawn: those of the study's text that differ between points."""
    wanted = METRICS.get(study, SHOWN[study])
    there = [metric for metric in wanted if any(metric in metrics for metrics in points.values())]
    return there[:MOST]


def draw_panel(axes, metric, points, has_names):
    """Draws the median and the range of each point, from top to bottom, and shades the first one's range."""
    factor, numbers = COLUMNS[metric][1], []
    for place, metrics in enumerate(points.values()):
        row = metrics.get(metric)
        if row is None:
            axes.text(0.02, place, "not measured", va="center", fontsize=7, color="0.5",
                      transform=axes.get_yaxis_transform())
            continue
        low, middle, high = (float(row[key]) * factor for key in ("smallest", "median", "largest"))
        if metric == "guarantee_kept":
            low = high = middle
        numbers += [low, high]
        colour = style.OURS if place == 0 else style.COLOURS[3]
        axes.plot([low, high], [place, place], color=colour, linewidth=3, alpha=0.5, solid_capstyle="round")
        axes.plot([middle], [place], "o", color=colour, markersize=5)
        if place == 0:
            axes.axvspan(low, high, color="0.9", zorder=0)
    positive = [number for number in numbers if number > 0]
    if len(positive) == len(numbers) and max(positive) > WIDE * min(positive):
        axes.set_xscale("log")
        axes.xaxis.set_major_locator(LogLocator(numticks=5))
        axes.xaxis.set_minor_formatter(NullFormatter())
        if max(positive) < 30 * WIDE * min(positive):
            axes.xaxis.set_major_locator(LogLocator(subs=(1, 3), numticks=6))
            axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    elif numbers:
        axes.set_xlim(min(0, min(numbers)), 1.08 * max(numbers) if max(numbers) > 0 else 1)
    axes.set(yticks=range(len(points)), ylim=(len(points) - 0.5, -0.5))
    axes.set_yticklabels([in_words(point) for point in points] if has_names else [], fontsize=7.5)
    axes.tick_params(axis="x", labelsize=7.5)


def draw(study, out):
    """Draws a study's picture. Returns its path."""
    plt = style.use()
    runs = largest_runs(study)
    rows = [(scene, size, points, shown(study, points)) for (scene, size), points in runs.items()]
    heights = [0.75 + 0.24 * len(points) for _, _, points, _ in rows]
    names = max(len(in_words(point)) for _, _, points, _ in rows for point in points)
    left, wide, high = 0.3 + 0.068 * names, 11.5, sum(heights) + 0.95
    with plt.rc_context({"figure.constrained_layout.use": False}):
        figure = plt.figure(figsize=(wide, high))
    top = high - 0.85
    for (scene, size, points, metrics), height in zip(rows, heights):
        each = (wide - left - 0.15) / MOST
        for column, metric in enumerate(metrics):
            axes = figure.add_axes(((left + column * each) / wide, (top - height + 0.3) / high, (each - 0.25) / wide,
                                    (height - 0.75) / high))
            draw_panel(axes, metric, points, column == 0)
            where = f"{scene.replace('_', ' ')}, {size}\n" if column == 0 else ""
            axes.set_title(where + COLUMNS[metric][0])
        top -= height
    title = TITLES[study]
    figure.text(0.1 / wide, 1 - 0.08 / high, title, va="top", fontsize=12, fontweight="bold")
    figure.text(0.1 / wide, 1 - 0.36 / high, "dot: median of jittered starts; bar: their range; blue and shaded: "
                "the first point, with which the others are compared; size: the largest at which the scene was run",
                va="top", fontsize=8.5, color="0.25")
    scenes = ", ".join(f"{scene}, {size}" for scene, size, *_ in rows)
    alt = (f"Panels of dots with ranges, a row for each scene ({scenes}), "
           f"for {', '.join(dict.fromkeys(COLUMNS[m][0] for *_, metrics in rows for m in metrics))}. {title}.")
    style.save(figure, out, title, alt, f"{', '.join(FILES.values())}; {commits(study)}")
    return out


def commits(study):
    """Returns the commits of the study's rows."""
    found = set()
    for name in FILES.values():
        with opened(RESULTS / name) as file:
            found |= {row["commit"] for row in csv.DictReader(file) if row["study"] == study}
    return ", ".join(sorted(filter(None, found)))


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    folder = Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    for name in sys.argv[2:] or TITLES:
        print(draw(name, folder / f"{name}.png"))
