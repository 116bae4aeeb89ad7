"""Runs the workflow and says in our own words how far it is: which figure, which step of how many, how long yet. What
the workflow itself prints goes to RUNS/reproduce.log.

Usage: python3 -m paper_figures.workflow.progress RUNS SCALE BACKEND [FIGURE …] -- COMMAND …; the exit status is the
command's.

The steps tell what they do in a file (job.py); which of them are due the workflow says itself: Snakemake in its table
of jobs, `in_order` in that file. Times are those that a step took here before, or the figure's on another machine
(results/*/durations.csv), or follow from how far the running program says it is.
"""

import json
import os
import re
import shutil
import subprocess
import sys
import time
from pathlib import Path

from paper_figures.workflow import recipes
from paper_figures.workflow.job import EVENTS, LINES

LOG = "reproduce.log"
LOOK = 0.3  # seconds between looks at the steps, and redraws of a terminal's line
SAY = 30  # seconds between lines where nobody watches
JOBS = re.compile(r"^Job stats:\n[^\n]*\n[- ]+\n(.*?)^total +\d+$", re.S | re.M)
FAR = re.compile(r"\b(\d+)/(\d+)\b")
RUN = re.compile(r"\((\d+) of (\d+)\)$", re.M)  # behind the name of each that `ogc ablate` makes
SCENE = re.compile(r"\((\d+) of (\d+)\): ogc ", re.M)  # of a study, before its runs
RUNS_SAID = 2**16  # bytes at the end of a log in which its last run and scene are looked for
REPORT = "report"


def verb(step, recipe, points):
    """What a step of a recipe does, in words; `points`: how many a sweep has."""
    body, part = recipe.body, step.name.removeprefix(recipe.name).strip("_")
    if "illustration" in body:
        return "computing it exactly" if part else "drawing"
    if "rows" in body and part:
        return f"the runs of {part}"
    if "vary" in body and part:
        return f"point {int(part)} of {points}"
    if {"run", "of", "rows", "vary"} & set(body):
        return {"run": f"simulating {recipe.scene}", "movie": "making the movie"}.get(part, "drawing")
    return f"simulating{f' {recipe.scene}' if recipe.scene else ''}, then drawing"


class Known:
    """What is known of the steps that may be due, by name: figure, words, log, and how long it takes [s], None where
    nobody knows."""

    def __init__(self, runs, scale, backend, names):
        measured = recipes.measured_times()
        self.figure, self.words = {REPORT: REPORT}, {REPORT: "making the page"}
        self.logs, self.seconds = {}, {REPORT: None}
        for recipe in recipes.choose(names, recipes.load(), backend):
            steps = recipes.steps(recipe, scale, backend, "ogc")
            drawn = "illustration" in recipe.body
            whole = measured.get((recipe.name, "-" if drawn else scale, "-" if drawn else backend))
            for step in steps:
                before = Path(runs) / f"{step.log}.json"
                self.figure[step.name] = f"{recipe.name} ({recipe.title})"
                self.words[step.name] = verb(step, recipe, len(steps) - 1)
                self.logs[step.name] = Path(runs) / step.log
                self.seconds[step.name] = (json.loads(before.read_text())["seconds"] if before.is_file()
                                           else whole[0] / len(steps) if whole else None)


class Course:
    """Which steps are due, at work and done."""

    def __init__(self, known, clock=time.monotonic):
        self.known, self.clock, self.due, self.begun, self.done, self.failed = known, clock, [], {}, [], []

    def take(self, event):
        """What a step says of itself; returns the line that is worth keeping of it, if any."""
        if "due" in event:
            self.due = event["due"]
            return ""
        name = event["step"]
        if event["what"] == "begins":
            self.begun[name] = self.clock()
            return ""
        self.begun.pop(name, None)
        (self.done if event["what"] == "ends" else self.failed).append(name)
        if event["what"] == "ends":
            took = recipes.in_words(event["seconds"])
            return f"{self.place(name, len(self.done))}: {self.known.words.get(name, name)} took {took}"
        return f"{self.known.figure.get(name, name)}: {event['words']}"

    def place(self, name, number):
        of = f" of {len(self.due)}" if self.due else ""
        return f"Step {number}{of}, {self.known.figure.get(name, name)}"

    def far(self, name):
        """(steps done, of how many) as the running program says in its log, or None; of a study runs, as if each of
        its scenes had as many."""
        log = self.known.logs.get(name)
        if not log or not log.is_file():
            return None
        said = tail(log, RUNS_SAID)
        if run := RUN.findall(said):
            (number, runs), (scene, scenes) = (tuple(map(int, found[-1])) if found else (1, 1)
                                               for found in (run, SCENE.findall(said)))
            far = ((scene - 1) * runs + number - 1, scenes * runs)
        else:
            found = FAR.findall(said[-400:])
            far = tuple(map(int, found[-1])) if found else (0, 0)
        return far if 0 < far[0] <= far[1] else None

    def left(self):
        """(seconds that are left as far as one knows, whether that is all)."""
        total, whole = 0.0, bool(self.due)
        for name in dict.fromkeys([*self.due, *self.begun]):
            if name in self.done or name in self.failed:
                continue
            expected, worked = self.known.seconds.get(name), self.clock() - self.begun.get(name, self.clock())
            far = self.far(name) if name in self.begun else None
            if far:
                total += worked * (far[1] - far[0]) / far[0]
            elif expected is not None:
                total += max(expected - worked, 0)
            else:
                whole = whole and name == REPORT
        return total, whole

    def line(self):
        """Where it is now; empty while nothing is at work."""
        if not self.begun:
            return ""
        name = min(self.begun, key=self.begun.get)
        far = self.far(name)
        beside = f", {len(self.begun) - 1} more beside it" if len(self.begun) > 1 else ""
        seconds, whole = self.left()
        time_left = f"{'about' if whole else 'at least'} {recipes.in_words(seconds)} left" if seconds >= 1 else (
            "almost done" if whole else "no time is known yet")
        at = f", {far[0]} of {far[1]}" if far else ""
        return f"{self.place(name, len(self.done) + 1)}: {self.known.words.get(name, name)}{at}{beside}; {time_left}"


