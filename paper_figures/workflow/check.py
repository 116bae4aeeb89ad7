"""Compares new runs with the accepted results of the same question (scene, settings, scale, solver, backend), and
claims with their verdicts. `experiments/reproduce … --check` calls it.

  bits     a run of the commit, device and compiler of the accepted one ends with its bits, and an illustration of the
    exact reference is the same data
  bands    otherwise it has as many steps, keeps the guarantee, and the means of its columns lie within
    results/bands.json of the accepted ones
  claims   a claim that the accepted results reproduce is reproduced again, and a setting that was as printed is so
           again; at a smaller scale than the claim's, its number lies in the claim's band, moved from the printed
           number to the accepted one. Times are not compared with an accepted run's: they depend more on the hour
           than on the program
"""

import gzip
import json
import math
import sys
from pathlib import Path

from paper_figures.workflow.evidence import RESULTS, Evidence, EvidenceError, contact_of, runs_in
from paper_figures.workflow.verdicts import STATES, band_in_words, judge_all, within

BANDS = RESULTS / "bands.json"
NOTHING = [0, 0]  # a band
QUESTION = ("settings", "scale", "solver", "backend", "scene", "jitter", "jitter_seed")
SAME_BITS = ("device", "commit", "compiler")
# Words in the name of a measure that is a time, or a share of it, or a size of the scene.
NOT_COMPARED = ('"wall"', "[ms]", "time", "stage_", '"scene"')


def bands(path=BANDS):
    """Returns column -> relative band of its mean."""
    document = json.loads(Path(path).read_text())
    return {name: document["factor"] * entry["spread"] for name, entry in document["columns"].items()}


def counterpart(run, accepted):
    """Returns the newest accepted run of the same question; runs of the same program and machine come first."""
    alike = [old for old in accepted if question(run) == question(old) and run.first_step == old.first_step]
    same = [old for old in alike if all(run.manifest.get(key) == old.manifest.get(key) for key in SAME_BITS)]
    return (same or alike or [None])[-1]


def question(run):
    """Returns the question of a run: its settings by value, without their explanations."""
    asked = {key: run.manifest.get(key) for key in QUESTION}
    bodies = [{**body, "body_contact": contact_of(body), "material": material_of(body)}
              for body in asked["scene"]["bodies"]]
    return {**asked, "settings": {name: entry["value"] for name, entry in asked["settings"].items()},
            "scene": {**asked["scene"], "bodies": bodies}}


def material_of(body):
    """Returns the material without the membrane if the body has no triangles, or has tetrahedra: nothing reads it."""
    has_membrane = body.get("triangle_count") and not body.get("tetrahedron_count")
    return {key: value for key, value in body["material"].items() if has_membrane or key != "membrane"}


def differences(run, old, allowed):
    """Returns sentences about differences between a run and its accepted counterpart that exceed the allowed ones."""
    m, kept = run.manifest, old.manifest
    if run.guarantee_kept is False:
        return ["its audit FAILED"]
    if m.get("status") != "finished":
        return [f"not finished (status: {m.get('status', 'unknown')})"]
    if all(m.get(key) == kept.get(key) for key in SAME_BITS) and not m.get("dirty"):
        hashes = f"{m['final_hash']}, not {kept['final_hash']}"
        wrong = f"NOT the bits of the accepted run ({hashes}), although program and machine are the same"
        return [] if m["final_hash"] == kept["final_hash"] else [wrong]
    steps = run.step_count, old.step_count
    if steps[0] != steps[1]:
        return [f"{steps[0]} steps, not {steps[1]}"]
    found = []
    for name, band in allowed.items():
        new, before = run.mean(name), old.mean(name)
        if abs(new - before) > band * abs(before):
            found.append(f"mean {name} {new:.4g}, accepted {before:.4g}: more than {100 * band:.1f} % apart")
    return found


def compare_runs(new, accepted, allowed):
    """Returns (line, met) for each new run that has an accepted counterpart."""
    for run in new:
        old = counterpart(run, accepted)
        if old is not None:
            wrong = differences(run, old, allowed)
            same = all(run.manifest.get(key) == old.manifest.get(key) for key in SAME_BITS)
            alike = f"{'the bits of' if same else 'within the bands of'} {old.source}"
            yield f"{run.source}: {'; '.join(wrong) or alike}", not wrong


