"""All runs of the paper's size that need a GPU or many cores, in one command, for a machine that is lent by the minute and has nothing but Python and the
program (experiments/bundle).

    python3 -m paper_figures.workflow.device_runs --program PROGRAM --out RUNS [--seconds N] [--keep FOLDER] [PART …]   a limit for each part; call again to go on
    python3 -m paper_figures.workflow.device_runs --out RUNS --pack FOLDER      what is finished and was not packed before, as pieces of at most 16 MB;
                                                                       --keep does so after each part, for a machine that may be taken away
    python3 -m paper_figures.workflow.device_runs --program PROGRAM --out runs --unpack FOLDER   at home: the figures' scripts find these runs finished

Folders are those of the workflow (figNN-SCALE-BACKEND), whole runs and windows of Table 1 those of experiments/table1. Packed are manifests, rows and some frames.
Beside each run on a GPU the device's memory is sampled (device_memory.py).
"""

import argparse
import json
import math
import os
import shutil
import subprocess
import sys
import tarfile
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

from paper_figures.figures import growth
from paper_figures.workflow import commands, in_time
from paper_figures.workflow.device_memory import DeviceMemory
from paper_figures.workflow.evidence import AUDIT
from paper_figures.workflow.timed_runs import FAILED, FINISHED, KEPT, STOPPED, Job, Limit, RunFailure, command_in, last_lines, make, manifest_of
from paper_figures.workflow.unpacking import UnpackError, extract_file

TABLE1 = Path(__file__).parents[2] / "experiments/table1"
ROWS = {"twist": "fig12", "fifty_layers_1m": "", "cloth_on_sphere": "fig18", "fifty_layers": "fig10", "knot": "fig11", "dress": "fig13", "robot_shirt": "fig14"}  # and the figures of their whole runs
PIECE, TOTAL = 15 * 2**20, 60 * 2**20  # bytes of a packed piece, and of all together
LEFT_OUT = "did not fit"
LEFT_FOR_THE_NEXT = 75  # exit status of experiments/table1 at its limit


@dataclass(frozen=True)
class Part:
    """Runs of one figure, or of one row of Table 1; chains may run side by side. Of each run `frames` are packed, evenly over it, and the `last` ones.
    `solvers`: of paper_figures.workflow.in_time, one after the other, each on all cores."""

    folder: str
    chains: tuple = ()
    row: str = ""
    windows: bool = False
    figure: str = ""
    frames: int = 4
    last: int = 0
    gpu: bool = True
    solvers: tuple = ()
    prepare: Callable | None = None  # of (program, folder), before the first run


def parts(scale, backend):
    """name -> Part, the most wanted first."""
    def figure(name):
        return f"{name}-{scale}-{backend}"

    def row(name, frames=4):
        return Part(figure("table1"), row=name, figure=ROWS[name] and figure(ROWS[name]), frames=frames)

    both = ["cpu", "cuda"] if backend == "cuda" else ["cpu"]
    single, double = commands.three_cloths(scale, both)
    half_turn, half_turn_ipc = commands.beside_ipc(commands.TWIST, scale, backend)
    windows = commands.ipc_windows(commands.TWIST, half_turn.name, commands.TWIST_WINDOWS, commands.TWIST_STEPS, scale)
    half_turn_by_ipc = [half_turn_ipc] if scale != "paper" else windows
    drop, ipc = commands.beside_ipc(commands.ONE_ITERATION, scale, backend)
    on_device = tuple(job for job in single if "cpu" not in job.name or backend == "cpu")
    wanted = {"twist": row("twist", frames=40), "fig02": Part(figure("fig02"), ((half_turn,),), frames=13), "fig20": Part(figure("fig20"), ((drop,),), frames=25),
              "fig17": Part(figure("fig17"), (on_device,), frames=0, last=1), "fifty_layers_1m": row("fifty_layers_1m", frames=0),
              "cloth_on_sphere": row("cloth_on_sphere", frames=21), "fifty_layers": row("fifty_layers", frames=3), "knot": row("knot", frames=17),
              "dress": row("dress", frames=20), "robot_shirt": row("robot_shirt", frames=20)}
    solvers = ("ipc", "newton", "vbd", *(["vbd_cuda"] if backend == "cuda" else []))
    on_cores = {"fig17_cpu": Part(figure("fig17"), (tuple(job for job in single if "cpu" in job.name),), frames=0, last=1, gpu=False),
                "fig21": Part(figure("fig21"), tuple(map(tuple, commands.activations(scale, backend))), frames=0, last=2),
                "fig02_ipc": Part(figure("fig02"), tuple((window,) for window in half_turn_by_ipc), frames=2, gpu=False),
                "fig20_ipc": Part(figure("fig20"), ((ipc,),), frames=25, gpu=False),
                "fig17_double": Part(figure("fig17"), tuple((job,) for job in double), frames=0, last=1, gpu=False),
                # A figure of the CPU, as its recipe says: a ratio is of the same cores, and of nothing beside them.
                "fig18_solvers": Part(f"fig18_solvers-{scale}-cpu", frames=21, solvers=solvers)}
    cores = os.cpu_count() or 1
    over = {name: Part(figure("growth"), (tuple(jobs),), frames=0, gpu=name == "growth_cuda", prepare=growth.scenes_of(jobs))
            for name, jobs in (*((f"growth_{kind}", growth.sizes(scale, kind)) for kind in reversed(both)), ("threads", growth.threads(scale, cores)))}
    windows = {f"windows_{name}": Part(figure("table1"), row=name, windows=True, frames=0, gpu=False) for name in sorted(ROWS, key="fifty_layers_1m".__eq__)}
    return {**wanted, **over, **on_cores, **windows}