class Screen:
    """A line that is redrawn where a person watches, plain lines every SAY seconds where a file does."""

    def __init__(self, stream):
        self.stream, self.terminal, self.said, self.drawn = stream, stream.isatty(), time.monotonic(), False

    def keep(self, line):
        self.clear()
        print(line, file=self.stream, flush=True)

    def show(self, line, fresh):
        """`fresh`: another step is at work than before, which is said at once."""
        if self.terminal:
            self.stream.write("\r" + line[:shutil.get_terminal_size().columns - 1] + "\x1b[K")
            self.stream.flush()
            self.drawn = True
        elif fresh or time.monotonic() - self.said >= SAY:
            self.said = time.monotonic()
            print(line, file=self.stream, flush=True)

    def clear(self):
        if self.drawn:
            self.stream.write("\r\x1b[K")
            self.drawn = False


def tail(path, size):
    """The last `size` bytes of a file as text."""
    with path.open("rb") as file:
        file.seek(max(0, path.stat().st_size - size))
        return file.read().decode(errors="replace")


def due_by_snakemake(text):
    """Names of the steps in Snakemake's table of jobs, None before it is printed."""
    table = JOBS.search(text)
    names = [line.split()[0] for line in table[1].splitlines() if line.split()] if table else None
    return table and [name for name in names if name != "all"]


def watch(process, course, screen, events, log):
    """Until the process ends: takes what its steps tell, and shows it."""
    read, at_work = 0, None
    while True:
        ended = process.poll() is not None
        if not course.due:
            course.due = due_by_snakemake(log.read_text(errors="replace")) or []
        lines = events.read_text().splitlines()
        for line in lines[read:]:
            kept = course.take(json.loads(line))
            if kept:
                screen.keep(kept)
        read = len(lines)
        line, now = course.line(), set(course.begun)
        if line:
            screen.show(line, now != at_work)
        at_work = now
        if ended:
            return screen.clear()
        time.sleep(LOOK)


def epilogue(status, course, log, seconds):
    """How it ended, in words."""
    failed, done = len(course.failed), len(course.done)
    if status == 0:
        return f"All {done} steps done in {recipes.in_words(seconds)}" if done else "Nothing is missing or changed"
    if failed:
        return f"{failed} of {len(course.due)} steps FAILED, {done} done; what the workflow said: {log}"
    last = "\n  ".join(tail(log, 4000).splitlines()[-LINES:])
    return f"The workflow failed:\n  {last}\n  (the whole log: {log})"


def run(runs, scale, backend, names, command, stream=sys.stderr):
    """Exit status of the command; 130 where it was interrupted."""
    runs = Path(runs).resolve()
    log, events, begun = runs / LOG, runs / ".events.jsonl", time.monotonic()
    events.write_text("")
    course, screen = Course(Known(runs, scale, backend, names)), Screen(stream)
    with log.open("w") as file:
        environment = {**os.environ, EVENTS: str(events)}
        process = subprocess.Popen(command, stdout=file, stderr=subprocess.STDOUT, env=environment)
        try:
            watch(process, course, screen, events, log)
        except KeyboardInterrupt:
            screen.clear()
            screen.keep("Interrupted; waiting for what is at work to stop")
            process.wait()
            screen.keep("What is finished is kept: call it again to go on")
            return 130
    screen.keep(epilogue(process.returncode, course, log, time.monotonic() - begun))
    return process.returncode


if __name__ == "__main__":
    split = sys.argv.index("--")
    try:
        sys.exit(run(*sys.argv[1:4], sys.argv[4:split], sys.argv[split + 1:]))
    except recipes.RecipeError as error:
        sys.exit(f"reproduce: {error}")
