"""Runs jobs of `ogc` under a limit of time: finished ones are kept, interrupted ones continue from their checkpoint,
and at the limit a job is told to stop. Needs only Python's own library.

A job is a command with a folder or a file of its own below the folder of its part. `make` makes it, or continues it,
and returns how that ended (KEPT, FINISHED, STOPPED); it throws RunFailure. `results` yields the files that are packed.
"""

import argparse
import contextlib
import contextvars
import glob
import json
import math
import os
import re
import shutil
import signal
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path

SECONDS_TO_STOP = 60  # for the current step, and its checkpoint
KEPT, FINISHED, STOPPED, FAILED = "kept", "finished", "stopped at the limit; call again to go on", "FAILED"
CALL_AGAIN = 75  # exit status if a limit came first (EX_TEMPFAIL of sysexits.h)
STOPPED_BY_US = (130, -signal.SIGINT, -signal.SIGKILL)  # exit status
LINES = 5
PROCESSOR_TIME = "processor_time.json"  # beside the manifest of a run whose processor time was requested [s]
MEMORY = "_device_memory.json"  # end of the name of samples taken while a run was on a device
ENDED_BY_TIME = "ended_by_time.json"  # beside the manifest of a run that reached its limit of seconds
AUDIT = "audit.json"  # beside a manifest: what an audit of the finished run found (paper_figures.workflow.audited)


@dataclass(frozen=True)
class Place:
    """Holds where commands run on a machine that several share: the device that they see (empty: those of the
    environment), and their processors (none: all)."""

    device: str = ""
    cores: tuple = ()

    def command(self, words):
        pinned = self.cores and shutil.which("taskset")
        return [*(["taskset", "-c", ",".join(map(str, self.cores))] if pinned else []), *words]

    def environment(self):
        return {**os.environ, "CUDA_VISIBLE_DEVICES": self.device} if self.device else None


# Where jobs run side by side, each has one of these for itself: a device, the cores of a place, or one core.
DEVICE, CORES, CORE = "device", "cores", "core"
PLACE = contextvars.ContextVar("place", default=Place())  # of the commands of a thread; side_by_side.py sets it


def here(function, *arguments):
    """Returns a function without arguments for another thread, which keeps this one's place."""
    context = contextvars.copy_context()
    return lambda: context.run(function, *arguments)


class RunFailure(Exception):
    """Raised for a job that did not end properly, or that can't begin; the message has its command and the log's last
    lines."""


