"""Fig. 2: half a turn of a cloth with a contact radius r of one edge and of ten, by IPC and by OGC, and the artefact in
numbers: how far vertices bulge, how far edges are stretched, kinetic energy.

Folds are no artefact, so that a distance from the mean of the neighbours, which folds have, measures nothing here. The
*angle defect* of an inner vertex is |2π − the sum of the angles around it|: 0 for every fold of a sheet that keeps its
shape (Gauss), K A for a smooth surface of curvature K and a vertex's share A of the area, and about 3 a² for a vertex
of a square grid that stands a edges above its neighbours' plane.
"""

import sys
from pathlib import Path

import numpy as np

from paper_figures.workflow import commands, half_turn
from paper_figures.workflow.common import baseline_arguments
from paper_figures.workflow.jobs import ENDED_BY_TIME
from paper_figures.workflow.runs import provenance, run_job, write_table
from plots import style
from plots.camera import around, fitted, subject
from plots.scene_figure import moment, show, source_of
from ogc_testbed.runs import Run, RunError

SCENE, OGC = commands.TWIST, "vbd"
SIZE, NEAR, MIDDLE = (960, 560), (960, 480), 0.16  # pixels; what is shown from near, around the middle [m]
FEW, TORN = 5, 1.5  # states; length of the median edge over that at rest
VISIBLE = 0.03  # angle defect of bulges of a tenth of an edge, which turn faces by 11° [rad]
# Names in pictures and at curves, by the run's folder.
NAMES = {OGC: "OGC", "vbd_thin": "OGC, r = 1/5 edge", "vbd_rings": "OGC, two rings left out",
         "vbd_k10": "OGC, k_c = 10 N/m", "vbd_k1": "OGC, k_c = 1 N/m",
         "ipc": "IPC", "ipc_stiff": "IPC, as stiff as OGC", "pairs": "IPC's set in OGC's solver",
         "vbd_wide": "OGC, r = ten edges",
         "vbd_wide_k10": "OGC, ten edges, k_c = 10 N/m", "vbd_wide_k1": "OGC, ten edges, k_c = 1 N/m",
         "vbd_wide_k0.1": "OGC, ten edges, k_c = 0.1 N/m",
         "vbd_wide_excluded": "OGC, ten edges, near ones left out"}
EDGE, TEN = ("pairs", "ipc", OGC, "vbd_rings"), ("vbd_wide", "vbd_wide_k1", "vbd_wide_excluded")  # rows of pictures
CURVES = {OGC: style.OURS, "vbd_rings": style.COLOURS[2], "ipc": style.BASELINE, "pairs": style.COLOURS[5],
          "ipc_stiff": style.COLOURS[1], "vbd_wide": style.COLOURS[4], "vbd_wide_k1": "0.6",
          "vbd_wide_excluded": style.COLOURS[6]}
# Whose contacts the title compares with OGC's set, and how stiff they are.
SETS = {"pairs": "IPC's contact set at OGC's stiffness", "ipc_stiff": "IPC's contact set at OGC's stiffness",
        "ipc": "IPC's contact set"}
ALT = ("Renderings of a square cloth that is twisted by half a turn, pairs of methods side by side: a sheet, blue in "
       "front and sand behind, wound once about its middle. Curves over time: angle defect of the vertices, stretch of "
       "edges, and kinetic energy. At the last states: {said}.")


def edges_of(triangles):
    pairs = np.sort(np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), axis=1)
    return np.unique(pairs, axis=0)


def angle_defects(positions, triangles):
    """Returns |2π − the sum of the angles around the vertex| of each inner vertex [rad]."""
    total, used, count = np.zeros((3, len(positions)))
    for k in range(3):
        apex, *ends = (positions[triangles[:, (k + i) % 3]] for i in range(3))
        u, v = (end - apex for end in ends)
        angle = np.arctan2(np.linalg.norm(np.cross(u, v), axis=1), np.einsum("ij,ij->i", u, v))
        np.add.at(total, triangles[:, k], angle)
        np.add.at(used, triangles[:, k], 1)
    edges = edges_of(triangles)
    for k in range(2):
        np.add.at(count, edges[:, k], 1)
    inner = (count == used) & (count > 0)  # as many triangles as neighbours: not on a boundary
    return np.abs(2 * np.pi - total[inner])


