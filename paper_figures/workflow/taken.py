"""Takes what experiments/evidence made, and no figure keeps, into results/MACHINE: the whole runs of Table 1's rows
with their audits, windows on the processors, the judge's counts and digests, the laws, jittered starts, the ablations,
the measured studies, repeated runs, steps of Fig. 17 by Newton's method and with one choice varied, and how long each
part took. Each file has a row in provenance.csv with the command that makes it again.

Figures are kept by `experiments/reproduce FIGURE … --unpack PACKED --accept MACHINE`, which draws them.

Usage: python3 -m paper_figures.workflow.taken MACHINE RUNS [KIND …] [--scale S] [--backend B] [--partly]. RUNS is the
--out of experiments/evidence, or where its packed files were unpacked (`python3 -m paper_figures.workflow.runner
--unpack PACKED --out RUNS`). A kind is one of those that `--help` lists. A table of which a part is missing is left as
it was, and the part is named; `--partly` takes it all the same, and of a table with rows of parts (JOINED) keeps the
accepted rows of the same sources that it does not replace. Nothing is taken of a program with uncommitted changes, of a
run that failed its audit, or of rows of several commits.
"""

import argparse
import csv
import gzip
import hashlib
import io
import json
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

from paper_figures.figures.table1 import paper
from paper_figures.workflow import accept, captions, commands, contents, everything, parts, varied, yarn_cases
from paper_figures.workflow import steady as repetitions
from paper_figures.workflow.contents import COLUMNS, PROVENANCE, merge, rows_of
from paper_figures.workflow.evidence import RESULTS, SCENES
from paper_figures.workflow.jobs import FINISHED, KEPT, RunFailure
from paper_figures.workflow.kept import AcceptError, file_of, run_files

SHORT = 10  # digits of a commit in a table
DRAWN = "drawn"  # in the words about a picture: the file that the script drew
# Tables of these figures have rows of several parts; the columns tell the parts' rows apart.
JOINED = {"steady": ("variant",), "seconds": ("part", "scale", "backend"), "ablations": ("study", "scene"),
          "jittered": ("scene", "bounds"), "cpu_windows": ("row", "state, share of the run [%]")}
# Columns of jittered_STARTS, from those of `ogc ablate`.
OF_A_START = {"bounds": "bounds", "seed": "seed", "steps [1]": "steps", "median_step [ms]": "median step [ms]",
              "worst_step [ms]": "worst step [ms]", "detections_a_step [1]": "detections a step [1]",
              "contacts_a_step [1]": "contacts a step [1]", "last_elastic_energy [J]": "last elastic energy [J]",
              "largest_lag [m]": "largest lag [m]", "smallest_distance [m]": "smallest distance [m]",
              "median_residual [1]": "median residual [1]", "guarantee_kept": "guarantee kept",
              "final_hash": "final hash", "device": "device"}
OF_AN_ITERATION = ("iteration [1]", "residual [1]", "energy [J]", "largest_change [m]", "share [1]", "vertices_cut [1]",
                   "discrete_detections [1]")


class Missing(Exception):
    """Raised for a table of which a part is not there; the message names it."""


class Runs:
    """Holds the folder of evidence, and the choices that it was made by."""

    def __init__(self, folder, scale, backend, partly=False):
        self.folder, self.partly = folder, partly
        self.wanted = parts.Wanted(scale=scale, backend=backend)

    @property
    def redo(self):
        return f"experiments/evidence {'gpu' if self.wanted.backend == 'cuda' else 'cores'}"

    def of(self, part):
        return self.folder / self.wanted.folder(part)

    def there(self, paths, what):
        """Returns the paths that are files. Throws Missing if there is none, or not all unless some are enough."""
        found = [path for path in paths if path.is_file()]
        if not found or (len(found) < len(paths) and not self.partly):
            lacking = next(path for path in paths if path not in found)
            raise Missing(f"{what}: {lacking.relative_to(self.folder)} is missing")
        return found


