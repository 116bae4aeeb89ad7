"""Makes the runs of figures and of Table 1, with a limit of time: what is finished is kept, what was
cut off goes on from its checkpoint at the next call. Needs Python's own library and a program `ogc`
(experiments/bundle).

Exit status: 0 all is finished, 75 the limit came first (call again to go on), 1 a job failed, 2 wrong words. An
interrupt, or SIGTERM, as a cluster sends it, is a limit that comes now. A job that is asked to stop has a minute for
the step at hand and its checkpoint: leave it that.

  python3 -m paper_figures.workflow.runner --program bundle/ogc --out runs --time-limit 500 --pack packed twist fig02
  python3 -m paper_figures.workflow.runner --program build/default/ogc --out runs --unpack packed    # where it is drawn
  python3 -m paper_figures.workflow.runner --program bundle/ogc --scale small --backend cpu --cores 36 --pack packed
"""

import argparse
import contextlib
import os
import shutil
import signal
import sys
import textwrap
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from paper_figures.workflow import packing, parts, schedule
from paper_figures.workflow.device_memory import DeviceMemory
from paper_figures.workflow.jobs import (CALL_AGAIN, FAILED, FINISHED, KEPT, MEMORY, STOPPED, Limit, RunFailure,
                                         here, manifest_of)

PACK_EVERY = 100.0  # seconds, with --cores


class Runner:
    """Makes parts of a book below one folder, with one program."""

    def __init__(self, program, out, limit, part_limit=None, jobs=1, after_job=lambda: None):
        self.program, self.out, self.limit, self.part_limit, self.jobs = program, out, limit, part_limit, jobs
        self.after_job = after_job  # is called in the job's thread, which has given its place back

    def chain(self, part, chain, limit):
        """Makes a chain's jobs and returns the worst way in which one ended; a job that begins with the state of a
        failed run is left out."""
        root, ends = self.out / part.folder, [KEPT]
        for job in chain:
            state = getattr(job, "state", ())
            if state and manifest_of(root / state[0]).get("status", "").startswith("failed"):
                continue
            wanted = job.on_device and not job.done(root)
            with self.place(job, limit), DeviceMemory(root / f"{job.name}{MEMORY}", wanted):
                ends.append(job.make(self.program, root, limit))
            if ends[-1] == FINISHED:
                self.after_job()
            if ends[-1] == STOPPED:
                return STOPPED
        return FINISHED if FINISHED in ends else KEPT

    def place(self, _job, _limit):
        """Returns a context with a place for a job; here it is the machine."""
        return contextlib.nullcontext()

    def part(self, part):
        """Makes a part and returns how it ended. Throws RunFailure with the messages of its chains, when all have
        ended."""
        limit = Limit(self.part_limit, self.limit)
        with ThreadPoolExecutor(max_workers=self.jobs) as pool:
            tasks = [pool.submit(here(self.chain, part, chain, limit)) for chain in part.chains]
        problems = [task.exception() for task in tasks if task.exception()]
        unexpected = next((problem for problem in problems if not isinstance(problem, RunFailure)), None)
        if unexpected:
            raise unexpected
        if problems:
            raise RunFailure("\n  ".join(map(str, problems)))
        ends = [task.result() for task in tasks] or [KEPT]
        self.show(part)
        return next(end for end in (STOPPED, FINISHED, KEPT) if end in ends)

    def show(self, part):
        """Links the run of the part's first job to the folder where the workflow looks for it, if that does not
        exist."""
        link, run = self.out / part.shown_as, self.out / part.folder / part.chains[0][0].name if part.shown_as else None
        if run and manifest_of(run).get("status") == "finished" and not link.exists():
            link.parent.mkdir(parents=True, exist_ok=True)
            link.unlink(missing_ok=True)
            link.symlink_to(os.path.relpath(run, link.parent))

    def make(self, name, part):
        """Makes a part, prints its line, and returns how it ended."""
        begun, words = time.monotonic(), ""
        if self.limit.left() == 0:
            print(f"{name:24} not begun: no time is left; call again to go on", flush=True)
            return STOPPED
        try:
            end = self.part(part)
        except RunFailure as problem:
            end, words = FAILED, f"\n  {problem}"
        print(f"{name:24} {time.monotonic() - begun:7.1f} s  {end}{words}", flush=True)
        return end


