"""Fig. 17: the residual of Eq. 29 over iterations and over time, one step of three cloths on a sphere, by VBD in single
and in double precision and by Newton.

All curves start from one state, which VBD in single precision reached with every step solved to convergence (γ_e = 0).
A curve that names another step starts from the state before that step. Contacts are detected again after one vertex in
a hundred was cut (the paper's γ_e), or after a single one (γ_e = 0). One curve with γ_e = 0 has a hundredth of the
printed ε_v, which may be in cm/s.

Residuals on curves use the contacts of the solver's last detection (stale), as in the paper. The table adds the
residual with contacts detected at the end (fresh). Newton's curve also uses the friction of its solve; it jumps where
the lagged friction is updated.

--start-iterations sets the number of iterations of the steps before. --without leaves curves out; picture and table
name them, and `accept` takes such results only with --incomplete.
"""

import argparse
import json
import sys
from pathlib import Path

import numpy as np

from paper_figures.workflow import commands
from paper_figures.workflow.accept import not_run
from paper_figures.workflow.evidence import CLAIMS
from paper_figures.workflow.runs import iterations, provenance, run_job, write_table
from plots import style
from ogc_testbed.runs import RunError, commits_in_words

SCENE, STEPS = commands.THREE_CLOTHS, commands.THREE_CLOTHS_STEP
# Deviations from the paper: their names in folders, and in words.
CHOICES = {"any": "γ_e = 0", "slow": "ε_v = 1e-4 m/s", "planes": "half-spaces", "pairs": "pair by pair",
           "narrow": "γ_p = 0.2"}
MARKS = (50, 500)  # last iteration of the paper's curves of Newton and of VBD


def label_of(name):
    """Describes in words a name such as vbd_cuda_any or vbd_cuda_any_at_25."""
    kind, *more = name.split("_")
    where = "single, " + more[0] if kind == "vbd" and more[0] != "double" else "double"
    said = "".join(f", {words}" for word, words in CHOICES.items() if word in more)
    other = f", step {more[-1]}" if "at" in more else ""
    return f"{'VBD' if kind == 'vbd' else 'Newton'}, {where}{said}{other}"


def curves(folder, ogc, jobs, without):
    """Returns the run of the steps before, and (label, run) of each curve."""
    start, *solved = (run_job(ogc, job, folder) for job in jobs if job.name not in without)
    return start, list(zip((label_of(job.name) for job in jobs[1:] if job.name not in without), solved))


def detection_share(run):
    stages = run.stage_columns()
    return float(np.sum(stages["detection"]) / sum(np.sum(times) for times in stages.values()))


def first_below(rows, level, name):
    below = np.flatnonzero(rows["residual"] <= level)
    return float(rows[name][below[0]]) if len(below) else float("nan")


def smallest_in(rows, iterations):
    """Returns the smallest residual of a curve within the paper's number of iterations."""
    return f"{rows['residual'][rows['iteration'] <= iterations].min():.3g}"


def last_step(run):
    return int(run.column("step")[-1])


