"""Fig. 21 and the ablation that the paper does not have: a cloth falls onto a sphere and the ground, 40 steps solved to
convergence with each contact energy.

Newton's method solves all five energies. An energy for which it does not converge keeps its row; Eq. 19 as printed has
a force that jumps at τ. Step 40 is then repeated from each energy's own state 39. Newton's repetition gives the
condition numbers of its matrices, also without friction and without contact. For the paper's two energies VBD in double
and in single precision repeats the step, too; its convergence is the paper's panel c. The states of both energies are
compared vertex by vertex.

Two choices that the paper leaves open are varied. κ: IPC's energy is −κ k_c (d − r)² ln(d/r). Weak contact: k_c is so
small that about half of OGC's contacts push with more than k_c r/2, where IPC's energy at equal force is stiffest in
comparison with OGC's. Each last state gives the contact forces and the number of contacts at which IPC's energy is
softer. --without leaves out all energies but the paper's two at κ = 1; picture and table then name what was not run,
and `accept` takes them only with --incomplete. `fig21_curves.csv` has the residuals of VBD's last step for each
variant, so that the curves can be drawn again without the runs.
"""

import argparse
import csv
import json
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from paper_figures.workflow import commands, contact_forces
from paper_figures.workflow.accept import not_run
from paper_figures.workflow.evidence import NOT_RUN
from paper_figures.workflow.runs import iterations, provenance, run_job, write_table
from plots import render, style
from plots.bodies import bodies_of
from plots.camera import fitted
from plots.scene_figure import look_of, show, source_of
from ogc_testbed.runs import Run, RunError

SCENE, STEPS, VARIANTS = commands.ACTIVATIONS, commands.ACTIVATION_STEPS, commands.VARIANTS
OGC, IPC = PAPER = commands.PRINTED[:2]
SIZE, DISTANCES = (800, 640), "cividis"  # pixels; the colours of distances
NAMES = {"ogc": "OGC's", "ipc_log": "IPC's"}
TITLE = "Fig. 21. OGC's and IPC's activation drape the cloth alike; here OGC's converges no faster"
ALT = ("Renderings of the cloth on a sphere after 40 steps with our activation function and with IPC's, of both in one "
       "picture, and of the first coloured by the distance between the two: median {} mm, at most {} mm. Curves: the "
       "residual over the iterations of the last step for both, the force over distance of both functions, residuals "
       "for other contact stiffnesses, and bars with condition numbers.")
LEVELS = {"1e-2": 1e-2, "1e-3": 1e-3, "1e-4": 1e-4}
CURVE_FIRST, CURVE_POINTS = 20, 100  # iterations that fig21_curves.csv keeps
CONDITIONS = {
    "condition_number": "with friction",
    "condition_without_friction": "without friction",
    "condition_without_contact": "without contact",
}


@dataclass(frozen=True)
class Solved:
    """Holds the runs of a variant: all steps; and the last step by Newton, by VBD in double and by VBD in single
    precision. A run that was not made is None."""

    run: Run
    newton: Run = None
    double: Run = None
    single: Run = None

    @property
    def all(self):
        return [run for run in (self.run, self.newton, self.double, self.single) if run]


def solved(folder, ogc, scale, variant, backend):
    run = run_job(ogc, commands.ablation(scale, variant), folder)
    if run.status != "finished":
        if variant in PAPER:
            raise RunError(f"{run.folder} is not finished ({run.status}); its last lines say why")
        return Solved(run)
    newton = run_job(ogc, commands.by_newton(scale, variant), folder)
    if not commands.compared(variant):
        return Solved(run, newton)
    return Solved(
        run,
        newton,
        run_job(ogc, commands.by_vbd(scale, variant), folder),
        run_job(ogc, commands.by_vbd_on(scale, variant, backend), folder),
    )


def curves(folder, ogc):
    """Returns the panels of `ogc illustrate fig21d`: {panel: {layer: (x, y)}}."""
    path = folder / "fig21d.json"
    if (
        subprocess.run([str(ogc), "illustrate", "fig21d", "--out", str(folder)], stdout=subprocess.DEVNULL).returncode
        != 0
    ):
        raise RunError("ogc illustrate fig21d failed; its last lines say why")
    panels = json.loads(path.read_text())["panels"]
    return {
        panel["name"]: {layer["name"]: np.array(layer["points"])[:, :2].T for layer in panel["layers"]}
        for panel in panels
    }


