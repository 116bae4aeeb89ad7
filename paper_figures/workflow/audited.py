"""Audits the stored states of a finished run exactly, after the run: what the audit takes is no part of the run's time.
It audits them in rounds, so that the audited states are spread evenly over the run at any time, and keeps the findings
of each round. If time runs out it stops, and continues when it is called again.

Usage: python3 -m paper_figures.workflow.audited PROGRAM RUN [--seconds N]; RUN/audit.json has the findings. Exit status
0: no state has an intersection, 1: one has, 2: the run can't be audited, 75: time ran out. Needs only Python's own
library.
"""

import argparse
import json
import os
import signal
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

from paper_figures.workflow.jobs import AUDIT, CALL_AGAIN, FINISHED, KEPT, STOPPED, Limit, RunFailure, command_in

INTERRUPTED = (130, -signal.SIGINT)
BOXES = "boxes.json"  # beside run.json: findings of an audit in boxes
SHORT_ROUND = 10.0  # [s]; the next round has twice as many states, because each round reads the scene again


def found_before(run):
    """Returns what earlier calls found of this run; nothing if the run was made again."""
    path = run / AUDIT
    if not path.is_file() or path.stat().st_mtime < (run / "run.json").stat().st_mtime:
        return {"states": 0, "steps": [], "intersections": 0, "clean": True, "complete": False, "seconds": 0.0}
    return json.loads(path.read_text())


def step_of(frame):
    return int(frame.stem.rpartition("_")[2])


def spread(frames):
    """Returns the frames in an order whose every beginning is spread evenly over them: first, last, middle, quarters,
    …"""
    bits = max(1, (len(frames) - 1).bit_length())
    halves = sorted(range(len(frames)), key=lambda i: int(f"{i:0{bits}b}"[::-1], 2))
    order = dict.fromkeys([*halves[:1], len(frames) - 1, *halves]) if frames else {}
    return [frames[i] for i in order]


def shown_alone(run, frames, folder):
    """Fills the folder, as a run that has only these frames of `run`."""
    (folder / "frames").mkdir()
    for path in (run / "run.json", run / "scene"):
        (folder / path.name).symlink_to(path)
    for frame in frames:
        (folder / "frames" / frame.name).symlink_to(frame)
    return folder


def ask(program, run, frames, limit):
    """Returns (output of `ogc audit --json` for these frames, exit status); the command must stop at the limit."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        said, errors = folder / "said.json", folder / "errors"
        command = [program, "audit", shown_alone(run, frames, folder), "--json"]
        status, _ = command_in(command, limit, errors, said)
        if status == 2:
            sys.stderr.write(errors.read_text())
        text = said.read_text()
        return json.loads(text) if text.strip() else {}, status


def together(before, said, seconds, frames):
    """Returns what was found before and now; `frames`: the number of the run's states."""
    steps = [int(state["state"].split()[-1]) for state in said.get("states", [])]
    wrong = [int(state["state"].split()[-1]) for state in said.get("states", []) if state["count"]]
    found = before["intersections"] + said.get("intersections", 0)
    return {"states": before["states"] + len(steps), "intersections": found, "clean": found == 0,
            "complete": before["states"] + len(steps) == frames, "seconds": round(before["seconds"] + seconds, 2),
            "threads": len(os.sched_getaffinity(0)), **({"left_out": said["left_out"]} if "left_out" in said else {}),
            "intersecting_steps": sorted([*before.get("intersecting_steps", []), *wrong]),
            "steps": sorted([*before["steps"], *steps])}


