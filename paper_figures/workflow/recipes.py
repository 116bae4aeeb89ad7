"""Describes figures as steps: the command that makes a file from other files. One YAML file a figure (figNN.yaml) lists
what is run and drawn; `local.py` does the steps on this machine, Snakemake (paper_figures/workflow/Snakefile) on a
Slurm cluster. Paths are relative to the folder of the runs.

Keys of a YAML file: `illustrations`, with a title for each; or `title` with `scene`, `script` (a module of
paper_figures.figures) and `run` (options of `ogc run`; without it the script makes its runs itself, with `options`), or
`script` with `of` (figures whose runs it draws); `movie: yes` if the script makes one of its run; or `study`
(figures/ablations/study.py describes its keys); or `rows` of Table 1; `backends` if only one makes sense; `kept` if
results hold only the runs whose names match one of these patterns, and of the others their rows in the figure's table.
A figure that is not implemented has `title`, `scene` and `missing`: what the program lacks for it.
"""

import argparse
import csv
import hashlib
import json
import sys
from dataclasses import dataclass
from pathlib import Path

import yaml

from paper_figures.workflow import parts
from paper_figures.workflow.audited import Audit
from paper_figures.workflow.durations import in_words, measured_times, seconds_between
from paper_figures.workflow.jobs import manifests_below

HERE = Path(__file__).parent
ROOM = HERE.parent
FIGURES, RESULTS, ROOT = ROOM / "figures", ROOM / "results", ROOM.parent
SCALES = ("smoke", "small", "paper")
PROGRAM = "program.txt"
REPRESENTATIVE = "fig18"
RUNS = ("commands.py", "layers.py", "release.py", "slide.py")  # modules that define the runs of figures with several
# Files that determine a run's numbers; a change elsewhere (tests, plots, documents) reruns nothing.
SOURCES = ("compare", "reference", "fast", "experiments")
KEYS = {"title", "illustrations", "scene", "script", "run", "row", "options", "of", "movie", "rows", "paper_rows",
        "backends", "missing", "kept", "study", "beyond"}
STUDIES = "ablations"  # the studies' folder, and the name for all of them
QUICK = ("fig17", "fig18", "fig18_solvers", "fig20")  # with illustrations: experiments/reproduce --quick, at small


class RecipeError(Exception):
    """Raised for a figure that does not exist or can't be made in this way; the message lists what there is."""


@dataclass(frozen=True)
class Step:
    """Holds a command (list of words) that makes `output` out of `inputs`; `gpu`: number of devices it needs;
    `all_cores`: it uses every core."""

    name: str
    output: str
    inputs: tuple
    command: tuple
    gpu: int = 0
    all_cores: bool = False

    @property
    def log(self):
        """Returns the log's path, beside the output, or beside the folder of a run, which is removed when the run
        begins anew."""
        here = Path(self.output).parent
        return f"{here.parent if Path(self.output).name == 'run.json' else here}/{self.name}.log"


@dataclass(frozen=True)
class Recipe:
    name: str
    title: str
    scene: str
    backends: tuple
    body: dict

    @property
    def file(self):
        """Returns the YAML file of the recipe."""
        if "illustration" in self.body:
            return "illustrations.yaml"
        return f"{STUDIES}/{self.name}.yaml" if "study" in self.body else f"{self.name}.yaml"

    def folder(self, scale, backend):
        return "illustrations" if "illustration" in self.body else f"{self.name}-{scale}-{backend}"

    def picture(self, scale, backend):
        """Returns the last file that the recipe makes."""
        return f"{self.folder(scale, backend)}/{self.name}" + (f"_{scale}.csv" if "rows" in self.body else ".png")

    def movie(self, scale, backend):
        """Returns the movie that the recipe makes besides, or None."""
        return f"{self.folder(scale, backend)}/{self.name}.mp4" if self.body.get("movie") else None

    def outputs(self, scale, backend):
        """Returns every file that the workflow has to make."""
        if "missing" in self.body:
            return []
        return [path for path in (self.picture(scale, backend), self.movie(scale, backend)) if path]