def distances(first, second):
    """Returns the distance of each vertex between the last states of two runs [m]."""
    a, b = (run.frame(run.frames[-1]).positions.astype(float) for run in (first, second))
    return np.linalg.norm(a - b, axis=1)


def first_below(rows, level):
    """Returns the first iteration whose state has at most this residual, with the contacts of the last detection, or
    "never"."""
    below = np.flatnonzero(rows["residual"] <= level)
    return int(rows["iteration"][below[0]]) if len(below) else "never"


def iterations_to(prefix, run, step):
    """Returns a solver's columns: the iterations of the last step to each level; empty if the step was not made."""
    rows = iterations(run, step) if run else None
    return {
        f"{prefix}_iterations_to_{name} [1]": first_below(rows, level) if rows else "" for name, level in LEVELS.items()
    }


def conditions(newton, step):
    """Returns columns about the matrices of the step: values of the last one, and medians over the iterations. Empty if
    Newton made none or gave up, because its last matrix then belongs to a state far from the end."""
    rows = iterations(newton, step) if newton and newton.status == "finished" else None
    known = np.flatnonzero(np.isfinite(rows["condition_number"])) if rows else []
    if not len(known):
        return {**{f"{name}_at_end [1]": "" for name in CONDITIONS}, "median_condition_number [1]": ""}
    ends = {f"{name}_at_end [1]": f"{rows[name][known[-1]]:.4g}" for name in CONDITIONS}
    return {**ends, "median_condition_number [1]": f"{np.median(rows['condition_number'][known]):.4g}"}


def pushing(forces):
    """Returns columns about the contacts of the last state; empty for an energy that neither curve describes."""
    if forces is None:
        return dict.fromkeys(
            ("contacts [1]", "median_force [k_c r]", "share_above_half [1]", "share_where_ipc_is_softer [1]"), ""
        )
    return {
        "contacts [1]": len(forces.force),
        "median_force [k_c r]": f"{np.median(forces.force):.3g}",
        "share_above_half [1]": f"{forces.share_above_half:.3g}",
        "share_where_ipc_is_softer [1]": f"{forces.share_softer:.3g}",
    }


def largest_residual(run):
    """Returns the largest residual over steps with contacts. In free flight f*, the force with which VBD begins, is
    only rounding."""
    touching = run.column("vertex_facet_contacts") + run.column("edge_edge_contacts") > 0
    return run.column("residual")[touching].max()


def row_of(variant, found, forces, like, scale):
    """Returns the row of a variant. `like`: the runs with OGC's energy and the same contact."""
    run, step, newton = found.run, STEPS[scale], found.newton
    whole = run.status == "finished"
    return {
        "activation": variant.label,
        "kappa [1]": variant.ratio,
        "contact_stiffness [N/m]": f"{variant.stiffness(scale):g}",
        "status": run.status.partition(":")[0],
        "steps [1]": len(run.column("step")),
        "newton_iterations_of_all_steps [1]": "" if variant.weak else int(run.column("iterations").sum()),
        "newton_iterations_of_last_step [1]": int(newton.column("iterations")[-1]) if newton else "",
        **iterations_to("newton", newton, step),
        **iterations_to("vbd", found.double, step),
        **iterations_to("single_vbd", found.single, step),
        **conditions(newton, step),
        **pushing(forces),
        "steps_above_tolerance [1]": "" if variant.weak else int((run.column("residual") > 1e-6).sum()),
        "largest_residual [1]": f"{largest_residual(run):.3g}",
        "smallest_distance [mm]": f"{1e3 * run.column('smallest_distance').min():.4g}",
        "median_step [ms]": f"{np.median(run.column('wall')):.4g}",
        **apart(like.run if like else None, run if whole else None),
        **provenance(run),
    }


def apart(ogc, run):
    """Returns columns: how far the last state is from that with OGC's energy; empty without one of them."""
    found = 1e3 * distances(ogc, run) if ogc and run else []
    return {f"{name}_distance_from_ogc [mm]": f"{np.percentile(found, share):.4g}" if len(found) else ""
            for name, share in (("median", 50), ("ninth_decile", 90), ("largest", 100))}


