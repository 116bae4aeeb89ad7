"""Where the time of a run's steps goes, by least squares over its rows: a step without detections and contacts, each
detection, 10⁵ contacts. It knows nothing of the kernels: a cost that grows with something else shows in the residual.
For fast/PERFORMANCE.md.

Usage: python3 -m paper_figures.workflow.step_costs RUN … (run folders, or manifests of accepted results)
"""

import sys
from pathlib import Path

import numpy as np

from paper_figures.workflow.evidence import EvidenceError, runs_in


def costs(run):
    """Returns (step, detection, 10⁵ contacts, residual), all in ms; the residual is a root mean square. Throws
    EvidenceError if the rows don't separate these costs. Of an accepted run with thinned rows it returns what `accept`
    computed."""
    if run.thinned:
        if "step_costs" not in run.manifest["whole_run"]:
            raise EvidenceError(f"{run.source}: no costs were computed from its rows before they were thinned")
        return tuple(run.manifest["whole_run"]["step_costs"])
    wall, detections = np.array(run.column("wall")), np.array(run.column("discrete_detections"))
    contacts = np.array(run.column("vertex_facet_contacts")) + np.array(run.column("edge_edge_contacts"))
    terms = np.stack([np.ones_like(wall), detections, contacts / 1e5], axis=1)
    if np.linalg.matrix_rank(terms) < 3:
        raise EvidenceError(f"{run.source}: detections and contacts do not change from step to step, or together: "
                            "their costs can't be told apart")
    solution = np.linalg.lstsq(terms, wall, rcond=None)[0]
    return (*map(float, solution), float(np.sqrt(np.mean((terms @ solution - wall) ** 2))))


def described(run):
    """Returns a line of a Markdown table."""
    numbers = (run.mean("wall"), run.largest("wall"), run.mean("discrete_detections"), *costs(run))
    cells = " | ".join(f"{number:.3g}" for number in numbers)
    return f"| {run.manifest['scene']['name']}, {run.step_count} steps | {cells} |"


def named(words):
    """Returns the runs of folders and manifests. Throws EvidenceError if there is none."""
    for word in map(Path, words):
        found = [run for run in runs_in(word if word.is_dir() else word.parent) if word.is_dir()
                 or run.source == word.name]
        if not found:
            raise EvidenceError(f"{word}: no run; give a run folder or the run.json of an accepted result")
        yield from found


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    try:
        print("| run | mean [ms] | worst | detections a step | step | a detection | 10⁵ contacts | residual "
              "|\n|---|---|---|---|---|---|---|---|")
        for each in named(sys.argv[1:]):
            print(described(each))
    except EvidenceError as error:
        sys.exit(f"step_costs: {error}")