def stretch(positions, rest, triangles):
    """Returns the ratio of edge lengths to their rest lengths: 1st percentile, median, 99th percentile."""
    edges = edges_of(triangles)
    length = [np.linalg.norm(x[edges[:, 0]] - x[edges[:, 1]], axis=1) for x in (positions, rest)]
    return np.percentile(length[0] / length[1], [1, 50, 99])


def history(run, rest):
    """Returns time [s], mean angle defect [rad] and stretch of each stored frame; `rest`: positions at rest."""
    triangles = run.bodies()[0]["triangles"]
    frames = [run.frame(path) for path in run.frames]
    return (np.array([f.time for f in frames]),
            np.array([angle_defects(f.positions.astype(float), triangles).mean() for f in frames]),
            np.array([stretch(f.positions.astype(float), rest, triangles) for f in frames]))


def rest_of(runs):
    """Returns the positions at rest, from a run that stored its start. Throws RunError if none did."""
    for run in runs.values():
        start = run.frame(run.frames[0])
        if start.step == 0:
            return start.positions.astype(float)
    raise RunError("no run stored step 0, by which stretch is measured: keep frame_000000.h5 of one")


def rows_of(runs):
    """Returns the table: the last stored state of each run, beside OGC's at that time. `runs`: folder's name -> run."""
    rest = rest_of(runs)
    times, defects, stretches = history(runs[OGC], rest)
    rows = []
    for name, run in runs.items():
        time, defect, stretched = history(run, rest)
        h, energies = run.setting("time_step"), dict(zip(run.column("step").astype(int), run.column("kinetic_energy")))
        rows.append({"run": name, "at": "end" if run.status == "finished" else "cut off",
                     "steps [1]": len(run.column("step")), "time [s]": time[-1], "angle defect [rad]": defect[-1],
                     **dict(zip(("stretch 1 % [1]", "stretch median [1]", "stretch 99 % [1]"), stretched[-1])),
                     "angle defect of OGC then [rad]": np.interp(time[-1], times, defects),
                     "stretch median of OGC then [1]": np.interp(time[-1], times, stretches[:, 1]),
                     # a run has no energy for the state with which it began
                     "kinetic energy [J]": energies.get(round(time[-1] / h), np.nan),
                     "iterations a step": np.mean(run.column("iterations")), **provenance(run)})
    return rows


def variant_rows(runs):
    """Returns the table of variants at ten edges: their contacts when these began, and their last state."""
    rest, rows = rest_of(runs), []
    for name, run in runs.items():
        contacts = {kind: run.column(f"{kind}_contacts") for kind in ("vertex_facet", "edge_edge")}
        some = np.flatnonzero(contacts["edge_edge"] + contacts["vertex_facet"])
        time, defect, stretched = history(run, rest)
        rows.append({"variant": name,
                     "first step with contacts [1]": run.column("step")[some[0]] if len(some) else np.nan,
                     **{f"{kind} contacts then [1]": found[some[0]] if len(some) else 0
                        for kind, found in contacts.items()},
                     "time [s]": time[-1], "angle defect [rad]": defect[-1],
                     **dict(zip(("stretch 1 % [1]", "stretch median [1]", "stretch 99 % [1]"), stretched[-1])),
                     "largest kinetic energy [J]": run.column("kinetic_energy").max(), **provenance(run)})
    return rows


