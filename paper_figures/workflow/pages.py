"""Writes the pages that follow from verdicts, provenance and durations alone: claims.md, which says of each claim about
a result how to make its evidence again, and the drafts of a replication report and of a software paper, from the
templates beside them (drafts/NAME.template).

Usage: python3 -m paper_figures.workflow.pages [--write]: checks whether all pages are those of the accepted results,
with exit status 1 if one is not, or writes them. Needs PyYAML, as the figures are listed in YAML files.
"""

import argparse
import csv
import math
import re
import string
import sys
import textwrap
from collections import Counter

from paper_figures.site import claims as words
from paper_figures.site.origins import Origins
from paper_figures.workflow import contents, recipes, releasable, verdicts
from paper_figures.workflow.durations import measured_times
from paper_figures.workflow.evidence import RESULTS, ROOM, Evidence

PAGE, DRAFTS = ROOM / "claims.md", ROOM / "drafts"
ROOT = ROOM.parent
FROM_NOTHING = "two_cores/from_nothing.csv"  # its first row: packages, build, one figure
WIDE = 120
LONG = 80  # letters of a command; a longer one stands in provenance.csv alone
RUNNER = re.compile(r"python3 -m paper_figures\.workflow\.runner .*--backend cuda (\w+)$")
INTRODUCTION = """# Claims: commands, minutes, hardware, bands, files

`.venv/bin/python -m paper_figures.workflow.pages --write` makes this page.

Of each claim about a result: its verdict, its band, the command that makes its evidence, the minutes of that command on
the named hardware, and the accepted file. Minutes are of the whole run, figure or table; – where nobody measured them,
or no run was made. `experiments/evidence gpu` makes everything on a GPU, `experiments/evidence cores` what two cores
can. {settings} ([verdicts.csv](results/verdicts.csv), with notes).

`experiments/reproduce --quick` makes the drawings, {quick} at scale small, and Table 1's scenes at smoke: by the
accepted [durations](results/two_cores/durations.csv) {minutes} minutes on two cores after an installation and build
[from nothing](results/two_cores/from_nothing.csv) of {build}. Its `--check` then holds the drawings' data, the runs'
audits and means, and the claims whose band has a meaning at these scales against the accepted results.
"""
HEAD = ("claim", "verdict", "band", "command", "minutes", "hardware", "file")


def command_of(origin):
    """Returns the command that makes a file again, in short."""
    found = RUNNER.fullmatch(origin.command)
    command = f"experiments/evidence gpu {found[1]}" if found else origin.command
    return f"`{command}`" if len(command) <= LONG else \
        f"[listed](results/{origin.machine}/provenance.csv)"


def hardware_of(device):
    """Returns a device in short: of a GPU the model alone."""
    return re.sub(r"NVIDIA | 80GB HBM3|, CUDA [\d.]+|(?<=^1 thread)s", "", device)


def minutes_of(seconds):
    return "–" if seconds is None or math.isnan(seconds) else "< 1" if seconds < 60 else f"{seconds / 60:.0f}"


def wanted_hardware(claim):
    """Returns the hardware of a run that nobody made yet."""
    run = claim.get("run", {})
    return run.get("device", "" if run.get("backend", "cuda") == "cpu" else "GPU")


def row(judgement, origins, book):
    """Returns the cells of a claim; where two runs make a number, the cells of both."""
    claim, measured = judgement.claim, judgement.measured
    found = origins.of(measured) if measured else []
    cells = [(command_of(each), minutes_of(each.seconds), hardware_of(each.hardware),
              f"[{each.file.rpartition('/')[2]}](results/{each.file})") for each in found]
    cells = cells or [(f"`{words.redo_of(claim, book)}`", "–", wanted_hardware(claim), "–")]
    late = " (set after a run)" if judgement.late else ""
    band = "–" if claim.get("band") is None else verdicts.band_in_words(claim) + late
    joined = (", ".join(dict.fromkeys(cell)) for cell in zip(*cells))
    return [f"`{claim['id']}`", judgement.verdict, band, *joined]


def table(judgements, origins, book):
    lines = [f"| {' | '.join(HEAD)} |", "|---" * len(HEAD) + "|"]
    return "\n".join([*lines, *(f"| {' | '.join(row(each, origins, book))} |" for each in judgements)])


def settings_in_words(given):
    """Returns how many settings and counts of meshes are as printed."""
    found = verdicts.counts(given, verdicts.AS_SET)
    counted = ", ".join(f"{found[name]} {name}" for name in verdicts.AS_SET)
    return f"{len(given)} settings and counts of meshes: {counted}"


def quick_seconds(book, times):
    """Returns how long the installation and build of the quick path took on two cores, and how long its figures did
    [s]. Throws KeyError with a figure that nobody timed."""
    drawn = [(name, "-", "-") for name, recipe in book.items() if "illustration" in recipe.body]
    figures = [*drawn, *((name, "small", "cpu") for name in recipes.QUICK), ("table1", "smoke", "cpu")]
    first, *_ = contents.rows_of(RESULTS / FROM_NOTHING)
    return float(first["seconds"]), sum(times[figure][0] for figure in figures)


