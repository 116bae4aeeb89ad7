"""Puts accepted runs whose every row is kept back into run folders (without frames), so that their figure is drawn
again from what is kept, where the runs themselves are gone.

Usage: python3 -m paper_figures.workflow.restored MACHINE FIGURE_SCALE OUT, for example h200 fig17_paper runs/fig17.
"""

import argparse
import json
import sys
from pathlib import Path

from paper_figures.workflow.evidence import RESULTS, EvidenceError, manifest_at, opened
from paper_figures.workflow.jobs import PROCESSOR_TIME

FILES = ("steps.csv", "iterations.csv", PROCESSOR_TIME)


def restore(machine, stem, out, results=RESULTS):
    """Writes a run folder below `out` for each unthinned run kept in results/machine/stem; returns their names. Throws
    EvidenceError if there is none."""
    folder, names = Path(results) / machine / stem, []
    for path in sorted(folder.glob("*_run.json")):
        name = path.name.removesuffix("_run.json")
        ways = {end: [path.with_name(f"{name}_{end}{zipped}") for zipped in ("", ".gz")] for end in FILES}
        kept = {end: way for end, both in ways.items() for way in both if way.is_file()}
        if FILES[0] not in kept:
            continue
        target = Path(out) / name
        target.mkdir(parents=True, exist_ok=True)
        (target / "run.json").write_text(json.dumps(manifest_at(path)))
        for end, way in kept.items():
            with opened(way) as file:
                (target / end).write_text(file.read())
        names.append(name)
    if not names:
        raise EvidenceError(f"{folder} has no run with a row for every step; those that were thinned can't be restored")
    return names


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("machine")
    parser.add_argument("stem", help="folder of the figure's runs in results/MACHINE")
    parser.add_argument("out", type=Path)
    options = parser.parse_args()
    try:
        print("\n".join(str(options.out / name) for name in restore(options.machine, options.stem, options.out)))
    except EvidenceError as error:
        sys.exit(f"restored: {error}")


if __name__ == "__main__":
    main()