def as_csv(rows):
    out = io.StringIO()
    writer = csv.DictWriter(out, fieldnames=list(rows[0]), lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    return out.getvalue().encode()


def origin_of(manifests):
    """Returns commit, compiler, device and end of runs. Throws AcceptError if they are of several programs."""
    commits = sorted({manifest["commit"] for manifest in manifests})
    if len(commits) > 1:
        raise AcceptError(f"runs of commits {', '.join(commit[:SHORT] for commit in commits)}: make all by one program")
    last = max(manifests, key=lambda manifest: manifest["ended"])
    return {key: last[key] for key in ("commit", "compiler", "device", "ended")}


def manifest_of(path):
    """Returns the manifest at `path`. Throws AcceptError if the run is no evidence."""
    manifest = accept.manifest_at(path)
    accept.check(path.parent.as_posix(), manifest)
    return manifest


def rows(runs):
    """Yields the files of each row's whole run that is there, with its audit."""
    found = 0
    for row in parts.ROWS:
        path = runs.of("table1") / row / "whole" / "run.json"
        audit = path.with_name(everything.AUDIT)
        if not path.is_file() or not (runs.partly or audit.is_file() and json.loads(audit.read_text())["complete"]):
            continue
        # The name tells the run from that of a device, because Table 1 has both columns.
        stem = row if runs.wanted.backend == "cuda" else f"{row}_{runs.wanted.backend}"
        size = f" --scale {runs.wanted.scale}" if stem != row else ""
        words = {"figure": stem, "redo": f"{runs.redo}{size} {row}", **origin_of([manifest_of(path)])}
        yield from ((name, data, words) for name, data in run_files(path, stem))
        found += 1
    if not found:
        raise Missing("rows: no whole run with a complete audit")


def windows(runs):
    """Yields the table of steps on the CPU from states of whole runs."""
    names = {(row, share): runs.of("table1") / row / f"cpu_{share}" / "run.json"
             for row in parts.ROWS for share in commands.SHARES}
    runs.there(list(names.values()), "windows")
    there = {key: path for key, path in names.items() if path.is_file()}
    manifests, table = {key: manifest_of(path) for key, path in there.items()}, []
    for (row, share), path in there.items():
        with path.with_name("steps.csv").open(newline="") as file:
            steps = list(csv.DictReader(file))
        took = [float(step["wall [ms]"]) for step in steps]
        mean = lambda *names: statistics.fmean(sum(float(step[name]) for name in names) for step in steps)  # noqa: E731
        table.append({"row": row, "state, share of the run [%]": share, "steps": len(steps),
                      "median step [ms]": f"{statistics.median(took):.4g}",
                      "mean step [ms]": f"{statistics.fmean(took):.4g}", "worst step [ms]": f"{max(took):.4g}",
                      "detections a step": f"{mean('discrete_detections [1]'):.4g}",
                      "contacts": f"{mean('vertex_facet_contacts [1]', 'edge_edge_contacts [1]'):.6g}",
                      "paper, mean of a whole run [ms]": paper(commands.scene_of(row), "cpu", "average")[0],
                      "device": manifests[row, share]["device"], "commit": manifests[row, share]["commit"][:SHORT]})
    yield (f"cpu_windows_{runs.wanted.scale}.csv", as_csv(table),
           {"figure": "cpu_windows", "backend": "cpu", "redo": f"{runs.redo} windows_ROW, of each row",
            **origin_of(list(manifests.values()))})


def said_by(path):
    """Returns what a command printed as JSON."""
    return json.loads(path.read_text())


def program_of(runs):
    """Returns commit, compiler and device of the program, as it said of itself when the evidence was made."""
    path = runs.folder / everything.STAMP
    if not path.is_file():
        raise Missing(f"{everything.STAMP}: it says which program made the evidence")
    said = path.read_text()
    commit = everything.line_of(said, "commit ")
    if not contents.HEX.fullmatch(commit):
        raise AcceptError(f"the program is of '{commit}': commit, build, and make the evidence again")
    device = everything.line_of(said, f"{runs.wanted.backend}: ").partition("(")[2].rpartition(")")[0]
    return {"commit": commit, "compiler": everything.line_of(said, "compiler "), "device": device, "ended": ""}


def judge(runs):
    """Yields the judge's counts, a row for each stage and seed."""
    backend = runs.wanted.backend
    asked = everything.judged(runs.wanted)["judge"].jobs
    wanted = [runs.of("judge") / job.name / "said.txt" for job in asked if isinstance(job, everything.Command)]
    runs.there(wanted, "judge")
    path = runs.of("judge") / f"judge_{backend}.csv"
    runs.there([path], "judge")
    yield f"judge_{backend}.csv", path.read_bytes(), {"figure": "judge", "scale": "-", "redo": f"{runs.redo} judge",
                                                      **program_of(runs)}


def determinism(runs):
    """Yields the digests of each stage's answers, which another machine can compare."""
    path, about = runs.of("determinism") / "all" / "said.txt", program_of(runs)
    runs.there([path], "determinism")
    table = [{"stage": stage["stage"], "cases": stage["cases"], "digest": f"{stage['digest']:016x}",
              "stated": stage["stated"], "device": about["device"], "commit": about["commit"][:SHORT]}
             for stage in said_by(path)["stages"] if not stage["skipped"]]
    name = f"determinism_{runs.wanted.backend}.csv"
    yield name, as_csv(table), {"figure": "determinism", "scale": "-", "redo": f"{runs.redo} determinism", **about}


def laws(runs):
    """Yields what each law measured beside its limit."""
    path, about = runs.of("laws") / "all" / "said.txt", program_of(runs)
    runs.there([path], "laws")
    table = [{"law": row["law"], "solver": row["solver"], "backend": row["backend"], "bounds": row["bounds"],
              "reading": reading["what"], "unit": reading["unit"], "measured": f"{reading['measured']:.6g}",
              "answer": f"{reading['answer']:.6g}", "side": reading["side"], "tolerance": f"{reading['tolerance']:.6g}",
              "verdict": reading["verdict"], "device": about["device"], "commit": about["commit"][:SHORT]}
             for row in said_by(path)["rows"] for reading in row["readings"]]
    name = f"laws_{runs.wanted.backend}.csv"
    yield name, as_csv(table), {"figure": "laws", "scale": "-", "redo": f"{runs.redo} laws", **about}


def jittered(runs):
    """Yields a row for each jittered start."""
    paths = {(scene, bounds): runs.of("jittered") / "starts" / bounds / scene / "runs" / "ablation.csv"
             for scene in everything.JITTERED for bounds in ("ball", "planes")}
    runs.there(list(paths.values()), "jittered")
    table, manifests = [], []
    for (scene, _), path in paths.items():
        if not path.is_file():
            continue
        made = [manifest_of(run) for run in sorted(path.parent.glob("*/run.json"))]
        manifests += made
        table += [{"scene": scene, **{ours: row[theirs] for theirs, ours in OF_A_START.items()},
                   "commit": made[0]["commit"][:SHORT]} for row in rows_of(path)]
    yield (f"jittered_{runs.wanted.scale}.csv", as_csv(table),
           {"figure": "jittered", "redo": f"{runs.redo} jittered", **origin_of(manifests)})


def ablations(runs):
    """Yields the table of all studies."""
    scale = "smoke" if runs.wanted.scale == "small" and runs.wanted.backend == "cpu" else runs.wanted.scale
    small = Runs(runs.folder, scale, runs.wanted.backend, runs.partly)
    asked = everything.studies_of(everything.list_of_studies(), scale, runs.wanted.backend)
    wanted = {(name, scene): small.of(name) / "runs" / scene / "runs" / "ablation_medians.csv"
              for name, scenes in asked.items() for scene in scenes}
    small.there(list(wanted.values()), "ablations")
    text, manifests = [], []
    with tempfile.TemporaryDirectory() as scratch:
        for name in dict.fromkeys(name for name, _ in wanted):
            folder, made = Path(scratch) / name, {scene: path.parent for (study, scene), path in wanted.items()
                                                  if study == name and path.is_file()}
            folder.mkdir()
            for scene, place in made.items():
                (folder / scene).symlink_to(place.resolve())
                manifests += [json.loads(path.read_text()) for path in sorted(place.glob("*/run.json"))]
            if made:
                subprocess.run([sys.executable, "-m", "paper_figures.figures.ablations.study", folder, "--study", name,
                                "--scale", scale, "--backend", runs.wanted.backend, "--made"], check=True,
                               stdout=subprocess.DEVNULL)
                text += [(folder / "ablations.csv").read_text()]
    faulty = [manifest["commit"] for manifest in manifests if manifest["dirty"] is not False]
    if faulty:
        raise AcceptError("ablations were made by a program with uncommitted changes: commit, build, and run again")
    title, *first = text[0].splitlines(keepends=True)
    whole = title + "".join(first) + "".join("".join(more.splitlines(keepends=True)[1:]) for more in text[1:])
    yield (f"ablations_{scale}.csv.gz", gzip.compress(whole.encode(), mtime=0),
           {"figure": "ablations", "scale": scale, "redo": f"{runs.redo} ablation_STUDY, of each study",
            **origin_of(manifests)})


def measured(runs):
    """Yields tables and pictures of the measured studies that are there."""
    found, scale = 0, runs.wanted.scale
    on_device = runs.wanted.backend == "cuda"
    for name in everything.MEASURED_ON_DEVICE if on_device else everything.MEASURED:
        folder = runs.of(name) / "all"
        if "status" not in everything.Command("all", ()).record(folder.parent):
            continue
        has_scales = on_device or everything.MEASURED[name]
        for path in sorted([*folder.glob("*.csv"), *folder.glob("*.png")]):
            stem = path.stem.removesuffix(f"_{scale}") + (f"_{scale}" if has_scales else "")
            suffix, data = file_of(path)
            yield stem + suffix, data, {"figure": name, "scale": scale if has_scales else "-", DRAWN: path,
                                        "redo": f"{runs.redo} {name}", **program_of(runs)}
            found += 1
    if not found:
        raise Missing("measured: no study is there")


def yarn(runs):
    """Yields the table and the picture of whether knits return, from the cases that are there."""
    name, scale = "yarn_return", runs.wanted.scale
    folder = runs.of(name)
    there = runs.there([folder / case.name / "run.json" for case in yarn_cases.cases(scale)], "yarn")
    subprocess.run([sys.executable, "-m", f"paper_figures.figures.measured.{name}", folder, "--scale", scale,
                    "--backend", runs.wanted.backend, "--made"], check=True, stdout=subprocess.DEVNULL)
    words = {"figure": name, "redo": f"{runs.redo} {name}", **origin_of([manifest_of(path) for path in there])}
    for path in (folder / f"{name}_{scale}{suffix}" for suffix in (".csv", ".png")):
        suffix, data = file_of(path)
        yield path.stem + suffix, data, {**words, DRAWN: path}


def seconds(runs):
    """Yields how long each finished part took, all its calls and the jobs of its chains together."""
    path, about = runs.folder / everything.TIMES, program_of(runs)
    runs.there([path], "seconds")
    table = [{"part": part, "scale": runs.wanted.scale, "backend": runs.wanted.backend, "seconds": each["seconds"],
              "device": about["device"], "commit": about["commit"][:SHORT]}
             for part, each in sorted(said_by(path).items()) if each["end"] in (FINISHED, KEPT) and each["seconds"]]
    if not table:
        raise Missing("seconds: no part is finished")
    yield everything.SECONDS, as_csv(table), {"figure": "seconds", "scale": "-", "redo": runs.redo, **about}


def steady(runs):
    """Yields the table of repeated whole runs."""
    folder = runs.of(varied.STEADY)
    try:
        table = repetitions.gathered(folder)
    except RunFailure as error:
        raise Missing(f"steady: {error}") from error
    yield (f"steady_{runs.wanted.scale}.csv", as_csv(table),
           {"figure": "steady", "redo": f"{runs.redo} steady_ROW, of each row",
            **origin_of([manifest_of(path) for path in sorted(folder.rglob("run.json"))])})


def solved_steps(runs):
    """Yields the tables of Fig. 17's step with one choice varied, those that this kind of machine makes."""
    folder, made = runs.of(varied.FIG17), varied.parts_of(runs.redo.split()[1], runs.wanted)
    names = [name for name, part in varied.FIG17_TABLES.items() if part in made]
    paths = runs.there([folder / f"{name}.csv" for name in names], "solved_steps")
    words = origin_of([manifest_of(path) for path in sorted(folder.rglob("run.json"))])
    for path in paths:
        part = varied.FIG17_TABLES[path.stem]
        yield (f"{path.stem}_{runs.wanted.scale}.csv", path.read_bytes(),
               {"figure": part, "redo": f"{runs.redo} {part}", **words})


def newton(runs):
    """Yields Newton's curves of Fig. 17, a row for each and their iterations, which the figure draws (--newton)."""
    # The figure needs NumPy, which the other kinds do without.
    from paper_figures.figures import fig17_three_cloths_on_sphere as fig17
    from ogc_testbed.runs import Run
    folder, scale = runs.of("fig17"), runs.wanted.scale
    found = [(label, run) for label, run in fig17.made(folder, runs.wanted.backends, scale)
             if label.startswith("Newton") and run.status == "finished"]
    if not found:
        raise Missing("newton: no finished run of Fig. 17 by Newton's method")
    start = Run(folder / "start")
    words = {"figure": "fig17_newton", "redo": f"{runs.redo} fig17 fig17_double",
             **origin_of([manifest_of(run.folder / "run.json") for _, run in found])}
    yield f"fig17_newton_{scale}.csv", as_csv([fig17.summary(label, run, start) for label, run in found]), words
    yield "fig17_newton_iterations.csv", as_csv([row for curve in found for row in iterations_of(*curve)]), words


def iterations_of(label, run):
    """Yields the rows of a curve: the columns OF_AN_ITERATION, without times, which other work beside lengthens."""
    for row in rows_of(run.folder / "iterations.csv"):
        yield {"curve": label, **{name: f"{float(row[name]):.6g}" for name in OF_AN_ITERATION}}


KINDS = {each.__name__: each for each in (rows, windows, judge, determinism, laws, jittered, ablations, measured,
                                          yarn, steady, newton, solved_steps, seconds)}


def joined(path, data, key):
    """Returns a table with the rows of the accepted one at `path` that it does not replace; rows of other sources than
    this table's go."""
    packed = path.suffix == ".gz"
    text = (gzip.decompress(data) if packed else data).decode()
    rows, accepted = list(csv.DictReader(io.StringIO(text))), rows_of(path)
    named = lambda row: tuple(row[name] for name in key)  # noqa: E731
    sources = {commit: of[:len(contents.ROOMS)] for commit, of in contents.of_history(
        {row["commit"] for row in (*rows, *accepted)}).items()}
    mine = {named(row) for row in rows}
    same = [row for row in accepted if named(row) not in mine and sources[row["commit"]] == sources[rows[0]["commit"]]]
    whole = as_csv(sorted((*rows, *same), key=named)) if same else text.encode()
    return gzip.compress(whole, mtime=0) if packed else whole


def keep(machine, runs, found, results):
    """Writes (name, bytes, words about them) and their rows of provenance.csv, in place of those of the same figure,
    scale and backend; returns the names."""
    folder, entries, drawn = results / machine, [], {}
    for name, data, words in found:
        path, picture = folder / name, words.pop(DRAWN, None)
        if picture and accept.is_picture(name):
            drawn[name] = picture
        if name.startswith(f"../{SCENES}/"):
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(data)
            continue
        if runs.partly and words["figure"] in JOINED:
            data = joined(path, data, JOINED[words["figure"]])
        entries.append((path, data, {"file": name, "scale": runs.wanted.scale, "backend": runs.wanted.backend, **words,
                                     "sha256": hashlib.sha256(data).hexdigest()[:16]}))
    table = [row for _, _, row in entries]
    outdated = accept.earlier_files(folder / PROVENANCE, table)
    for name in outdated:
        (folder / name).unlink(missing_ok=True)
    for path, data, _ in entries:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(data)
    merge(folder / PROVENANCE, COLUMNS, table, ("file",), {(name,) for name in outdated})
    captions.keep(folder, drawn, outdated)
    accept.drop_scenes(results)
    return [row["file"] for row in table]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("machine", help="folder below paper_figures/results, named after the machine")
    parser.add_argument("runs", type=Path, help="folder of the evidence")
    parser.add_argument("kinds", nargs="*", metavar="KIND", help=f"{', '.join(KINDS)} (default: all)")
    parser.add_argument("--scale", default="paper", choices=("smoke", "small", "paper"))
    parser.add_argument("--backend", default="cuda", choices=("cpu", "cuda"))
    parser.add_argument("--results", default=RESULTS, type=Path, help="where to (default: paper_figures/results)")
    parser.add_argument("--partly", action="store_true", help="also a table of which parts are missing")
    options = parser.parse_args()
    for kind in options.kinds:
        if kind not in KINDS:
            parser.error(f"no kind '{kind}'; there are: {', '.join(KINDS)}")
    if not options.runs.is_dir():
        parser.error(f"no folder {options.runs}: name the --out of experiments/evidence")
    runs, failed = Runs(options.runs, options.scale, options.backend, options.partly), False
    for kind in options.kinds or KINDS:
        try:
            names = keep(options.machine, runs, list(KINDS[kind](runs)), options.results)
            print(f"{kind}: {len(names)} files")
        except Missing as error:
            print(f"not taken: {error}", file=sys.stderr)
            failed = failed or bool(options.kinds)
        except AcceptError as error:
            print(f"not taken: {kind}: {error}", file=sys.stderr)
            failed = True
    try:
        contents.write(options.results)
    except contents.ContentsError as error:
        print(f"results/contents.csv is as it was: {error}", file=sys.stderr)
    print("next: python3 -m paper_figures.workflow.whole_runs MACHINE --write, then verdicts, contents and "
          "page_tables, each with --write, and look at what changed")
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
