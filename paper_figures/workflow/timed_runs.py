"""Runs of `ogc` under a limit of time: what is finished is kept, what was cut off goes on, and at the limit a run is asked to stop. Python's library is enough."""

import json
import math
import os
import shutil
import signal
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path

SECONDS_TO_STOP = 60  # for the step at hand, and its checkpoint
KEPT, FINISHED, STOPPED, FAILED = "kept", "finished", "stopped at the limit; call again to go on", "FAILED"
LINES = 5


class RunFailure(Exception):
    """A run that did not end as it should, or that can't begin; the message has its command and the log's last lines."""


@dataclass(frozen=True)
class Step:
    """The frame after this step."""

    number: int


@dataclass(frozen=True)
class Job:
    """`ogc run [scene] ARGUMENTS --out FOLDER/name`; `scene`: a scene file below FOLDER; `state`: (another job's name, place among its frames or a step) where it begins;
    `may_fail`: to fail is a result."""

    name: str
    arguments: tuple
    state: tuple = ()
    scene: str = ""
    may_fail: bool = False

    def words(self, root):
        """Arguments with the frame that the run begins with. Throws RunFailure where it is missing."""
        scene = [str(root / self.scene)] if self.scene else []
        if not self.state:
            return [*scene, *map(str, self.arguments)]
        name, place = self.state
        frames = sorted((root / name / "frames").glob("frame_*.h5"))
        if isinstance(place, Step):
            frames, place = [frame for frame in frames if frame.stem == f"frame_{place.number:06d}"], 0
        if len(frames) < (place + 1 if place >= 0 else -place):
            raise RunFailure(f"{root / self.name} begins with a frame of {root / name}, which does not have it: make that run first")
        return [*scene, *map(str, self.arguments), "--from-state", str(frames[place])]

    def command(self, program, root):
        return [str(program), "run", *self.words(root), "--out", str(root / self.name)]


class Limit:
    """A moment on the clock; without seconds it never comes."""

    def __init__(self, seconds=None):
        self.end = time.monotonic() + seconds if seconds else math.inf

    def left(self):
        return max(0.0, self.end - time.monotonic())


def manifest_of(folder):
    path = Path(folder) / "run.json"
    return json.loads(path.read_text()) if path.is_file() else {}


def without_paths(command):
    """The words of a command but for the program and the folders that its files lie in."""
    words = command.split() if isinstance(command, str) else list(map(str, command))
    return [word.rpartition("/")[2] for word in words[1:]]


def same_command(folder, command):
    """Whether `folder` holds a run of this command by this program. The workflow names in OGC_STAMP a file that is rewritten when the program changes."""
    manifest, stamp = folder / "run.json", os.environ.get("OGC_STAMP", "")
    changed = stamp and Path(stamp).is_file() and Path(stamp).stat().st_mtime > manifest.stat().st_mtime
    return not changed and without_paths(manifest_of(folder)["command"]) == without_paths(command)


def usable(folder, command):
    """Whether `folder` holds the finished run of this command by this program."""
    return manifest_of(folder).get("status") == "finished" and same_command(folder, command)


def is_of(folder, program):
    """Whether this program's commit made the run: no other can go on with it."""
    said = subprocess.run([str(program), "--version"], capture_output=True, text=True).stdout
    return f"commit {manifest_of(folder)['commit']}" in said


def command_in(command, log, limit):
    """Exit status of a command that is asked to stop at the limit, and killed a minute later; what it prints goes to `log`, or its progress to the screen."""
    if log is None:
        return waited(subprocess.Popen(list(map(str, command)), stdout=subprocess.DEVNULL), limit)
    log.parent.mkdir(parents=True, exist_ok=True)
    with log.open("w") as file:
        return waited(subprocess.Popen(list(map(str, command)), stdout=file, stderr=subprocess.STDOUT), limit)


def waited(process, limit):
    try:
        return process.wait(timeout=None if math.isinf(limit.left()) else limit.left())
    except subprocess.TimeoutExpired:
        process.send_signal(signal.SIGINT)
    try:
        return process.wait(timeout=SECONDS_TO_STOP)
    except subprocess.TimeoutExpired:
        process.kill()
        return process.wait()


def last_lines(log):
    return "\n  ".join(log.read_text(errors="replace").splitlines()[-LINES:]) if log else "its last lines say why"


def make(program, job, root, limit, shown=False):
    """Makes the run of a job below `root`, and says how that ended; `shown`: with its progress on the screen. Throws RunFailure."""
    folder, log = root / job.name, None if shown else root / f"{job.name}.log"
    command = job.command(program, root)
    status = manifest_of(folder).get("status", "")
    alike = status and same_command(folder, command)
    if alike and (status == "finished" or job.may_fail and status.startswith("failed")):
        return KEPT
    if limit.left() == 0:
        return STOPPED
    goes_on = alike and not status.startswith("failed") and (folder / "checkpoint.h5").is_file() and is_of(folder, program)
    used = [str(program), "run", "--resume", str(folder)] if goes_on else command
    if status and not goes_on:
        print(f"{folder}: of another command or program, failed, or without a checkpoint: run again", file=sys.stderr, flush=True)
    if not goes_on:
        shutil.rmtree(folder, ignore_errors=True)
    if shown:
        print(" ".join(used), file=sys.stderr, flush=True)
    code = command_in(used, log, limit)
    status = manifest_of(folder).get("status", "")
    if code == 0 and status == "finished":
        return FINISHED
    if limit.left() == 0 and not status.startswith("failed"):
        return STOPPED
    if job.may_fail and status.startswith("failed"):
        return FINISHED
    raise RunFailure(f"{' '.join(used)}: exit status {code}\n  {last_lines(log)}")