def curve_rows(results, step):
    """Returns the rows of the curves: for each variant the residual of VBD's last step after its first iterations, and
    after about CURVE_POINTS more, evenly on a logarithmic axis, the last among them."""
    found = []
    for variant, solved_by in results.items():
        if not solved_by.double:
            continue
        rows = iterations(solved_by.double, step)
        last = len(rows["iteration"]) - 1
        places = np.unique(np.concatenate([np.arange(min(CURVE_FIRST, last + 1)),
                                           np.geomspace(1, max(last, 1), CURVE_POINTS).round().astype(int)]))
        found += [{"activation": variant.label, "iteration [1]": int(rows["iteration"][i]),
                   "residual [1]": f"{rows['residual'][i]:.5g}", "commit": provenance(solved_by.double)["commit"],
                   "device": solved_by.double.manifest["device"]} for i in places if i <= last]
    return found


def ratio_rows(ratio):
    """Returns the table of curvature ratios: a row for each force, a column for each κ."""
    chosen = (0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 100)
    return [
        {
            "force [k_c r]": f"{force:g}",
            **{
                f"curvature_ratio_kappa_{name} [1]": f"{contact_forces.ratio_at(force, curve):.3g}"
                for name, curve in ratio.items()
            },
        }
        for force in chosen
    ]


def colour(variant):
    """Returns the colour of a κ; black for OGC."""
    return (
        style.COLOURS[-1] if variant.energy == "ogc" else style.COLOURS[commands.STIFFNESS_RATIOS.index(variant.ratio)]
    )


def coloured(run, frame, shades):
    """Returns the bodies of a state whose cloth has these colours: one, or one for each vertex of the run [n, 3]."""
    bodies, first = [], 0
    for body in bodies_of(run, frame):
        own = shades if isinstance(shades, str) else shades[first:first + len(body[0])]
        first += len(body[0])
        bodies.append(body if isinstance(body[2], str) and body[2] == style.BODY else
                      (*body[:2], own, own if isinstance(own, str) else None))
    return bodies


def draw_states(axes, results):
    """Draws the paper's panels a and b, both states in one picture, and OGC's coloured by how far IPC's is from it.
    Returns the distances [m]; not-a-number if states were not kept."""
    runs = [results[variant].run for variant in PAPER]
    step = int(runs[0].column("step")[-1])
    titles = [f"({letter}) {NAMES[variant.energy]} activation, step {step}" for letter, variant in zip("ab", PAPER)]
    if not all(run.frames for run in runs):
        for place, title in zip(axes, (*titles, "both", "their distance")):
            style.not_run(place, "the states were not kept")
            place.set_title(title)
        return np.array([np.nan])
    frames = [run.frame(run.frames[-1]) for run in runs]
    camera = fitted(runs[0], frames, SIZE)
    for place, run, frame, title in zip(axes, runs, frames, titles):
        show(place, run, frame, camera, title, SIZE)
    far = distances(*runs)
    usable, reason = render.available()
    if not usable:
        for place in axes[2:]:
            style.not_run(place, reason)
        return far
    import matplotlib

    look = look_of(runs[0])
    both = [body for run, frame, shade in zip(runs, frames, (style.FRONTS[0], style.BACKS[0]))
            for body in coloured(run, frame, shade)]
    style.picture(axes[2], render.picture(both, camera, SIZE, **look), "(a), blue, and (b), sand, in one picture")
    shades = 255 * matplotlib.colormaps[DISTANCES](far / max(far.max(), 1e-12))[:, :3]
    image = render.picture(coloured(runs[0], frames[0], shades), camera, SIZE, **look)
    style.picture(axes[3], image, f"(a) by its distance to (b), median {1e3 * np.median(far):.2g} mm")
    shown = matplotlib.cm.ScalarMappable(matplotlib.colors.Normalize(0, 1e3 * far.max()), DISTANCES)
    inset = axes[3].inset_axes((0.66, 0.09, 0.24, 0.035))
    axes[3].figure.colorbar(shown, cax=inset, orientation="horizontal").ax.tick_params(labelsize=7)
    inset.text(1.06, 0.5, "mm", fontsize=7.5, va="center", transform=inset.transAxes)
    return far


def draw_residual(axes, run, step, dash, shade, label):
    rows = iterations(run, step)
    axes.plot(rows["iteration"], np.maximum(rows["residual"], 1e-16), dash, color=shade, linewidth=1, label=label)


