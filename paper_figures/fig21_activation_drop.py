"""Fig. 21 and the ablation that the paper does not have: a cloth falls onto a sphere and the ground, 40 steps solved to convergence with each contact energy.

All five energies are solved with Newton's method; one that does not converge (Eq. 19 as printed has a force that jumps at τ) keeps its row. Step 40 is then taken
again from each energy's own state 39: by Newton with the condition number of each matrix, and, for the paper's two energies, by VBD in double, whose convergence is
the paper's panel c. Both energies' states are compared vertex by vertex. With --without the paper's two can be drawn before the others are run; picture and table
then name what was not run, and `accept` takes them with --incomplete only.
"""

import argparse
import csv
import json
import subprocess
import sys
from pathlib import Path

import numpy as np

from paper_figures import commands
from paper_figures.accept import not_run
from paper_figures.runs import iterations, provenance, run_job, write_table
from paper_figures.timed_runs import Limit, RunFailure, make
from plots import render, style
from plots.run_folder import Run, RunError, commits_in_words
from plots.scene_figure import bodies_of

SCENE, STEPS, ENERGIES, PAPER = commands.ACTIVATIONS, commands.ACTIVATION_STEPS, commands.ENERGIES, commands.PAPER_ENERGIES
CAMERA = ((1.6, 0.9, 1.9), (-0.08, -0.12, 0.0), (0, 1, 0))


def ablation(folder, ogc, scale, energies):
    """The run of each energy, as `ogc ablate` makes them: finished, or failed for good."""
    jobs = {energy: commands.ablation(scale, energy) for energy in energies}
    for job in jobs.values():
        print(" ".join(job.command(ogc, folder)), file=sys.stderr, flush=True)
        try:
            make(ogc, job, folder, Limit())
        except RunFailure as error:
            raise RunError(str(error)) from error
    runs = {energy: Run(folder / job.name) for energy, job in jobs.items()}
    for energy in PAPER:
        if runs[energy].status != "finished":
            raise RunError(f"{runs[energy].folder} is not finished ({runs[energy].status}); its last lines say why")
    return runs


def force_curves(folder, ogc):
    """{energy: (distance, force)} of Fig. 21d."""
    path = folder / "fig21d.json"
    if not path.is_file() and subprocess.run([str(ogc), "illustrate", "fig21d", "--out", str(folder)], stdout=subprocess.DEVNULL).returncode != 0:
        raise RunError("ogc illustrate fig21d failed; its last lines say why")
    layers = json.loads(path.read_text())["panels"][0]["layers"]
    return {layer["name"]: np.array(layer["points"])[:, :2].T for layer in layers}


def largest_distance(first, second):
    a, b = (run.frame(run.frames[-1]).positions.astype(float) for run in (first, second))
    return np.linalg.norm(a - b, axis=1).max()


def first_below(residual, level):
    below = np.flatnonzero(residual <= level)
    return int(below[0]) if len(below) else -1


def iterations_to(levels, runs, energy, step):
    return [first_below(iterations(runs[energy], step)["residual"], level) if energy in runs else "" for level in levels]


def row_of(energy, runs, newton, vbd, on_device, step):
    run = runs[energy]
    condition = iterations(newton[energy], step)["condition_number"] if energy in newton else np.array([np.nan])
    condition = condition[np.isfinite(condition)] if energy in newton else condition
    vbd_iterations, device_iterations = (iterations_to((1e-2, 1e-3), solved, energy, step) for solved in (vbd, on_device))
    return {"activation": energy, "status": run.status.partition(":")[0], "steps [1]": len(run.column("step")), "newton_iterations_of_all_steps [1]": int(run.column("iterations").sum()),
            "newton_iterations_of_last_step [1]": int(newton[energy].column("iterations")[-1]) if energy in newton else "",
            "vbd_iterations_to_1e-2 [1]": vbd_iterations[0], "vbd_iterations_to_1e-3 [1]": vbd_iterations[1],
            "single_vbd_iterations_to_1e-2 [1]": device_iterations[0], "single_vbd_iterations_to_1e-3 [1]": device_iterations[1],
            "condition_number_at_end [1]": f"{condition[-1]:.4g}", "median_condition_number [1]": f"{np.median(condition):.4g}",
            "steps_above_tolerance [1]": int((run.column("residual") > 1e-6).sum()), "largest_residual [1]": f"{run.column('residual').max():.3g}",
            "smallest_distance [mm]": f"{1e3 * run.column('smallest_distance').min():.4g}", "median_step [ms]": f"{np.median(run.column('wall')):.4g}",
            "largest_distance_from_ogc [mm]": f"{1e3 * largest_distance(runs['ogc'], run):.4g}" if energy in newton else "", **provenance(run)}


