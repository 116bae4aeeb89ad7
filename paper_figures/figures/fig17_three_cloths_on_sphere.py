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
import csv
import sys
from pathlib import Path

import numpy as np

from paper_figures.workflow import commands
from paper_figures.workflow.accept import not_run
from paper_figures.workflow.runs import Iterations, iterations, provenance, run_job, write_table
from plots import style
from plots.scene_figure import source_of
from ogc_testbed.runs import Run, RunError

SCENE, STEPS = commands.THREE_CLOTHS, commands.THREE_CLOTHS_STEP
# Deviations from the paper: their names in folders, and in words.
CHOICES = {"any": "γ_e = 0", "slow": "ε_v = 1e-4 m/s", "planes": "half-spaces", "pairs": "pair by pair",
           "narrow": "γ_p = 0.2"}
MARKS = (50, 500)  # last iteration of the paper's curves of Newton and of VBD
BELOW = 1e-4  # residual below which the paper's curves end
MARKED = {46: "paper: Newton, 46", 500: "paper: VBD, 500"}
LEFT_TO_TABLE = ("ε_v", "pair by pair", "half-spaces", "γ_p", "VBD, double")
TITLE = "Fig. 17. VBD reaches in milliseconds the residual that Newton's method reaches in minutes"
ALT = ("Two plots of the relative force residual in one step of three cloths on a sphere. Over iterations Newton's "
       "method falls faster than Vertex Block Descent at first; over time VBD on the GPU is at the same residual after "
       "tens of milliseconds, Newton's method on two cores after minutes. Stars mark where the paper's curves end, "
       "below 1e-4 after 46 iterations of Newton and 500 of VBD; ours with the printed γ_e stay above.")


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
    axes.plot(rows[abscissa], residual, color=colour, linestyle=dash, linewidth=1.1, label=label)
    if "detected" in rows.columns:
        anew = rows["detected"] == 1
        axes.plot(rows[abscissa][anew], residual[anew], ".", color=colour, markersize=3)


def kept_newton(path, table):
    """Returns (label, rows, share of detection) of Newton's curves kept as two tables: iterations, and a row for each
    curve. Times of iterations were not measured: each has an equal share of the step's."""
    with Path(path).open(newline="") as file:
        found = list(csv.DictReader(file))
    with Path(table).open(newline="") as file:
        about = {row["curve"]: row for row in csv.DictReader(file)}
    for label in dict.fromkeys(row["curve"] for row in found):
        own = [row for row in found if row["curve"] == label]
        columns = {name.partition(" [")[0]: np.array([float(row[name] or "nan") for row in own])
                   for name in own[0] if name != "curve"}
        columns["wall"] = columns["iteration"] * float(about[label]["step [ms]"]) / columns["iteration"][-1]
        yield label, Iterations(columns), float(about[label]["detection_share_of_time [1]"])


def shown(runs, newton):
    """Returns (label, rows, share of detection) of the curves that the picture shows: the printed γ_e and γ_e = 0, by
    VBD in single precision and by Newton. The table has all."""
    found = [(label, iterations(run, last_step(run)), detection_share(run)) for label, run in runs]
    found += [curve for curve in newton if curve[0] not in [label for label, _, _ in found]]
    return [curve for curve in found if "step" not in curve[0] and not any(word in curve[0] for word in LEFT_TO_TABLE)]


