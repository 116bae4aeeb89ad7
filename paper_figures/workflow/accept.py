"""Accepts what figures made: copies small data, pictures and movies of finished figures into results/MACHINE, each with
a row in provenance.csv (command, program, device, digest) and its duration in durations.csv. `experiments/reproduce …
--accept MACHINE` calls it.

The kept files are small (kept.py, thinned.py), and a run that another figure keeps is not kept twice.

Nothing is accepted of an unfinished run, of one that failed its audit, of a program with uncommitted changes, or of
runs or rows of several commits. What the commits' sources were is kept in contents.csv (contents.py).
"""

import argparse
import csv
import gzip
import hashlib
import json
import re
import subprocess
import sys
from fnmatch import fnmatch
from pathlib import Path

from paper_figures.workflow import captions, contents, recipes
from paper_figures.workflow.contents import COLUMNS, merge, rows_of
from paper_figures.workflow.evidence import NOT_RUN, RESULTS, SCENES, run_at
from paper_figures.workflow.jobs import ENDED_BY_TIME, manifests_below
from paper_figures.workflow.kept import MOVIES, PICTURES, AcceptError, file_of, run_files

# Bytes of a file, and of a picture or movie; a test limits tables to 10 MB and pictures and movies to 30.
LARGEST, LARGEST_PICTURE = 2**20, 4 * 2**20
# There is one Table 1 of the paper's size, whole_runs.csv, which is computed from the kept runs; its table of the runs
# just made would be a second.
COMPUTED = {("table1", "paper")}


def manifests(folder):
    """Returns (run folder's name below the figure's, manifest) of each run of a figure; an audit after the run counts
    like one beside it."""
    paths = manifests_below(folder)
    return [("_".join(path.parent.relative_to(folder).parts), manifest_at(path)) for path in paths]


def manifest_at(path):
    run, manifest = run_at(path.parent), json.loads(path.read_text())
    if (path.parent / ENDED_BY_TIME).is_file():  # it was given a limit of time, and is complete
        manifest["status"] = "finished"
    return {**manifest, "guarantee_kept": run.guarantee_kept} if run and run.afterwards else manifest


def check(name, manifest):
    """Throws AcceptError if the run is no evidence. An ablation keeps the energies that did not converge: they failed,
    but no audit did."""
    if manifest.get("dirty") is not False:
        raise AcceptError(f"{name} was made by a program with uncommitted changes: commit, build, and run again")
    if manifest.get("guarantee_kept") is False:
        raise AcceptError(f"{name} failed its audit: that is a finding for compare/deviations.md, not an accepted "
                          "result")
    if not str(manifest.get("status", "unknown")).startswith(("finished", "failed: Newton")):
        raise AcceptError(f"{name} is not finished (status: {manifest.get('status', 'unknown')}): run "
                          "experiments/reproduce again, it goes on where it was")


def program(ogc):
    """Returns commit and compiler of the program, as it prints them."""
    said = subprocess.run([ogc, "--version"], capture_output=True, text=True, check=True).stdout
    words = dict(line.split(" ", 1) for line in said.splitlines() if line.startswith(("commit ", "compiler ")))
    if "dirty" in words["commit"] or words["commit"] == "unknown":
        raise AcceptError(f"{ogc} was built from uncommitted changes: commit, build, and run again")
    return words


def origin(recipe, folder, ogc, backend=None):
    """Returns commit, compiler, device and end of the figure's runs, or of the program if it has none. With `backend`,
    those of the last run by it, if there is one: windows on the CPU beside it are not what the picture shows."""
    runs = manifests(folder) if "illustration" not in recipe.body else []
    for name, manifest in runs:
        check(f"{folder.name}/{name}", manifest)
    if not runs:
        return {**program(ogc), "device": "exact reference", "ended": ""}
    commits = sorted({manifest["commit"] for _, manifest in runs})
    if len(commits) > 1:
        raise AcceptError(f"{folder} mixes runs of commits {', '.join(commit[:10] for commit in commits)}: remove it "
                          "and run again")
    last = max((manifest for _, manifest in runs),
               key=lambda manifest: (manifest.get("backend") == backend, manifest["ended"]))
    return {key: last[key] for key in ("commit", "compiler", "device", "ended")}


def not_run(key, name, columns):
    """Returns the row about a run that was left out of a figure: its name and that it was not run."""
    return {**dict.fromkeys(columns, ""), key: name, "status": NOT_RUN, "commit": "-"}


def left_out(folder):
    """Returns the names in these rows of a figure's tables; a figure with any is incomplete."""
    for path in sorted(folder.glob("*.csv")):
        with path.open(newline="") as file:
            rows = [row for row in csv.DictReader(file) if row.get("status") == NOT_RUN]
        yield from (next(text for key, text in row.items() if text and key not in ("status", "commit")) for row in rows)


