"""Says what hinders this commit from being a release: old accepted files, versions or dates that differ between
CMakeLists.txt, pyproject.toml, CITATION.cff and CHANGELOG.md, placeholders in CITATION.cff, a program of another
version or commit. A dated first heading of the changelog says that this commit is a release, and a test fails if one is
hindered, or if the version is 1 or more and none of them was ever released: 1.0.0 is the first release, with evidence
of one commit's sources alone.

Usage: python3 -m paper_figures.workflow.releasable [OGC]; prints a line for each reason, exit status 1 if there is one.
The standard library is enough.
"""

import re
import subprocess
import sys
from pathlib import Path

from paper_figures.workflow import contents
from paper_figures.workflow.evidence import ROOM

ROOT = ROOM.parent
PROGRAM = "build/default/ogc"
VERSIONS = {"CMakeLists.txt": r"^project\(ogc_testbed VERSION (\S+)", "pyproject.toml": r'^version = "([^"]*)"',
            "CITATION.cff": r"^version: (\S+)", "CHANGELOG.md": r"^## (\S+),"}
JUDGE = re.compile(r'"ogc-testbed-judge==([^"]*)"')  # that pyproject.toml asks for
DATES = {"CITATION.cff": r"^date-released: \"?([^\"\n]*)", "CHANGELOG.md": r"^## \S+, (.*)$"}
DATE = re.compile(r"\d{4}-\d{2}-\d{2}")
# Words that stand for something still to be filled in. Repository and DOI stay out of CITATION.cff until there are any.
PLACEHOLDER = re.compile(r"\b(TODO|TBD|FIXME|XXX+|example\.(com|org)|your[- ]\w+|to be (added|assigned|announced)|"
                         r"10\.(?:5281/zenodo\.)?[0X]+|0000-0000-0000-0000)\b|<[^>\n]*>|^\S+: *(\"\")?$(?!\n[ -])",
                         re.I | re.M)


def first(root, name, pattern):
    """Returns the first group of a pattern's first match in a file; empty if there is none."""
    found = re.search(pattern, (root / name).read_text(), re.M)
    return found[1].strip() if found else ""


def version(root=ROOT):
    return first(root, "CMakeLists.txt", VERSIONS["CMakeLists.txt"])


def released(root=ROOT):
    """Returns the changelog's versions, each with its date, or "" if it is not released yet."""
    found = re.findall(r"^## (\S+), (.*)$", (root / "CHANGELOG.md").read_text(), re.M)
    return [(number, date if DATE.fullmatch(date) else "") for number, date in found]


def of_claim(root=ROOT):
    """Yields reasons why this commit may not say of itself what it says: that it is a release, or after the first."""
    found = released(root)
    if found and found[0][1]:
        yield from (f"{found[0][0]} is dated, but: {reason}" for reason in reasons(root))
    elif not version(root).startswith("0.") and not any(date for number, date in found if number[:2] != "0."):
        yield f"version {version(root)}, but none from 1 on is released: date CHANGELOG.md's heading if nothing hinders"


def of_versions(root):
    """Yields reasons about versions and dates."""
    wanted = version(root)
    if not re.fullmatch(r"\d+\.\d+\.\d+", wanted):
        yield f"CMakeLists.txt: version '{wanted}' is not three numbers"
    for name, pattern in VERSIONS.items():
        if (said := first(root, name, pattern)) != wanted:
            yield f"{name}: version '{said}', CMakeLists.txt has {wanted}"
    if (judge := JUDGE.search((root / "pyproject.toml").read_text())) and judge[1] != wanted:
        yield f"pyproject.toml: asks for ogc-testbed-judge {judge[1]}, CMakeLists.txt has {wanted}"
    dates = {name: first(root, name, pattern) for name, pattern in DATES.items()}
    for name, date in dates.items():
        if not DATE.fullmatch(date):
            yield f"{name}: '{date}' is no date of the release (YYYY-MM-DD)"
    if all(map(DATE.fullmatch, dates.values())) and len(set(dates.values())) > 1:
        yield f"dates differ: {', '.join(f'{name} {date}' for name, date in dates.items())}"


def of_placeholders(root):
    """Yields reasons about what is still to be filled in."""
    for found in PLACEHOLDER.finditer((root / "CITATION.cff").read_text()):
        yield f"CITATION.cff: '{found[0].strip()}' is a placeholder: leave the line out until it is known"


def of_program(root, program):
    """Yields reasons about what the program says of itself."""
    try:
        said = subprocess.run([program, "--version"], capture_output=True, text=True, check=True).stdout
        head = subprocess.run(["git", "-C", root, "rev-parse", "HEAD"], capture_output=True, text=True,
                              check=True).stdout.strip()
    except (OSError, subprocess.CalledProcessError) as error:
        yield f"{program}: cannot be asked for its version ({error}): build it in the repository"
        return
    for words in (f"OGC Testbed {version(root)}", f"commit {head}"):
        if words not in said.splitlines():
            yield f"{program}: does not say '{words}': build this commit, with nothing changed"


def of_evidence():
    """Yields a reason if an accepted file is old."""
    try:
        if stale := contents.old():
            yield f"{contents.in_words()} The first is {stale[0]}: make them again (experiments/evidence)"
    except contents.ContentsError as error:
        yield f"accepted files: {error}"


def reasons(root=ROOT, program=None):
    """Returns all reasons; without a program nothing is asked of it."""
    return [*of_evidence(), *of_versions(root), *of_placeholders(root), *(of_program(root, program) if program else ())]


def main():
    if sys.argv[1:2] in (["-h"], ["--help"]) or len(sys.argv) > 2:
        print(__doc__)
        sys.exit(0 if len(sys.argv) == 2 else 2)
    found = reasons(program=sys.argv[1] if len(sys.argv) == 2 else str(ROOT / PROGRAM))
    print("\n".join(found) or f"Nothing hinders the release of {version()}.")
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
