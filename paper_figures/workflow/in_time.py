"""Runs of Fig. 2 and 18 where a command may last so long only: each solver runs for so many seconds, is asked to stop, and goes on from its last frame when
this is called again. Needs Python's own library alone, so that a bare machine with the program can do it; what draws the results is
`python3 -m paper_figures.figures.fig18_solvers FOLDER --parts` or `python3 -m paper_figures.figures.fig02_large_radius_twist FOLDER --parts`.

A part that continues starts from positions rounded to single precision, so its last bits differ from those of one long run.
"""

import argparse
import json
import os
import resource
import signal
import subprocess
import sys
from pathlib import Path

# Newton stops by IPC's velocity tolerance. It detects as soon as one vertex is cut: held by its ball it would never slow down. OGC's force jumps at block
# boundaries, so that a step may never get there: after 100 iterations it ends as it is, as a step of VBD does.
NEWTON = ["newton_tolerance=0", "newton_step_tolerance=1e-3", "redetect_fraction=0", "newton_iterations=100"]
# IPC's run first: it is the baseline.
SOLVERS = {"ipc": ["--solver", "ipc", "--profile"], "newton": ["--solver", "newton", "--profile", *(word for value in NEWTON for word in ("--set", value))],
           "vbd": [], "vbd_cuda": ["--backend", "cuda"]}
AUDIT = {"cloth_on_sphere": "end", "large_radius_twist": "frame"}
SECONDS_TO_STOP = 60  # for the step at hand
PROCESSOR_TIME = "processor_time.json"


def parts(folder):
    """Run folders of one solver in the order of their making."""
    return sorted(path for path in Path(folder).glob("part_*") if (path / "run.json").is_file())


def status(part):
    return json.loads((part / "run.json").read_text()).get("status")


def ended(folder):
    """Whether the run in this folder has reached its end."""
    done = parts(folder)
    return bool(done) and status(done[-1]) == "finished"


def last_frame(folder):
    """The latest frame of all parts; None where there is none."""
    frames = [frame for part in parts(folder) for frame in (part / "frames").glob("frame_*.h5")]
    return max(frames, key=lambda frame: frame.name, default=None)


def run_for(ogc, arguments, folder, seconds):
    """Runs at most so long, from the last frame if there is one; True when the run has reached its end. Throws RuntimeError where ogc fails."""
    done = parts(folder)
    if ended(folder):
        return True
    part = Path(folder) / f"part_{len(done):02d}"
    state = last_frame(folder)
    command = [str(ogc), "run", *map(str, arguments), *(["--from-state", str(state)] if state else []), "--out", str(part)]
    print(" ".join(command), file=sys.stderr, flush=True)
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL)
    try:
        process.wait(timeout=seconds)
    except subprocess.TimeoutExpired:
        process.send_signal(signal.SIGINT)
        try:
            process.wait(timeout=SECONDS_TO_STOP)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()
    if not (part / "run.json").is_file() or status(part) == "failed":
        raise RuntimeError(f"{' '.join(command)}: failed; its last lines say why")
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    used = {"user [s]": after.ru_utime - before.ru_utime, "system [s]": after.ru_stime - before.ru_stime}
    (part / PROCESSOR_TIME).write_text(json.dumps(used))
    return status(part) == "finished"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", help="where the runs go")
    parser.add_argument("--ogc", default="build/default/ogc", help="the program")
    parser.add_argument("--scene", default="cloth_on_sphere", choices=tuple(AUDIT))
    parser.add_argument("--scale", default="paper", choices=("smoke", "small", "paper"))
    parser.add_argument("--membrane", default="stable_neo_hookean", help="of all solvers alike")
    parser.add_argument("--seconds", type=float, default=120, help="for each solver")
    parser.add_argument("--solvers", nargs="+", default=["ipc", "newton", "vbd"], choices=tuple(SOLVERS))
    parser.add_argument("--cores", nargs="+", type=int, help="run on these alone, so that two calls can go on side by side (default: on all)")
    options = parser.parse_args()
    if options.cores:
        os.sched_setaffinity(0, options.cores)  # what is started from here inherits it
    base = [options.scene, "--scale", options.scale, "--set", f"membrane={options.membrane}", "--audit", AUDIT[options.scene]]
    for name in options.solvers:
        try:
            ended = run_for(options.ogc, [*base, *SOLVERS[name]], Path(options.folder) / name, options.seconds)
        except RuntimeError as error:
            sys.exit(f"in_time: {error}")
        print(f"{name}: " + ("finished" if ended else f"stopped at {last_frame(Path(options.folder) / name).stem}; call again to go on"))


if __name__ == "__main__":
    main()