def load(folder=FIGURES):
    """Returns name -> Recipe. Throws RecipeError if a file has a key that nothing reads."""
    bodies = {}
    for path in sorted([*Path(folder).glob("*.yaml"), *Path(folder).glob(f"{STUDIES}/*.yaml")]):
        body = yaml.safe_load(path.read_text())
        unknown = set(body) - KEYS
        if unknown:
            known = ", ".join(sorted(KEYS))
            raise RecipeError(f"{path.name}: unknown key {', '.join(sorted(unknown))}; there are: {known}")
        drawn = body.get("illustrations", {})
        bodies.update({name: {"title": title, "illustration": name} for name, title in drawn.items()}
                      or {path.stem: body})
    return {name: Recipe(name, body["title"], body.get("scene", ""), tuple(body.get("backends", ("cpu", "cuda"))), body)
            for name, body in sorted(bodies.items())}


def shown_of(body):
    """Returns figure -> folder of its run that a picture of other figures' runs shows; fig19/planes/whole is the run
    planes/whole of fig19."""
    return {name: run or "run" for name, _, run in (text.partition("/") for text in body.get("of", ()))}


def choose(names, recipes, backend):
    """Returns recipes by figure, scene, `illustrations`, `ablations` or `all`: what the paper has. Throws RecipeError
    for a name that is none of these, is not implemented, or has no such backend."""
    chosen, apart = [], {"missing", "study", "beyond"}
    for name in names or [REPRESENTATIVE]:
        found = [r for r in recipes.values() if r.name == name] or [r for r in recipes.values() if r.scene == name][:1]
        if name == "all":
            found = [r for r in recipes.values() if backend in r.backends and not apart & set(r.body)]
        elif name == "illustrations":
            found = [r for r in recipes.values() if "illustration" in r.body]
        elif name == STUDIES:
            found = [r for r in recipes.values() if "study" in r.body]
        elif name == "quick":
            found = [r for r in recipes.values() if r.name in QUICK or "illustration" in r.body]
        there = [r.name for r in recipes.values() if "missing" not in r.body]
        if not found:
            raise RecipeError(f"no figure or scene '{name}'; there are: {', '.join(there)}, illustrations, {STUDIES}, "
                              "all")
        if "missing" in found[0].body:
            missing = found[0]
            raise RecipeError(f"{missing.name} ({missing.scene}) is not there yet: the program has no "
                              f"{missing.body['missing']}. "
                              f"There are: {', '.join(there)}")
        if backend not in found[0].backends:
            raise RecipeError(f"{found[0].name} compares solvers of the CPU: it has no backend '{backend}'; leave "
                              "--backend out")
        chosen += [r for r in found if r not in chosen]
    needed = [recipes[name] for r in chosen for name in shown_of(r.body)]
    # figures that draw other figures' runs come after these
    return sorted([*chosen, *(r for r in needed if r not in chosen)], key=lambda r: "of" in r.body)


