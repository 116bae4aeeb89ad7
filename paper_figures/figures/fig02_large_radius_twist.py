"""Fig. 2: the end of half a turn with a contact radius of one edge, by IPC and by OGC, and the artefact in numbers:
roughness, stretch, kinetic energy."""

import sys
from pathlib import Path

import numpy as np

from paper_figures.workflow import commands
from paper_figures.workflow.common import baseline_arguments, ipc_windows, label
from paper_figures.workflow.runs import provenance, run_job, write_table
from plots import style
from plots.camera import around, fitted, subject
from plots.scene_figure import moment, show, source_of
from ogc_testbed.runs import Run, RunError

SCENE = commands.TWIST
SIZE, NEAR, MIDDLE = (960, 560), (960, 480), 0.16  # pixels; what is shown from near, around the middle [m]
TITLE = "Fig. 2. {turned} with a contact radius of one edge: {ends}"
ALIKE = 1.25  # quotient of the roughness by two methods up to which they are called about equally rough
ALT = ("Renderings of a square cloth after half a turn, by IPC on the left and by OGC on the right, whole and from "
       "near: a sheet, blue in front and sand behind, wound once about its middle, with folds that run towards the "
       "ends. Curves over time: out-of-plane roughness, stretch of edges, and kinetic energy. Roughness at the end, in "
       "edge lengths: {said}.")


def edges_of(triangles):
    pairs = np.sort(np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), axis=1)
    return np.unique(pairs, axis=0)


def roughness(positions, triangles):
    """Returns the roughness, in mean edge lengths: the root mean square, over inner vertices, of the distance along the
    normal from the mean of the neighbours."""
    edges = edges_of(triangles)
    count, (mean, normal) = np.zeros(len(positions)), np.zeros((2, *positions.shape))
    for a, b in ((0, 1), (1, 0)):
        np.add.at(count, edges[:, a], 1)
        np.add.at(mean, edges[:, a], positions[edges[:, b]])
    face = np.cross(positions[triangles[:, 1]] - positions[triangles[:, 0]],
                    positions[triangles[:, 2]] - positions[triangles[:, 0]])
    for corner in range(3):
        np.add.at(normal, triangles[:, corner], face)
    used = np.zeros((len(positions),), dtype=int)
    for corner in range(3):
        np.add.at(used, triangles[:, corner], 1)
    inner = (count == used) & (count > 0)  # as many triangles as neighbours: not on a boundary
    unit = normal[inner] / np.linalg.norm(normal[inner], axis=1, keepdims=True)
    offset = np.einsum("ij,ij->i", positions[inner] - mean[inner] / count[inner, None], unit)
    length = np.linalg.norm(positions[edges[:, 0]] - positions[edges[:, 1]], axis=1).mean()
    return float(np.sqrt(np.mean(offset**2)) / length)


def stretch(positions, rest, triangles):
    """Returns the ratio of edge lengths to their rest lengths: 1st percentile, median, 99th percentile."""
    edges = edges_of(triangles)
    length = [np.linalg.norm(x[edges[:, 0]] - x[edges[:, 1]], axis=1) for x in (positions, rest)]
    return np.percentile(length[0] / length[1], [1, 50, 99])


def history(run, rest):
    """Returns time [s], roughness and stretch of each stored frame; `rest`: positions of the rest shape."""
    triangles = run.bodies()[0]["triangles"]
    frames = [run.frame(path) for path in run.frames]
    return (np.array([f.time for f in frames]),
            np.array([roughness(f.positions.astype(float), triangles) for f in frames]),
            np.array([stretch(f.positions.astype(float), rest, triangles) for f in frames]))


def rows_of(runs):
    """Returns the table: roughness, stretch and kinetic energy of each run at the last step that both first runs
    reached, and at its own end."""
    both_at = min(int(run.column("step")[-1]) for run in runs[:2])
    ogc = next(run for run in runs if run.manifest["solver"] == "vbd")
    rest = ogc.frame(ogc.frames[0]).positions.astype(float)  # a window does not begin at rest
    rows = []
    for run in runs:
        time, rough, stretched = history(run, rest)
        h, energies = run.setting("time_step"), dict(zip(run.column("step").astype(int), run.column("kinetic_energy")))
        for at in sorted({np.searchsorted(time, min(both_at * h, time[-1]) - h / 2), len(time) - 1}):
            stretches = dict(zip(("stretch 1 % [1]", "stretch median [1]", "stretch 99 % [1]"), stretched[at]))
            rows.append({"time [s]": time[at], "roughness [edges]": rough[at], **stretches,
                         # a run has no energy for the state with which it began
                         "kinetic energy [J]": energies.get(round(time[at] / h), np.nan),
                         "iterations a step": np.mean(run.column("iterations")), **provenance(run)})
    return rows