class Machine:
    """Where the runs go, and with what."""

    def __init__(self, options):
        self.program, self.out, self.options = options.program, Path(options.out), options
        self.book, self.all = parts(options.scale, options.backend), Limit(options.all_seconds)

    def chain(self, part, jobs, limit):
        """The worst end of its jobs; one that can't begin because another was stopped is stopped, too."""
        ends = [KEPT]
        for job in jobs:
            if job.state and manifest_of(self.out / part.folder / job.state[0]).get("status", "").startswith("failed"):
                continue
            with DeviceMemory(self.out / part.folder / f"{job.name}_device_memory.json", part.gpu and self.options.backend == "cuda"):
                ends.append(make(self.program, job, self.out / part.folder, limit))
            if ends[-1] == STOPPED:
                return STOPPED
        return FINISHED if FINISHED in ends else KEPT

    def chains(self, part, limit):
        if part.prepare:
            part.prepare(self.program, self.out / part.folder)
        with ThreadPoolExecutor(max_workers=self.options.jobs) as pool:
            tasks = [pool.submit(self.chain, part, jobs, limit) for jobs in part.chains]
        problems = [str(task.exception()) for task in tasks if task.exception()]
        if problems:
            raise RunFailure("\n".join(problems))
        ends = [task.result() for task in tasks]
        return next(end for end in (STOPPED, FINISHED, KEPT) if end in ends)

    def in_parts(self, part, limit):
        """By paper_figures.workflow.in_time, which keeps and goes on by itself; a process a solver, which so knows its processor time."""
        folder = self.out / part.folder
        if all(in_time.ended(folder / name) for name in part.solvers):
            return KEPT
        for name in part.solvers:
            if limit.left() == 0:
                return STOPPED
            if not in_time.ended(folder / name):
                self.in_time(folder, name, part, limit)
            if not in_time.ended(folder / name):
                return STOPPED
        return FINISHED

    def in_time(self, folder, name, part, limit):
        log = folder / f"{name}.log"
        options = ["--ogc", self.program, "--scale", self.options.scale, "--seconds", limit.left(), "--solvers", name]
        with DeviceMemory(folder / f"{name}_device_memory.json", part.gpu and name == "vbd_cuda"):
            code = command_in([sys.executable, "-m", "paper_figures.workflow.in_time", folder, *options], log, Limit())
        if code != 0:
            raise RunFailure(f"paper_figures.workflow.in_time {name}: exit status {code}\n  {last_lines(log)}")

    def table(self, part, limit):
        """By experiments/table1, which keeps and resumes by itself; the figure of the row's scene is drawn of the whole run."""
        o, log = self.options, self.out / part.folder / f"{part.row}_{'windows' if part.windows else 'whole'}.log"
        extra = ["--skip", "whole", "--window", o.window] if part.windows else ["--skip", "cpu"]
        extra += ["--data", o.data] if o.data and part.row == "dress" else []
        seconds = [] if math.isinf(limit.left()) else ["--seconds", int(limit.left())]
        with DeviceMemory(self.out / part.folder / f"{part.row}_device_memory.json", part.gpu and o.backend == "cuda"):
            where = [self.out / part.folder, part.row, "--scale", o.scale, "--backend", o.backend]
            code = command_in([TABLE1, self.program, *where, *extra, *seconds], log, Limit())
        if code == LEFT_FOR_THE_NEXT:
            return STOPPED
        if code != 0:
            raise RunFailure(f"experiments/table1 {part.row}: exit status {code}\n  {last_lines(log)}")
        if part.figure and not part.windows:
            link = self.out / part.figure / "run"
            link.parent.mkdir(parents=True, exist_ok=True)
            if not link.is_symlink():
                link.symlink_to(os.path.relpath(self.out / part.folder / part.row / "whole", link.parent))
        return FINISHED if log.read_text().strip() else KEPT

    def limit(self):
        """Of the part that begins now."""
        seconds = min(self.options.seconds or math.inf, self.all.left())
        return Limit(None if math.isinf(seconds) else max(seconds, 1e-9))

    def do(self, name):
        """Makes a part; prints its line. True where it failed."""
        part, begun, words = self.book[name], time.monotonic(), ""
        limit = self.limit()
        if limit.left() == 0:
            print(f"{name:24} not begun: no time is left; call again to go on")
            return False
        try:
            make_part = self.table if part.row else self.in_parts if part.solvers else self.chains
            end = make_part(part, limit)
        except RunFailure as problem:
            end, words = FAILED, f"\n  {problem}"
        print(f"{name:24} {time.monotonic() - begun:7.1f} s  {end}{words}", flush=True)
        return end == FAILED


