"""Two runs of one scene held against each other: largest and root-mean-square distance of corresponding vertices over
time.

Not a figure of the paper: it shows from which step on two backends, or two builds, part ways.
"""

import argparse
import sys
from pathlib import Path

import numpy as np

from plots import style
from plots.run_folder import Run, RunError


def differences(first, second):
    """Returns (steps, largest, root mean square) [m] over the frames that both runs have."""
    seconds = {path.name: path for path in second.frames}
    rows = []
    for path in first.frames:
        if path.name in seconds:
            a, b = first.frame(path), second.frame(seconds[path.name])
            if a.positions.shape != b.positions.shape:
                raise RunError(f"{first.folder} and {second.folder} have different meshes: {a.positions.shape} and "
                               f"{b.positions.shape}")
            distance = np.linalg.norm(a.positions.astype(float) - b.positions.astype(float), axis=1)
            rows.append((a.step, distance.max(), np.sqrt(np.mean(distance**2))))
    if not rows:
        raise RunError(f"{first.folder} and {second.folder} have no frame in common")
    return np.array(rows).T


def draw(pairs, out):
    plt = style.use()
    figure, axes = plt.subplots(figsize=(6.5, 3.6))
    for (first, second), colour in zip(pairs, style.COLOURS):
        steps, largest, mean = differences(first, second)
        name = f"{label(first)} against {label(second)}"
        floor = 1e-9  # a logarithmic axis has no zero: equal frames are drawn on this line, as the legend explains
        axes.plot(steps, np.maximum(largest, floor), color=colour, label=f"{name}, largest")
        axes.plot(steps, np.maximum(mean, floor), color=colour, linestyle="--", label=f"{name}, root mean square")
        equal = steps[largest == 0]
        if len(equal):
            axes.plot(equal, np.full(len(equal), floor), "o", color=colour, markersize=3,
                      label=f"{name}: the same bits (drawn at {floor:g} m)")
    axes.set(yscale="log", xlabel="step", ylabel="distance of corresponding vertices [m]",
             title=f"Two runs of {pairs[0][0].manifest['scene']['name']}")
    axes.axhline(pairs[0][0].setting("contact_radius"), color="black", linewidth=0.8, linestyle=":",
                 label="contact radius")
    axes.legend(fontsize=7)
    style.save(figure, out)
    for number, (first, second) in enumerate(pairs):
        table = np.column_stack(differences(first, second))
        np.savetxt(out.with_name(f"{out.stem}_{number}.csv"), table, delimiter=",", comments="",
                   fmt=["%d", "%.9g", "%.9g"],
                   header="step [1],largest [m],root_mean_square [m]")


def label(run):
    return f"{run.folder.name} ({run.manifest['backend']})"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("runs", nargs="+", help="run folders, in pairs: FIRST SECOND [FIRST SECOND …]")
    parser.add_argument("--out", required=True, help="PNG to write")
    arguments = parser.parse_args()
    if len(arguments.runs) % 2:
        parser.error("run folders come in pairs")
    try:
        runs = [Run(folder) for folder in arguments.runs]
        draw(list(zip(runs[::2], runs[1::2])), Path(arguments.out))
    except RunError as error:
        sys.exit(f"agreement: {error}")


if __name__ == "__main__":
    main()
