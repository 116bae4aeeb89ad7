"""Fig. 20: one iteration a step, by OGC and by IPC: frames 0, 50 and 80 (of 10 steps each), kinetic energy and centre
of mass over time."""

import sys
from pathlib import Path

import numpy as np

from paper_figures.workflow import commands
from paper_figures.workflow.common import baseline_arguments, label
from paper_figures.workflow.runs import provenance, run_job, write_table
from plots import render, style
from ogc_testbed.runs import RunError, commits_in_words
from plots.scene_figure import bodies_of

SCENE = commands.ONE_ITERATION
CAMERA = ((1.3, 0.5, 1.5), (-0.1, -0.25, 0.0), (0, 1, 0))
FRAMES = (0, 50, 80)


def centre(run):
    """Returns time [s] and mean height [m] of the cloth's vertices in each frame. The mean height differs from the
    centre of mass only because vertices at the rim are lighter."""
    body = run.bodies()[0]
    cloth = slice(body["first_vertex"], body["first_vertex"] + body["vertex_count"])
    frames = [run.frame(path) for path in run.frames]
    return np.array([f.time for f in frames]), np.array([f.positions[cloth, 1].mean() for f in frames])


def rows(runs):
    """Returns a row for each run and shown frame: kinetic energy and mean height in the frame, the run's largest
    kinetic energy, and the largest loss of kinetic energy in one step."""
    result = []
    for run in runs:
        energy, last = run.column("kinetic_energy"), int(run.column("step")[-1])
        heights = dict(zip(*centre(run)))
        for frame_number in FRAMES:
            frame = run.frame_at_step(round(frame_number / FRAMES[-1] * last))
            result.append({"frame": frame_number, "time [s]": frame.time,
                           "kinetic energy [J]": float(energy[frame.step - 1]) if frame.step else 0.0,
                           "mean height [m]": float(heights[frame.time]),
                           "largest kinetic energy [J]": float(energy.max()),
                           "largest loss in one step [J]": float(-np.diff(energy).min()), **provenance(run)})
    return result


def draw(runs, out):
    plt = style.use()
    figure = plt.figure(figsize=(11, 3.2 * len(runs) + 3))
    grid = figure.add_gridspec(len(runs) + 1, 6)
    usable, reason = render.available()
    for row, run in enumerate(runs):
        last = run.column("step")[-1]
        for column, frame_number in enumerate(FRAMES):
            axes = figure.add_subplot(grid[row, 2 * column:2 * column + 2])
            axes.axis("off")
            frame = run.frame_at_step(round(frame_number / FRAMES[-1] * last))
            axes.set_title(f"{label(run)}, step {frame.step}")
            if usable:
                axes.imshow(render.picture(bodies_of(run, frame), CAMERA))
            else:
                axes.text(0.5, 0.5, reason, ha="center", wrap=True, transform=axes.transAxes)
    energy, height = figure.add_subplot(grid[-1, :3]), figure.add_subplot(grid[-1, 3:])
    lines = []
    for run, dash in zip(runs, style.DASHES):
        h = run.setting("time_step")
        energy.plot(run.column("step") * h, run.column("kinetic_energy"), dash, label=label(run))
        time, mean = centre(run)
        height.plot(time, mean, dash, label=label(run))
        lines.append(f"{label(run)}: at t = {time[-1]:.3g} s kinetic energy {run.column('kinetic_energy')[-1]:.3g} J "
                     "(largest "
                     f"{run.column('kinetic_energy').max():.3g} J), mean height {mean[-1]:.4g} m, "
                     f"{np.mean(run.column('wall')):.4g} ms a step")
    energy.set(xlabel="time [s]", ylabel="energy [J]", title="Kinetic energy", ylim=(0, None))
    height.set(xlabel="time [s]", ylabel="height [m]", title="Mean height of the cloth")
    for axes in (energy, height):
        axes.legend()
    figure.suptitle(f"{SCENE} ({runs[0].manifest['scale']}); {commits_in_words(runs)}", fontsize=9)
    style.save(figure, out)
    return lines


def runs_of(arguments):
    return [run_job(arguments.ogc, job, arguments.folder)
            for job in commands.beside_ipc(SCENE, arguments.scale, arguments.backend, arguments.membrane)]


if __name__ == "__main__":
    options = baseline_arguments(__doc__.splitlines()[0], backends=("cpu", "cuda")).parse_args()
    try:
        found = runs_of(options)
        write_table(Path(options.folder) / "fig20.csv", rows(found))
        print("\n".join(draw(found, Path(options.folder) / "fig20.png")))
    except RunError as error:
        sys.exit(f"fig20: {error}")
