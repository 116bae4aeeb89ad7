"""Makes all evidence of one program, in parts with a limit of time: `experiments/evidence` calls it.

On a device (`gpu`): the runs of all figures and of Table 1 at the paper's size, what the judge counts, the laws of
motion, jittered starts, the ablations, the measured study of the mat, yarn's return; windows on the processors come
last. On processors (`cores`): the same at scale small on the CPU, the ablations at smoke, and what needs no device:
drawings and the other measured studies. Left out are other people's programs (experiments/peers/run), sanitizers and
fuzz, which need builds of their own, and tables about rejected ideas.

What is finished is kept, what the limit cut off goes on at the next call, which is due as long as the exit status is
75. As runs end, tables, manifests and some frames are packed into archives (--pack) of at most 16 MiB, or of one larger
file. On another machine, or at home, --unpack brings them back: what is in them is not made again, but a run that
begins with a state that was not packed is refused there. Everything is of one program: runs of another one in the
folder are made again, its archives are refused, and so is a program with uncommitted changes, or whose sources are not
those of the checkout's HEAD.

Expected times are those of an earlier call into the same folder, else of the accepted results, on the machine that made
them; "–" where nobody measured. Python's own library is enough, except for the list of ablations, which needs PyYAML:
where that is missing, --studies names the file that --write-studies wrote elsewhere. Drawings and measured studies need
the project's Python environment; where NumPy is missing they are left out, which is said.

What is finished becomes results by `python3 -m paper_figures.workflow.taken MACHINE RUNS`, and figures by
`experiments/reproduce FIGURE … --unpack PACKED --accept MACHINE`.

Exit status: 0 all is finished, 1 a part failed (the others were made), 2 wrong words, 75 the limit came first.

Examples:
  experiments/evidence cores --dry-run                                    # what there is, and how long it takes
  experiments/evidence cores --time-limit 3600 --pack packed              # on two cores, an hour at a time
  experiments/evidence gpu --program bundle/ogc --time-limit 500 --pack packed --studies studies.json
  experiments/evidence gpu --cards 4 --time-limit 500 --pack packed --frames 0  # four cards side by side, tables alone
  experiments/evidence gpu --cards 4 --unpack packed --pack packed        # goes on, on another machine
  CUDA_VISIBLE_DEVICES=0,0,0,0,0 experiments/evidence gpu --cards 5 fig15 fig16 judge  # on one card; no times are kept
  taskset -c 0-15 experiments/evidence gpu fig18_solvers windows_twist    # times of 16 processors of a larger machine
  experiments/evidence gpu judge twist fig20                              # these parts alone
"""

import argparse
import csv
import hashlib
import io
import json
import math
import os
import re
import shutil
import subprocess
import sys
import threading
import time
from dataclasses import dataclass, replace
from importlib.util import find_spec
from pathlib import Path

from paper_figures.workflow import commands, contents, packing, parts, varied
from paper_figures.workflow.audited import Audit
from paper_figures.workflow.durations import RESULTS, in_words, measured_times, seconds_between
from paper_figures.workflow.jobs import (AUDIT, CALL_AGAIN, CORES, DEVICE, FAILED, FINISHED, KEPT, STOPPED, Limit,
                                         RunFailure, Step, command_in, last_lines)
from paper_figures.workflow.runner import Runner
from paper_figures.workflow.side_by_side import SideBySide

# In the folder of the runs: what the program says of itself, newer than the runs of another one (STAMP); part ->
# seconds that its calls took, and whether it is finished (TIMES).
STAMP, TIMES = packing.STAMP, packing.TIMES
FOUND = (0, 1)  # exit status of a command that came to an end; 1: a check failed, which is a result
JITTERED = ("twist", "knot", "dress")
STARTS = 10  # jittered ones
SEEDS = {"smoke": 2, "small": 10, "paper": 10}  # of the judge
CASES = {"smoke": 100, "small": 100_000, "paper": 1_000_000}  # that it asks of a cheap stage, of a dear one a tenth
CHEAP = ("rest_state", "closest_face", "closest_points", "block", "detect_vertex_facet", "detect_edge_edge", "bound",
         "initial_guess", "activation", "contact_force", "friction_force", "volume_force", "membrane", "bending",
         "spring", "tetrahedron", "rod", "truncate")