def summary(label, run, start):
    rows = iterations(run, last_step(run))
    residual = rows["residual"]
    tail = residual[-max(1, len(residual) // 5):]
    return {"curve": label, "iterations [1]": int(rows["iteration"][-1]),
            "smallest_residual [1]": f"{residual.min():.3g}",
            "residual_of_last_fifth [1]": f"{np.median(tail):.3g}",
            "residual_contacts_of_the_end [1]": f"{run.column('residual')[-1]:.3g}",
            **{f"smallest_residual_in_{mark} [1]": smallest_in(rows, mark) for mark in MARKS},
            "iterations_to_1e-3 [1]": first_below(rows, 1e-3, "iteration"),
            "iterations_to_1e-4 [1]": first_below(rows, 1e-4, "iteration"),
            "time_to_1e-3 [ms]": f"{first_below(rows, 1e-3, 'wall'):.4g}", "step [ms]": f"{run.column('wall')[-1]:.4g}",
            "detections [1]": int(run.column("discrete_detections")[-1]),
            "detection_share_of_time [1]": f"{detection_share(run):.3g}",
            "contacts [1]": int(run.column("vertex_facet_contacts")[-1] + run.column("edge_edge_contacts")[-1]),
            "iterations_of_steps_before [1]": start.setting("iterations"), **provenance(run)}


def draw_curve(axes, rows, abscissa, label, colour, dash):
    residual = np.maximum(rows["residual"], 1e-16)
    axes.plot(rows[abscissa], residual, color=colour, linestyle=dash, linewidth=1, label=label)
    anew = rows["detected"] == 1
    axes.plot(rows[abscissa][anew], residual[anew], ".", color=colour, markersize=3)


def draw(runs, start, left_out, step, scale, claims, out):
    plt = style.use()
    figure, (left, right) = plt.subplots(1, 2, figsize=(11, 4.4), sharey=True)
    for number, (label, run) in enumerate(runs):
        rows = iterations(run, last_step(run))
        colour, dash = style.COLOURS[number % len(style.COLOURS)], style.DASHES[number // len(style.COLOURS)]
        share = f"{label} (detection {100 * detection_share(run):.2g} % of the time)"
        draw_curve(left, rows, "iteration", share, colour, dash)
        draw_curve(right, rows, "wall", label, colour, dash)
    left.set(yscale="log", xlabel="iteration", ylabel="residual (Eq. 29) [1]",
             title="Over iterations (dots: contacts detected anew)")
    right.set(xscale="log", xlabel="time since the step began [ms]", title="Over time")
    for mark in MARKS:
        left.axvline(mark, color="0.7", linewidth=0.6, zorder=0)
    left.legend(fontsize=6.5)
    paper = ", ".join(f"{c['quantity'].replace('_', ' ')} {c['value']:g}" for c in claims)
    lacks = "NOT RUN: " + "; ".join(left_out) + "; " if left_out else ""
    figure.suptitle(f"{SCENE} ({scale}), step {step}; {start.setting('iterations')} iterations in each step before; "
                    f"{lacks}{commits_in_words([start, *(run for _, run in runs)])}\npaper: {paper}", fontsize=8)
    style.save(figure, out)


def main(folder, ogc, scale="small", backends=("cpu",), single_only=False, start_iterations=None, without=()):
    """Makes the missing runs in `folder`, writes fig17.png and fig17.csv there, and returns the picture's path."""
    folder = Path(folder)
    claims = json.loads((CLAIMS / f"{SCENE}.json").read_text())["claims"]
    # claims that compare curves; each names a cell of the table
    claims = [c for c in claims if isinstance(c["measure"], list)]
    single, double = commands.three_cloths(scale, list(dict.fromkeys(backends)), start_iterations)
    start, runs = curves(folder, ogc, [*single, *([] if single_only else double)], without)
    rows, left_out = [{**summary(label, run, start), "status": run.status}
                      for label, run in runs], [label_of(name) for name in without]
    write_table(folder / "fig17.csv", [*rows, *(not_run("curve", label, rows[0]) for label in left_out)])
    draw(runs, start, left_out, STEPS[scale], scale, claims, folder / "fig17.png")
    return folder / "fig17.png"


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", help="where the runs are, or go, and the figure")
    parser.add_argument("--ogc", default="build/default/ogc", help="the program")
    parser.add_argument("--scale", default="small", choices=STEPS)
    parser.add_argument("--backend", action="append", choices=["cpu", "cuda"],
                        help="of VBD; repeatable; the last one makes the start (default: cpu)")
    parser.add_argument("--single-only", action="store_true",
                        help="without the curves in double precision, which take the exact detection's time")
    parser.add_argument("--start-iterations", type=int, metavar="N",
                        help="of each step before the one that is drawn (default: 500, the scene's)")
    parser.add_argument("--without", nargs="+", default=(), metavar="CURVE",
                        help="curves that are left out, as their folders are called; the figure says so")
    arguments = parser.parse_args()
    try:
        print(main(arguments.folder, arguments.ogc, arguments.scale, arguments.backend or ["cpu"],
                   arguments.single_only, arguments.start_iterations,
                   arguments.without))
    except RunError as error:
        sys.exit(f"fig17: {error}")
