"""How long things took: figures, as results/*/durations.csv has it, and runs, by their manifests. The standard library
is enough."""

import csv
from datetime import datetime
from pathlib import Path

OF_ALL_RUNS = "time_of_all_runs"  # metric of ablations: of a scene's runs together, from starts to ends
RESULTS = Path(__file__).parent.parent / "results"


def measured_times():
    """Returns (figure, scale, backend) -> (seconds, machine) of results/*/durations.csv."""
    result = {}
    for path in sorted(RESULTS.glob("*/durations.csv")):
        with path.open(newline="") as file:
            for row in csv.DictReader(file):
                result[row["figure"], row["scale"], row["backend"]] = (float(row["seconds"]), row["machine"])
    return result


def seconds_between(manifest):
    """Returns how long a run took [s], or None if its manifest does not say."""
    if not (manifest.get("started") and manifest.get("ended")):
        return None
    begun, ended = (datetime.fromisoformat(manifest[key]) for key in ("started", "ended"))
    return (ended - begun).total_seconds()


def in_words(seconds):
    if seconds < 120:
        return f"{seconds:.0f} s"
    return f"{seconds / 60:.0f} min" if seconds < 7200 else f"{seconds / 3600:.1f} h"
