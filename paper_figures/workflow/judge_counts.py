"""Runs the judge's large counts: every stage of `ogc compare`, chunk by chunk, one process at a time (two on one device
alternate every few milliseconds, and a mesh stage waits for each answer). Needs only Python's own library.

A chunk is a run of its own with its own seed (1000 × `seed` + number). The next chunk is of the stage that lacks the
largest part of its wanted cases, so that a limit affects all stages alike; a first, small one measures the speed of a
stage. The folder gets a JSON line for each chunk, counts.md (their sums as a table), counts.json, and the output and
files of failed chunks. Counts continue where they were stopped, with the same program.
"""

import json
import shutil
import subprocess
import time
from dataclasses import dataclass

from paper_figures.workflow.jobs import FINISHED, KEPT, STOPPED, Limit, RunFailure, command_in

# Wanted cases, and cases of the first chunk. A question of the stage sweep has some twenty cases (vertices).
STAGES = {
    "truncate": (450_000_000, 20_000_000),
    "closest_face": (440_000_000, 20_000_000),
    "closest_points": (100_000_000, 4_000_000),
    "block": (12_000_000, 1_000_000),
    "initial_guess": (40_000_000, 4_000_000),
    "spring": (25_000_000, 1_000_000),
    "tetrahedron": (8_000_000, 400_000),
    "rod": (10_000_000, 500_000),
    "orientation": (1_000_000, 50_000),
    "contact_force": (13_000_000, 500_000),
    "friction_force": (9_000_000, 500_000),
    "volume_force": (10_000_000, 500_000),
    "bending": (8_000_000, 400_000),
    "activation": (4_000_000, 200_000),
    "membrane": (2_000_000, 100_000),
    "detect_vertex_facet": (4_000_000, 1_000_000),
    "detect_edge_edge": (4_000_000, 1_000_000),
    "bound": (3_000_000, 1_000_000),
    "plane": (4_000_000, 200_000),
    "volume_depth": (4_000_000, 200_000),
    "sweep": (240_000, 10_000),
    "rest_state": (300_000, 30_000),
    "step": (300_000, 20_000),
}
# Aims: the sum over these stages, counted in cases or in questions.
STENCILS = ("initial_guess", "spring", "tetrahedron", "rod", "orientation", "contact_force", "friction_force",
            "volume_force", "bending", "activation", "membrane")
AIMS = (
    ("pairs", 10**9, "cases", ("truncate", "closest_face", "closest_points", "block")),
    ("stencils", 10**8, "cases", STENCILS),
    ("whole answers", 10**7, "cases", ("detect_vertex_facet", "detect_edge_edge", "bound", "plane", "volume_depth")),
    ("sweeps", 10**4, "questions", ("sweep",)),
)
SUMS = ("cases", "questions", "decisions", "grey", "grey_not_exact", "near", "mismatches", "seconds",
        "contestant_seconds",
        "authority_seconds", "wall_seconds")
COLUMNS = ("cases", "questions", "decisions", "grey", "answered otherwise than exactly", "mismatches", "seconds",
           "contestant's")
CHUNK_SECONDS = 20  # of a chunk after the first: what a limit may cost


