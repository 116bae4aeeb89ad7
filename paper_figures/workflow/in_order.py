"""The steps of figures one after the other, where Snakemake can't be had. A step whose output is there already is not
done again unless an input is newer, but a changed parameter goes unnoticed: remove the figure's folder then.

Usage: python3 -m paper_figures.workflow.in_order RUNS OGC SCALE BACKEND [FIGURE …]
"""

import os
import sys
from pathlib import Path

from paper_figures.workflow import job, recipes


def due(step):
    output = Path(step.output)
    return not output.is_file() or any(Path(path).stat().st_mtime > output.stat().st_mtime for path in step.inputs)


def main(runs, ogc, scale, backend, names):
    """Exit status of the first step that fails, or 0. Tells first which steps are due (progress.py)."""
    chosen = recipes.choose(names, recipes.load(), backend)
    recipes.program_stamp(runs, ogc)
    os.chdir(runs)
    os.environ.update(PYTHONPATH=str(recipes.ROOT), OGC_STAMP=recipes.PROGRAM)
    wanted, made = [], set()
    for step in (step for recipe in chosen for step in recipes.steps(recipe, scale, backend, ogc)):
        if made & set(step.inputs) or due(step):
            wanted.append(step)
            made.add(step.output)
    job.tell(due=[step.name for step in wanted])
    for step in wanted:
        print(f"{step.name} → {step.output}", file=sys.stderr, flush=True)
        status = job.run(step.log, step.output, list(step.command))
        if status != 0:
            return status
    return 0


if __name__ == "__main__":
    try:
        sys.exit(main(*sys.argv[1:5], sys.argv[5:]))
    except recipes.RecipeError as error:
        sys.exit(f"reproduce: {error}")