def steps(recipe, scale, backend, ogc, python=sys.executable):
    """Returns the steps of a figure, in an order in which they can be done; none for one that is not implemented."""
    if "missing" in recipe.body:
        return []
    here, gpu = recipe.folder(scale, backend), int(backend == "cuda")
    picture = recipe.picture(scale, backend)
    drawing = (python, "-m", f"paper_figures.figures.{recipe.body.get('script', 'illustrations')}")
    plots = tuple(str(path) for path in sorted((ROOT / "plots").glob("*.py")))
    script = (str(FIGURES / f"{recipe.body['script'].replace('.', '/')}.py"),) if "script" in recipe.body else ()
    if "illustration" in recipe.body:
        data = f"{here}/{recipe.name}.json"
        return [Step(f"{recipe.name}_data", data, (PROGRAM,), (ogc, "illustrate", recipe.name, "--out", here)),
                Step(recipe.name, picture, (data, str(FIGURES / "illustrations.py"), *plots),
                     (*drawing, here, recipe.name))]
    runner = (python, "-m", "paper_figures.workflow.runner", "--program", ogc, "--out", ".", "--scale", scale,
              "--backend", backend)
    if {"run", "row"} & set(recipe.body):
        run, movie = f"{here}/run", recipe.movie(scale, backend)
        # A row's run is made once for Table 1 and its figure, which has a link to it.
        options = ("--scale", scale, "--backend", backend, *map(str, recipe.body.get("run", ())), "--out", run)
        command = (*runner, recipe.name) if "row" in recipe.body else (ogc, "run", recipe.scene, *options)
        inputs = (f"{run}/run.json", *script, *plots)
        return [Step(f"{recipe.name}_run", f"{run}/run.json", (PROGRAM,), command, gpu, all_cores=True),
                Step(recipe.name, picture, inputs, (*drawing, run, "--out", picture)),
                *([Step(f"{recipe.name}_movie", movie, inputs, (*drawing, run, "--movie", movie))] if movie else [])]
    if "rows" in recipe.body:
        return _table(recipe, scale, backend, runner)
    if "of" in recipe.body:
        drawn = [f"{name}-{scale}-{backend}/{run}" for name, run in shown_of(recipe.body).items()]
        # A figure that makes its runs itself has its picture as output.
        made = [f"{name}-{scale}-{backend}/" + ("run/run.json" if run == "run" else f"{name}.png")
                for name, run in shown_of(recipe.body).items()]
        return [Step(recipe.name, picture, (*made, *script, *plots), (*drawing, picture, *drawn))]
    options = [str(option).format(backend=backend) for option in recipe.body.get("options", [])]
    # A study's runs follow from its own file; those of a figure with several runs from the modules that list them.
    made_by = (*script, *((str(FIGURES / recipe.file),) if "study" in recipe.body
                          else (str(HERE / name) for name in RUNS)))
    movie = recipe.movie(scale, backend)
    drawing = (*drawing, here, "--ogc", ogc, "--scale", scale, *options)
    return [Step(recipe.name, picture, (PROGRAM, *made_by, *plots), drawing, gpu, all_cores=True),
            *([Step(f"{recipe.name}_movie", movie, (picture, *script, *plots), (*drawing, "--movie", movie))]
              if movie else [])]


def _table(recipe, scale, backend, runner):
    """Returns the steps of Table 1. The output of a row's step is the row's last run: the others continue where they
    were interrupted. Windows on the CPU stand beside the runs of a device alone."""
    here, scripts = recipe.folder(scale, backend), tuple(str(HERE / name) for name in RUNS)
    names = (*recipe.body["rows"], *(recipe.body["paper_rows"] if scale == "paper" else ()))
    book, rows = parts.book(parts.Wanted(scale, backend)), []
    for row in names:
        asked = (row,) if backend == "cpu" else (row, f"windows_{row}")
        last = [job.name for name in asked for job in book[name].jobs if not isinstance(job, Audit)][-1]
        rows.append(Step(f"{recipe.name}_{row}", f"{here}/{last}/run.json", (PROGRAM, *scripts), (*runner, *asked),
                         int(backend == "cuda"), all_cores=True))
    gather = Step(recipe.name, recipe.picture(scale, backend),
                  (*(row.output for row in rows), str(FIGURES / "table1.py")),
                  (runner[0], "-m", "paper_figures.figures.table1", here))
    return [*rows, gather]


def program_stamp(runs, ogc):
    """Writes PROGRAM into the folder of the runs, only if it changed. It is a digest of the sources, so that a new
    build of the same sources reruns nothing, or of the program itself if it was not built here."""
    digest, ogc = hashlib.sha256(), Path(ogc).resolve()
    ours = ogc.is_relative_to(ROOT / "build")
    files = sorted(p for room in SOURCES for p in (ROOT / room).rglob("*")
                   if p.suffix in (".cpp", ".hpp", ".h", ".cu", ".cuh")) if ours else [ogc]
    for path in files:
        digest.update((path.relative_to(ROOT) if ours else path).as_posix().encode() + b"\0" + path.read_bytes())
    stamp = Path(runs) / PROGRAM
    if not stamp.is_file() or stamp.read_text() != digest.hexdigest():
        stamp.parent.mkdir(parents=True, exist_ok=True)
        stamp.write_text(digest.hexdigest())