def pieces(recipe, scale, backend, runs, incomplete=False):
    """Returns (name in results, bytes) of what is kept of a figure. `incomplete`: it may lack its movie, if too few
    frames were unpacked for one."""
    folder, picture = runs / recipe.folder(scale, backend), runs / recipe.picture(scale, backend)
    if not picture.is_file():
        raise AcceptError(f"{picture} is missing: make it with experiments/reproduce {recipe.name} --scale {scale}")
    if "illustration" in recipe.body:
        suffix, data = file_of(picture)
        return [(picture.stem + suffix, data),
                (f"{recipe.name}.json.gz", gzip.compress((folder / f"{recipe.name}.json").read_bytes(), mtime=0))]
    outputs = [runs / path for path in recipe.outputs(scale, backend) if not is_computed(recipe, scale, Path(path))]
    missing = [path for path in outputs if not path.is_file()]
    if missing and not incomplete:
        raise AcceptError(f"{missing[0]} is missing: make it with experiments/reproduce {recipe.name} --scale {scale}, "
                          "or keep the figure without it by --incomplete")
    found = [(f"{recipe.name}_{scale}{suffix}", data) for suffix, data in map(file_of, (path for path in outputs
                                                                                        if path not in missing))]
    tables = [path for path in sorted(folder.glob("*.csv")) if not is_computed(recipe, scale, path)]
    check_tables(tables)
    found += [(f"{path.stem}_{scale}.csv", path.read_bytes()) for path in tables
              if not path.stem.endswith(f"_{scale}")]
    paths = [path for path in manifests_below(folder) if keeps(recipe, run_name(path, folder))]
    for path in paths:  # one run lies beside its picture, several in a folder
        apart = f"/{run_name(path, folder)}" if len(paths) > 1 else ""
        found += run_files(path, f"{recipe.name}_{scale}{apart}")
    return found


def is_computed(recipe, scale, path):
    return (recipe.name, scale) in COMPUTED and contents.is_table(path.name)


def check_tables(paths):
    """Throws AcceptError if the rows of a table are of several programs, or of one with uncommitted changes."""
    for path in paths:
        commits = contents.commits_in(path)
        changed = [commit for commit in commits if not contents.HEX.fullmatch(commit)]
        if changed:
            raise AcceptError(f"{path} has rows of {', '.join(changed)}, which is no commit: commit, build, run again")
        if len(commits) > 1:
            raise AcceptError(f"{path} mixes rows of commits {', '.join(commits)}: make all its rows by one program")


def keeps(recipe, name):
    """Returns whether the files of the run of this name are kept; other runs have only their row in the figure's
    table."""
    return "kept" not in recipe.body or any(fnmatch(name, pattern) for pattern in recipe.body["kept"])


def run_name(path, folder):
    """Returns the folders from the figure's to the run's, without those that every run has."""
    return "_".join(part for part in path.parent.relative_to(folder).parts if part != "runs")


def is_picture(name):
    return name.endswith(PICTURES + MOVIES)


def accept(chosen, scale, backend, runs, machine, ogc, results=RESULTS, incomplete=False, by_hand=None,
           pictures=False):
    """Copies all that is kept of the `chosen` figures; returns the rows about them. Nothing is written if one of them
    can't be accepted. `incomplete`: also accepts a figure that itself names the runs left out. `by_hand`: the command
    that makes it again, if it was not the workflow's. Of a picture of other figures' runs only the picture is made,
    because those figures keep the runs. `pictures`: keeps pictures and movies alone, and of what was accepted before
    all else."""
    folder, kept, rows, scenes = Path(results) / machine, [], [], {}
    before = {(row["file"], row["sha256"]): row["redo"] for row in rows_of(folder / "provenance.csv")}
    shown = {name for recipe in chosen for name in recipes.shown_of(recipe.body)}
    for recipe in chosen:
        missing = [] if incomplete else list(left_out(Path(runs) / recipe.folder(scale, backend)))
        if missing:
            raise AcceptError(f"{recipe.name} was drawn without {', '.join(missing)}: run them, or keep it as it is "
                              "with --incomplete and say so in the README")
        words = origin(recipe, Path(runs) / recipe.folder(scale, backend), ogc,
                       backend) if "of" not in recipe.body else composed(recipe, chosen, scale, backend, runs, ogc)
        for name, data in unlike_others(pieces(recipe, scale, backend, Path(runs), incomplete), folder, recipe.name,
                                        rows):
            if pictures and not is_picture(name):
                continue
            if name.startswith(f"../{SCENES}/"):
                scenes[folder / name] = data
                continue
            if len(data) > (LARGEST_PICTURE if is_picture(name) else LARGEST):
                raise AcceptError(f"{name} has {len(data) / 2**20:.2g} MiB: accepted results are small data")
            drawn = "illustration" in recipe.body
            options = f" --scale {scale}" + (" --backend cuda" if backend == "cuda" else "")
            redo = f"experiments/reproduce {recipe.name}{'' if drawn else options}"
            digest = hashlib.sha256(data).hexdigest()[:16]
            if by_hand:
                redo = by_hand if recipe.name not in shown else before.get((name, digest), redo)
            rows.append({"file": name, "figure": recipe.name, "scale": "-" if drawn else scale,
                         "backend": "-" if drawn else backend, "redo": redo, **words,
                         "sha256": digest})
            kept.append((folder / name, data))
    twice = {path.name for path, _ in kept if sum(other == path for other, _ in kept) > 1}
    if twice:
        raise AcceptError(f"two files would both be called {', '.join(sorted(twice))}")
    outdated = [name for name in earlier_files(folder / "provenance.csv", rows) if not pictures or is_picture(name)]
    for name in outdated:
        (folder / name).unlink(missing_ok=True)
    for path, data in (*kept, *scenes.items()):
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(data)
    merge(folder / "provenance.csv", COLUMNS, rows, ("file",), {(name,) for name in outdated})
    drawn = {recipe.name: Path(runs) / recipe.picture(scale, backend) for recipe in chosen}
    captions.keep(folder, {row["file"]: drawn[row["figure"]] for row in rows if is_picture(row["file"])}, outdated)
    drop_scenes(Path(results))
    if pictures:
        return rows
    merge(folder / "durations.csv", ("figure", "scale", "backend", "seconds", "machine"),
          list(recipes.durations(chosen, scale, backend, Path(runs), machine)), ("figure", "scale", "backend"))
    return rows


