"""Does the steps of figures that are due, on this machine, and says in our own words how far it is: which figure, which
step of how many, and the time left. Figures run at the same time as far as there are cores; a step that uses all of
them runs alone.

A step is due if its output is missing, if it was interrupted, if its command is not the one that made the output, or if
an input is newer or made again. When it is interrupted and called again, finished steps are kept. A figure whose step
fails stops there; the others continue.

Usage: python3 -m paper_figures.workflow.local RUNS OGC SCALE BACKEND [FIGURE …] [--jobs N] [--dry-run]. Exit status: 0
all is done, 1 a step failed, 130 it was interrupted.

A time is that of the step here before, or of the figure on another machine (results/*/durations.csv), or an estimate
from the progress in the log of the running program.
"""

import argparse
import contextlib
import os
import re
import shutil
import signal
import sys
import threading
import time
from collections import deque
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from paper_figures.workflow import job, recipes
from paper_figures.workflow.jobs import Limit

LOOK = 0.3  # seconds between checks of the steps, and redraws of a terminal's line
SAY = 30  # seconds between lines if the output is not a terminal
FAR = re.compile(r"\b(\d+)/(\d+)\b")
RUN = re.compile(r"\((\d+) of (\d+)\)$", re.M)  # follows the name of each run that `ogc ablate` makes
SCENE = re.compile(r"\((\d+) of (\d+)\): ogc ", re.M)  # of a study, before its runs
RUNS_SAID = 2**16  # bytes at the end of a log in which its last run and scene are looked for


def verb(step, recipe):
    """Describes what a step of a recipe does."""
    body, part = recipe.body, step.name.removeprefix(recipe.name).strip("_")
    if "illustration" in body:
        return "computing it exactly" if part else "drawing"
    if "rows" in body and part:
        return f"the runs of {part}"
    if {"run", "row", "of", "rows"} & set(body):
        return {"run": f"simulating {recipe.scene}", "movie": "making the movie"}.get(part, "drawing")
    return f"simulating{f' {recipe.scene}' if recipe.scene else ''}, then drawing"


def why_due(step, made):
    """Returns in words why a step is due; empty if it is not. `made`: outputs of steps that will be done before."""
    output = Path(step.output)
    record = job.record(step.log)
    if not output.is_file():
        return f"{output} is missing"
    if record and "seconds" not in record:
        return "it was interrupted, or failed"
    if record and record["command"] != list(map(str, step.command)):
        return "its command is another"
    newer = [path for path in step.inputs
             if path in made or Path(path).is_file() and Path(path).stat().st_mtime > output.stat().st_mtime]
    return f"{newer[0]} is newer, or made anew" if newer else ""


def due_of(chosen, scale, backend, ogc):
    """Returns (recipe, its due steps, each with the reason in words), in an order in which they can be done."""
    made, found = set(), []
    for recipe in chosen:
        steps = []
        for step in recipes.steps(recipe, scale, backend, ogc):
            if why := why_due(step, made):
                made.add(step.output)
                steps.append((step, why))
        found.append((recipe, steps))
    return found


class Known:
    """Holds what is known of the steps that may be due, by name: figure, words, log, and duration [s], None if not
    known."""

    def __init__(self, runs, scale, backend, names):
        measured = recipes.measured_times()
        self.figure, self.words, self.logs, self.seconds = {}, {}, {}, {}
        for recipe in recipes.choose(names, recipes.load(), backend):
            steps = recipes.steps(recipe, scale, backend, "ogc")
            drawn = "illustration" in recipe.body
            whole = measured.get((recipe.name, "-" if drawn else scale, "-" if drawn else backend))
            for step in steps:
                before = job.record(Path(runs) / step.log)
                self.figure[step.name] = f"{recipe.name} ({recipe.title})"
                self.words[step.name] = verb(step, recipe)
                self.logs[step.name] = Path(runs) / step.log
                self.seconds[step.name] = before.get("seconds", whole[0] / len(steps) if whole else None)


class Course:
    """Holds the names of the steps that are due, running and done; `said` are lines that are worth keeping."""

    def __init__(self, known, due, clock=time.monotonic):
        self.known, self.due, self.clock = known, due, clock
        self.begun, self.done, self.failed, self.said = {}, [], [], deque()

    def begins(self, name):
        self.begun[name] = self.clock()

    def ends(self, name, seconds):
        self.begun.pop(name)
        self.done.append(name)
        took = recipes.in_words(seconds)
        self.said.append(f"{self.place(name, len(self.done))}: {self.known.words[name]} took {took}")

    def fails(self, name, words):
        self.begun.pop(name)
        self.failed.append(name)
        self.said.append(f"{self.known.figure[name]}: {words}")

    def place(self, name, number):
        return f"Step {number} of {len(self.due)}, {self.known.figure[name]}"

    def far(self, name):
        """Returns (steps done, of how many) from the log of the running program, or None; for a study it counts runs,
        as if each of its scenes had as many."""
        log = self.known.logs[name]
        if not log.is_file():
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
        """Returns (the seconds left as far as they are known, whether that covers everything)."""
        total, whole = 0.0, True
        for name in self.due:
            if name in self.done or name in self.failed:
                continue
            expected, worked = self.known.seconds.get(name), self.clock() - self.begun.get(name, self.clock())
            far = self.far(name) if name in self.begun else None
            if far:
                total += worked * (far[1] - far[0]) / far[0]
            elif expected is not None:
                total += max(expected - worked, 0)
            else:
                whole = False
        return total, whole

    def line(self):
        """Returns the current state in words; empty if nothing is running."""
        begun = dict(self.begun)  # other threads end steps meanwhile
        if not begun:
            return ""
        name = min(begun, key=begun.get)
        far = self.far(name)
        beside = f", {len(begun) - 1} more beside it" if len(begun) > 1 else ""
        seconds, whole = self.left()
        time_left = f"{'about' if whole else 'at least'} {recipes.in_words(seconds)} left" if seconds >= 1 else (
            "almost done" if whole else "no time is known yet")
        at = f", {far[0]} of {far[1]}" if far else ""
        return f"{self.place(name, len(self.done) + 1)}: {self.known.words[name]}{at}{beside}; {time_left}"