DEAR = ("plane", "volume_depth", "orientation", "sweep", "step")  # for the reference, whose answers take the time
# Study -> whether it has scales.
MEASURED = {"activation_load": True, "creep": True, "falling": False, "left_forces": False, "radius": True}
MEASURED_ON_DEVICE = ("mat_volumes",)
SECONDS = "part_seconds.csv"  # of a machine's results: how long parts took there
ON_DEVICE = "cuda: usable"  # what the program says of a machine with a device
LARGEST = 2**20  # bytes of a packed file
PACK_EVERY = 20  # seconds at least between two packings, which take seconds of all parts


class PlanError(Exception):
    """Raised for what can't be planned or may not be run; the message says what to do."""


def line_of(said, begin):
    """Returns the rest of the line that begins so, of what a program says of itself; empty if there is none."""
    return next((line.strip().removeprefix(begin) for line in said.splitlines() if line.strip().startswith(begin)), "")


def number_of(value):
    return "inf" if value is None else f"{value:.4g}"


def program_in(said):
    """Returns what names the program in what it says of itself: not the machine's devices."""
    return said.partition("backends")[0]


@dataclass(frozen=True)
class Command:
    """Runs a command as a job (jobs.py) in a folder of its own, with its standard output in said.txt there.

    `words` begin with PROGRAM or PYTHON; FOLDER stands for the job's folder. `kept`: patterns of the files there that
    are packed. `judged`: it says whether answers are right, and no time, so that it needs cores and no device for
    itself. A command of another program, or with other words, is run again; one that was cut off is called again and
    goes on by itself."""

    name: str
    words: tuple
    kept: tuple = ()
    on_device: bool = False
    judged: bool = False

    PROGRAM, PYTHON, FOLDER = "{ogc}", "{python}", "{folder}"

    @property
    def needs(self):
        return DEVICE if self.on_device and not self.judged else CORES

    def digest(self):
        said = program_in(Path(os.environ["OGC_STAMP"]).read_text())
        return hashlib.sha256(json.dumps([said, self.words]).encode()).hexdigest()

    def record(self, root):
        path = root / self.name / "made.json"
        return json.loads(path.read_text()) if path.is_file() else {}

    def done(self, root):
        return "status" in self.record(root) and self.record(root)["digest"] == self.digest()

    def make(self, program, root, limit=Limit(), _shown=False):
        folder, digest = root / self.name, self.digest()
        if self.done(root):
            return KEPT
        if self.record(root).get("digest") != digest:
            shutil.rmtree(folder, ignore_errors=True)
        if limit.left() == 0:
            return STOPPED
        folder.mkdir(parents=True, exist_ok=True)
        (folder / "made.json").write_text(json.dumps({"digest": digest}))
        stands = {self.PROGRAM: str(program), self.PYTHON: sys.executable, self.FOLDER: str(folder)}
        words = [re.sub("|".join(map(re.escape, stands)), lambda found: stands[found[0]], word) for word in self.words]
        code, _ = command_in(words, limit, folder / "log.txt", folder / "said.part")
        if code not in FOUND:
            if limit.left() == 0:
                return STOPPED
            raise RunFailure(f"{' '.join(words)}: exit status {code}\n  {last_lines(folder / 'log.txt')}")
        (folder / "said.part").replace(folder / "said.txt")
        made = {"digest": digest, "status": code, "words": self.words,
                "said": Path(os.environ["OGC_STAMP"]).read_text()}
        (folder / "made.json").write_text(json.dumps(made))
        return FINISHED

    def results(self, root, _frames, _last):
        if self.done(root):
            found = (path for pattern in ("made.json", "said.txt", *self.kept)
                     for path in sorted((root / self.name).glob(pattern)))
            yield from (path for path in found if path.is_file() and path.stat().st_size <= LARGEST)


