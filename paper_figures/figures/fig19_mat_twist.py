"""Fig. 19, CPU row: time a step of the twisted mat by VBD-OGC over the whole run, and by IPC on windows of 20 steps at
t = 0, 4, 8 and 12 s of it.

The mat needs tetrahedra: until its scene exists, `ogc` says that it does not. IPC would take days for the whole run.
"""

import sys
from pathlib import Path

import numpy as np

from paper_figures.workflow.common import baseline_arguments, ipc_windows, label, options_of
from paper_figures.workflow.runs import provenance, run_once, write_table
from plots import style
from plots.run_folder import RunError

SCENE = "mat_twist"
WINDOWS = (0, 960, 1920, 2880)  # 240 steps a second
# Mean time a step on the CPU [ms], as the paper's text says.
CLAIMS = {"vbd": 540.0, "ipc": 61180.0}


def runs_of(arguments):
    ogc = run_once(arguments.ogc, [SCENE, *options_of(arguments)], Path(arguments.folder) / "vbd")
    return ogc, ipc_windows(arguments, SCENE, ogc, WINDOWS)


def draw(ogc, windows, out):
    plt = style.use()
    figure, axes = plt.subplots(figsize=(8, 4.5))
    h = ogc.setting("time_step")
    axes.plot(h * ogc.column("step"), ogc.column("wall"), label=label(ogc))
    for number, run in enumerate(windows):
        axes.plot(h * run.column("step"), run.column("wall"), color=style.COLOURS[1],
                  label=label(run) if number == 0 else None)
    for solver, value in CLAIMS.items():
        axes.axhline(value, color="black", linestyle=":", linewidth=0.8,
                     label=f"paper, {solver}: {value:g} ms (average, 16 cores)")
    axes.set(xlabel="time [s]", ylabel="time a step [ms]", yscale="log", title="Twisted mat, CPU")
    axes.legend()
    style.save(figure, out)


if __name__ == "__main__":
    options = baseline_arguments(__doc__.splitlines()[0]).parse_args()
    try:
        whole, parts = runs_of(options)
        write_table(Path(options.folder) / "fig19.csv",
                    [{**provenance(run), "mean [ms]": float(np.mean(run.column("wall")))} for run in (whole, *parts)])
        draw(whole, parts, Path(options.folder) / "fig19.png")
    except RunError as error:
        sys.exit(f"fig19: {error}")