def run_folders(out, part):
    """Finished run folders of a part, or failed ones where to fail is a result; of runs made in parts all, where the last is finished."""
    if part.solvers:
        solvers = [out / part.folder / name for name in part.solvers]
        return [made for solver in solvers if in_time.ended(solver) for made in in_time.parts(solver)]
    if part.row:
        row = out / part.folder / part.row
        found = sorted(row.glob("cpu_*")) if part.windows else sorted(row.glob("whole*")) + sorted(row.glob("residual_*"))
    else:
        found = [out / part.folder / job.name for jobs in part.chains for job in jobs]
    return [folder for folder in found if manifest_of(folder).get("status", "").startswith(("finished", "failed: Newton"))]


def chosen_frames(folder, part):
    """The part's frames of a run: the first, evenly on to the last, and the last ones."""
    frames = sorted((folder / "frames").glob("frame_*.h5"))
    spread = {round(i * (len(frames) - 1) / (part.frames - 1)) for i in range(part.frames)} if part.frames > 1 and frames else set()
    return [frame for i, frame in enumerate(frames) if i in spread or i >= len(frames) - part.last]


def files_of(out, part):
    """What is packed of a part."""
    for folder in run_folders(out, part):
        frames = [] if folder.name.startswith("residual_") else chosen_frames(folder, part)
        names = ("run.json", "steps.csv", "iterations.csv", in_time.PROCESSOR_TIME, AUDIT)
        yield from (folder / name for name in names if (folder / name).is_file())
        yield from frames
        if frames:
            yield from sorted(path for path in (folder / "scene").glob("*") if path.is_file())
    yield from sorted((out / part.folder).glob("*_device_memory.json")) if part.gpu else ()
    if part.figure and (out / part.figure / "run").is_symlink():
        yield out / part.figure / "run"


def packed_before(out):
    """Part -> its run folders that were packed."""
    kept = out / "packed.json"
    return json.loads(kept.read_text()) if kept.is_file() else {}


def pack(out, book, folder, before=None):
    """Pieces of one archive of every finished part that was not packed before, as long as they fit; returns lines about them. `before`: what counts as packed
    before, where not all that was; the pieces in the folder are replaced. Other processes may do so with other parts."""
    packed, lines = dict(packed_before(out) if before is None else before), []
    folder.mkdir(parents=True, exist_ok=True)
    out.mkdir(parents=True, exist_ok=True)
    whole = out / f"packed_{os.getpid()}.tar.gz"
    with tarfile.open(whole, "w:gz", compresslevel=6) as archive:
        found, inside = [(name, list(files_of(out, part))) for name, part in book.items()], set()
        sizes = {name: sum(path.lstat().st_size for path in files) for name, files in found}
        for name, files in sorted(found, key=lambda item: sizes[item[0]]):  # a piece that is lost on its way takes few runs along
            runs = [path.parent.as_posix() for path in files if path.name == "run.json"]
            if not runs or packed.get(name) == runs:
                continue
            size = sizes[name]
            if archive.fileobj.fileobj.tell() + size > TOTAL:  # as if nothing were compressed
                lines.append(f"{name}: {size / 2**20:.1f} MiB {LEFT_OUT}; take these pieces away, then --pack another folder")
                continue
            for path in dict.fromkeys(files):
                name_inside = path.relative_to(out).as_posix()
                if name_inside not in inside:  # the device's memory lies beside all rows of a table
                    archive.add(path, name_inside)
                    inside.add(name_inside)
            packed[name] = runs
            lines.append(f"{name}: {len(runs)} runs, {size / 2**20:.1f} MiB")
    data = whole.read_bytes()
    for number, first in enumerate(range(0, len(data), PIECE)):
        (folder / f"runs_{number:02d}").write_bytes(data[first:first + PIECE])
    whole.unlink()
    (out / "packed.json").write_text(json.dumps({**packed_before(out), **packed}))
    return [*lines, f"{-(-len(data) // PIECE)} pieces in {folder}, {len(data) / 2**20:.1f} MiB"]