def draw_convergence(axes, results, step):
    for number, variant in enumerate(PAPER):
        found = results[variant]
        names = (
            (found.double, "-", "VBD"),
            (found.newton, "--", "Newton"),
        )
        for run, dash, name in names:
            if run:
                label = f"{NAMES[variant.energy]},\n{name}"
                draw_residual(axes, run, step, dash, (style.OURS, style.BASELINE)[number], label)
    axes.set(yscale="log", xlabel="iteration", ylabel="residual (Eq. 29) [1]",
             title=f"(c) residual in step {step}, double")
    style.label_ends(axes, 7)


def draw_forces(axes, force):
    for energy, colour_of in zip(commands.PAPER_ENERGIES, (style.OURS, style.BASELINE)):
        axes.plot(*force[energy], color=colour_of, label=NAMES[energy])
    axes.set(
        ylim=(0, 5),
        xlim=(0, 1.1),
        xlabel="distance [r]",
        ylabel="force [k_c r]",
        title="(d) force over distance (r = 1, k_c = 1)",
    )
    axes.legend(fontsize=8, loc="upper right")


def short(label):
    return label.replace("weak contact", "weak")


def draw_by_ratio(axes, kept, step):
    """Draws the rows of fig21_curves.csv: a line for each variant."""
    axes.set_title(f"VBD in double, step {step}, by κ and contact stiffness")
    for variant in VARIANTS:
        rows = [row for row in kept if row["activation"] == variant.label]
        if rows and not variant.other_membrane:
            axes.plot([int(row["iteration [1]"]) for row in rows],
                      [max(float(row["residual [1]"]), 1e-16) for row in rows], "--" if variant.weak else "-",
                      color=colour(variant), linewidth=1, label=short(variant.label))
    if not kept:
        return style.not_run(axes, "the curves of other κ and of weak contact were not kept")
    axes.set(yscale="log", xlabel="iteration", ylabel="residual (Eq. 29) [1]")
    return style.label_ends(axes, 6.5)


def draw_conditions(axes, rows):
    shown = [row for row in rows if row["condition_number_at_end [1]"]]
    places = np.arange(len(shown))
    for number, (name, words) in enumerate(CONDITIONS.items()):
        axes.barh(
            places + 0.27 * (number - 1),
            [float(row[f"{name}_at_end [1]"]) for row in shown],
            0.27,
            color=style.COLOURS[number],
            label=words,
        )
    axes.set_yticks(places, [short(row["activation"]) for row in shown], fontsize=6.5)
    left = axes.get_position()
    axes.set_position([left.x0 + 0.07, left.y0, left.width - 0.07, left.height])  # for the names
    axes.invert_yaxis()
    largest = max((float(row["condition_number_at_end [1]"]) for row in shown), default=1)
    axes.set(xscale="log", xlim=(1, 3 * largest), xlabel="condition number [1]", title="Newton's last matrix")
    if not shown:
        style.not_run(axes)
    for number, words in enumerate(CONDITIONS.values()):
        axes.text(1.02, 0.9 - 0.1 * number, words, color=style.COLOURS[number], fontsize=7, transform=axes.transAxes)


def over(rows, column, top=IPC, bottom=OGC):
    """Returns the quotient of two cells as text; a dash if one is no number."""
    cells = {row["activation"]: row[column] for row in rows}
    try:
        return f"{float(cells[top.label]) / float(cells[bottom.label]):.3g}"
    except (KeyError, ValueError):
        return "–"


def below(results, rows, scale):
    """Returns the line below the title: what the paper says and what we find."""
    told = {row["activation"] for row in rows if row["status"] != NOT_RUN}
    left_out = [variant.label for variant in VARIANTS if variant not in results and variant.label not in told]
    found = [over(rows, column) for column in ("vbd_iterations_to_1e-3 [1]", "condition_number_at_end [1]")]
    where = "4,900 vertices" if scale == "paper" else f"scale {scale}"
    said = [text if text != "–" else "not reached by both" for text in found]
    words = (f"{where}; of IPC's over ours, VBD's iterations to 1e-3: {said[0]} (paper 2), condition number: {said[1]} "
             "(paper 5)")
    return words + (f"; not run: {'; '.join(left_out)}" if left_out else "")


