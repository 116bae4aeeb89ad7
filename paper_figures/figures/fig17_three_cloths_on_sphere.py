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
ALT = ("Plots of the relative force residual in one step of three cloths on a sphere. Over iterations Newton's "
       "method falls faster than Vertex Block Descent at first; over measured time VBD is there long before Newton's "
       "method. Stars mark where the paper's curves end, below 1e-4 after 46 iterations of Newton and 500 of VBD; ours "
       "with the printed γ_e stay above.")


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
    curve. Times of their iterations were not measured, so that they have no `wall`."""
    with Path(path).open(newline="") as file:
        found = list(csv.DictReader(file))
    with Path(table).open(newline="") as file:
        about = {row["curve"]: row for row in csv.DictReader(file)}
    for label in dict.fromkeys(row["curve"] for row in found):
        own = [row for row in found if row["curve"] == label]
        columns = {name.partition(" [")[0]: np.array([float(row[name] or "nan") for row in own])
                   for name in own[0] if name != "curve"}
        yield label, Iterations(columns), float(about[label]["detection_share_of_time [1]"])


def shown(runs, newton):
    """Returns (label, rows, share of detection) of the curves that the picture shows: the printed γ_e and γ_e = 0, by
    VBD in single precision and by Newton. The table has all."""
    found = [(label, iterations(run, last_step(run)), detection_share(run)) for label, run in runs]
    found += [curve for curve in newton if curve[0] not in [label for label, _, _ in found]]
    return [curve for curve in found if "step" not in curve[0] and not any(word in curve[0] for word in LEFT_TO_TABLE)]


def draw_kind(panels, curves_shown, abscissas):
    """Draws curves into panels, one for each abscissa; curves without measured times only over iterations."""
    colours = {"VBD": iter((style.OURS, style.COLOURS[4], style.COLOURS[2], style.COLOURS[5])),
               "Newton": iter((style.BASELINE, style.COLOURS[1]))}
    for label, rows, _ in curves_shown:
        colour, dash = next(colours[label.partition(",")[0]], "0.6"), "-" if "γ_e" not in label else "--"
        name = label.replace(", single, ", ",\n").replace(", double", "").replace(", γ_e", ",\nγ_e")
        for axes, abscissa in zip(panels, abscissas):
            if abscissa in rows.columns:
                draw_curve(axes, rows, abscissa, name, colour, dash)


def draw(runs, newton, left_out, step, scale, out, beside=()):
    """Draws the curves and the paper's numbers. `newton`: curves of kept_newton; `left_out`: names of curves that were
    not run; `beside`: (label, run) of another scale, whose times are all measured on the same cores."""
    style.use()
    curves_shown, others = shown(runs, newton), shown(beside, ())
    shares = "; ".join(f"{label} {100 * share:.2g} %" for label, _, share in curves_shown)
    below = (f"step {step}{'' if scale == 'paper' else f' (scale {scale})'}; share of detection in the time: {shares} "
             "(paper: VBD 10 %, Newton 3 %)" + (f"; not run: {'; '.join(left_out)}" if left_out else ""))
    timed = [label for label, rows, _ in curves_shown if "wall" in rows.columns]
    count = 3 if others else 2
    about = beside[0][1].manifest if others else None
    title = title_of(curves_shown, others, f" (at {about['scale']}, {about['device']})" if about else "")
    figure, (panels,) = style.page([(3.9, [(1 / count, "plot")] * count)], title, below)
    draw_kind(panels[:2], curves_shown, ("iteration", "wall"))
    draw_kind(panels[2:], others, ("wall",))
    for (at, words), higher in zip(MARKED.items(), (6, -12)):
        panels[0].plot([at], [BELOW], "*", color=style.PAPER, markersize=9, zorder=5)
        panels[0].annotate(words, (at, BELOW), xytext=(5, higher), textcoords="offset points", fontsize=7.5)
    floor = min(np.nanmin(rows["residual"]) for _, rows, _ in curves_shown)
    for axes in panels:
        axes.axhline(BELOW, color=style.PAPER, linewidth=0.8, linestyle=":")
        axes.set(yscale="log", ylim=(min(floor, BELOW) / 4, 3), ylabel="residual (Eq. 29) [1]")
    panels[0].set(xlabel="iteration", title="Over iterations; stars: the paper's last points")
    there = list(dict.fromkeys(run.manifest["device"] for _, run in runs))
    panels[1].set(xscale="log", xlabel="time [ms]", title=f"Over measured time, {' and '.join(there)}")
    for axes in panels[2:]:
        axes.set(xscale="log", xlabel="time [ms]", title=f"The same at {about['scale']}, both on {about['device']}")
    for axes in panels:
        style.label_ends(axes, 7)
    if not any(label.startswith("Newton") for label in timed):
        panels[1].annotate("Newton's method: not timed at this size", (0.03, 0.03), xycoords="axes fraction",
                           fontsize=7.5, color=style.BASELINE)
    style.save(figure, out, title, ALT, source_of([run for _, run in (*runs, *beside)]))


def time_to(curves_shown, kind, level=1e-3):
    """Returns the shortest measured time in which curves of a kind reach a residual [ms]; None if none does."""
    times = [first_below(rows, level, "wall") for label, rows, _ in curves_shown
             if label.startswith(kind) and "wall" in rows.columns]
    return min((time for time in times if np.isfinite(time)), default=None)


def in_words(ms):
    return f"{ms:.3g} ms" if ms < 1e3 else f"{ms / 1e3:.3g} s"


def title_of(curves_shown, others, of_others):
    """Returns the title: after what time both methods have brought the residual down to a thousandth."""
    for found, where in ((curves_shown, ""), (others, of_others)):
        ours, theirs = time_to(found, "VBD"), time_to(found, "Newton")
        if ours and theirs:
            return (f"Fig. 17. VBD brings the residual to a thousandth in {in_words(ours)}, Newton's method in "
                    f"{in_words(theirs)}{where}")
    return "Fig. 17. Newton's method takes fewer iterations than VBD at first, and each takes far longer"


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
    """Draws and tabulates the runs that are there, and returns the picture's path. The table says which curves of the
    figure have no run, if the run of the steps before is there."""
    folder, backends = Path(arguments.folder), list(dict.fromkeys(arguments.backend or ["cpu"]))
    newton = list(kept_newton(*arguments.newton)) if arguments.newton else []
    beside = made(arguments.beside, ["cpu"], "small") if arguments.beside else []
    runs = made(folder, backends, arguments.scale)
    if runs and (folder / "start/run.json").is_file():
        rows = [{**summary(label, run, Run(folder / "start")), "status": run.status} for label, run in runs]
        there = {label for label, _ in runs}
        single, double = commands.three_cloths(arguments.scale, backends)
        lacking = [label for job in (*single[1:], *double) if (label := label_of(job.name)) not in there]
        write_table(folder / "fig17.csv", [*rows, *(not_run("curve", label, rows[0]) for label in lacking)])
    draw(runs, newton, [], STEPS[arguments.scale], arguments.scale, folder / "fig17.png", beside)
    return folder / "fig17.png"


def made(folder, backends, scale):
    """Returns (label, run) of the curves whose runs lie in a folder and have iterations."""
    single, double = commands.three_cloths(scale, backends)
    names = [job.name for job in (*single[1:], *double)]
    return [(label_of(name), Run(Path(folder) / name)) for name in names
            if (Path(folder) / name / "iterations.csv").is_file()]


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
    parser.add_argument("--beside", metavar="FOLDER", help="with --made: runs at small, whose times stand beside")
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