@dataclass(frozen=True)
class Counts:
    """Makes the table of what the judge counted, a row for each stage and seed, from the seeds that are there."""

    backend: str
    seeds: tuple
    on_device = None  # it takes no time

    @property
    def name(self):
        return f"judge_{self.backend}"

    def done(self, _root):
        return False

    def rows(self, root):
        for seed in self.seeds:
            said = seed.record(root).get("said", "")
            device = re.search(r"\((.*)\)", line_of(said, f"{self.backend}: "))
            for stage in json.loads((root / seed.name / "said.txt").read_text())["stages"] if seed.done(root) else ():
                # JSON has no infinity: an answer that is no number has none.
                errors = "; ".join(f"{each['name']} {number_of(each['maximum'])}/{number_of(each['tolerance'])}"
                                   for each in stage["metrics"])
                yield {"stage": stage["stage"], "generator": "all", "seed": seed.name.split("_")[1],
                       "cases": stage["cases"], "mismatches": stage["mismatches"],
                       "grey share of generic cases": stage["grey_share_generic"],
                       "largest errors over tolerances": errors, "seconds": f"{stage['seconds']:.2f}",
                       "device": device[1] if device else "", "commit": line_of(said, "commit ")[:10]}

    def make(self, _program, root, _limit=Limit(), _shown=False):
        rows, out, path = list(self.rows(root)), io.StringIO(), root / f"{self.name}.csv"
        if rows:
            writer = csv.DictWriter(out, fieldnames=list(rows[0]), lineterminator="\n")
            writer.writeheader()
            writer.writerows(rows)
            if not path.is_file() or path.read_text() != out.getvalue():  # a file that changes is packed again
                path.write_text(out.getvalue())
        return KEPT

    def results(self, root, _frames, _last):
        self.make("", root)
        yield from (path for path in [root / f"{self.name}.csv"] if path.is_file())


def commands_of(name, made, wanted):
    """Returns a part whose jobs are independent commands."""
    return parts.Part(wanted.folder(name), tuple((job,) for job in made), frames=0)


