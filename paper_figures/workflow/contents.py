"""Names what programs are made of: the content of the rooms that a result depends on, at each commit that an accepted
file names. It is a digest of a room's files without its documents (.md), which are written after the results: `git
ls-tree -r COMMIT -- fast | grep -v "[.]md$" | sha256sum`. Two commits of the same content made the same programs. What
judges kernels or runs other programs (JUDGE) takes no part in our runs: it has a digest of its own, on which what it
says depends alone.

`results/contents.csv` holds them, so that a checkout without its history knows them; the program writes it from the
history and never by hand. A commit that the history of HEAD does not have has UNKNOWN contents. An accepted file is
*old* if a commit that it names has other contents than HEAD's, or unknown ones, or if it names none. Tables about what
was tried (TRIED) are about the prototypes and former programs that they name, so that they do not grow old.

Usage: python3 -m paper_figures.workflow.contents: prints how many files are old; `--list` names them; `--write` keeps
results/contents.csv. `--keep MACHINE/FILE --redo COMMAND` keeps the row of provenance.csv about a table that no figure
made; `--commit` names its program if its rows do not. The standard library is enough.
"""

import argparse
import csv
import datetime
import gzip
import hashlib
import io
import json
import re
import subprocess
import sys
from functools import lru_cache
from pathlib import Path

from paper_figures.workflow.evidence import RESULTS

ROOMS = ("fast", "reference", "compare", "experiments")
JUDGE = (*(f"compare/judge/{folder}" for folder in ("stages", "engine", "report")), "experiments/judge",
         "experiments/peers")
DIGESTS = (*ROOMS, "judge")
JUDGED = ("judge", "determinism", "peers")  # begin the names of files whose numbers the judge said
KEPT, PROVENANCE = "contents.csv", "provenance.csv"
TRIED = "tried"  # folder below the results
UNKNOWN = "unknown"
DIGITS = 16  # of a digest
DOCUMENT = ".md\n"  # ends the line about a document
SHORT = 8  # digits by which tables name a commit, at least
HEX = re.compile(rf"[0-9a-f]{{{SHORT},40}}")
NO_COMMIT = ("", "-")  # of a row about a run that was not made, or of another program
COLUMNS = ("file", "figure", "scale", "backend", "redo", "commit", "compiler", "device", "ended", "sha256")
SAID_BY_ROWS = "rows say"  # where the rows of a table differ


class ContentsError(Exception):
    """Raised where there is no repository, or not its whole history, or a file can't be kept; the message says what to
    do."""


def git(*words, text=None):
    """Returns what a git command prints. Throws ContentsError where there is no repository."""
    asked = ["git", "-C", str(RESULTS), *words]
    try:
        return subprocess.run(asked, input=text, capture_output=True, text=True, check=True).stdout
    except (OSError, subprocess.CalledProcessError) as error:
        raise ContentsError("no git repository: clone it") from error


@lru_cache(maxsize=1)
def history():
    """Returns the names of all commits from which HEAD comes. Throws ContentsError in a shallow clone."""
    if git("rev-parse", "--is-shallow-repository").strip() != "false":
        raise ContentsError("a clone without its history: git fetch --unshallow")
    return frozenset(git("rev-list", "HEAD").split())


def contents_at(commits):
    """Returns commit -> its contents, in the order of DIGESTS; UNKNOWN for a room that it does not have."""
    return {commit: (*(content_of(commit, [room], JUDGE) for room in ROOMS), content_of(commit, JUDGE))
            for commit in commits}


def content_of(commit, folders, but=()):
    """Returns the digest of the folders of a commit without documents and without the folders in `but`."""
    listed = git("ls-tree", "-r", "--full-tree", commit, "--", *folders).splitlines(keepends=True)
    left_out = tuple(f"{folder}/" for folder in but)
    text = "".join(line for line in listed
                   if not line.endswith(DOCUMENT) and not line.partition("\t")[2].startswith(left_out))
    return hashlib.sha256(text.encode()).hexdigest()[:DIGITS] if text else UNKNOWN