def title_of(ends, turned="Half a turn"):
    """Returns the title, which says whose cloth is rougher. `ends`: name -> roughness at the last common time;
    `turned`: what both runs have done until then."""
    if not {"IPC", "VBD-OGC"} <= set(ends):
        return TITLE.format(turned=turned, ends="OGC's cloth, and IPC's in a window")
    ratio = ends["IPC"] / ends["VBD-OGC"]
    if 1 / ALIKE <= ratio <= ALIKE:
        return TITLE.format(turned=turned, ends="IPC's cloth and OGC's are about equally rough")
    rougher, smoother = ("IPC's", "OGC's") if ratio > 1 else ("OGC's", "IPC's")
    return TITLE.format(turned=turned, ends=f"{rougher} cloth is rougher than {smoother}")


def whole(run):
    """Returns whether the run begins at the scene's start; a window begins with a state of OGC's run."""
    return run is not None and run.column("step")[0] == 1


def size_of(run):
    """Returns the vertices along both sides of the cloth in words."""
    side = round(run.bodies()[0]["vertex_count"] ** 0.5)
    return f"{side} × {side} vertices"


def frames_of(runs):
    """Returns a frame of each run: of whole runs the last that both stored; of a window of IPC's its last, beside the
    state of OGC's run from which it began."""
    ipc, ogc = runs
    if ipc is None or not whole(ipc):
        begins = ipc and int(ipc.column("step")[0]) - 1
        return ipc and ipc.frame(ipc.frames[-1]), ogc and ogc.frame_at_step(begins or ogc.column("step")[-1])
    steps = [{int(path.stem.removeprefix("frame_")) for path in run.frames} for run in runs if run]
    last = max(set.intersection(*steps))
    return ipc.frame_at_step(last), ogc and ogc.frame_at_step(last)


def draw_pair(axes, runs, edges, reach=None, sizes=False):
    """Draws states of IPC's run and OGC's, side by side; `reach` [m]: of what is shown; `sizes`: titles name them."""
    frames, camera = frames_of(runs), None
    if reach and runs[1]:  # both from the same place
        points = subject(runs[1], frames[1])
        camera = around(points, np.median(points, axis=0), reach, runs[1], size=NEAR)
    for place, run, frame, letter, name in zip(axes, runs, frames, "ab", ("IPC", "OGC")):
        title = f"({letter}) {name}, r = {edges}" + (", from near" if reach else "")
        if run is None:
            style.not_run(place)
            place.set_title(title)
            continue
        size = NEAR if reach else SIZE
        begins = int(run.column("step")[0]) - 1
        title += f", {frame.step - begins} steps from OGC's state" if begins else ""
        title += f", {size_of(run)}" if sizes else ""
        show(place, run, frame, camera or fitted(run, [frame], size), f"{title}, {moment(frame)}", size)