def draw(runs, newton, left_out, step, scale, out):
    """Draws the curves and the paper's numbers. `newton`: curves of kept_newton; `left_out`: names of curves that were
    not run."""
    style.use()
    curves_shown = shown(runs, newton)
    colours = {"VBD": iter((style.OURS, style.COLOURS[4], style.COLOURS[2], style.COLOURS[5])),
               "Newton": iter((style.BASELINE, style.COLOURS[1]))}
    shares = "; ".join(f"{label} {100 * share:.2g} %" for label, _, share in curves_shown)
    below = (f"step {step}{'' if scale == 'paper' else f' (scale {scale})'}; share of detection in the time: {shares} "
             "(paper: VBD 10 %, Newton 3 %)" + (f"; not run: {'; '.join(left_out)}" if left_out else ""))
    figure, ((left, right),) = style.page([(3.9, [(0.5, "plot")] * 2)], TITLE, below)
    for label, rows, _ in curves_shown:
        colour, dash = next(colours[label.partition(",")[0]], "0.6"), "-" if "γ_e" not in label else "--"
        name = label.replace(", single, ", ",\n").replace(", double", "").replace(", γ_e", ",\nγ_e")
        draw_curve(left, rows, "iteration", name, colour, dash)
        draw_curve(right, rows, "wall", name, colour, dash)
    for at, words in MARKED.items():
        left.plot([at], [BELOW], "*", color=style.PAPER, markersize=9, zorder=5)
        left.annotate(words, (at, BELOW), xytext=(5, -11), textcoords="offset points", fontsize=7.5)
    left.axhline(BELOW, color=style.PAPER, linewidth=0.8, linestyle=":")
    right.axhline(BELOW, color=style.PAPER, linewidth=0.8, linestyle=":")
    floor = min(np.nanmin(rows["residual"]) for _, rows, _ in curves_shown)
    for axes in (left, right):
        axes.set(yscale="log", ylim=(min(floor, BELOW) / 4, 3), ylabel="residual (Eq. 29) [1]")
        style.label_ends(axes, 7)
    left.set(xlabel="iteration", title="Over iterations; dots: contacts detected anew; stars: the paper's last points")
    right.set(xscale="log", xlabel="time [ms]", title="Over the step's time, shared out among its iterations")
    style.save(figure, out, TITLE, ALT, source_of([run for _, run in runs]))


def main(folder, ogc, scale="small", backends=("cpu",), single_only=False, start_iterations=None, without=(),
         newton=()):
    """Makes the missing runs in `folder`, writes fig17.png and fig17.csv there, and returns the picture's path."""
    folder = Path(folder)
    single, double = commands.three_cloths(scale, list(dict.fromkeys(backends)), start_iterations)
    start, runs = curves(folder, ogc, [*single, *([] if single_only else double)], without)
    rows, left_out = [{**summary(label, run, start), "status": run.status}
                      for label, run in runs], [label_of(name) for name in without]
    write_table(folder / "fig17.csv", [*rows, *(not_run("curve", label, rows[0]) for label in left_out)])
    draw(runs, list(kept_newton(*newton)) if newton else [], left_out, STEPS[scale], scale, folder / "fig17.png")
    return folder / "fig17.png"


def drawn_as_made(arguments):
    """Draws the runs that are there, without a table, and returns the picture's path."""
    folder = Path(arguments.folder)
    single, double = commands.three_cloths(arguments.scale, list(dict.fromkeys(arguments.backend or ["cpu"])))
    names = [job.name for job in (*single[1:], *double)]
    there = [(label_of(name), Run(folder / name)) for name in names if (folder / name / "run.json").is_file()]
    newton = list(kept_newton(*arguments.newton)) if arguments.newton else []
    draw(there, newton, [], STEPS[arguments.scale], arguments.scale, folder / "fig17.png")
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
    parser.add_argument("--newton", nargs=2, default=(), metavar=("ITERATIONS", "TABLE"),
                        help="kept curves of Newton (CSV) to draw beside the runs")
    parser.add_argument("--made", action="store_true", help="draw the curves whose runs are there, and make none")
    arguments = parser.parse_args()
    try:
        if arguments.made:
            print(drawn_as_made(arguments))
            sys.exit()
        print(main(arguments.folder, arguments.ogc, arguments.scale, arguments.backend or ["cpu"],
                   arguments.single_only, arguments.start_iterations,
                   arguments.without, arguments.newton))
    except RunError as error:
        sys.exit(f"fig17: {error}")
