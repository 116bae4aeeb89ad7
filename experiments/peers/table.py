"""Puts a peer before the judge, stage by stage, and prints a table as CSV: one row a stage.

    experiments/peers/run ipctk [STAGE…] [--cases N] [--seed S] [--out FILE]

It runs in the peer's environment (`run` makes it). OGC_PROGRAM names the program `ogc`, else build/default/ogc.
"""

import argparse
import csv
import importlib.metadata
import json
import os
import subprocess
import sys
import tempfile
from dataclasses import dataclass, field
from pathlib import Path

HERE = Path(__file__).resolve().parent
DISTRIBUTIONS = {"ipctk": ["ipctk"], "newton": ["newton", "warp-lang"]}
HINGES = ["uniform", "bits", "dust", "lattice", "ladder.flat", "ladder.fold", "ladder.needle"]
EASY = ["uniform", "bits", "lattice", "ladder.gap", "ladder.turning"]  # others have motions that take minutes each
MOTIONS = [*EASY, "aimed", "dust", "ladder.grazing", "ladder.parallel", "ladder.planar", "ladder.needle",
           "ladder.offset"]  # all but ladder.slide, likewise
PAIRS = ["uniform", "bits", "dust", "lattice", "ladder.parallel", "ladder.threshold", "ladder.overlap",
         "ladder.exact_parallel", "ladder.end", "ladder.zero_length", "ladder.near", "ladder.offset", "ladder.boundary"]
STABLE = ["neo_hookean", "neo_hookean_bits", "lattice.neo_hookean", "ladder.neo_hookean_rest",
          "ladder.neo_hookean_collapse"]

CONTACTS = "evaluate_vertex_triangle_collision_force_hessian, evaluate_edge_edge_contact"


@dataclass
class Question:
    """A row: what a peer is asked. `generators` are those that ask what the peer has; `settings` are set in each of
    their cases (with them, cases are a batch of problem strings)."""

    peer: str
    stage: str
    function: str
    definition: str = "the stage's"
    generators: list = field(default_factory=list)
    settings: str = ""
    environment: dict = field(default_factory=dict)
    share: float = 1  # of --cases, for slow ones


QUESTIONS = [
    Question("ipctk", "closest_face", "point_triangle_distance"),
    Question("ipctk", "closest_points", "edge_edge_distance", generators=PAIRS),
    Question("ipctk", "activation", "TwoStageBarrier, ClampedLogBarrier, CubicBarrier"),
    Question("ipctk", "barrier", "barrier"),
    Question("ipctk", "bending", "dihedral_angle", generators=HINGES),
    Question("ipctk", "truncate", "ogc.TrustRegion.filter_step"),
    Question("ipctk", "ccd", "TightInclusionCCD", generators=EASY, share=0.005),
    Question("ipctk", "ccd", "AdditiveCCD", generators=MOTIONS, environment={"OGC_PEERS_CCD": "additive"}, share=0.02),
    Question("ipctk", "friction_force", "FrictionPotential.gradient", "ipctk's: forces alone"),
    Question("newton", "closest_face", "triangle_closest_point"),
    Question("newton", "closest_points", "warp.closest_point_edge_edge", generators=PAIRS),
    Question("newton", "activation", "evaluate_self_contact_force_norm"),
    Question("newton", "activation", "evaluate_self_contact_force_norm", "Newton's: a parabola below 10 µm",
             environment={"OGC_PEERS_OWN": "1"}),
    Question("newton", "membrane", "evaluate_neo_hookean_membrane_force_hessian", generators=STABLE, settings="k=0",
             share=0.1),
    Question("newton", "membrane", "evaluate_neo_hookean_membrane_force_hessian",
             "Newton's: forces alone, J above 1e-10", generators=STABLE, settings="k=0",
             environment={"OGC_PEERS_OWN": "1"}, share=0.1),
    Question("newton", "bending", "evaluate_dihedral_angle_based_bending_force_hessian", generators=HINGES),
    Question("newton", "bending", "evaluate_dihedral_angle_based_bending_force_hessian",
             "Newton's: none below 10⁻⁶ m, m²", generators=HINGES, environment={"OGC_PEERS_OWN": "1"}),
    Question("newton", "contact_force", CONTACTS),
    Question("newton", "contact_force", CONTACTS, "Newton's: within r, above the parabola, edges above 3.2 mm",
             environment={"OGC_PEERS_OWN": "1"}),
    Question("newton", "friction_force", "compute_friction"),
    Question("newton", "friction_force", "compute_friction", "Newton's: as of contact_force, and where something slips",
             environment={"OGC_PEERS_OWN": "1"}),
]
COLUMNS = ["peer", "version", "stage", "function", "definition", "cases", "asked_share", "mismatches", "groups_failing",
           "first_failing", "message", "mistake", "adapter_ns_a_case", "ours_ns_a_case", "prepare_s", "seed"]


def version(peer):
    return ", ".join(f"{name} {importlib.metadata.version(name)}" for name in DISTRIBUTIONS[peer])


def program():
    return os.environ.get("OGC_PROGRAM") or str(HERE.parents[1] / "build/default/ogc")