def seconds_of(recipe, scale, backend, runs):
    """Returns the duration of a finished figure's steps here [s], or None. It is at least that of its runs, because a
    script that found them done was quick. Unpacked runs have no logs of steps: their own duration alone counts."""
    records = [json.loads(path.read_text()) for path in (runs / f"{step.log}.json" for step in
                                                         steps(recipe, scale, backend, "ogc")) if path.is_file()]
    took = [record["seconds"] for record in records if "seconds" in record]
    of_runs = sum(map(seconds_of_run, manifests_below(runs / recipe.folder(scale, backend))))
    if 0 < len(took) < len(steps(recipe, scale, backend, "ogc")) or not (took or of_runs):
        return None
    return max(sum(took), of_runs)


def seconds_of_run(path):
    """Returns the time from a run's start to its end [s], or that of the steps of a run that was resumed, because such
    a run waited; 0 if it has not ended."""
    manifest, rows = json.loads(path.read_text()), path.with_name("steps.csv")
    if "resumed" in manifest and rows.is_file():
        with rows.open(newline="") as file:
            return sum(float(row["wall [ms]"]) for row in csv.DictReader(file)) / 1000
    return seconds_between(manifest) or 0.0


def durations(chosen, scale, backend, runs, machine):
    """Returns rows of results/MACHINE/durations.csv: the durations of the finished ones of the `chosen` figures
    here."""
    for recipe in chosen:
        took, drawn = seconds_of(recipe, scale, backend, runs), "illustration" in recipe.body
        if took is not None:
            yield {"figure": recipe.name, "scale": "-" if drawn else scale, "backend": "-" if drawn else backend,
                   "seconds": f"{took:.1f}", "machine": machine}


def table(recipes, scale, backend, runs):
    """Returns the lines of --list."""
    times, lines = measured_times(), [f"{'figure':22} {'scene':23} {'scale':6} {'time (measured on)':34} done  title"]
    for recipe in recipes.values():
        used = backend if backend in recipe.backends else recipe.backends[0]
        drawn = "illustration" in recipe.body
        known = times.get((recipe.name, "-" if drawn else scale, "-" if drawn else used))
        time = f"{in_words(known[0])} ({known[1]})" if known else "not measured"
        if "missing" in recipe.body:
            time = "not there yet"
        drawn_here = (Path(runs) / recipe.picture(scale, used)).is_file()
        done = "-" if "missing" in recipe.body else "yes" if drawn_here else "no"
        lines.append(f"{recipe.name:22} {recipe.scene or '-':23} {'-' if drawn else scale:6} {time:34} {done:5} "
                     f"{recipe.title}")
    return lines


def arguments():
    parser = argparse.ArgumentParser(description="Lists the figures (used by experiments/reproduce).")
    parser.add_argument("--scale", default="small", choices=SCALES)
    parser.add_argument("--backend", default="cpu", choices=("cpu", "cuda"))
    parser.add_argument("--runs", default=ROOT / "runs", type=Path)
    parser.add_argument("--check-names", nargs="*", help="only say whether there are such figures")
    parser.add_argument("--pictures", nargs="*", help="the file that each figure ends in")
    parser.add_argument("--with-runs", nargs="*", help="those of the figures whose runs the runner makes")
    parser.add_argument("--stamp", metavar="OGC", help="only say in the folder of the runs which program it is")
    return parser.parse_args()


def asked(options):
    """Carries out the options that end main before any step, and returns the lines to print. Throws RecipeError."""
    book, scale, backend = load(), options.scale, options.backend
    if options.stamp:
        program_stamp(options.runs, options.stamp)
        return []
    if options.check_names is not None:
        choose(options.check_names, book, backend)
        return []
    if options.pictures is not None:
        return [str(options.runs / recipe.picture(scale, backend))
                for recipe in choose(options.pictures, book, backend)]
    if options.with_runs is not None:
        there = {part.recipe for part in parts.book(parts.Wanted(scale, backend)).values()}
        return [recipe.name for recipe in choose(options.with_runs, book, backend) if recipe.name in there]
    return table(book, scale, backend, options.runs)


def main():
    try:
        for line in asked(arguments()):
            print(line)
    except RecipeError as error:
        print(f"reproduce: {error}", file=sys.stderr)
        sys.exit(2)


if __name__ == "__main__":
    main()