def judged(wanted):
    """Returns the judge's counts under SEEDS seeds, and, as a part of its own, digests that another machine can
    compare."""
    begin, on_device = (Command.PROGRAM, "compare", "--backend", wanted.backend), wanted.backend == "cuda"
    cases = CASES[wanted.scale]
    made = tuple(Command(f"seed_{seed}_{kind}", (*begin, *stages, "--cases", str(number), "--seed", str(seed), "--json",
                                                 "--report", Command.FOLDER), ("report.txt",), on_device, True)
                 for seed in range(1, 1 + SEEDS[wanted.scale])
                 for kind, stages, number in (("cheap", CHEAP, cases), ("dear", DEAR, cases // 10)))
    same = Command("all", (*begin, "--determinism", "--json"), (), on_device, True)
    return {"judge": parts.Part(wanted.folder("judge"), (*((each,) for each in made), (Counts(wanted.backend, made),)),
                                frames=0),
            "determinism": commands_of("determinism", [same], wanted)}


def laws(wanted):
    words = (Command.PROGRAM, "laws", "--backend", wanted.backend, "--json", *(["--quick"] * (wanted.scale == "smoke")))
    return commands_of("laws", [Command("all", words, (), wanted.backend == "cuda", True)], wanted)


def ablated(name, scene, words, backend):
    return Command(f"{name}/{scene}", (Command.PROGRAM, *words, "--out", f"{Command.FOLDER}/runs"),
                   ("runs/*.csv", "runs/*/run.json"), backend == "cuda")


def jittered(wanted):
    """Returns jittered starts of scenes in which a perturbation grows, with both bounds; with balls twisted cloth has
    the query radius of its row."""
    near = lambda row: commands.NEAR if row in commands.NEAR_ROWS else ()  # noqa: E731
    made = [ablated(f"starts/{bounds}", scene, ("ablate", scene, "--scale", wanted.scale, "--backend", wanted.backend,
                                                "--audit", "end", *near(row), "--point", f"bounds={bounds}",
                                                "--repeat", str(STARTS), "--jitter", "1e-6"), wanted.backend)
            for scene in JITTERED for bounds, row in (("ball", scene), ("planes", f"{scene}{commands.WITH_PLANES}"))]
    return commands_of("jittered", made, wanted)


def studies(wanted, listed):
    """Returns a part for each study of the ablations. `listed`: its commands by name, scene and scale."""
    return {name: commands_of(name, [ablated("runs", *scene, wanted.backend) for scene in scenes.items()], wanted)
            for name, scenes in studies_of(listed, wanted.scale, wanted.backend).items()}


def studies_of(listed, scale, backend):
    """Returns study -> scene -> words of `ogc ablate` of a kind of machine: a solver that knows processors alone is not
    asked on a device."""
    asked = {name: scenes[scale][backend] for name, scenes in listed.items()}
    return {name: scenes for name, scenes in asked.items()
            if backend == "cpu" or not any("--solver" in words for words in scenes.values())}


def list_of_studies():
    """Returns study -> scale -> backend -> scene -> words of `ogc ablate`. Throws PlanError without PyYAML."""
    try:
        from paper_figures.figures.ablations import study
    except ImportError as error:
        raise PlanError(f"the ablations are listed in YAML files, and {error.name} is missing: write them elsewhere "
                        "with --write-studies, and name the file with --studies; or leave them out with --no-studies"
                        ) from error
    return {path.stem: {scale: {backend: {scene: study.command(body, scene, scale, backend)
                                          for scene in study.scenes_at(body, scale)} for backend in ("cpu", "cuda")}
                        for scale in ("smoke", "small", "paper")}
            for path in sorted(study.HERE.glob("*.yaml")) for body in [study.load(path.stem)]}


def measured_studies(where, wanted):
    """Returns what is drawn or measured in the project's Python environment."""
    scale = ("--scale", wanted.scale)
    of_study = lambda name, *more: commands_of(name, [Command(  # noqa: E731
        "all", (Command.PYTHON, "-m", f"paper_figures.figures.measured.{name}", Command.FOLDER, "--ogc",
                Command.PROGRAM, *more), ("*.csv", "*.png"), "cuda" in more)], wanted)
    if where == "gpu":
        return {name: of_study(name, *scale, "--backend", wanted.backend) for name in MEASURED_ON_DEVICE}
    draw = Command("all", (Command.PYTHON, "-m", "paper_figures.workflow.local", Command.FOLDER, Command.PROGRAM,
                           wanted.scale, "cpu", "illustrations"), ("*/*.png", "*/*.json", "*/*.gz"))
    return {"illustrations": commands_of("illustrations", [draw], wanted),
            **{name: of_study(name, *(scale if has_scales else ())) for name, has_scales in MEASURED.items()}}


def plan(where, wanted, listed, data=""):
    """Returns name -> Part of all evidence on a machine of this kind, in the order in which it is made. `data`: the
    folder of the published dress, whose repeated runs stand beside those of the stand-in."""
    book = parts.book(wanted)
    last = {name: book.pop(name) for name in list(book) if name.startswith("windows_")}
    small = replace(wanted, scale="smoke") if wanted.scale == "small" else wanted
    return {**book, **judged(wanted), "laws": laws(wanted), "jittered": jittered(wanted),
            **studies(small, listed), **measured_studies(where, wanted),
            **varied.parts_of(where, replace(wanted, data=data)), **last}


def accepted_seconds(name, wanted, times):
    """Returns how long a part took where its accepted results were made: a row's run and its audit, or a figure; None
    if nobody measured."""
    part = (name, wanted.scale, wanted.backend)
    for row in (row for path in sorted(RESULTS.glob(f"*/{SECONDS}")) for row in contents.rows_of(path)):
        if (row["part"], row["scale"], row["backend"]) == part:
            return float(row["seconds"])
    run = RESULTS / f"h200/{name}_run.json"
    if wanted.scale == "paper" and run.is_file():
        audit = run.with_name(f"{name}_{AUDIT}")
        audited = json.loads(audit.read_text()).get("seconds", 0) if audit.is_file() else 0
        return (seconds_between(json.loads(run.read_text())) or 0) + audited
    if name.removeprefix("windows_") in parts.ROWS and (steps := seconds_of_steps(name, wanted)):
        return steps
    if name == "illustrations":
        return sum(seconds for (_, scale, _), (seconds, _) in times.items() if scale == "-")
    known = times.get((name, wanted.scale, wanted.backend))
    return known[0] if known else varied.EXPECTED.get(name) if wanted.scale == "paper" else None


def seconds_of_steps(name, wanted):
    """Returns how long the steps of a row's whole run, or of its windows on the CPU, took by the accepted tables; 0 if
    they have no such row."""
    row = name.removeprefix("windows_")
    if wanted.scale == "paper":
        windows = contents.rows_of(RESULTS / "h200/cpu_windows_paper.csv") if row != name else []
        return sum(int(each["steps"]) * float(each["mean step [ms]"]) for each in windows if each["row"] == row) / 1000
    table = contents.rows_of(RESULTS / f"two_cores/table1_{wanted.scale}.csv") if wanted.backend == "cpu" else []
    return sum(int(each["steps"]) * float(each["average [ms]"]) for each in table
               if each["scene"] == row and (int(each["steps"]) < int(each["of steps"])) == (row != name)) / 1000


def measured_before(out):
    path = out / TIMES
    return json.loads(path.read_text()) if path.is_file() else {}


def groups(chosen):
    """Returns lists of names of parts, those that share a run together, so that no two cards make it at once."""
    found = []
    for name, part in chosen.items():
        runs = {f"{part.folder}/{job.name}" for job in part.jobs}
        mine = [group for group in found if group[1] & runs]
        found = [group for group in found if group not in mine]
        found.append(([other for group in mine for other in group[0]] + [name], runs.union(*(g[1] for g in mine))))
    return [names for names, _ in found]


def said_by(program):
    """Returns what the program says of itself. Throws PlanError if there is none."""
    if not shutil.which(program):
        raise PlanError(f"no program at '{program}': build it first, or name it with --program")
    # Runs that share a device name it several times. CUDA finds no device in such a list.
    named = os.environ.get("CUDA_VISIBLE_DEVICES")
    once = {} if named is None else {"CUDA_VISIBLE_DEVICES": ",".join(dict.fromkeys(named.split(",")))}
    return subprocess.run([program, "--version"], capture_output=True, text=True, check=True,
                          env={**os.environ, **once}).stdout


def check_program(said):
    """Throws PlanError if the program is of a changed tree, or of other sources than the checkout's HEAD."""
    commit = line_of(said, "commit ")
    if not contents.HEX.fullmatch(commit):
        raise PlanError(f"the program is of '{commit}': commit, build, and call again; --changed tries it all the same")
    try:
        rooms = slice(len(contents.ROOMS))  # what the judge says is old by itself (contents.py)
        same = contents.of_history([commit])[commit][rooms] == contents.of_head()[rooms]
    except contents.ContentsError:  # a machine that has the bundle alone
        return
    if not same:
        raise PlanError(f"the program is of commit {commit[:10]}, whose sources are not those of HEAD: build it; "
                        "--changed tries it all the same")


def stamp(out, said):
    """Keeps what the program says of itself, and so makes runs of another one in the folder due (jobs.same_command);
    another machine makes nothing due, and one without a device does not replace what one with a device says."""
    path = out / STAMP
    out.mkdir(parents=True, exist_ok=True)
    if not path.is_file() or program_in(path.read_text()) != program_in(said):
        path.write_text(said)
        (out / TIMES).unlink(missing_ok=True)
    elif path.read_text() != said and (ON_DEVICE in said or ON_DEVICE not in path.read_text()):
        about = path.stat()
        path.write_text(said)
        os.utime(path, ns=(about.st_atime_ns, about.st_mtime_ns))
    os.environ["OGC_STAMP"] = str(path)


def half_made(chosen, times, packed):
    """Returns the folders of packed runs whose states jobs of their part still need and which were not packed: these
    runs are made again. `packed`: member -> its archive."""
    for name, part in chosen.items():
        again = set()
        # A run begins with the states of one before it in its chain.
        for job in reversed(part.jobs) if times.get(name, {}).get("end") not in (FINISHED, KEPT) else ():
            again.add(lacking(job, part, packed, getattr(job, "name", "") in again))
        yield from (f"{part.folder}/{run}/" for run in sorted(again - {""}))


def lacking(job, part, packed, again):
    """Returns the run of which a job needs states that were not packed, or "". `again`: the job is made again."""
    if hasattr(job, "of"):
        audit = f"{part.folder}/{job.of}/{AUDIT}"
        said = packing.read(packed[audit], audit) if isinstance(job, Audit) and audit in packed else "{}"
        return "" if json.loads(said).get("complete") else job.of
    if not getattr(job, "state", ()) or f"{part.folder}/{job.name}/run.json" in packed and not again:
        return ""
    run, place = job.state
    frames = f"{part.folder}/{run}/frames/frame_"
    if isinstance(place, Step):
        return "" if f"{frames}{place.number:06d}.h5" in packed else run
    last = isinstance(place, int) and place < 0 and (part.last >= -place or place == -1 and part.frames > 1)
    return "" if last and any(name.startswith(frames) for name in packed) else run


def bring(folder, out, said, chosen):
    """Unpacks what --pack packed of this program, and takes over how long its parts took. Throws PlanError where
    nothing is there or it is of another program, UnpackError for a damaged archive."""
    found = sorted(folder.glob("runs_*.tar.gz"))
    if not found:
        raise PlanError(f"{folder} has no runs_NN.tar.gz: name the folder that --pack filled")
    for path in found:
        if program_in(packing.read(path, STAMP)) != program_in(said):
            commit = line_of(packing.read(path, STAMP), "commit ") or "unknown"
            raise PlanError(f"{path.name} is of another program (commit {commit}): move it away")
    packed = {name: path for path in found for name in packing.members(path)}
    left_out = (STAMP, TIMES, *half_made(chosen, packing.take_times(found, out), packed))
    for path in found:
        packing.note(out, packing.extract(path, out, left_out))


def dry_run(chosen, seconds, before):
    """Prints the parts with their expected times."""
    print(f"{'part':32} {'expected':>10}  state")
    for name in chosen:
        state = before.get(name, {}).get("end", "")
        print(f"{name:32} {'–' if seconds[name] is None else in_words(seconds[name]):>10}  {state}".rstrip())
    known = [seconds[name] for name in chosen if seconds[name] is not None]
    print(f"{len(chosen)} parts; the {len(known)} that were measured before take {in_words(sum(known))} together")


def make(options, chosen):
    """Makes the chosen parts, packs them as they end, and returns the exit status."""
    limit = Limit(options.time_limit)
    common = (options.program, options.out, limit, options.part_limit, options.jobs)
    archive = packing.Archive(options.pack, options.out, options.frames, (STAMP, TIMES)) if options.pack else None
    ends, lock, packed_at = [], threading.Lock(), [-math.inf]
    if not (options.out / TIMES).is_file():
        (options.out / TIMES).write_text("{}\n")

    def pack():  # as soon as a job ends: a machine that is taken away takes what was not packed
        with lock:
            if archive and time.monotonic() - packed_at[0] > PACK_EVERY:
                archive.write(chosen)
                packed_at[0] = time.monotonic()

    def ended(name, end, seconds):
        with lock:
            ends.append(end)
            for job in chosen[name].jobs:
                if isinstance(job, Counts):
                    job.make("", options.out / chosen[name].folder)
            times = measured_before(options.out)
            earlier = times.get(name, {}).get("seconds", 0)
            times[name] = {"seconds": round(earlier + seconds, 1), "end": end}
            (options.out / TIMES).write_text(json.dumps(times, indent=1) + "\n")
        pack()

    if options.cards:
        SideBySide(*common, cards=options.cards, after_job=pack).make_all(chosen, groups(chosen), ended)
    else:
        for name, part in chosen.items():
            begun = time.monotonic()
            ended(name, Runner(*common, after_job=pack).make(name, part), time.monotonic() - begun)
    lines = archive.write(chosen) if archive else []
    print("\n".join(lines), end="\n" if lines else "")
    return 1 if FAILED in ends else CALL_AGAIN if STOPPED in ends else 0


def arguments():
    parser = argparse.ArgumentParser(prog="experiments/evidence", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    add = parser.add_argument
    add("where", choices=("cores", "gpu"), help="what the machine has")
    add("parts", nargs="*", metavar="PART", help="these alone, in this order (default: all; --dry-run lists them)")
    add("--dry-run", action="store_true", help="list the parts, their expected times and how they ended; run nothing")
    add("--program", default="build/default/ogc", help="ogc (default: build/default/ogc)")
    add("--out", type=Path, default=Path("runs/evidence"), help="where runs go (default: runs/evidence)")
    add("--scale", choices=("smoke", "small", "paper"), help="default: small on cores, paper on a GPU")
    add("--time-limit", type=float, metavar="SECONDS", help="of the whole call")
    add("--part-limit", type=float, metavar="SECONDS", help="of each part")
    add("--jobs", type=int, default=1, help="chains of a part that go on side by side (default: 1)")
    add("--pack", type=Path, metavar="FOLDER", help="pack what is finished, as runs end")
    add("--unpack", type=Path, metavar="FOLDER", help="first unpack what --pack packed, which then is not made again")
    add("--frames", type=int, metavar="N", help="pack at most N frames of a run (default: as its picture needs)")
    add("--cards", type=int, default=0, metavar="N", help="make parts side by side on N devices of this machine")
    add("--studies", type=Path, metavar="FILE", help="the ablations' commands, where PyYAML is missing")
    add("--no-studies", action="store_true", help="leave the ablations out")
    add("--data", type=Path, metavar="FOLDER", help="of Codimensional IPC's dress and dancer, whose steps are repeated")
    add("--write-studies", type=Path, metavar="FILE", help="write that file, and run nothing")
    add("--changed", action="store_true", help="also a program of other sources than HEAD's; its runs are no evidence")
    return parser


def prepared(options):
    """Returns (parts to make, their expected seconds). Throws PlanError, and KeyError with a name that is no part."""
    wanted = parts.Wanted(scale=options.scale or {"cores": "small", "gpu": "paper"}[options.where],
                          backend={"cores": "cpu", "gpu": "cuda"}[options.where])
    data = str(options.data.resolve(strict=True)) if options.data else ""
    whole = plan(options.where, wanted, {}, data)
    if not options.no_studies and (not options.parts or set(options.parts) - set(whole)):
        listed = json.loads(options.studies.read_text()) if options.studies else list_of_studies()
        whole = plan(options.where, wanted, listed, data)
    for name in options.parts:
        if name not in whole:
            raise KeyError(name)
    chosen = {name: whole[name] for name in options.parts or whole}
    lacking = [] if options.parts or find_spec("numpy") else list(measured_studies(options.where, wanted))
    if lacking:
        print(f"evidence: left out, as NumPy is missing: {', '.join(lacking)}", file=sys.stderr)
        chosen = {name: part for name, part in chosen.items() if name not in lacking}
    before, times = measured_before(options.out), measured_times()
    seconds = {name: before[name]["seconds"] if before.get(name, {}).get("end") in (FINISHED, KEPT)
               else accepted_seconds(name, wanted, times) for name in chosen}
    return chosen, seconds


def main():
    parser = arguments()
    options = parser.parse_intermixed_args()
    try:
        if options.write_studies:
            options.write_studies.write_text(json.dumps(list_of_studies()))
            return
        chosen, seconds = prepared(options)
        if options.dry_run:
            dry_run(chosen, seconds, measured_before(options.out))
            return
        said = said_by(options.program)
        if not options.changed:
            check_program(said)
        stamp(options.out.resolve(), said)
        if options.unpack:
            bring(options.unpack, options.out, said, chosen)
    except KeyError as name:
        parser.error(f"no part {name}; --dry-run lists them")
    except (PlanError, packing.UnpackError, OSError) as error:
        parser.error(str(error))
    sys.exit(make(options, chosen))


if __name__ == "__main__":
    main()