def judged(question, options, folder):
    """Runs the judge with these options; returns its verdict and the lines of the adapter's log."""
    log = Path(folder) / "log"
    log.unlink(missing_ok=True)
    command = [program(), "compare", *options, "--plugin", HERE / f"{question.peer}_adapter.py", "--time-limit", 3600]
    environment = {**os.environ, **question.environment, "OGC_PYTHON": sys.executable, "OGC_PEERS_LOG": str(log),
                   "OGC_PEERS_STAGE": question.stage}
    command += ["--json", "--report", Path(folder) / "report"]
    done = subprocess.run(list(map(str, command)), env=environment, capture_output=True, text=True, check=False)
    if not done.stdout.strip():
        raise SystemExit(f"{question.peer} {question.stage}: {done.stderr.strip() or done.returncode}")
    return json.loads(done.stdout), [json.loads(line) for line in log.read_text(encoding="utf-8").splitlines()]


def runs(question, cases, seed, folder):
    """Yields the verdicts and logs of a question: one run, one a generator, or a batch of problem strings."""
    count = max(1, int(cases * question.share))
    if question.settings:
        batch = Path(folder) / "batch.txt"
        each = max(1, count // len(question.generators))
        batch.write_text("".join(
            f"stage={question.stage} gen={name} seed={seed} index={i} {question.settings}\n"
            for name in question.generators for i in range(each)), encoding="utf-8")
        yield judged(question, ["--batch", batch], folder)
    elif question.generators:
        for name in question.generators:
            options = [question.stage, "--generator", name, "--cases", max(1, count // len(question.generators))]
            yield judged(question, [*options, "--seed", seed], folder)
    else:
        yield judged(question, [question.stage, "--cases", count, "--seed", seed], folder)


def share_asked(rows, cases):
    """Returns the share of cases that the peer was asked. The judge's first calls are the cases; after them it repeats
    some to explain failures."""
    seen = asked = 0
    for row in rows:
        if "asked" in row and seen < cases:
            seen, asked = seen + row["cases"], asked + row["asked"]
    return asked / max(1, seen)


def row_of(question, cases, seed):
    """Asks a question and returns its row."""
    total = {"cases": 0, "mismatches": 0, "asked": 0.0, "peer": 0.0, "ours": 0.0}
    failing, listed, mistakes, prepared = [], [], [], []
    with tempfile.TemporaryDirectory(prefix="ogc-peers-") as folder:
        for verdict, log in runs(question, cases, seed, folder):
            (stage,) = verdict["stages"]
            total["cases"] += stage["cases"]
            total["mismatches"] += stage["mismatches"]
            total["asked"] += stage["cases"] * share_asked(log, stage["cases"])
            for times in verdict["plugin"]["times"]:
                total["peer"] += times["plugin_seconds"]
                total["ours"] += times["our_seconds"]
            failing += [f"{g['name']} {g['mismatches']}/{g['cases']}" for g in stage["generators"] if g["mismatches"]]
            listed += stage["listed"]
            # A diagnosis asks cases of all generators, so that it says nothing of a peer that is asked some.
            if stage.get("diagnosis", {}).get("name") and not question.generators:
                mistakes.append(stage["diagnosis"]["name"])
            prepared.append(sum(row["seconds"] for row in log if "prepared" in row))
    first = min(listed, key=lambda case: "lattice" not in case["problem"], default={"problem": "", "message": ""})
    each = 1e9 / max(1, total["cases"])
    return {
        "peer": question.peer, "version": version(question.peer), "stage": question.stage,
        "function": question.function, "definition": question.definition, "cases": total["cases"],
        "asked_share": f"{total['asked'] / max(1, total['cases']):.3g}", "mismatches": total["mismatches"],
        "groups_failing": "; ".join(failing), "first_failing": first["problem"], "message": first["message"],
        "mistake": "; ".join(dict.fromkeys(mistakes)), "adapter_ns_a_case": f"{total['peer'] * each:.3g}",
        "ours_ns_a_case": f"{total['ours'] * each:.3g}" if total["ours"] else "",
        "prepare_s": f"{max(prepared):.3g}", "seed": seed,
    }


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("peer", choices=sorted(DISTRIBUTIONS))
    parser.add_argument("stages", nargs="*")
    parser.add_argument("--cases", type=int, default=50_000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--out", help="the table goes into this file, too")
    options = parser.parse_args()
    asked = [q for q in QUESTIONS if q.peer == options.peer and (not options.stages or q.stage in options.stages)]
    print(f"{version(options.peer)}, Python {sys.version.split()[0]}, seed {options.seed}", file=sys.stderr)
    tables = [sys.stdout] + ([open(options.out, "w", newline="", encoding="utf-8")] if options.out else [])
    writers = [csv.DictWriter(table, COLUMNS, lineterminator="\n") for table in tables]
    for writer in writers:
        writer.writeheader()
    for question in asked:
        row = row_of(question, options.cases, options.seed)
        for writer, table in zip(writers, tables):
            writer.writerow(row)
            table.flush()


if __name__ == "__main__":
    main()