def arguments():
    names = textwrap.fill(" ".join(parts.book(parts.Wanted())), 110, initial_indent="  ", subsequent_indent="  ")
    figures = " ".join(sorted({part.recipe for part in parts.book(parts.Wanted()).values()} - {""}))
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter,
        epilog=f"Parts, the most wanted first:\n{names}\nFigures: {figures}")
    add = parser.add_argument
    add("parts", nargs="*", metavar="PART", help="what is made, in this order (default: all figures)")
    add("--figures", nargs="+", default=(), metavar="FIGURE", help="all parts of these")
    add("--program", default="build/default/ogc", help="ogc (default: build/default/ogc)")
    add("--out", type=Path, default=Path("runs"), help="where the runs are, or go (default: runs)")
    add("--scale", default="paper", choices=("smoke", "small", "paper"))
    add("--backend", default="cuda", choices=("cpu", "cuda"), help="of VBD in single precision (default: cuda)")
    add("--time-limit", type=float, metavar="SECONDS", help="of the whole call")
    add("--part-limit", type=float, metavar="SECONDS", help="of each part")
    add("--jobs", type=int, default=1, help="chains of a part that go on side by side (default: 1)")
    add("--cores", type=int, default=0, metavar="N",
        help="on the CPU: jobs of all parts side by side on so many cores (default: part after part)")
    add("--known", type=Path, metavar="FILE", help="with --cores: times.json of an earlier call, which plans this one")
    add("--last", action="store_true",
        help="with --cores: no call follows; runs with a limit of their own are complete where --time-limit stops them")
    add("--plan", action="store_true", help="with --cores: print the jobs, the longest chain first, and run nothing")
    add("--pack", type=Path, metavar="FOLDER", help="after each part, pack what is finished and was not packed before")
    add("--unpack", type=Path, metavar="FOLDER", help="unpack what --pack packed, and run nothing")
    table = parser.add_argument_group("Table 1")
    add = table.add_argument
    add("--window", type=int, default=0, metavar="N",
        help="steps of a window on the CPU (default: 10; 20 below scale paper)")
    add("--runs", type=int, default=1, metavar="N", help="whole runs, of which the table takes the median (default: 1)")
    add("--steps", type=int, default=0, metavar="N", help="end whole runs at this step (default: the scene's end)")
    add("--audit", default="afterwards", choices=("afterwards", "every", "frame", "end", "off"),
        help="of whole runs: afterwards in time of its own (default), or beside them")
    add("--data", default="", metavar="FOLDER", help="of Codimensional IPC's dress and dancer (default: a stand-in)")
    add = parser.add_argument_group("Fig. 19").add_argument
    add("--window-seconds", type=float, default=0, metavar="N",
        help="of IPC's windows, and of Newton's steps at most (default: 120; 5 at scale smoke)")
    return parser


def unpacked(options):
    """Unpacks archives and returns the exit status."""
    try:
        for path in packing.unpack(options.unpack, options.out, options.program):
            print(path)
    except packing.UnpackError as error:
        print(f"runner: {options.unpack}: {error}; nothing is unpacked", file=sys.stderr)
        return 1
    return 0


def made(options, chosen):
    """Makes the chosen parts and returns the exit status."""
    limit = Limit(options.time_limit)
    for stop in (signal.SIGINT, signal.SIGTERM):
        signal.signal(stop, lambda *_: limit.stop())
    runner = Runner(options.program, options.out, limit, options.part_limit, options.jobs)
    archive = packing.Archive(options.pack, options.out) if options.pack else None
    ends, lines = [], []
    for name, part in chosen.items():
        ends.append(runner.make(name, part))
        if archive:
            lines = archive.write(chosen)
    print("\n".join(lines), end="\n" if lines else "")
    if FAILED in ends:
        return 1
    return CALL_AGAIN if STOPPED in ends else 0


def planned(tasks, cores):
    """Prints tasks, the longest chain first."""
    chain = schedule.longest_chain(tasks)
    work = sum(task.cores * task.seconds for task in tasks.values())
    said = ", ".join(f"{task.name} {task.seconds:.0f}" for task in chain)
    print(f"{len(tasks)} jobs, {work:.0f} s of a core, {work / cores:.0f} s of {cores} cores; the longest chain, "
          f"{chain[0].follows if chain else 0:.0f} s: {said}")
    for task in sorted(tasks.values(), key=lambda task: -task.follows):
        print(f"{task.follows:8.0f} {task.seconds:8.0f} s on {task.cores:2} cores  {task.name}")


def made_together(options, chosen):
    """Makes the jobs of the chosen parts side by side, packs what is finished every PACK_EVERY seconds, and returns the
    exit status."""
    limit = Limit(options.time_limit)
    for stop in (signal.SIGINT, signal.SIGTERM):
        signal.signal(stop, lambda *_: limit.stop())
    tasks = schedule.tasks_of(chosen, options.out, schedule.known_in(options.known))
    if options.plan:
        planned(tasks, options.cores)
        return 0
    runner, packed = Runner(options.program, options.out, limit), [time.monotonic()]

    def pack():
        packed[0] = time.monotonic()
        if options.pack:
            print("\n".join(packing.Archive(options.pack, options.out).write(chosen)[-1:]), flush=True)

    def after(task, _):
        for name in task.parts:
            if chosen[name].chains[0][:1] == (task.job,):
                runner.show(chosen[name])
        if time.monotonic() - packed[0] >= PACK_EVERY:
            pack()

    cpus = sorted(os.sched_getaffinity(0))[:options.cores]
    ends = schedule.Maker(options.program, options.out, limit, options.last).make(tasks, cpus, after)
    pack()
    for name in [name for name, end in ends.items() if end in (STOPPED, "left out")]:
        print(f"{ends[name]}: {name}")
    if FAILED in [end for name, end in ends.items() if not getattr(tasks[name].job, "may_fail", False)]:
        return 1
    return CALL_AGAIN if STOPPED in ends.values() else 0


def main():
    parser = arguments()
    options = parser.parse_intermixed_args()
    if options.unpack:
        sys.exit(unpacked(options))
    keys = ("scale", "backend", "window", "runs", "steps", "audit", "data", "window_seconds")
    wanted = parts.Wanted(**{key: getattr(options, key) for key in keys})
    try:
        chosen = parts.chosen(parts.book(wanted), options.parts, options.figures)
    except KeyError as word:
        parser.error(f"no part or figure {word}; --help lists them")
    if not shutil.which(options.program):
        parser.error(f"no program at '{options.program}': build it first, or name it with --program")
    if options.cores and options.backend != "cpu":
        parser.error("--cores is for --backend cpu: runs on a device would measure each other; leave one out")
    sys.exit((made_together if options.cores else made)(options, chosen))


if __name__ == "__main__":
    main()
