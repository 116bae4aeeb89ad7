"""How long it takes to measure what forces a step leaves (compare/method.md §6), in sweeps and as a share of the time:
`stage_metrics` of the steps that measure less that of the others, medians, on the CPU at scale small. Runs and table.
"""

import sys

import numpy as np

from paper_figures.workflow.jobs import Job, RunFailure, parser_of_figure
from paper_figures.workflow.runs import provenance, write_table
from ogc_testbed.runs import Run

NAME = "left_forces"
SCALE = "small"
# Keys are the runs' names, values scene and options. The runs have every kind of element, both bendings, and volumes,
# and so many steps that they meet contacts.
RUNS = {"cloth_on_sphere": ("cloth_on_sphere",),
        "cloth_on_sphere_isometric": ("cloth_on_sphere", "--set", "bending=isometric_quadratic"),
        "twist_planes": ("twist", "--steps", 300, "--set", "bounds=planes"), "mat_twist": ("mat_twist", "--steps", 240),
        "yarn_stretch": ("yarn_stretch", "--steps", 200),
        "robot_shirt_volumes": ("robot_shirt", "--steps", 60, "--set", "body_contact=volume")}


def job(name):
    scene, *options = RUNS[name]
    return Job(name, (scene, "--scale", SCALE, "--profile", "--audit", "off", *options))


def row_of(name, run):
    """Returns what measuring costs. Throws RunFailure if no step measured, or all."""
    measured = np.isfinite(run.column("left_residual"))
    if measured.all() or not measured.any():
        raise RunFailure(f"{name}: {measured.sum()} of {len(measured)} steps measured what they leave")
    metrics, iterations = run.column("stage_metrics"), np.median(run.column("iterations"))
    more = np.median(metrics[measured]) - np.median(metrics[~measured])
    every = np.median(np.diff(np.flatnonzero(measured))) if measured.sum() > 1 else len(measured)
    mean, sweep = np.mean(run.column("wall")), np.median(run.column("stage_sweep")) / iterations
    return {"run": name, "steps": len(measured), "iterations": f"{iterations:g}", "measured every": f"{every:g}",
            "mean step [ms]": f"{mean:.4g}", "a sweep [ms]": f"{sweep:.4g}", "measuring [ms]": f"{more:.4g}",
            "measuring [sweeps]": f"{more / sweep:.4g}",
            "measuring [% of the time]": f"{100 * more / every / mean:.4g}", **provenance(run)}


def main():
    options = parser_of_figure(__doc__.splitlines()[0], has_backend=False).parse_args()
    try:
        for name in RUNS:
            job(name).make(options.ogc, options.folder, shown=True)
        rows = [row_of(name, Run(options.folder / name)) for name in RUNS]
    except RunFailure as error:
        sys.exit(f"{NAME}: {error}")
    write_table(options.folder / f"{NAME}.csv", rows)


if __name__ == "__main__":
    main()