def title_of(rows):
    """Returns the title: what the table says about IPC's contacts and OGC's. `rows`: run -> row."""
    other, ours = next((name for name in SETS if name in rows), None), rows[OGC]
    theirs = rows.get(other)
    bulges, without = ours["angle defect [rad]"], rows.get("vbd_rings", ours)["angle defect [rad]"]
    words = []
    if theirs:
        apart = theirs["stretch median [1]"] - theirs["stretch median of OGC then [1]"]
        bulged = theirs["angle defect [rad]"] >= max(VISIBLE, 2 * theirs["angle defect of OGC then [rad]"])
        words.append(f"{SETS[other]} " + (
            f"stretches the sheet by {100 * (theirs['stretch median [1]'] - 1):.0f} %" if apart >= 0.01 else
            "bulges the sheet" if bulged else "leaves the sheet smooth"))
    whose, sheet = ("OGC's", "it") if words else ("OGC's contact set", "the sheet")
    words.append(f"{whose} leaves {sheet} smooth" if bulges < VISIBLE else f"{whose} bulges {sheet}" + (
        " only by its own neighbours" if without <= bulges / 2 else ""))
    if not theirs and "vbd_wide" in rows:
        longer = rows["vbd_wide"]["stretch median [1]"]
        words.append("with r of ten edges, too" if longer < TORN else
                     f"with r of ten edges it blows it up, edges {longer:.2g} times as long")
    return f"Fig. 2. {'; '.join(words)}"


def size_of(run):
    """Returns the vertices along both sides of the cloth in words."""
    side = round(run.bodies()[0]["vertex_count"] ** 0.5)
    return f"{side} × {side} vertices"


def frame_beside(run, others):
    """Returns the last frame of a run; of OGC's run the one at the latest time that another run reached, so that states
    are compared."""
    if run.manifest["solver"] != "vbd" or not others:
        return run.frame(run.frames[-1])
    return run.frame_at_step(max(int(other.column("step")[-1]) for other in others))


def draw_row(axes, runs, names, letters, reach=None):
    """Draws states of runs side by side, whole or, from one place, so much of them (`reach` [m])."""
    for place, letter, name in zip(axes, letters, names):
        if name not in runs:
            style.not_run(place, f"({letter}) {NAMES[name]}: not run, or no step in its time")
    there = [(place, letter, name) for place, letter, name in zip(axes, letters, names) if name in runs]
    axes, letters, names = zip(*there)
    others = [runs[name] for name in names if runs[name].manifest["solver"] != "vbd"]
    shown = [(runs[name], frame_beside(runs[name], others if name == OGC else [])) for name in names]
    size, camera = (NEAR, None) if reach else (SIZE, None)
    if reach:
        points = subject(*shown[-1])
        camera = around(points, np.median(points, axis=0), reach, shown[-1][0], size=NEAR)
    for place, (run, frame), letter, name in zip(axes, shown, letters, names):
        show(place, run, frame, camera or fitted(run, [frame], size),
             f"({letter}) {NAMES[name]}, {'from near' if reach else moment(frame)}", size)


def draw(runs, out):
    """Draws states at r = one edge, whole and from near, states at ten edges, and curves of all runs. `runs`: folder's
    name -> run. Returns a line about each run."""
    style.use()
    rest, rows = rest_of(runs), {row["run"]: row for row in rows_of(runs)}
    whole_size = runs[OGC].manifest["scale"] == "paper"  # of which there are fewer runs
    edge = [name for name in EDGE if name in runs or not whole_size]
    ten = [name for name in TEN if name in runs]
    shown = [(edge, None), (edge, MIDDLE), *([(ten, None)] if ten else [])]
    sizes = [style.pictures(len(names), NEAR if reach else SIZE) for names, reach in shown]
    # Few states show no course.
    curves = 1 if all(len(run.frames) < FEW for run in runs.values()) else 3
    figure, axes = style.page([*sizes, (2.4, [(1 / curves, "plot")] * curves), (0.55, [(1, "picture")])],
                              title_of(rows), below_of(runs, rows))
    letters = iter("abcdefghijklmnop")
    for places, (names, reach) in zip(axes, shown):
        draw_row(places, runs, names, [next(letters) for _ in names], reach)
    draw_curves(axes[-2], runs, rest)
    style.key(axes[-1][0], axes[-2][-1].get_lines())
    said = ", ".join(f"{NAMES.get(name, name)} {row['angle defect [rad]']:.2g} rad, edges stretched by "
                     f"{row['stretch median [1]']:.3g}" for name, row in rows.items())
    style.save(figure, out, title_of(rows), ALT.format(said=said), source_of(list(runs.values())))
    return [f"{name}: {row['steps [1]']} steps, {row['iterations a step']:.3g} iterations a step, angle defect "
            f"{row['angle defect [rad]']:.3g} rad, stretch {row['stretch median [1]']:.3g} at t = {row['time [s]']:.3g}"
            " s" for name, row in rows.items()]


