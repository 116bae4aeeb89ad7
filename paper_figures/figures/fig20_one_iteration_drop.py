"""Fig. 20: one iteration a step, by OGC and by IPC: frames 0, 50 and 80 (of 10 steps each), and 20, in which IPC's
cloth has stopped and OGC's falls; kinetic energy, and height of the cloth over time."""

import sys
from pathlib import Path

import numpy as np

from paper_figures.workflow import commands
from paper_figures.workflow.common import baseline_arguments, label
from paper_figures.workflow.runs import provenance, run_job, write_table
from plots import render, style
from plots.camera import is_cloth, subject, view_of
from plots.scene_figure import WIDTH, show, source_of
from ogc_testbed.runs import RunError

SCENE, FRAMES = commands.ONE_ITERATION, (0, 50, 80)
SHOWN = (0, 20, 50, 80)
TITLE = "Fig. 20. With one iteration a step IPC loses the fall's energy at first self-contact; OGC keeps it"
ALT = ("Two rows of four renderings of a cloth that falls on a small sphere. Above, by OGC, it wraps the sphere and "
       "hangs down in folds; below, by IPC, it stops when parts of it first meet and hangs higher. Curves: kinetic "
       "energy and mean height over time; IPC loses {ipc:.2g} J of kinetic energy within one step, OGC {ogc:.2g} J at "
       "most.")


def centre(run):
    """Returns time [s] and mean height [m] of the cloth's vertices in each frame. The mean height differs from the
    centre of mass only because vertices at the rim are lighter."""
    body = run.bodies()[0]
    cloth = slice(body["first_vertex"], body["first_vertex"] + body["vertex_count"])
    frames = [run.frame(path) for path in run.frames]
    return np.array([f.time for f in frames]), np.array([f.positions[cloth, 1].mean() for f in frames])


def largest_loss(run):
    """Returns the largest loss of kinetic energy in one step [J]."""
    return float(-np.diff(run.column("kinetic_energy")).min())


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
                           "largest loss in one step [J]": largest_loss(run), **provenance(run)})
    return result


def draw(runs, out):
    """Draws a row of pictures for each run, and the curves. Returns a line about each run."""
    style.use()
    states = [[run.frame_at_step(round(number / FRAMES[-1] * run.column("step")[-1])) for number in SHOWN]
              for run in runs]
    # The first two frames have cameras of their own: the flat cloth is twice as wide as the fallen one.
    seen = [np.concatenate([subject(run, frame, bodies) for run, found in zip(runs, states) for frame in found[part]])
            for part, bodies in ((slice(0, 1), None), (slice(1, 2), None), (slice(2, None), is_cloth))]
    size = render.shape_of(view_of(SCENE), seen[-1], WIDTH, 0.7, 0.85)
    cameras = [view_of(SCENE).fit(points, size) for points in (*seen, seen[-1])]
    scale = runs[0].manifest["scale"]
    below = "4,900 vertices, one iteration in each step of 1/500 s" if scale == "paper" else f"scale {scale}"
    below += "; loss of kinetic energy in one step, at most: " + ", ".join(
        f"{label(run)} {largest_loss(run):.2g} of {run.column('kinetic_energy').max():.2g} J" for run in runs)
    figure, axes = style.page([*[style.pictures(len(SHOWN), size)] * len(runs), (2.5, [(0.5, "plot")] * 2)], TITLE,
                              below)
    for run, found, row in zip(runs, states, axes):
        for frame, place, camera in zip(found, row, cameras):
            show(place, run, frame, camera, f"{label(run)}, t = {frame.time:.2g} s", size)
    energy, height = axes[-1]
    lines = []
    for run, colour in zip(runs, (style.OURS, style.BASELINE)):
        h = run.setting("time_step")
        energy.plot(run.column("step") * h, run.column("kinetic_energy"), color=colour, label=label(run).split(",")[0])
        time, mean = centre(run)
        height.plot(time, mean, color=colour, label=label(run).split(",")[0])
        lines.append(f"{label(run)}: at t = {time[-1]:.3g} s kinetic energy {run.column('kinetic_energy')[-1]:.3g} J "
                     f"(largest {run.column('kinetic_energy').max():.3g} J), mean height {mean[-1]:.4g} m, "
                     f"{np.mean(run.column('wall')):.4g} ms a step")
    energy.set(xlabel="time [s]", ylabel="energy [J]", title="Kinetic energy", ylim=(0, None))
    height.set(xlabel="time [s]", ylabel="height [m]", title="Mean height of the cloth")
    for place in (energy, height):
        style.label_ends(place)
    losses = {run.manifest["solver"]: largest_loss(run) for run in runs}
    alt = ALT.format(ipc=losses.get("ipc", np.nan), ogc=losses.get("vbd", np.nan))
    style.save(figure, out, TITLE, alt, source_of(runs))
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