def audit(program, run, limit=Limit()):
    """Returns the exit status, and what is known now, which RUN/audit.json keeps after each round of some seconds."""
    run = Path(run).resolve()
    frames, found = sorted((run / "frames").glob("frame_*.h5")), found_before(run)
    size = len(os.sched_getaffinity(0))
    while not found["complete"]:
        if limit.left() == 0:
            return CALL_AGAIN, found
        known, begun = set(found["steps"]), time.monotonic()
        ahead = [frame for frame in spread(frames) if step_of(frame) not in known][:size]
        said, status = ask(program, run, ahead, limit)
        if not said.get("states"):
            return (CALL_AGAIN if said or limit.left() == 0 or status in INTERRUPTED else 2), found
        seconds = time.monotonic() - begun
        found = together(found, said, seconds, len(frames))
        partial = run / f"{AUDIT}.partial"
        partial.write_text(json.dumps(found) + "\n")
        partial.replace(run / AUDIT)
        print(f"{run.name}: {in_words(found)}", file=sys.stderr, flush=True)
        if status == 2 or status in INTERRUPTED:
            return (2 if status == 2 else CALL_AGAIN), found
        size = 2 * size if seconds < SHORT_ROUND else size
    return (0 if found["clean"] else 1), found


def in_words(found):
    words = "no intersection"
    if not found["clean"]:
        words = f"{found['intersections']} INTERSECTIONS, the first in step {found['intersecting_steps'][0]}"
    rest = "" if found["complete"] else "; not all yet"
    return f"{found['states']} states audited in {found['seconds']:.1f} s: {words}{rest}"


@dataclass(frozen=True)
class Audit:
    """Audits the stored states of the finished run `of` as a job."""

    of: str
    on_device = False

    @property
    def name(self):
        return f"{self.of}_{AUDIT}"

    def make(self, program, root, limit=Limit(), _shown=False):
        if found_before(root / self.of)["complete"] and found_before(root / self.of)["clean"]:
            return KEPT
        if limit.left() == 0:
            return STOPPED
        status, found = audit(program, root / self.of, limit)
        if status in (1, 2):
            raise RunFailure(f"{program} audit {root / self.of}: exit status {status}\n  {in_words(found)}")
        return STOPPED if status == CALL_AGAIN else FINISHED

    def results(self, _root, _frames, _last):
        """Returns nothing: the findings lie beside the run's manifest."""
        return iter(())


@dataclass(frozen=True)
class BoxAudit:
    """Audits the last state of the finished run `of` in boxes, as a job: `ogc audit RUN --boxes`."""

    of: str
    boxes: int
    seed: int
    engine: str
    on_device = False

    @property
    def name(self):
        return f"{self.of}_{BOXES}"

    def make(self, program, root, limit=Limit(), _shown=False):
        run, kept = root / self.of, root / self.of / BOXES
        if kept.is_file() and kept.stat().st_mtime > (run / "run.json").stat().st_mtime:
            return KEPT
        if limit.left() == 0:
            return STOPPED
        partial, errors = run / f"{BOXES}.partial", root / f"{self.name}.log"
        status, _ = command_in([program, "audit", run, "--boxes", self.boxes, "--seed", self.seed, "--engine",
                                self.engine, "--json"], limit, errors, partial)
        if status not in (0, 1):
            if limit.left() == 0:
                return STOPPED
            raise RunFailure(f"{program} audit {run} --boxes {self.boxes}: exit status {status}\n"
                             f"{errors.read_text()}")
        partial.replace(kept)
        if status == 1:
            raise RunFailure(f"{run}: {json.loads(kept.read_text())['first']}")
        return FINISHED

    def results(self, root, _frames, _last):
        """Returns the findings."""
        return iter([path for path in (root / self.of / BOXES,) if path.is_file()])


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", help="ogc")
    parser.add_argument("run", type=Path, help="run folder")
    parser.add_argument("--seconds", type=float, help="stop after about so long, exit status 75: call again")
    options = parser.parse_args()
    if not (options.run / "run.json").is_file():
        parser.error(f"{options.run} is no run folder: it has no run.json")
    status, found = audit(options.program, options.run, Limit(options.seconds))
    print(in_words(found))
    sys.exit(status)


if __name__ == "__main__":
    main()