def compare_illustrations(runs, results):
    """Returns (line, met) for each illustration's data; the exact reference gives the same numbers everywhere."""
    for path in sorted(Path(runs).glob("illustrations/fig*.json")):
        for old in sorted(Path(results).glob(f"*/{path.name}.gz")):
            same = gzip.decompress(old.read_bytes()) == path.read_bytes()
            words = "the data" if same else "NOT the data"
            yield f"illustrations/{path.name}: {words} of {old.relative_to(results)}", same


def compare_claims(new, kept):
    """Returns (line, met) for each claim that the new runs can judge."""
    accepted = {j.claim["id"]: j for j in judge_all(kept)}
    for judgement in judge_all(new):
        before = accepted[judgement.claim["id"]].verdict
        if judgement.measured:
            lost = (before, judgement.verdict) in (("reproduced", "refuted"), ("as printed", "not as printed"))
            yield (f"{judgement.claim['id']}: {judgement.verdict}, {judgement.measured.value:.4g} (paper "
                   f"{judgement.claim['value']:g}, band {band_in_words(judgement.claim)}); "
                   f"accepted: {before}{' – LOST' if lost else ''}"), not lost
        elif movable(judgement.claim):
            yield from compare_smaller(judgement.claim, new, kept)


def movable(claim):
    """Returns whether the claim's band is meaningful at another scale: not for times, nor for sizes, which are part of
    the question, nor if the printed number is an end of the band. That nothing happens is meaningful at each scale."""
    band, value = claim.get("band"), claim["value"]
    if band == NOTHING:
        return True
    if not isinstance(band, list) or None in band or not value:
        return False
    if any(word in json.dumps(claim["measure"]) for word in NOT_COMPARED):
        return False
    return band[0] == value == band[1] or value not in band


def compare_smaller(claim, new, kept):
    """Compares the claim's number at a smaller scale, new and accepted, with the claim's band moved to the accepted
    number. A run that was not audited says nothing about the guarantee."""
    audited = ("audited",) if "guarantee" in claim["measure"] else ()
    wanted = {key: value for key, value in {"scene": claim["scene"], **claim.get("run", {})}.items()
              if key not in {"steps", "device", "audited", "audited_states"}.difference(audited)}
    for scale in STATES:
        found = new.measure(claim["measure"], {**wanted, "scale": scale})
        try:
            before = kept.measure(claim["measure"], {**wanted, "scale": scale}) if found else None
        except EvidenceError as error:  # an accepted table without the column, because it is older
            yield f"{claim['id']} at {scale}: not compared: {error}", True
            continue
        if found and before and math.isnan(before.value):
            yield f"{claim['id']} at {scale}: {found.value:.4g}; the accepted run never reached it", True
        elif found and before:
            moved = [end * before.value / (claim["value"] or 1) for end in claim["band"]]
            good = within(found.value, before.value, moved)
            numbers = f"{found.value:.4g}, accepted {before.value:.4g}"
            band = f"the claim's band moved there {band_in_words({'band': moved})}"
            yield f"{claim['id']} at {scale}: {numbers}, {band}{'' if good else ' – LOST'}", good


def check(runs, results=RESULTS):
    """Returns text about all runs below `runs`, and whether everything is met."""
    new, kept = runs_in(runs), Evidence(results)
    found = [*compare_runs(new, kept.runs, bands()), *compare_illustrations(runs, results),
             *compare_claims(Evidence(runs), kept)]
    if not found:
        return [f"{len(new)} runs, none of which an accepted result or a claim (they are about the paper's size) is "
                "about"], True
    return [line for line, _ in found], all(met for _, met in found)


def main(runs):
    """Prints the text; exit status 1 if something is not met."""
    try:
        lines, met = check(runs)
    except EvidenceError as error:
        sys.exit(f"check: {error}")
    print("\n".join(lines))
    print("check: " + ("all is met" if met else "NOT met; the lines above say what"), file=sys.stderr)
    sys.exit(0 if met else 1)


if __name__ == "__main__":
    main(sys.argv[1])