def of_history(commits):
    """Returns commit, as it is named -> its contents, rebuilt from the history of HEAD; UNKNOWN where that lacks it."""
    whole = {commit: next((name for name in sorted(history()) if name.startswith(commit)), None) for commit in commits}
    there = contents_at([name for name in whole.values() if name])
    return {commit: there[name] if name else (UNKNOWN,) * len(DIGESTS) for commit, name in whole.items()}


@lru_cache(maxsize=1)
def of_head():
    """Returns the contents of HEAD."""
    return contents_at(["HEAD"])["HEAD"]


def rows_of(path):
    """Returns the rows of a table, compressed or not; none if there is no such file."""
    if not path.is_file():
        return []
    with (gzip.open if path.suffix == ".gz" else open)(path, "rt", newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def merge(path, columns, rows, key, gone=()):
    """Replaces rows of a table by those of the same key and removes the rows in `gone`. The table is sorted, so that a
    new acceptance changes only its own lines."""
    old = {tuple(row[name] for name in key): row for row in rows_of(path)}
    old = {name: row for name, row in old.items() if name not in gone}
    old.update({tuple(row[name] for name in key): row for row in rows})
    with path.open("w", newline="") as file:
        writer = csv.DictWriter(file, fieldnames=columns, lineterminator="\n")
        writer.writeheader()
        writer.writerows(old[name] for name in sorted(old))


def is_table(name):
    return name.endswith((".csv", ".csv.gz"))


def commits_in(path):
    """Returns the commits that the rows of a table, or a manifest, name, sorted."""
    if is_table(path.name):
        return sorted({row.get("commit") or "" for row in rows_of(path)} - set(NO_COMMIT))
    return [json.loads(path.read_text())["commit"]] if path.name.endswith("run.json") else []


def named(results=RESULTS):
    """Returns file below the results -> the commits that it names: in provenance.csv, and itself. Of a commit that both
    name, the longer name counts."""
    found = {}
    for provenance in sorted(results.glob(f"*/{PROVENANCE}")):
        for row in rows_of(provenance):
            said, path = row["commit"].split(), provenance.parent / row["file"]
            inside = [commit for commit in commits_in(path) if not any(name.startswith(commit) for name in said)]
            found[f"{provenance.parent.name}/{row['file']}"] = tuple(said + inside)
    return found


def abbreviated(commits):
    """Returns each commit once, by the longest of its names."""
    names = sorted(set(commits), key=len, reverse=True)
    return sorted(name for place, name in enumerate(names)
                  if not any(longer.startswith(name) for longer in names[:place]))


def kept(results=RESULTS):
    """Returns commit -> its contents, as kept."""
    return {row["commit"]: tuple(row[name] for name in DIGESTS) for row in rows_of(results / KEPT)}


def as_table(by_commit):
    """Returns the text of contents.csv."""
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(["commit", *DIGESTS])
    writer.writerows([commit, *by_commit[commit]] for commit in sorted(by_commit))
    return out.getvalue()


def rebuilt(results=RESULTS):
    """Returns the text of contents.csv from the history."""
    return as_table(of_history(abbreviated(commit for commits in named(results).values() for commit in commits)))


def contents_of(commit, known):
    """Returns the contents of a commit by any of its names; UNKNOWN if nothing is known of it."""
    return next((each for name, each in known.items() if name.startswith(commit)), (UNKNOWN,) * len(DIGESTS))


def counting(name):
    """Returns how many digests count for a file, in the order of DIGESTS."""
    return len(DIGESTS) if name.partition("/")[2].startswith(JUDGED) else len(ROOMS)


def old(results=RESULTS, head=None):
    """Returns the files that are old, sorted. `head`: the contents of HEAD."""
    known, head = kept(results), head or of_head()

    def is_new(name, commits):
        count = counting(name)
        return commits and all(contents_of(commit, known)[:count] == head[:count] for commit in commits)

    return sorted(name for name, commits in in_use(results).items() if not is_new(name, commits))


def in_use(results=RESULTS):
    """Returns what `named` does, without tables about what was tried."""
    return {name: commits for name, commits in named(results).items() if not name.startswith(f"{TRIED}/")}


def mixed(results=RESULTS):
    """Returns the files of programs of different content, sorted."""
    known = kept(results)

    def of(name, commit):
        found = contents_of(commit, known)[:counting(name)]
        return commit if UNKNOWN in found else found

    return sorted(name for name, commits in in_use(results).items()
                  if len({of(name, commit) for commit in commits}) > 1)


def in_words(results=RESULTS, head=None):
    """Returns how many files are old, as a sentence."""
    there, stale = len(in_use(results)), len(old(results, head))
    return f"{stale} of {there} accepted files are of other sources than this commit's."


def keep(path, redo, figure="", commit=""):
    """Keeps the row of provenance.csv about a table that no figure made; returns it. `commit`: that of the program, if
    the table's rows name none. Throws ContentsError for a table of a program with uncommitted changes, or of another
    one."""
    rows = rows_of(path)
    if not rows:
        raise ContentsError(f"{path}: no table with rows: name one below {RESULTS}")
    commits, provenance = commits_in(path), next(folder for folder in path.parents if folder.parent == RESULTS)
    if commit and commits:
        raise ContentsError(f"{path.name} names its program itself ({', '.join(commits)}): leave --commit out")
    commits = commits or [commit] * bool(commit)
    faulty = [commit for commit in commits if not HEX.fullmatch(commit)]
    if faulty:
        raise ContentsError(f"{path.name} is of a changed program ({', '.join(faulty)}): commit, build, and run again")
    said = lambda key: dict.fromkeys(filter(None, (row.get(key) for row in rows)))  # noqa: E731
    devices, stem = list(said("device")), path.name.partition(".")[0]
    scale = stem.rpartition("_")[2]
    whole = {commit: next((name for name in history() if name.startswith(commit)), commit) for commit in commits}
    row = {"file": path.relative_to(provenance).as_posix(), "figure": figure or stem.removesuffix(f"_{scale}"),
           "scale": scale if scale in ("smoke", "small", "paper") else "-",
           "backend": "-" if not devices else "cuda" if any("CUDA" in name for name in devices) else "cpu",
           "redo": redo, "commit": " ".join(whole.values()), "compiler": "",
           "device": devices[0] if len(devices) == 1 else SAID_BY_ROWS if devices else "", "ended": "",
           "sha256": hashlib.sha256(path.read_bytes()).hexdigest()[:16]}
    before = next((each for each in rows_of(provenance / PROVENANCE) if each["file"] == row["file"]), {})
    row |= {key: before[key] for key in ("figure", "scale", "backend", "compiler", "device")
            if row[key] in ("", "-") and before.get(key) or key == "figure" and before and not figure}
    same = all(row[key] == before.get(key) for key in ("commit", "sha256"))
    now = datetime.datetime.now(datetime.timezone.utc).strftime("%Y-%m-%dT%H:%M:%SZ")
    row["ended"] = before["ended"] if same else max(said("ended"), default=now)
    merge(provenance / PROVENANCE, COLUMNS, [row], ("file",))
    return row


def write(results=RESULTS):
    (results / KEPT).write_text(rebuilt(results))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--write", action="store_true", help="keep results/contents.csv")
    parser.add_argument("--list", action="store_true", help="name the old files")
    parser.add_argument("--keep", type=Path, metavar="FILE", help="a table below the results: MACHINE/FILE.csv")
    parser.add_argument("--redo", metavar="COMMAND", help="that makes the table again")
    parser.add_argument("--commit", default="", help="of the program, if the table's rows name none")
    options = parser.parse_args()
    if bool(options.keep) != bool(options.redo):
        parser.error("--keep FILE and --redo COMMAND belong together")
    try:
        if options.keep:
            keep(RESULTS / options.keep, options.redo, commit=options.commit)
        if options.write or options.keep:
            write()
        stale = old()
        print("\n".join([*(stale if options.list else []), in_words()]))
    except ContentsError as error:
        sys.exit(f"contents: {error}")


if __name__ == "__main__":
    main()