def draw(results, panels, rows, kept, scale, out):
    """Draws the page. `kept`: the rows of fig21_curves.csv."""
    style.use()
    step = STEPS[scale]
    figure, axes = style.page([style.pictures(4, SIZE), (2.7, [(0.5, "plot")] * 2), (2.7, [(0.5, "plot")] * 2)], TITLE,
                              below(results, rows, scale))
    far = draw_states(axes[0], results)
    draw_convergence(axes[1][0], results, step)
    draw_forces(axes[1][1], panels["force"])
    draw_by_ratio(axes[2][0], kept, step)
    draw_conditions(axes[2][1], rows)
    runs = [run for found in results.values() for run in found.all]
    style.save(figure, out, TITLE, ALT.format(*(f"{1e3 * value:.2g}" for value in (np.median(far), far.max()))),
               source_of(runs))


def main(folder, ogc, scale="small", backend="cpu", without=()):
    """Makes the missing runs in `folder`, writes fig21.png and the tables there, and returns the picture's path.
    `backend`: of VBD in single precision. `without`: names of variants that are neither run nor drawn."""
    folder = Path(folder)
    panels = curves(folder, ogc)
    results = {v: solved(folder, ogc, scale, v, backend) for v in VARIANTS if v.name not in without}
    states = {
        v: contact_forces.forces_of(ogc, found.run, v, panels["ratio"][str(v.ratio)])
        for v, found in results.items()
        if found.double
    }
    rows = [
        row_of(v, found, states.get(v), results.get(v.beside), scale)
        for v, found in results.items()
    ]
    write_table(
        folder / "fig21.csv", [*rows, *(not_run("activation", v.label, rows[0]) for v in VARIANTS if v not in results)]
    )
    write_table(folder / "fig21_forces.csv", list(contact_forces.table(states)))
    write_table(folder / "fig21_ratios.csv", ratio_rows(panels["ratio"]))
    kept = curve_rows(results, STEPS[scale])
    write_table(folder / "fig21_curves.csv", kept)
    draw(results, panels, rows, kept, scale, folder / "fig21.png")
    return folder / "fig21.png"


def rows_of(path):
    """Returns the rows of a CSV file."""
    with path.open(newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def drawn_as_made(arguments):
    """Draws the runs that are there, with the rows of a kept table, and returns the picture's path."""
    folder = Path(arguments.folder)

    def there(job):
        return Run(folder / job.name) if (folder / job.name / "run.json").is_file() else None

    scale = arguments.scale
    found = {v: Solved(there(commands.ablation(scale, v)), there(commands.by_newton(scale, v)),
                       there(commands.by_vbd(scale, v)), there(commands.by_vbd_on(scale, v, arguments.backend)))
             for v in VARIANTS}
    results = {v: solved for v, solved in found.items() if solved.run}
    if not set(PAPER) <= set(results):
        raise RunError(f"{folder} lacks the runs of the paper's two energies; leave --made out, and they are made")
    made = Path(arguments.made)
    rows = [row for row in rows_of(made) if row["status"] != NOT_RUN]
    kept = made.with_name(made.name.replace("fig21", "fig21_curves"))
    draw(results, curves(folder, arguments.ogc), rows, rows_of(kept) if kept.is_file() else curve_rows(results,
         STEPS[scale]), scale, folder / "fig21.png")
    return folder / "fig21.png"


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", help="where the runs are, or go, and the figure")
    parser.add_argument("--ogc", default="build/default/ogc", help="the program")
    parser.add_argument("--scale", default="small", choices=STEPS)
    parser.add_argument("--backend", default="cpu", choices=("cpu", "cuda"), help="of VBD in single precision")
    parser.add_argument(
        "--without",
        nargs="+",
        default=(),
        choices=[v.name for v in VARIANTS if v not in PAPER],
        help="what is left out; the figure says so",
    )
    parser.add_argument("--made", metavar="CSV", help="draw the runs that there are, with this kept "
                                                        "table, and make none")
    arguments = parser.parse_args()
    try:
        if arguments.made:
            print(drawn_as_made(arguments))
            sys.exit()
        print(main(arguments.folder, arguments.ogc, arguments.scale, arguments.backend, arguments.without))
    except (RunError, csv.Error) as error:
        sys.exit(f"fig21: {error}")
