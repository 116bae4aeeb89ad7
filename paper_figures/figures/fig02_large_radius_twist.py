"""Fig. 2: the end of half a turn with a contact radius of one edge, by IPC and by OGC, and the artefact in numbers:
roughness, stretch, kinetic energy."""

import sys
from pathlib import Path

import numpy as np

from paper_figures.workflow import commands
from paper_figures.workflow.common import baseline_arguments, ipc_windows, label
from paper_figures.workflow.runs import provenance, run_job, write_table
from plots import render, style
from ogc_testbed.runs import Run, RunError, commits_in_words
from plots.scene_figure import bodies_of

SCENE = commands.TWIST
CAMERA = ((0.75, 0.85, 1.25), (0, 0, 0), (0, 1, 0))


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


def draw(runs, out):
    """Draws the last common state of the first two runs (or of the only run), and curves of all runs."""
    plt = style.use()
    figure = plt.figure(figsize=(11, 8))
    grid = figure.add_gridspec(2, 6, height_ratios=[1.2, 1])
    usable, reason = render.available()
    axes = [figure.add_subplot(grid[1, 2 * i:2 * i + 2]) for i in range(3)]
    both_at = min(int(run.column("step")[-1]) for run in runs[:2])  # the last step that both reached
    shown_runs = runs[:2]
    for i, run in enumerate(shown_runs):
        picture = figure.add_subplot(grid[0, 3 * i:3 * i + 3] if len(shown_runs) > 1 else grid[0, :])
        picture.axis("off")
        shown = run.frame_at_step(both_at)
        picture.set_title(f"{label(run)}, t = {shown.time:.3g} s")
        if usable:
            picture.imshow(render.picture(bodies_of(run, shown), CAMERA))
        else:
            picture.text(0.5, 0.5, reason, ha="center", wrap=True, transform=picture.transAxes)
    lines, rows = [], []
    ogc = next(run for run in runs if run.manifest["solver"] == "vbd")
    rest = ogc.frame(ogc.frames[0]).positions.astype(float)  # a window does not begin at rest
    for run, dash in zip(runs, style.DASHES):
        time, rough, stretched = history(run, rest)
        h = run.setting("time_step")
        axes[0].plot(time, rough, dash, label=label(run))
        axes[1].fill_between(time, stretched[:, 0], stretched[:, 2], alpha=0.3)
        axes[1].plot(time, stretched[:, 1], dash, label=f"{label(run)}: median, 1 % to 99 %")
        axes[2].plot(run.column("step") * h, run.column("kinetic_energy"), dash, label=label(run))
        steps = run.column("step")
        energies = dict(zip(steps.astype(int), run.column("kinetic_energy")))
        for at in sorted({np.searchsorted(time, min(both_at * h, time[-1]) - h / 2), len(time) - 1}):
            energy = energies.get(round(time[at] / h), np.nan)  # a run has no energy for the state with which it began
            lines.append(f"{label(run)}: at t = {time[at]:.3g} s roughness {rough[at]:.3g} edges, stretch "
                         f"{stretched[at][0]:.3g} … {stretched[at][2]:.3g}, "
                         f"kinetic energy {energy:.3g} J")
            stretches = dict(zip(("stretch 1 % [1]", "stretch median [1]", "stretch 99 % [1]"), stretched[at]))
            rows.append({"time [s]": time[at], "roughness [edges]": rough[at], **stretches,
                         "kinetic energy [J]": energy, "iterations a step": np.mean(run.column("iterations")),
                         **provenance(run)})
        lines.append(f"{label(run)}: {len(steps)} steps, {np.mean(run.column('wall')):.4g} ms and "
                     f"{np.mean(run.column('iterations')):.3g} iterations a step, "
                     f"{np.mean(run.column('vertex_facet_contacts') + run.column('edge_edge_contacts')):.4g} pairs")
    axes[0].set(xlabel="time [s]", ylabel="edge lengths", title="Out-of-plane roughness", ylim=(0, None))
    axes[1].set(xlabel="time [s]", ylabel="length / rest length", title="Stretch of edges")
    axes[2].set(xlabel="time [s]", ylabel="energy [J]", title="Kinetic energy", yscale="log")
    for a in axes:
        a.legend()
    figure.suptitle(f"{SCENE} ({runs[0].manifest['scale']}); {commits_in_words(runs)}", fontsize=9)
    style.save(figure, out)
    write_table(Path(out).with_suffix(".csv"), rows)
    return lines


def runs_of(arguments):
    """Returns IPC's run and OGC's. At the paper's size IPC's whole run would take days; IPC then has windows of 20
    steps from states of OGC's run."""
    folder = Path(arguments.folder)
    ours, baseline = commands.beside_ipc(SCENE, arguments.scale, arguments.backend, arguments.membrane)
    ogc = run_job(arguments.ogc, ours, folder)
    if arguments.without_ipc:
        found = sorted((Run(path.parent) for path in folder.glob("ipc*/run.json")),
                       key=lambda run: run.column("step")[0])
        return [*found[-1:], ogc, *found[:-1]]
    if arguments.scale != "paper":
        return [run_job(arguments.ogc, baseline, folder), ogc]
    *earlier, last = ipc_windows(arguments, SCENE, ogc, commands.TWIST_WINDOWS)
    return [last, ogc, *earlier]


if __name__ == "__main__":
    parser = baseline_arguments(__doc__.splitlines()[0], backends=("cpu", "cuda"))
    parser.add_argument("--without-ipc", action="store_true",
                        help="OGC's run, and those of IPC that are there: makes none")
    options = parser.parse_args()
    try:
        print("\n".join(draw(runs_of(options), Path(options.folder) / "fig02.png")))
    except RunError as error:
        sys.exit(f"fig02: {error}")