def parser_of_figure(description, scales=(), scale="small", has_backend=True):
    """Returns the parser of a figure that makes its runs itself: folder, ogc, and, if there is a choice, scale and
    backend."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("folder", type=Path, help="where the runs are, or go, and table and picture")
    parser.add_argument("--ogc", default="build/default/ogc", help="the program")
    if scales:
        parser.add_argument("--scale", default=scale, choices=tuple(scales))
    if has_backend:
        parser.add_argument("--backend", default="cpu", choices=("cpu", "cuda"))
    return parser


def options_of_figure(description, scales):
    """Returns the options of a figure whose runs and tables need only Python's own library: folder, ogc, scale,
    backend, no_picture, no_runs."""
    parser = parser_of_figure(description, scales)
    parser.add_argument("--no-picture", action="store_true", help="runs and tables alone")
    parser.add_argument("--no-runs", action="store_true", help="tables and picture of the runs that are there")
    return parser.parse_args()


class Limit:
    """Holds a moment on the clock, not after that of `within`; without seconds it never comes."""

    def __init__(self, seconds=None, within=None):
        self.end = time.monotonic() + seconds if seconds is not None else math.inf
        self.within = within

    def left(self):
        own = max(0.0, self.end - time.monotonic())
        return min(own, self.within.left()) if self.within else own

    def stop(self):
        """Makes the moment come now."""
        self.end = time.monotonic()


@dataclass(frozen=True)
class Step:
    """Selects the frame after this step."""

    number: int


@dataclass(frozen=True)
class Share:
    """Selects the frame at so many hundredths of a run's steps, rounded down to one that is stored every `frame_steps`
    steps; the last one at 100."""

    percent: int
    frame_steps: int


def last_step(run):
    """Returns the step of the last row of a run. Throws RunFailure if it has none."""
    rows = run / "steps.csv"
    last = rows.read_text().splitlines()[-1].partition(",")[0] if rows.is_file() else ""
    if not last.isdigit():
        raise RunFailure(f"{run} has no step yet: make that run first")
    return int(last)


def frame_of(run, place, read=True):
    """Returns (path, step) of a run's frame: a place in their order, a Step or a Share. Throws RunFailure if it is
    missing. `read=False`: it may be missing; the last one of a run follows from its rows."""
    if isinstance(place, Share):
        last = last_step(run)
        place = Step(last if place.percent == 100
                     else last * place.percent // 100 // place.frame_steps * place.frame_steps)
    if place == -1 and not read:
        place = Step(last_step(run))
    if isinstance(place, Step) and not read:
        return run / f"frames/frame_{place.number:06d}.h5", place.number
    frames = sorted((run / "frames").glob("frame_*.h5"))
    if isinstance(place, Step):
        frames, place = [frame for frame in frames if frame.stem == f"frame_{place.number:06d}"], 0
    if len(frames) < (place + 1 if place >= 0 else -place):
        raise RunFailure(f"a run begins with a frame of {run}, which does not have it: remove it, and call again")
    return frames[place], int(frames[place].stem.removeprefix("frame_"))


@dataclass(frozen=True)
class Job:
    """Runs `ogc run ARGUMENTS --out FOLDER/name`.

    `state`: (another job's name, frame) with which it begins; it is `more_steps` long if that is not 0. `scene`: a file
    that it writes first (layers.Stack). `may_fail`: a failure is a result. `processor_time`: its processor time is kept
    beside the run. `pictured`: frames of it are packed, the `first` ones among them. `begins`: places of frames with
    which jobs begin on the machine where it is unpacked; they are packed without the scene. `seconds`: it is stopped
    after this time, and is then complete; with `least`, not before it has so many steps."""

    name: str
    arguments: tuple
    state: tuple = ()
    more_steps: int = 0
    scene: object = None
    may_fail: bool = False
    processor_time: bool = False
    pictured: bool = True
    first: int = 0
    begins: tuple = ()
    seconds: float = 0
    least: int = 0

    def words(self, root, read=True):
        """Returns the words after the program's name. Throws RunFailure if the state with which it begins is missing;
        `read=False` as in frame_of."""
        words = ["run", *([str(root / self.scene.path)] if self.scene else []), *map(str, self.arguments)]
        if self.state:
            frame, step = frame_of(root / self.state[0], self.state[1], read)
            words += ["--from-state", str(frame)]
            words += ["--steps", str(step + self.more_steps)] if self.more_steps else []
        return [*words, "--out", str(root / self.name)]

    @property
    def on_device(self):
        return ("--backend", "cuda") in zip(self.arguments, self.arguments[1:])

    @property
    def needs(self):
        """Returns what it has for itself. If the reference measures its residuals, which takes nearly all of its time,
        that is one core, unless the step is repeated for its time."""
        measured = {"--residual", "--iterations"} & set(self.arguments) and "--repeats" not in self.arguments
        return CORES if not self.on_device else CORE if measured else DEVICE

    def done(self, root):
        """Returns whether the folder holds the run of this command by this program, at its end. The state with which it
        began may be missing: packed runs have few frames."""
        status = manifest_of(root / self.name).get("status", "")
        ended = status == "finished" or self.may_fail and failed_in_step(status)
        ended = ended or bool(status) and (root / self.name / ENDED_BY_TIME).is_file()
        return ended and same_command(root / self.name, self.words(root, read=False))

    def make(self, program, root, limit=Limit(), shown=False):
        """Makes or continues the run. `shown`: with its progress on the screen."""
        folder = root / self.name
        if self.done(root):
            return KEPT
        if limit.left() == 0:
            return STOPPED
        goes_on = can_go_on(folder, self.words(root), program)
        if not goes_on:
            self.begin_anew(program, root)
        words = ["run", "--resume", str(folder)] if goes_on else self.words(root)
        command = [str(program), *words]
        log = None if shown else root / f"{self.name}.log"
        if shown:
            print(" ".join(command), file=sys.stderr, flush=True)
        used_before = taken_before(folder) if goes_on and self.processor_time else {}
        code, used = command_in(command, limit, log, seconds=self.seconds, waits=self.least > 0)
        if self.seconds and code in STOPPED_BY_US and limit.left() > 0:
            return self.end_by_time(program, root, limit, shown)
        if self.processor_time and used_before is not None and folder.is_dir():
            together = {name: used_before.get(name, 0) + seconds for name, seconds in used.items()}
            (folder / PROCESSOR_TIME).write_text(json.dumps(together) + "\n")
        return self.end(folder, code, limit, command, log)

    def end_by_time(self, program, root, limit, shown):
        """Ends a run that was stopped by its own limit of seconds, and not by `limit`."""
        rows = root / self.name / "steps.csv"
        steps = rows.read_text().count("\n") - 1 if rows.is_file() else 0
        if steps < self.least:
            return self.make(program, root, limit, shown)
        (root / self.name / ENDED_BY_TIME).write_text(json.dumps({"seconds": self.seconds, "steps": steps}) + "\n")
        return FINISHED

    def begin_anew(self, program, root):
        folder = root / self.name
        if manifest_of(folder):
            print(f"{folder}: of another command or program, failed, or without a checkpoint: run again",
                  file=sys.stderr, flush=True)
        remove(folder)
        if self.scene:
            self.scene.write(program, root)

    def end(self, folder, code, limit, command, log):
        status = manifest_of(folder).get("status", "")
        if code == 0 and status == "finished":
            return FINISHED
        if limit.left() == 0 and not status.startswith("failed"):
            return STOPPED
        if self.may_fail and failed_in_step(status):
            return FINISHED
        raise RunFailure(f"{' '.join(command)}: exit status {code}\n  {last_lines(log)}")

    def results(self, root, frames, last):
        """Yields manifest, rows and so many frames, evenly over the run, and the last ones; only if the run has
        ended."""
        folder = root / self.name
        by_time = (folder / ENDED_BY_TIME).is_file()
        if not by_time and not manifest_of(folder).get("status", "").startswith(("finished", "failed: Newton")):
            return
        names = ("run.json", "steps.csv", "iterations.csv", PROCESSOR_TIME, ENDED_BY_TIME, AUDIT)
        chosen = chosen_frames(folder, frames, last, self.first) if self.pictured else []
        beside = [root / f"{self.name}{MEMORY}", *(folder / name for name in names)]
        yield from (path for path in beside if path.is_file())
        yield from dict.fromkeys([*chosen, *(frame_of(folder, place)[0] for place in self.begins)])
        if chosen:
            yield from sorted(path for path in (folder / "scene").glob("*") if path.is_file())


def manifest_of(folder):
    path = Path(folder) / "run.json"
    return json.loads(path.read_text()) if path.is_file() else {}


def manifests_below(folder):
    """Returns the paths of the manifests below a folder, sorted; a link to a run is as good as the run."""
    return sorted(folder / name for name in glob.glob("**/run.json", root_dir=folder, recursive=True))


def failed_in_step(status):
    """Returns whether a run failed in a step, or in the audit of one, which can be a result: its status names the step.
    A run without memory, disk or device says nothing about the method."""
    return bool(re.match(r"failed: .*\b(in|of) step \d", status))


def remove(folder):
    """Removes a run folder as a whole, or a link to one."""
    if folder.is_symlink():
        folder.unlink()
    shutil.rmtree(folder, ignore_errors=True)


def without_paths(words):
    """Returns words without the folders of their files."""
    return [str(word).rpartition("/")[2] for word in words]


def same_command(folder, words):
    """Returns whether `folder` holds a run of these words by this program. The workflow names in OGC_STAMP a file that
    is rewritten when the program changes."""
    manifest, stamp = folder / "run.json", os.environ.get("OGC_STAMP", "")
    changed = stamp and Path(stamp).is_file() and Path(stamp).stat().st_mtime > manifest.stat().st_mtime
    command = manifest_of(folder)["command"]
    said = command.split() if isinstance(command, str) else command
    return not changed and without_paths(said[1:]) == without_paths(words)


def is_of(folder, program):
    """Returns whether this program's commit made the run, with uncommitted changes or without: no other program can
    continue it."""
    said = subprocess.run([str(program), "--version"], capture_output=True, text=True, check=False).stdout
    about = manifest_of(folder)
    commit = next((line for line in said.splitlines() if line.startswith(f"commit {about['commit']}")), "")
    return bool(commit) and ("(dirty" in commit) == about.get("dirty", False)


def can_go_on(folder, words, program):
    """Returns whether the folder holds a part of the run of these words that this program can continue."""
    status = manifest_of(folder).get("status", "failed")
    return (not status.startswith("failed") and (folder / "checkpoint.h5").is_file() and same_command(folder, words)
            and is_of(folder, program))


def taken_before(folder):
    """Returns the processor time of a run's earlier attempts [s], and removes it from its file until it is added to;
    None if one of them was killed together with the process that measured it."""
    path = folder / PROCESSOR_TIME
    if not path.is_file():
        return None
    used = json.loads(path.read_text())
    path.unlink()
    return used


def chosen_frames(folder, frames, last, first=0):
    """Returns so many frames of a run: the first, evenly on to the last, and the `first` and the `last` ones."""
    found = sorted((folder / "frames").glob("frame_*.h5"))
    spread = {round(i * (len(found) - 1) / (frames - 1)) for i in range(frames)} if frames > 1 and found else set()
    return [frame for i, frame in enumerate(found) if i in spread or i < first or i >= len(found) - last]


def command_in(command, limit=Limit(), log=None, out=None, seconds=0, waits=False):
    """Returns (exit status, processor time) of a command that is told to stop at the limit, or after so many `seconds`,
    and is killed a minute later; `waits`: told before the limit, it may continue until then. Its output goes to the
    file `log`; its standard output to `out` if that is named; without both, errors and progress go to the screen."""
    command, place = list(map(str, command)), PLACE.get()
    # An interrupt reaches it only from us, and once: a second one kills.
    apart = {"start_new_session": True, "env": place.environment()}
    command = place.command(command)
    if log is None:
        return waited(subprocess.Popen(command, stdout=subprocess.DEVNULL, **apart), limit, seconds, waits)
    log.parent.mkdir(parents=True, exist_ok=True)
    with log.open("w") as errors, (out.open("w") if out else contextlib.nullcontext(errors)) as output:
        return waited(subprocess.Popen(command, stdout=output, stderr=errors, **apart), limit, seconds, waits)


def waited(process, limit, seconds=0, waits=False):
    """Waits for a process, which is told to stop as in command_in; returns (exit status, processor time by kind
    [s])."""
    asked = Limit(seconds, limit) if seconds else limit
    for stop, until in ((None, asked), (signal.SIGINT, None), (signal.SIGKILL, Limit())):
        until = until or Limit((limit.left() if waits else 0) + SECONDS_TO_STOP)
        if stop is not None:
            os.kill(process.pid, stop)
        try:
            found = ended(process, until)
        except KeyboardInterrupt:
            os.kill(process.pid, signal.SIGINT)
            ended(process, Limit(SECONDS_TO_STOP))
            raise
        if found:
            return found
    raise AssertionError("a killed process ends")


def ended(process, limit):
    """Returns the result of `waited`, or None if the process continues at the limit."""
    pause = 1e-3
    while True:
        pid, status, used = os.wait4(process.pid, os.WNOHANG)
        if pid:
            process.returncode = os.waitstatus_to_exitcode(status)
            return process.returncode, {"user [s]": used.ru_utime, "system [s]": used.ru_stime}
        if limit.left() == 0:
            return None
        pause = min(2 * pause, 0.05)
        time.sleep(pause)


def last_lines(log, lines=LINES):
    return "\n  ".join(log.read_text(errors="replace").splitlines()[-lines:]) if log else "its last lines say why"
