"""The accepted whole runs of the paper's size as one table, which documents quote: ours beside the paper's, where the
time of a step goes, how a run's first quarter differs from its last, how many states were audited.

Usage: python3 -m paper_figures.workflow.whole_runs MACHINE [--write]. `--write` keeps results/MACHINE/whole_runs.csv;
the standard library is enough. The costs of a detection and of contacts are in the manifests of thinned runs (`accept`
computes them); for a run with all rows they need numpy.
"""

import argparse
import csv
import io
import statistics
import sys

from paper_figures.figures.table1 import ROWS, paper
from paper_figures.workflow import commands, contents, verdicts
from paper_figures.workflow.evidence import RESULTS, Evidence, EvidenceError

TABLE = "whole_runs.csv"
ON_CPU = "_cpu"  # ends the name of a row about a run on processors
COSTS = ("step alone [ms]", "a detection [ms]", "10⁵ contacts [ms]", "residual of the fit [ms]")


def quarters(run, name):
    """Returns the means of a column over the first and the last quarter of a run's rows, in whole hundreds if it is
    thinned."""
    values = run.thinned.of("mean", name) if run.thinned else run.column(name)
    quarter = len(values) // 4
    return statistics.fmean(values[:quarter]), statistics.fmean(values[-quarter:])


def row_of(row, run):
    from paper_figures.workflow.step_costs import costs

    scene, closest = run.manifest["scene"], "smallest_distance"
    name, backend = scene["name"], run.manifest["backend"]
    first, last = quarters(run, "wall")
    free, cut = quarters(run, "share_cut")
    try:
        parts = costs(run)
    except EvidenceError:
        parts = ()
    if not parts or min(parts) < 0:  # the fit can't separate them
        parts = ("",) * len(COSTS)
    return {"scene": row, "membrane": " and ".join(sorted(run.membranes)), "vertices": scene["vertices"],
            "steps": run.step_count,
            "mean [ms]": run.mean("wall"), "worst [ms]": run.largest("wall"),
            "paper, mean [ms]": paper(name, backend, "average")[0],
            "paper, worst [ms]": paper(name, backend, "maximum")[0],
            "audited states": run.audited_states, "detections a step": run.mean("discrete_detections"),
            "contacts a step": run.mean("vertex_facet_contacts") + run.mean("edge_edge_contacts"),
            **dict(zip(COSTS, parts)), "first quarter [ms]": first, "last quarter [ms]": last,
            "at bound, first quarter [1]": free, "at bound, last quarter [1]": cut,
            "left residual, median [1]": float(run.manifest.get("left_residual", "nan")),
            "largest elastic energy [J]": run.largest("elastic_energy"), "largest lag [m]": run.largest("largest_lag"),
            "smallest distance [m]": min(run.thinned.of("smallest", closest) if run.thinned else run.column(closest)),
            "device": run.manifest["device"], "commit": run.manifest["commit"][:10], "source": run.source}


def newest(runs):
    """Returns the newest run with each membrane, the newest of all first."""
    found = {tuple(run.membranes): run for run in runs}
    return [run for run in reversed(runs) if run in found.values()]


def table(folder):
    """Returns as CSV, for each row of Table 1, the run on a GPU that judges its claims, and the newest one with another
    membrane; below them the runs on the paper's number of processors, which the row's name tells."""
    evidence, claims = Evidence(folder), verdicts.load()
    rows = []
    for backend, end in (("cuda", ""), ("cpu", ON_CPU)):
        asked = {claim["scene"]: claim["run"] for claim in claims if claim["id"].endswith(f".{backend}_average")}
        for row in ROWS:
            scene, bounds = commands.scene_of(row), "planes" if row.endswith(commands.WITH_PLANES) else "ball"
            wanted = {"scene": scene, **asked.get(scene, {}), "bounds": bounds, "body_contact": commands.body_of(row)}
            runs = evidence.runs_as(wanted) if scene in asked else []
            rows += [row_of(row + end, run) for run in newest(runs)]
    if not rows:
        raise EvidenceError(f"{folder} holds no whole run of Table 1: accept one")
    out = io.StringIO()
    writer = csv.DictWriter(out, fieldnames=list(rows[0]), lineterminator="\n")
    writer.writeheader()
    writer.writerows({key: f"{value:.7g}" if isinstance(value, float) else value for key, value in row.items()}
                     for row in rows)
    return out.getvalue()


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("machine", help="folder below paper_figures/results")
    parser.add_argument("--write", action="store_true", help="keep the table beside the runs")
    options = parser.parse_args()
    folder = RESULTS / options.machine
    try:
        text = table(folder)
    except EvidenceError as error:
        sys.exit(f"whole_runs: {error}")
    if options.write:
        (folder / TABLE).write_text(text)
        contents.keep(folder / TABLE, f".venv/bin/python -m {__spec__.name} {options.machine} --write")
        contents.write()
    else:
        sys.stdout.write(text)


if __name__ == "__main__":
    main()