def page(judgements, evidence, book):
    """Returns the text of claims.md."""
    origins = Origins(evidence.runs)
    own, studies = verdicts.by_origin(judgements)
    build, figures = (f"{seconds / 60:.0f}" for seconds in quick_seconds(book, measured_times()))
    filled = {"settings": settings_in_words(verdicts.apart(judgements)[1]), "build": build, "minutes": figures,
              "quick": ", ".join(f"`{name}`" for name in recipes.QUICK)}
    return "\n\n".join([wrapped(INTRODUCTION.format(**filled)), "## The paper's own", table(own, origins, book),
                        "## Our studies'", table(studies, origins, book)]) + "\n"


def wrapped(text):
    """Returns a text whose paragraphs fill their lines; headings, tables and lists stay as they are."""
    kept = lambda block: block.startswith(("#", "|", "-"))  # noqa: E731
    return "\n\n".join(block if kept(block) else textwrap.fill(" ".join(block.split()), WIDE, break_on_hyphens=False)
                       for block in text.strip().split("\n\n"))


def by_figure(own):
    """Returns a table of verdicts by figure."""
    lines = [f"| figure | {' | '.join(verdicts.VERDICTS)} |", "|---" * 5 + "|"]
    figures = sorted({each.claim["figures"][0] for each in own})
    for figure in figures:
        found = verdicts.counts([each for each in own if each.claim["figures"][0] == figure])
        name = re.sub(r"fig(?:0)?(\d+)", r"Fig. \1", figure).replace("table1", "Table 1")
        lines.append(f"| {name} | {' | '.join(str(found[verdict]) for verdict in verdicts.VERDICTS)} |")
    return "\n".join(lines)


def listed(own, verdict):
    """Returns a list of the claims of a verdict, each with the paper's words and the reason."""
    return "\n".join(textwrap.fill(f"{words.Claim(each, '', '', '', (), '').says} ({each.claim['place']}): "
                                   f"{words.sentence_of(each)}", WIDE, initial_indent="- ", subsequent_indent="  ",
                                   break_on_hyphens=False)
                     for each in own if each.verdict == verdict)


def title_mark(own):
    """Returns ReScience's mark of a title: a replication, or one that failed. It failed if fewer of the paper's own
    claims are reproduced than refuted, or an audit refuted the guarantee."""
    found = verdicts.counts(own)
    broken = any(each.verdict == "refuted" and "guarantee" in str(each.claim.get("measure")) for each in own)
    return "[¬Re]" if broken or found["reproduced"] < found["refuted"] else "[Re]"


def audits_in_words(evidence):
    """Returns what audits of accepted runs found."""
    wrong = len(evidence.failed)
    return f"Audits of {wrong} accepted runs found intersections." if wrong else \
        "No audit of an accepted run found an intersection."


def values(judgements, evidence):
    """Returns the values of all places of the templates."""
    own, studies = verdicts.by_origin(judgements)
    found, of_studies = verdicts.counts(own), verdicts.counts(studies)
    with (RESULTS / contents.KEPT).open(newline="") as file:
        commits = list(csv.DictReader(file))
    rows = [line for line in (ROOT / "compare/deviations.md").read_text().splitlines() if line.startswith("| ")][1:]
    date = dict(releasable.released()).get(releasable.version()) or "unreleased"
    late = sum(each.late for each in own if each.verdict == "reproduced")
    stages = Counter(path.suffix for path in (ROOT / "compare/judge/stages").glob("*.cpp"))[".cpp"]
    return {"mark": title_mark(own), "version": releasable.version(), "date": date, "claims": len(own),
            **{verdict.replace(" ", "_"): found[verdict] for verdict in verdicts.VERDICTS}, "late": late,
            "studies": len(studies), "studies_reproduced": of_studies["reproduced"],
            "studies_refuted": of_studies["refuted"], "settings": settings_in_words(verdicts.apart(judgements)[1]),
            "by_figure": by_figure(own), "refuted_list": listed(own, "refuted"), "deviations": len(rows),
            "commits": len(commits), "stages": stages, "audits": audits_in_words(evidence)}


def pages():
    """Returns path -> text of every page."""
    evidence, book = Evidence(), recipes.load()
    judgements = verdicts.judge_all(evidence)
    filled = values(judgements, evidence)
    return {PAGE: page(judgements, evidence, book),
            **{path.with_suffix(".md"): wrapped(string.Template(path.read_text()).substitute(filled)) + "\n"
               for path in sorted(DRAFTS.glob("*.template"))}}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--write", action="store_true", help="write them")
    options = parser.parse_args()
    for path, text in pages().items():
        if options.write:
            path.write_text(text)
        elif not path.is_file() or path.read_text() != text:
            sys.exit(f"{path.relative_to(ROOT)} is not that of the accepted results: write it with --write")


if __name__ == "__main__":
    main()
