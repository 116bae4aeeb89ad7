"""Audits the stored states of a finished run exactly, after the run: what the audit takes is no part of the run's time.
Where time runs out it stops after the state at hand, and goes on with the next ones when it is called again.

Usage: python3 -m paper_figures.workflow.audited PROGRAM RUN [--seconds N]; RUN/audit.json says what was found. Exit
status 0: no state has an intersection, 1: one has, 2: the run can't be audited, 75: time ran out. Python's own library
is enough.
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


def found_before(run):
    """What earlier calls found of this run; of a run that was made anew, nothing."""
    path = run / AUDIT
    if not path.is_file() or path.stat().st_mtime < (run / "run.json").stat().st_mtime:
        return {"states": 0, "steps": [], "intersections": 0, "clean": True, "complete": False, "seconds": 0.0}
    return json.loads(path.read_text())


def step_of(frame):
    return int(frame.stem.rpartition("_")[2])


def left_over(run, steps, folder):
    """The run itself, or, where some of its steps were audited before, a folder that shows the other frames alone."""
    if not steps:
        return run
    (folder / "frames").mkdir()
    for path in (run / "run.json", run / "scene"):
        (folder / path.name).symlink_to(path)
    for frame in sorted((run / "frames").glob("frame_*")):
        if step_of(frame) not in steps:
            (folder / "frames" / frame.name).symlink_to(frame)
    return folder


def ask(program, run, limit, folder):
    """(what `ogc audit RUN --json` says, exit status), asked to stop at the limit; `folder` is for what it prints."""
    said = folder / "said.json"
    status, _ = command_in([program, "audit", run, "--json"], limit, folder / "errors", said)
    text = said.read_text()
    sys.stderr.write((folder / "errors").read_text())
    return json.loads(text) if text.strip() else {}, status


def together(before, said, seconds, frames):
    """What was found before and now; `frames`: how many states the run has."""
    steps = [int(state["state"].split()[-1]) for state in said.get("states", [])]
    wrong = [int(state["state"].split()[-1]) for state in said.get("states", []) if state["count"]]
    found = before["intersections"] + said.get("intersections", 0)
    return {"states": before["states"] + len(steps), "intersections": found, "clean": found == 0,
            "complete": before["states"] + len(steps) == frames, "seconds": round(before["seconds"] + seconds, 2),
            "threads": len(os.sched_getaffinity(0)), **({"left_out": said["left_out"]} if "left_out" in said else {}),
            "intersecting_steps": [*before.get("intersecting_steps", []), *wrong], "steps": [*before["steps"], *steps]}


def audit(program, run, limit=Limit()):
    """Exit status, and what is known now; kept in RUN/audit.json."""
    run = Path(run).resolve()
    before, begun = found_before(run), time.monotonic()
    if before["complete"]:
        return (0 if before["clean"] else 1), before
    with tempfile.TemporaryDirectory() as folder:
        shown = left_over(run, set(before["steps"]), Path(folder))
        said, status = ask(program, shown, limit, Path(folder))
    if not said.get("states"):
        return (CALL_AGAIN if said or limit.left() == 0 or status in INTERRUPTED else 2), before
    found = together(before, said, time.monotonic() - begun, len(list((run / "frames").glob("frame_*"))))
    partial = run / f"{AUDIT}.partial"
    partial.write_text(json.dumps(found) + "\n")
    partial.replace(run / AUDIT)
    if status == 2 or not found["complete"]:
        return (2 if status == 2 else CALL_AGAIN), found
    return (0 if found["clean"] else 1), found


def in_words(found):
    words = "no intersection"
    if not found["clean"]:
        words = f"{found['intersections']} INTERSECTIONS, the first in step {found['intersecting_steps'][0]}"
    rest = "" if found["complete"] else "; not all yet"
    return f"{found['states']} states audited in {found['seconds']:.1f} s: {words}{rest}"


@dataclass(frozen=True)
class Audit:
    """The job that audits the stored states of the finished run `of`."""

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
        """None of its own: what it found lies beside the run's manifest."""
        return iter(())


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