class Screen:
    """Shows a line that is redrawn on a terminal, and plain lines every SAY seconds in a file."""

    def __init__(self, stream):
        self.stream, self.terminal, self.said, self.drawn = stream, stream.isatty(), time.monotonic(), False

    def keep(self, line):
        self.clear()
        print(line, file=self.stream, flush=True)

    def show(self, line, fresh):
        """Shows the line. `fresh`: a new step has begun, which is shown at once."""
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
    """Returns the last `size` bytes of a file as text."""
    with path.open("rb") as file:
        file.seek(max(0, path.stat().st_size - size))
        return file.read().decode(errors="replace")


class Cores:
    """Distributes the cores among the steps."""

    def __init__(self, count):
        self.count = self.free = count
        self.changed = threading.Condition()

    @contextlib.contextmanager
    def taken(self, step):
        wanted = self.count if step.all_cores or step.gpu else 1
        with self.changed:
            self.changed.wait_for(lambda: self.free >= wanted)
            self.free -= wanted
        try:
            yield
        finally:
            with self.changed:
                self.free += wanted
                self.changed.notify_all()


def do(steps, course, cores, limit):
    """Does the due steps of one figure, until one fails or the limit comes."""
    for step, _ in steps:
        with cores.taken(step):
            if limit.left() == 0:
                return
            course.begins(step.name)
            try:
                course.ends(step.name, job.run(step.log, step.output, step.command, limit))
            except job.StepFailure as failure:
                if limit.left() > 0:
                    course.fails(step.name, str(failure))
                return


def do_all(found, course, screen, jobs, limit):
    """Does all due steps; pictures of other figures' runs come after these. Shows the progress."""
    cores, at_work = Cores(jobs), None
    for later in (False, True):
        with ThreadPoolExecutor(max_workers=max(1, len(found))) as pool:
            tasks = [pool.submit(do, steps, course, cores, limit) for recipe, steps in found
                     if ("of" in recipe.body) == later]
            while course.said or not all(task.done() for task in tasks):
                while course.said:
                    screen.keep(course.said.popleft())
                now = set(course.begun)
                if line := course.line():
                    screen.show(line, now != at_work)
                at_work = now
                time.sleep(LOOK)
            screen.clear()
        for task in tasks:
            task.result()


def epilogue(course, seconds):
    """Describes in words how it ended."""
    if course.failed:
        return f"{len(course.failed)} of {len(course.due)} steps FAILED, {len(course.done)} done"
    return f"All {len(course.done)} steps done in {recipes.in_words(seconds)}"


def run(options, stream=sys.stderr):
    """Does the due steps and returns the exit status."""
    chosen = recipes.choose(options.figures, recipes.load(), options.backend)
    ogc, limit, begun = str(Path(options.ogc).resolve()), Limit(), time.monotonic()
    recipes.program_stamp(options.runs, ogc)
    os.chdir(options.runs)
    os.environ.update(PYTHONPATH=str(recipes.ROOT), OGC_STAMP=recipes.PROGRAM)
    found = due_of(chosen, options.scale, options.backend, ogc)
    due = [step.name for _, steps in found for step, _ in steps]
    if options.dry_run or not due:
        print("\n".join(f"{step.name} → {step.output}: {why}" for _, steps in found for step, why in steps)
              or "Nothing is missing or changed", file=stream)
        return 0
    for stop in (signal.SIGINT, signal.SIGTERM):
        signal.signal(stop, lambda *_: limit.stop())
    course, screen = Course(Known(".", options.scale, options.backend, options.figures), due), Screen(stream)
    do_all(found, course, screen, options.jobs, limit)
    if limit.left() == 0:
        screen.keep("Interrupted. What is finished is kept: call it again to go on")
        return 130
    screen.keep(epilogue(course, time.monotonic() - begun))
    return 1 if course.failed else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    add = parser.add_argument
    add("runs", type=Path)
    add("ogc")
    add("scale", choices=recipes.SCALES)
    add("backend", choices=("cpu", "cuda"))
    add("figures", nargs="*")
    add("--jobs", type=int, default=os.cpu_count() or 1, help="cores to use at most (default: all)")
    add("--dry-run", action="store_true", help="say what is due, and why")
    try:
        sys.exit(run(parser.parse_intermixed_args()))
    except recipes.RecipeError as error:
        sys.exit(f"reproduce: {error}")


if __name__ == "__main__":
    main()