def below_of(runs, rows):
    """Returns the line below the title: the sizes, and how the last states compare."""
    scale = runs[OGC].manifest["scale"]
    small = "" if scale == "paper" else f" (scale {scale}; the paper has 200 × 200)"
    found = ", ".join(f"{NAMES[name].replace(', ', ' at ', 1) if 'wide' in name else NAMES[name]} "
                      f"{row['angle defect [rad]']:.2g}" + ("" if row["at"] == "end" else
                                                            f" (at {row['time [s]']:.2g} s)")
                      for name, row in rows.items() if name in CURVES)
    return (f"{size_of(runs[OGC])}{small}, r = one edge where nothing else is said; mean angle defect [rad], which is "
            f"0.03 where vertices stand a tenth of an edge out: {found}")


def draw_curves(panels, runs, rest):
    """Draws the kinetic energy of runs, and before it in two panels, if there are three, what states show."""
    *courses, energy = panels
    for name, colour in CURVES.items():
        if name not in runs:
            continue
        run = runs[name]
        time, defect, stretches = history(run, rest)
        for panel, values in zip(courses, (defect, stretches[:, 1])):
            panel.plot(time[time > 0], values[time > 0], color=colour)
        energy.plot(run.column("step") * run.setting("time_step"), run.column("kinetic_energy"), color=colour,
                    linewidth=0.8, label=NAMES[name])
    energy.set(xlabel="time [s]", ylabel="energy [J]", title="Kinetic energy", yscale="log")
    if not courses:
        return
    bulges, stretched = courses
    bulges.axhline(VISIBLE, color=style.PAPER, linewidth=0.8, linestyle=":")
    bulges.set(xlabel="time [s]", ylabel="angle defect [rad]", title="Bulges; dotted: a tenth of an edge", yscale="log")
    stretched.set(xlabel="time [s]", ylabel="length / rest length", title="Stretch of edges, median")


def has_steps(folder):
    """Returns whether a run has a step: one whose first step takes longer than its time has none."""
    rows = Path(folder) / "steps.csv"
    return rows.is_file() and rows.read_text().count("\n") > 1


def runs_of(arguments):
    """Returns folder's name -> run. At the paper's size IPC's run would take days, and is none."""
    folder = Path(arguments.folder)
    if arguments.made:
        return {name: Run(folder / name) for name in NAMES if has_steps(folder / name)}
    runs = {job.name: run_job(arguments.ogc, job, folder)
            for job in half_turn.ogc(arguments.scale, arguments.backend, arguments.membrane)}
    for job in half_turn.ipc(arguments.scale, arguments.membrane) if arguments.scale != "paper" else ():
        try:
            runs[job.name] = run_job(arguments.ogc, job, folder)
        except RunError:
            if not (folder / job.name / ENDED_BY_TIME).is_file():  # else no step ended in its time
                raise
    return runs


if __name__ == "__main__":
    parser = baseline_arguments(__doc__.splitlines()[0], backends=("cpu", "cuda"))
    parser.add_argument("--made", action="store_true", help="draw the runs that are there, and make none")
    parser.add_argument("--variants", choices=("variants", "neighbours", "wide_softer"),
                        help="instead: a table of OGC's runs with one choice varied, at ten edges or at one")
    options = parser.parse_args()
    try:
        into = Path(options.folder)
        if options.variants:
            jobs = getattr(half_turn, options.variants)(options.scale, options.backend)
            made = {job.name.partition("/")[2]: Run(into / job.name) if options.made else
                    run_job(options.ogc, job, into) for job in jobs}
            write_table(into / f"fig02_{options.variants}.csv", variant_rows(made))
            sys.exit()
        found_runs = runs_of(options)
        write_table(into / "fig02.csv", rows_of(found_runs))
        print("\n".join(draw(found_runs, into / "fig02.png")))
    except RunError as error:
        sys.exit(f"fig02: {error}")