@dataclass(frozen=True)
class Counts:
    """Counts cases as a job; `share`: of the wanted cases; `stages`: those of STAGES that are counted."""

    backend: str
    share: float = 1
    seed: int = 1
    stages: tuple = tuple(STAGES)
    name: str = "counts"
    on_device = False  # its memory is not that of a run

    def make(self, program, root, limit=Limit(), _shown=False):
        self.clear_if_of_another(program, root)
        if not self.next_stage(root):
            return self.verdict(root, KEPT)
        begun = False  # a call makes at least one chunk, so that short calls make progress, too
        while limit.left() > 0:
            stage = self.next_stage(root)
            if not stage:
                return self.verdict(root, FINISHED)
            cases = self.size_of_chunk(stage, self.sums(root)[stage], limit)
            if not cases and begun:
                break
            self.chunk(program, root, stage, cases or self.least(stage), limit)
            self.write(root)
            begun = True
        return STOPPED

    def clear_if_of_another(self, program, root):
        """Removes counts of another program."""
        said = subprocess.run([str(program), "--version"], capture_output=True, text=True, check=False)
        asked = {"program": said.stdout, "backend": self.backend, "seed": self.seed}
        path = root / "asked.json"
        if not path.is_file() or json.loads(path.read_text()) != asked:
            shutil.rmtree(root, ignore_errors=True)
            root.mkdir(parents=True)
            path.write_text(json.dumps(asked))

    def chunks(self, root):
        """Returns the existing chunks of each stage, in the order of their names."""
        return [json.loads(path.read_text()) for path in sorted(root.glob("*.chunk.json"))]

    def sums(self, root):
        sums = {stage: dict.fromkeys(SUMS, 0) for stage in self.stages}
        for chunk in self.chunks(root):
            for key in SUMS if chunk["stage"] in sums else ():
                sums[chunk["stage"]][key] += chunk.get(key, 0)
        return sums

    def wanted(self, stage):
        return max(1, int(STAGES[stage][0] * self.share))

    def next_stage(self, root):
        """Returns the stage that lacks the largest part of its cases, None if none lacks any; a stage that gave no
        result is not run again."""
        sums, dead = self.sums(root), {chunk["stage"] for chunk in self.chunks(root) if "cases" not in chunk}
        parts = {stage: sums[stage]["cases"] / self.wanted(stage) for stage in self.stages if stage not in dead}
        stage = min(parts, key=parts.get, default=None)
        return stage if stage and parts[stage] < 1 else None

    def least(self, stage):
        return max(1, int(STAGES[stage][1] * self.share))

    def size_of_chunk(self, stage, done, limit):
        """Returns the number of cases of the next chunk, 0 if there is no time for one; never below the first's,
        because a short run has only small meshes."""
        least = self.least(stage)
        if not done["wall_seconds"]:
            return least
        seconds = min(CHUNK_SECONDS, 0.8 * limit.left())
        cases = int(seconds * done["cases"] / done["wall_seconds"])
        if cases < least and seconds < CHUNK_SECONDS:
            return 0
        return max(least, min(cases, self.wanted(stage) - done["cases"]))

    def chunk(self, program, root, stage, cases, limit):
        """Makes one chunk, kept as a line, with its output if it failed; one that the limit interrupted leaves
        nothing."""
        name = f"{stage}.s{1000 * self.seed + len(list(root.glob(f'{stage}.s*.chunk.json')))}"
        folder, log, begun = root / name, root / f"{name}.log", time.monotonic()
        words = ["compare", stage, "--backend", self.backend, "--cases", cases, "--seed", name.rpartition(".s")[2]]
        status, _ = command_in([program, *words, "--report", folder], limit, log)
        report = folder / "report.jsonl"
        result = json.loads(report.read_text()) if report.is_file() else {}
        if status == 0 or not result and limit.left() == 0:
            shutil.rmtree(folder, ignore_errors=True)
            log.unlink()
        if not result and limit.left() == 0:
            return
        took = time.monotonic() - begun
        line = {"stage": stage, **result, "exit_status": status, "wall_seconds": took}
        (root / f"{name}.chunk.json").write_text(json.dumps(line) + "\n")
        counted = f"{result['cases']} cases, {result['mismatches']} mismatches" if result else "no result"
        print(f"  {name}: {counted} in {took:.1f} s, exit status {status}", flush=True)

    def failed(self, root):
        """Returns a line for each chunk that did not end well."""
        for path in sorted(root.glob("*.chunk.json")):
            status, name = json.loads(path.read_text())["exit_status"], path.name.removesuffix(".chunk.json")
            if status != 0:
                yield f"{name}: exit status {status}, see {root / name} and {root / name}.log"

    def verdict(self, root, end):
        """Returns `end` if no chunk failed. Throws RunFailure."""
        problems = list(self.failed(root))
        if problems:
            raise RunFailure("\n  ".join(problems))
        return end

    def write(self, root):
        """Writes counts.md and counts.json of the existing chunks."""
        sums = self.sums(root)
        text = markdown(sums) + "\n\n" + "\n".join(f"- {line}" for line in totals(sums)) + "\n"
        (root / "counts.md").write_text(text)
        about = {"backend": self.backend, "seed": self.seed, "share": self.share, "stages": sums,
                 "totals": totals(sums)}
        (root / "counts.json").write_text(json.dumps({**about, "failed": list(self.failed(root))}, indent=1) + "\n")

    def results(self, root, _frames, _last):
        """Returns the sums, and all that failed chunks left."""
        kept = [root / name for name in ("counts.md", "counts.json") if (root / name).is_file()]
        failed = [path for path in root.glob("*.log") if path.is_file()]
        left = [path for folder in root.iterdir() if folder.is_dir()
                for path in folder.rglob("*")] if root.is_dir() else []
        yield from [*kept, *sorted(failed), *sorted(path for path in left if path.is_file())]


def markdown(counts):
    """Returns the sums as a table, a row for each stage."""
    rows = ["| stage | " + " | ".join(COLUMNS) + " |", "|---" * (len(COLUMNS) + 1) + "|"]
    for stage, sums in counts.items():
        cells = [f"{sums[key]:,}" for key in (*SUMS[:5], "mismatches")]
        cells += [f"{sums[key]:.0f}" for key in ("wall_seconds", "contestant_seconds")]
        rows.append(f"| `{stage}` | " + " | ".join(cells) + " |")
    return "\n".join(rows)


def totals(counts):
    """Returns aims and what was reached, a line for each aim, and all cases."""
    lines = []
    for name, wanted, unit, stages in AIMS:
        reached = sum(counts[stage][unit] for stage in stages if stage in counts)
        if any(stage in counts for stage in stages):
            lines.append(f"{name}: {reached:,} of {wanted:,}" + ("" if reached >= wanted else ", not reached"))
    cases, near, wrong = (sum(sums[key] for sums in counts.values()) for key in ("cases", "near", "mismatches"))
    share = 100 * near / max(cases, 1)
    lines.append(f"{cases:,} cases in all, {share:.1f} % within 2^10 ulp of a decision boundary, {wrong} mismatches")
    return lines
