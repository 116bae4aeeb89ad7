"""Provides what the figure scripts share: arguments, claims, and errors in words instead of a traceback."""

import argparse
import sys
from pathlib import Path

from paper_figures.workflow import commands
from paper_figures.workflow.evidence import CLAIMS
from paper_figures.workflow.runs import run_job
from ogc_testbed.runs import Run, RunError
from plots.scene_figure import draw, draw_movie, load_claims


def label(run):
    """Returns the name of a solver in the paper, and where it ran."""
    names = {"ipc": "IPC", "newton": "Newton-OGC", "vbd": "VBD-OGC", "reference_vbd": "VBD-OGC in double"}
    solver, backend = run.manifest["solver"], run.manifest["backend"]
    return names.get(solver, solver) + (", CUDA" if backend == "cuda" else "")


def baseline_arguments(description, scales=("smoke", "small", "paper"), backends=("cpu",)):
    """Returns the parser of the figures that compare IPC with OGC: a folder for the runs and the figure, the program,
    the scale, the membrane of all solvers."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("folder", help="where the runs are, or go, and the figure")
    parser.add_argument("--ogc", default="build/default/ogc", help="the program")
    parser.add_argument("--scale", default="small", choices=scales)
    parser.add_argument("--membrane", default=commands.NEO_HOOKEAN,
                        help="of all solvers alike (default: that of the scenes)")
    if len(backends) > 1:
        parser.add_argument("--backend", default="cpu", choices=backends, help="of OGC's run; IPC's is on the CPU")
    return parser


def draw_a_run(scene, draw_it, profiled=False, seen=None):
    """Draws the figure of the run of `scene` that the command line names, by draw_it(run, out), or its movie.
    `profiled`: draw_it gets a third argument, the run of the option --profiled, or None. `seen`: camera of the movie as
    a function of the run; None: one that shows all."""
    parser = argparse.ArgumentParser(description=f"Draws the figure of a run of {scene}.")
    parser.add_argument("run", help="run folder, made by: ogc run " + scene)
    parser.add_argument("--out", help="picture to write (default: SCENE.png in the run folder)")
    parser.add_argument("--movie", help="MP4 to write instead of the figure")
    if profiled:
        parser.add_argument("--profiled",
                            help="run folder of the same scene, made with --profile, for the times by stage")
    arguments = parser.parse_args()
    try:
        run = run_of(arguments.run, scene)
        if arguments.movie:
            draw_movie(run, arguments.movie, seen and seen(run))
            sys.exit()
        out = Path(arguments.out or Path(arguments.run) / f"{scene}.png")
        more = (Run(arguments.profiled) if arguments.profiled else None,) if profiled else ()
        draw_it(run, out, *more)
    except RunError as error:
        sys.exit(f"{Path(sys.argv[0]).name}: {error}")
    print(out)


def main(scene, frames, title, alt, driven=False, near=None):
    """Draws the figure of one run of `scene`. `frames` are steps, moved together if the run is shorter than the last of
    them. `title`: its claim, in a clause. `alt`: what it shows, for readers who don't see it. `driven`: a motion that
    may be faster than bounds allow drives a body, whose lag is shown in place of detections. `near`: (a camera for the
    last frame as a function of run and frame, words)."""
    def figure(run, out, by_stage):
        draw(run, scaled(run, frames), claims_of(run), out, title, alt, by_stage, driven, near)

    draw_a_run(scene, figure, profiled=True)


def run_of(folder, scene):
    """Returns the run. Throws RunError if it is of another scene."""
    run = Run(folder)
    found = run.manifest["scene"]["name"]
    if found != scene:
        raise RunError(f"{folder} is a run of '{found}', not of '{scene}'")
    return run


def scaled(run, steps):
    """Returns the steps, moved together if the run is shorter than the last of them."""
    share = min(1, int(run.column("step")[-1]) / steps[-1])
    return [round(step * share) for step in steps]


def claims_of(run):
    """Returns the paper's numbers about a run, which are of the paper's size alone."""
    path = CLAIMS / f"{run.manifest['scene']['name']}.json"
    return load_claims(path, run.manifest["backend"]) if run.manifest.get("scale") == "paper" else {}