def unlike_others(found, folder, figure, rows):
    """Returns the (name, bytes) of `found` without the runs that another figure keeps: in the folder, or in `rows`,
    about those accepted with it."""
    others = {row["sha256"] for row in (*rows_of(folder / "provenance.csv"), *rows) if row["figure"] != figure}
    twice = [name.removesuffix("run.json") for name, data in found
             if name.endswith("run.json") and hashlib.sha256(data).hexdigest()[:16] in others]
    run_file = re.compile("|".join(re.escape(stem) + r"[a-z_]+\.(json|csv)(\.gz)?" for stem in twice) or r"(?!)")
    return [(name, data) for name, data in found if not run_file.fullmatch(name)]


def drop_scenes(results):
    """Removes the scenes that no accepted manifest names."""
    named = {json.loads(path.read_text())["scene"].get("sha256") for path in results.glob("*/**/*run.json")}
    for path in results.glob(f"{SCENES}/*.json"):
        if path.stem not in named:
            path.unlink()


def composed(recipe, chosen, scale, backend, runs, ogc):
    """Returns the origin of a picture of other figures' runs: theirs, if they have only one."""
    found = [origin(other, Path(runs) / other.folder(scale, backend), ogc) for other in chosen
             if other.name in recipes.shown_of(recipe.body)]
    if len({words["commit"] for words in found}) > 1:
        raise AcceptError(f"{recipe.name} mixes runs of several commits: run experiments/reproduce "
                          f"{' '.join(recipes.shown_of(recipe.body))} anew")
    return max(found, key=lambda words: words["ended"])


def earlier_files(provenance, rows):
    """Returns the files of an earlier acceptance of the figures in `rows`, at the same scale by the same backend, that
    have no successor there."""
    about = {tuple(row[key] for key in ("figure", "scale", "backend")) for row in rows}
    names = {row["file"] for row in rows}
    return [row["file"] for row in rows_of(provenance) if (row["figure"], row["scale"], row["backend"]) in about
            and row["file"] not in names]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("machine", help="folder below paper_figures/results, named after the machine")
    parser.add_argument("figures", nargs="*")
    parser.add_argument("--scale", default="small", choices=recipes.SCALES)
    parser.add_argument("--backend", default="cpu", choices=("cpu", "cuda"))
    parser.add_argument("--runs", default=recipes.ROOT / "runs", type=Path)
    parser.add_argument("--ogc", default=recipes.ROOT / "build/default/ogc", help="the program that made them")
    parser.add_argument("--results", default=RESULTS, type=Path, help="where to (default: paper_figures/results)")
    parser.add_argument("--redo", metavar="COMMAND",
                        help="that makes the figure again, where the workflow's does not (options of its script)")
    parser.add_argument("--incomplete", action="store_true",
                        help="also a figure that says itself which runs it was drawn without, or that has no movie")
    parser.add_argument("--pictures", action="store_true", help="keep pictures and movies alone, not the runs")
    options = parser.parse_args()
    try:
        chosen = recipes.choose(options.figures, recipes.load(), options.backend)
        rows = accept(chosen, options.scale, options.backend, options.runs, options.machine, str(options.ogc),
                      results=options.results, incomplete=options.incomplete, by_hand=options.redo,
                      pictures=options.pictures)
    except (AcceptError, recipes.RecipeError) as error:
        sys.exit(f"accept: {error}")
    try:
        contents.write(options.results)
    except contents.ContentsError as error:
        print(f"accept: results/contents.csv is as it was: {error}", file=sys.stderr)
    print(f"{len(rows)} files accepted into {options.results / options.machine}; then: python3 -m "
          "paper_figures.workflow.verdicts --write, and look at what changed")


if __name__ == "__main__":
    main()
