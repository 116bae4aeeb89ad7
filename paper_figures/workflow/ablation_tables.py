"""The table of an ablation, from the accepted medians and ranges: a row a scene and point, of the largest size at which
the scene was run, and a column a metric of which the study's text speaks. A bold number lies apart from that of the
first point: every run of one is above, or below, every run of the other. `page_tables.py` writes it into ablations.md.
"""

import csv
import re

from paper_figures.workflow.evidence import RESULTS, opened

FILES = {"smoke": "two_cores/ablations_smoke.csv.gz", "paper": "h200/ablations_paper.csv.gz"}  # the largest size last
# Titles and factors by metric. A column without a number in a study is left out.
COLUMNS = {"guarantee_kept": ("kept [runs]", 1), "detections_a_step": ("detections a step", 1),
           "contacts_a_step": ("contacts a step", 1), "median_step": ("step [ms]", 1),
           "smallest_distance": ("smallest distance [mm]", 1e3), "largest_share_cut": ("vertices cut [%]", 100),
           "largest_momentum_lost_guess": ("momentum lost, guess [%]", 100), "largest_lag": ("lag [mm]", 1e3),
           "last_elastic_energy": ("elastic energy [J]", 1), "last_kinetic_energy": ("kinetic energy [J]", 1),
           "last_mean_stretch": ("mean stretch", 1)}
SHOWN = {
    "ablation_overhead": ("detections_a_step", "contacts_a_step", "median_step", "last_kinetic_energy"),
    "ablation_query_radius": ("detections_a_step",),
    "ablation_policy": ("guarantee_kept", "detections_a_step", "largest_lag", "last_elastic_energy"),
    "ablation_redetection": ("detections_a_step", "largest_share_cut", "largest_momentum_lost_guess",
                             "last_kinetic_energy"),
    "ablation_truncation": ("detections_a_step", "last_elastic_energy"),
    "ablation_colours": ("detections_a_step", "last_elastic_energy", "last_kinetic_energy"),
    "ablation_iterations": ("detections_a_step", "last_elastic_energy", "last_kinetic_energy"),
    "ablation_activation": ("detections_a_step", "smallest_distance", "largest_lag"),
    "ablation_small_radius": ("detections_a_step", "largest_share_cut", "last_kinetic_energy"),
    "ablation_membrane": ("detections_a_step", "largest_lag", "last_elastic_energy"),
    "ablation_frames": ("last_kinetic_energy", "last_mean_stretch"),
}
ALL_KEPT = "Every run kept the guarantee."  # below a table that has no column for it
POINTS_OF_RODS = re.compile(r"(?!.*iterations=)|.*iterations=(1|16|64)$")


def largest_runs(study, folder=RESULTS):
    """Returns (scene, size) -> {point: {metric: row}} of a study."""
    found = {}
    for size, name in FILES.items():
        with opened(folder / name) as file:
            for row in csv.DictReader(file):
                left_out = study == "ablation_frames" and not POINTS_OF_RODS.match(row["point"])
                if row["study"] == study and row["median"] not in ("", "nan") and not left_out:
                    points = found.setdefault(row["scene"], {}).setdefault(size, {})
                    points.setdefault(row["point"], {})[row["metric"]] = row
    return {(scene, list(sizes)[-1]): sizes[list(sizes)[-1]] for scene, sizes in sorted(found.items())}


def rounded(value):
    """Returns a number with three digits, with commas between 1,000 and 100,000."""
    short = f"{value:.3g}"
    return f"{float(short):,.0f}" if 1e3 <= abs(value) < 1e5 else short


def cell(metric, row, first):
    """Returns the median of a metric's row; in bold if the runs lie apart from those of the row `first`."""
    if row is None:
        return ""
    low, high = float(row["smallest"]), float(row["largest"])
    if metric == "guarantee_kept":  # its number is how many runs kept it
        text, apart = f"{float(row['median']):g} of {row['runs']}", row["median"] != first["median"]
    else:
        text = rounded(float(row["median"]) * COLUMNS[metric][1])
        apart = first is not None and (low > float(first["largest"]) or high < float(first["smallest"]))
    return f"**{text}**" if apart else text


def table(study, folder=RESULTS):
    """Returns the lines of a study's table in Markdown, and a sentence if every run kept the guarantee."""
    runs = largest_runs(study, folder)
    there = {metric for points in runs.values() for metrics in points.values() for metric in metrics}
    columns = [metric for metric in SHOWN[study] if metric in there]
    lines = [f"| scene, size | point | {' | '.join(COLUMNS[metric][0] for metric in columns)} |",
             "|---" * (2 + len(columns)) + "|"]
    for (scene, size), points in runs.items():
        first = next(iter(points.values()))
        lines += [f"| `{scene}`, {size} | {point} | "
                  + " | ".join(cell(metric, metrics.get(metric), first.get(metric)) for metric in columns) + " |"
                  for point, metrics in points.items()]
    kept = [metrics.get("guarantee_kept") for points in runs.values() for metrics in points.values()]
    return lines + (["", ALL_KEPT] if all(row and float(row["median"]) == float(row["runs"]) for row in kept) else [])