def draw_state(axes, run, title):
    axes.axis("off")
    axes.set_title(title)
    usable, reason = render.available()
    if usable:
        axes.imshow(render.picture(bodies_of(run, run.frame(run.frames[-1])), CAMERA))
    else:
        axes.text(0.5, 0.5, reason, ha="center", va="center", wrap=True, transform=axes.transAxes)


def draw_convergence(axes, newton, vbd, on_device, step):
    for number, energy in enumerate(PAPER):
        backend = on_device[energy].manifest["backend"]
        for runs, dash, name in ((vbd, "-", "VBD, double"), (on_device, ":", f"VBD, single, {backend}"), (newton, "--", "Newton")):
            rows = iterations(runs[energy], step)
            axes.plot(rows["iteration"], np.maximum(rows["residual"], 1e-16), dash, color=style.COLOURS[number], linewidth=1, label=f"{energy}, {name}")
    axes.set(yscale="log", xlabel="iteration", ylabel="residual (Eq. 29) [1]", title=f"Step {step}")
    axes.legend(fontsize=7)


def draw_forces(axes, curves):
    for number, energy in enumerate(ENERGIES):
        axes.plot(*curves[energy], color=style.COLOURS[number], linestyle=style.DASHES[number % len(style.DASHES)], label=energy)
    axes.set(ylim=(0, 5), xlim=(0, 1.1), xlabel="distance [r]", ylabel="force [k_c r]", title="Force over distance (r = 1, k_c = 1)")
    axes.legend(fontsize=7)


def draw(runs, newton, vbd, on_device, curves, rows, step, scale, out):
    plt = style.use()
    figure, axes = plt.subplots(2, 2, figsize=(11, 8))
    for panel, energy in zip(axes[0], PAPER):
        draw_state(panel, runs[energy], f"{energy}, step {step}")
    draw_convergence(axes[1, 0], newton, vbd, on_device, step)
    draw_forces(axes[1, 1], curves)
    ogc, ipc = rows[0], rows[1]
    ratio = float(ipc["condition_number_at_end [1]"]) / float(ogc["condition_number_at_end [1]"])
    left_out = [energy for energy in ENERGIES if energy not in runs]
    missing = f"; NOT RUN: {', '.join(left_out)}" if left_out else ""
    figure.suptitle(f"{SCENE} ({scale}): the two states are at most {ipc['largest_distance_from_ogc [mm]']} mm apart; condition number of ipc_log {ratio:.3g} × "
                    f"that of ogc (paper: 5 ×)\nVBD iterations to 10⁻³: {ogc['vbd_iterations_to_1e-3 [1]']} and {ipc['vbd_iterations_to_1e-3 [1]']} "
                    f"(paper: 2 ×){missing}; {commits_in_words([*runs.values(), *newton.values(), *vbd.values(), *on_device.values()])}", fontsize=8)
    style.save(figure, out)


def main(folder, ogc, scale="small", backend="cpu", without=()):
    """Does the runs that are missing in `folder`, and writes fig21.png and fig21.csv there; `backend`: of VBD in single precision, `without`: energies that are
    neither run nor drawn. Returns the picture's path."""
    folder, step = Path(folder), STEPS[scale]
    runs = ablation(folder, ogc, scale, [energy for energy in ENERGIES if energy not in without])
    newton = {e: run_job(ogc, commands.by_newton(scale, e), folder) for e in runs if runs[e].status == "finished"}
    vbd = {e: run_job(ogc, commands.by_vbd(scale, e), folder) for e in PAPER}
    on_device = {e: run_job(ogc, commands.by_vbd_on(scale, e, backend), folder) for e in PAPER}
    rows = [row_of(energy, runs, newton, vbd, on_device, step) for energy in runs]
    write_table(folder / "fig21.csv", [*rows, *(not_run("activation", energy, rows[0]) for energy in ENERGIES if energy in without)])
    draw(runs, newton, vbd, on_device, force_curves(folder, ogc), rows, step, scale, folder / "fig21.png")
    return folder / "fig21.png"


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", help="where the runs are, or go, and the figure")
    parser.add_argument("--ogc", default="build/default/ogc", help="the program")
    parser.add_argument("--scale", default="small", choices=STEPS)
    parser.add_argument("--backend", default="cpu", choices=("cpu", "cuda"), help="of VBD in single precision")
    parser.add_argument("--without", nargs="+", default=(), choices=ENERGIES[len(PAPER):], help="energies that are left out; the figure says so")
    arguments = parser.parse_args()
    try:
        print(main(arguments.folder, arguments.ogc, arguments.scale, arguments.backend, arguments.without))
    except (RunError, csv.Error) as error:
        sys.exit(f"fig21: {error}")