def draw(runs, out, wide=(None, None)):
    """Draws the last states and close views by IPC and OGC with r of one edge; states with r of ten edges (`wide`); and
    curves of all runs. Returns a line about each run."""
    style.use()
    ipc = next((run for run in runs if run.manifest["solver"] == "ipc"), None)
    ogc = next(run for run in runs if run.manifest["solver"] == "vbd")
    rest = ogc.frame(ogc.frames[0]).positions.astype(float)
    third = [(1 / 3, "plot")] * 3
    rows = [style.pictures(2, SIZE), style.pictures(2, NEAR)]
    if any(wide):
        rows.append(style.pictures(2, SIZE))
    curves, lines = [(f"{label(run).split(',')[0]}", run) for run in (ipc, ogc) if run], []
    curves += [(f"{label(run).split(',')[0]}, ten edges", run) for run in wide if run]
    found = {name: history(run, rest) for name, run in curves}
    until = min((found[name][0][-1] for name, run in curves if whole(run) and "edges" not in name), default=0)
    ends = {name: rough[np.searchsorted(time, until + 1e-6) - 1] for name, (time, rough, _) in found.items()
            if time[0] == 0}
    scale = ogc.manifest["scale"]
    below = (f"{size_of(ogc)}{'' if scale == 'paper' else f' (scale {scale}; the paper has 200 × 200)'}; "
             f"roughness at {until:.3g} s [edge lengths]: "
             + ", ".join(f"{name} {rough:.2g}" for name, rough in ends.items())
             + (f"; IPC's curve: a window of {len(ipc.column('step'))} steps from OGC's state"
             if ipc and not whole(ipc) else ""))
    all_done = until >= 0.99 * ogc.column("step")[-1] * ogc.setting("time_step")
    title = title_of(ends if whole(ipc) else {}, "Half a turn" if all_done else f"{until:.2g} s of half a turn")
    figure, axes = style.page([*rows, (2.4, third)], title, below)
    draw_pair(axes[0], (ipc, ogc), "one edge")
    draw_pair(axes[1], (ipc, ogc), "one edge", MIDDLE)
    if any(wide):
        draw_pair(axes[2], wide, "ten edges", sizes=True)
    rough_axes, stretch_axes, energy_axes = axes[-1]
    for (name, run), colour in zip(curves, (style.BASELINE, style.OURS, style.COLOURS[1], style.COLOURS[4])):
        time, rough, stretched = found[name]
        rough_axes.plot(time, rough, color=colour, label=name.replace(", ", ",\n"))
        stretch_axes.fill_between(time, stretched[:, 0], stretched[:, 2], alpha=0.25, color=colour)
        stretch_axes.plot(time, stretched[:, 1], color=colour, label=name.replace(", ", ",\n"))
        steps, h = run.column("step"), run.setting("time_step")
        energy_axes.plot(steps * h, run.column("kinetic_energy"), color=colour, linewidth=0.8,
                         label=name.replace(", ", ",\n"))
        lines.append(f"{name}: {len(steps)} steps, {np.mean(run.column('wall')):.4g} ms and "
                     f"{np.mean(run.column('iterations')):.3g} iterations a step, roughness {rough[-1]:.3g} edges at t "
                     f"= {time[-1]:.3g} s")
    rough_axes.set(xlabel="time [s]", ylabel="edge lengths", title="Out-of-plane roughness", ylim=(0, None))
    stretch_axes.set(xlabel="time [s]", ylabel="length / rest length", title="Stretch of edges, median, 1 % to 99 %")
    energy_axes.set(xlabel="time [s]", ylabel="energy [J]", title="Kinetic energy", yscale="log")
    if any(wide):
        stretch_axes.set_yscale("log")
    for place in axes[-1]:
        style.label_ends(place)
    said = ", ".join(f"{name} {rough:.2g}" for name, rough in ends.items())
    style.save(figure, out, title, ALT.format(said=said), source_of([run for _, run in curves]))
    return lines


def runs_of(arguments):
    """Returns IPC's run and OGC's. At the paper's size IPC's whole run would take days; IPC then has windows of 20
    steps from states of OGC's run."""
    folder = Path(arguments.folder)
    if arguments.made:
        windows = sorted((Run(path.parent) for path in folder.glob("ipc*/run.json") if "wide" not in path.parent.name),
                         key=lambda run: run.column("step")[0])
        return [*windows[-1:], Run(folder / "vbd"), *windows[:-1]]
    ours, baseline = commands.beside_ipc(SCENE, arguments.scale, arguments.backend, arguments.membrane)
    ogc = run_job(arguments.ogc, ours, folder)
    if arguments.scale != "paper":
        return [run_job(arguments.ogc, baseline, folder), ogc]
    *earlier, last = ipc_windows(arguments, SCENE, ogc, commands.TWIST_WINDOWS)
    return [last, ogc, *earlier]


def wide_runs(folder):
    """Returns the runs of IPC and OGC with r of ten edges, if they lie in the folder."""
    return [Run(folder / name) if (folder / name / "run.json").is_file() else None for name in ("ipc_wide", "vbd_wide")]


if __name__ == "__main__":
    parser = baseline_arguments(__doc__.splitlines()[0], backends=("cpu", "cuda"))
    parser.add_argument("--made", action="store_true", help="draw the runs that are there, and make none")
    options = parser.parse_args()
    try:
        found_runs, into = runs_of(options), Path(options.folder)
        write_table(into / "fig02.csv", rows_of(found_runs))
        print("\n".join(draw(found_runs, into / "fig02.png", wide_runs(into))))
    except RunError as error:
        sys.exit(f"fig02: {error}")