def unpack(folder, out, program):
    """Unpacks what `pack` made, and assembles what draws the meshes (trajectory.vtkhdf) of the frames that came along."""
    out.mkdir(parents=True, exist_ok=True)
    whole = out / "packed.tar.gz"
    whole.write_bytes(b"".join(path.read_bytes() for path in sorted(folder.glob("runs_*"))))
    try:  # a part is never above TOTAL, and a call packs each of them once at most
        names = extract_file(whole, out, TOTAL, TOTAL * len(parts("paper", "cuda")))
    except UnpackError as error:
        sys.exit(f"device_runs: {folder}: {error}; nothing is unpacked")
    finally:
        whole.unlink()
    for run in sorted({(out / name).parent for name in names if name.endswith("run.json")}):
        if any((run / "frames").glob("*")) and not (run / "trajectory.vtkhdf").is_file():
            scratch = run / "exported"
            subprocess.run([str(program), "export", str(run), "--format", "obj", "--out", str(scratch)], check=True, stdout=subprocess.DEVNULL)
            for path in scratch.iterdir():
                path.unlink()
            scratch.rmdir()
        print(run)
    for link in [path for path in out.glob("*/run") if path.is_symlink()]:  # accept.py looks into folders alone
        run = link.resolve()
        link.unlink()
        shutil.copytree(run, link)


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0], epilog="Parts, the most wanted first: " + " ".join(parts("paper", "cuda")))
    parser.add_argument("parts", nargs="*", metavar="PART", help="default: all, in their order")
    parser.add_argument("--program", default="build/default/ogc", help="ogc")
    parser.add_argument("--out", required=True, help="where the runs go")
    parser.add_argument("--scale", default="paper", choices=("smoke", "small", "paper"))
    parser.add_argument("--backend", default="cuda", choices=("cpu", "cuda"))
    parser.add_argument("--seconds", type=float, help="limit of each part")
    parser.add_argument("--all-seconds", type=float, help="limit of all parts together")
    parser.add_argument("--jobs", type=int, default=1, help="chains of a part that run side by side")
    parser.add_argument("--window", type=int, default=200, help="steps of a CPU window of Table 1")
    parser.add_argument("--data", metavar="FOLDER", help="of Codimensional IPC's dress and dancer, for the dress (default: its stand-in)")
    parser.add_argument("--keep", type=Path, metavar="FOLDER", help="after each part pack those of this call that are finished")
    parser.add_argument("--pack", type=Path, metavar="FOLDER", help="pack, and run nothing")
    parser.add_argument("--unpack", type=Path, metavar="FOLDER", help="unpack, and run nothing")
    return parser


def main():
    parser = arguments()
    options = parser.parse_args()
    if options.pack:
        print("\n".join(pack(Path(options.out), parts(options.scale, options.backend), options.pack)))
    elif options.unpack:
        unpack(options.unpack, Path(options.out), options.program)
    else:
        machine = Machine(options)
        unknown = [name for name in options.parts if name not in machine.book]
        if unknown:
            parser.error(f"no part {', '.join(unknown)}; there are: {', '.join(machine.book)}")
        wanted = {name: machine.book[name] for name in options.parts or machine.book}
        before, failed, lines = packed_before(machine.out), False, []
        for name in wanted:
            failed |= machine.do(name)
            if options.keep:
                lines = pack(machine.out, wanted, options.keep, before)
        for line in lines:
            print(line)
        sys.exit(1 if failed or any(LEFT_OUT in line for line in lines) else 0)


if __name__ == "__main__":
    main()
