"""Judges every claim of claims/*.json by the accepted results, or by run folders. The verdict is computed, never
written by hand.

Of a result, which a program computes and which may come out otherwise:
  reproduced      the number lies within the claim's band
  refuted         it lies outside; the evidence is named
Of a setting or a count of a mesh, which whoever sets the run up decides, so that it proves nothing:
  as printed      what was set is what the paper prints
  not as printed  it is not
Of both:
  not comparable  the claim is about another machine or another program; ours is given, and the claim that is comparable
    is named. A claim `against` another program is comparable only by the rule of ratios.py
  not yet run     no accepted run is of the kind that the claim needs; or the number lies outside of the band, and no
    run made a choice of ours (`choices`, or in words `not_varied`), or it is a time of one run where repeats count

`python3 -m paper_figures.workflow.verdicts` prints all, `--write` keeps them in results/verdicts.csv, `--runs FOLDER`
judges run folders instead.
"""

import argparse
import csv
import io
import json
import math
import sys
from dataclasses import dataclass
from pathlib import Path

from paper_figures.workflow import ratios
from paper_figures.workflow.evidence import CLAIMS, MEMBRANES, RESULTS, Evidence, EvidenceError

KEPT = RESULTS / "verdicts.csv"
RESULT, SETTING, MESH_COUNT = KINDS = ("result", "setting", "mesh count")
# The measure (evidence.value_of) determines what a claim is about. The simulated time of a run is its number of steps
# times the time step: both are set.
KIND_OF_MEASURE = {"setting": SETTING, "material": SETTING, "simulated": SETTING, "scene": MESH_COUNT,
                   "steps": RESULT, "guarantee": RESULT, "real_time": RESULT, "ratio": RESULT, "table": RESULT}
COLUMNS_THAT_ARE_SET = ("steps [1]",)
UNDECIDED = ("not comparable", "not yet run")
VERDICTS = ("reproduced", "refuted", *UNDECIDED)
AS_SET = ("as printed", "not as printed", *UNDECIDED)
STATES = ("smoke", "small")
REPEATS = "It waits for quiet repeats of its run, as the longest step of one run may be the machine's."
UNMADE = "It is not called refuted before runs made all choices."
STUDY = "ablation_"  # begins the names of the files of our own studies' claims
# Relative rounding of a number stored in single precision.
SINGLE = 2.0**-24


@dataclass(frozen=True)
class Judgement:
    """Holds a claim (as in its file, with scene, figures and kind), its verdict, our number or None, and further
    remarks as sentences; `late`: whether a run that answers it was known when its band was set."""

    claim: dict
    verdict: str
    measured: object
    note: str
    late: bool = False


def load(folder=CLAIMS):
    """Returns all claims with their scene, figures and the time when their band was set, and whether they are of a
    `study` of ours, whose files begin with STUDY, not the paper's own. Throws EvidenceError if a file is wrong."""
    result = []
    for path in sorted(Path(folder).glob("*.json")):
        document = json.loads(path.read_text())
        for claim in document["claims"]:
            _check(claim, path)
            common = {"scene": document["scene"], "figures": document["figures"], "kind": kind_of(claim),
                      "study": path.name.startswith(STUDY)}
            if common["kind"] == RESULT and "measure" in claim:
                own = claim.get("choices", [])
                said = {choice["says"] for choice in own}
                of_all = [] if "against" in claim else document.get("choices", [])  # another program has its own cloth
                common["choices"] = [*own, *(each for each in of_all if each["says"] not in said)]
            result.append({**claim, **common, "band_set": claim.get("band_set", document["bands_set"])})
    twice = {claim["id"] for claim in result if sum(other["id"] == claim["id"] for other in result) > 1}
    named = {claim["instead"] for claim in result if "instead" in claim}
    unknown = named - {claim["id"] for claim in result if "against" not in claim}
    if twice or unknown:
        raise EvidenceError(f"claims: {', '.join(sorted(twice)) or 'none'} twice; named as comparable, but missing or "
                            f"against another program: {', '.join(sorted(unknown)) or 'none'}")
    return result


def kind_of(claim):
    """Returns one of KINDS, from what is measured; if nothing is, from the claim itself. Throws EvidenceError."""
    specs = claim.get("measure", [])
    kinds = {_kind_of_measure(spec) for spec in (specs if isinstance(specs, list) else [specs])} or {claim.get("kind")}
    if len(kinds) != 1 or not kinds <= set(KINDS):
        raise EvidenceError(f"claim {claim.get('id', '?')}: what it measures is not one of {', '.join(KINDS)}: "
                            "say it by a `measure`, or by `kind` where nothing is measured")
    return kinds.pop()


def _kind_of_measure(spec):
    if spec.get("column") in COLUMNS_THAT_ARE_SET:
        return SETTING
    return next((kind for key, kind in KIND_OF_MEASURE.items() if key in spec), None)


def _check(claim, path):
    missing = [key for key in ("id", "value", "unit", "place", "says", "why") if key not in claim]
    if missing:
        raise EvidenceError(f"{path.name}: claim {claim.get('id', '?')} lacks {', '.join(missing)}")
    if "kind" in claim and "measure" in claim:
        raise EvidenceError(f"{path.name}: claim {claim['id']}: its kind follows from what is measured; remove `kind`")
    if "band" in claim and "measure" not in claim:
        raise EvidenceError(f"{path.name}: claim {claim['id']} has a band, but nothing is measured")
    explained = {"band", "instead", "against"} & set(claim) or "devices" in json.dumps(claim.get("measure", ""))
    if not explained:
        raise EvidenceError(f"{path.name}: claim {claim['id']} has no band, so it must name the claim that is "
                            "comparable (instead)")


def within(value, printed, band):
    """Returns whether `value` lies in the band; "stored" is the printed number rounded to single precision, None an
    open end."""
    if band == "stored":
        return abs(value - printed) <= SINGLE * abs(printed)
    low, high = band
    return (low is None or value >= low) and (high is None or value <= high)


def _is_empty(measure, measured):
    """Returns whether the measured value is an empty cell of a table."""
    return "table" in measure and math.isnan(measured.value)


def judge(claim, evidence):
    if "measure" not in claim:
        return Judgement(claim, "not comparable", None, _said(_against(claim, ()), sentence(claim["why"])))
    wanted = {"scene": claim["scene"], **claim.get("run", {})}
    measured = evidence.measure(claim["measure"], wanted)
    if measured is None or _is_empty(claim["measure"], measured):
        if "against" in claim:
            return Judgement(claim, "not comparable", None, _against(claim, ()))
        return Judgement(claim, "not yet run", None, _elsewhere(claim, evidence))
    membrane = f"The membrane is {MEMBRANES.get(measured.membrane, measured.membrane)}." \
        if measured.membrane and claim["kind"] == RESULT else ""
    known = _known_before(claim, evidence, wanted) if "band" in claim else ""
    late = f"The band was set on {claim['band_set'][:10]}, when this was known: {known}." if known else ""
    if obstacle := _against(claim, measured.sides):
        words = _said(obstacle, _own_ratio(claim, measured), measured.about, membrane, late)
        return Judgement(claim, "not comparable", measured, words, bool(known))
    if "band" not in claim:
        times = ("The paper prints no unit." if claim["unit"] == "not printed"
                 else f"Ours is {measured.value / claim['value']:.3g} times the paper's.")
        return Judgement(claim, "not comparable", measured, _said(times, membrane))
    also = [other for other in claim.get("also", []) if "band" in other]
    hit = within(measured.value, claim["value"], claim["band"])
    others = [other["place"] for other in also if within(measured.value, other["value"], other["band"])]
    note = [measured.about, membrane]
    note += [f"The paper says it in two ways, and ours is as in {', '.join(others)}."] if others and not hit \
        else []
    note.append(late)
    yes, no = (VERDICTS if claim["kind"] == RESULT else AS_SET)[:2]
    if hit or others:
        return Judgement(claim, yes, measured, _said(*note), bool(known))
    varied = [(choice["says"], _measured_with(choice, claim, evidence, wanted)) for choice in claim.get("choices", [])
              if "membrane" not in choice or measured.membrane not in ("", choice["membrane"])]
    otherwise = _other_choices(claim, varied)
    outside = f"Our run never comes to what is claimed ({measured.source})." if math.isnan(measured.value) \
        else f"Our number, {measured.value:.3g}, lies outside of the band ({measured.source})."
    if "not_varied" in claim:
        wait = f"It is not called refuted before this is varied: {claim['not_varied']}."
        return Judgement(claim, "not yet run", None, _said(outside, *otherwise, wait))
    if _of_one_run(claim, evidence, wanted):
        words = f"In one run it is {measured.value:.3g}, outside of the band ({measured.source})."
        return Judgement(claim, "not yet run", None, _said(REPEATS, words, *otherwise))
    if claim["kind"] == RESULT and any(value is None for _, value in varied):
        return Judgement(claim, "not yet run", None, _said(outside, membrane, *otherwise, UNMADE))
    return Judgement(claim, no, measured, _said(*note, *otherwise), bool(known))


def _of_one_run(claim, evidence, wanted):
    """Returns whether a claim about steadiness was measured in one run: what the machine does beside it can only make
    the longest step longer, so that one run can show that a claim holds, and not that it does not."""
    specs = claim["measure"]
    return isinstance(specs, list) and specs[0].get("table") == "steady" and not evidence.measure(specs[:1], wanted)


def sentence(text):
    """Returns a text that begins with a capital and ends with a full stop."""
    return f"{text[0].upper()}{text[1:]}{'' if text.endswith('.') else '.'}"


def _said(*sentences):
    return " ".join(filter(None, sentences))


def _against(claim, sides):
    """Returns why the claim's ratio with another program is not comparable, as a sentence; empty if it is."""
    return ratios.obstacle(sides, claim["against"]) if "against" in claim else ""


def _own_ratio(claim, measured):
    """Returns a sentence about the ratio that stands beside one with another program."""
    return (f"This testbed's own ratio, of its own solvers, is {measured.value:.3g}, where the paper prints "
            f"{claim['value']:g}.") if measured.sides and len(measured.sides) > 1 else \
        f"Beside it stands our {measured.value:.3g}, where the paper prints {claim['value']:g}."


def _other_choices(claim, varied):
    """Returns sentences about the measure with other choices where the paper leaves one open (`choices` of the claim:
    `says`, and what differs in the measure, or a `measure` of its own), and about choices that no run made. This is no
    verdict, but a claim that fails as printed may hold with another choice."""
    missing = [says for says, value in varied if value is None]
    made = [(says, value) for says, value in varied if value is not None and not math.isnan(value)]
    hits = [each for each in made if within(each[1], claim["value"], claim["band"])]
    misses = [each for each in made if each not in hits]
    listed = lambda found: "; ".join(f"{says} ({value:.3g})" for says, value in found)  # noqa: E731
    one = lambda found: len(found) == 1  # noqa: E731
    words = []
    if hits:
        words.append(f"{'This other choice brings' if one(hits) else 'These other choices bring'} it into the band: "
                     f"{listed(hits)}.")
    if misses and hits:
        words.append(f"{'This one does' if one(misses) else 'These do'} not: {listed(misses)}.")
    elif misses:
        words.append(f"{'This other choice does' if one(misses) else 'These other choices do'} not bring it into the "
                     f"band: {listed(misses)}.")
    if missing:
        words.append(f"No run made {'this choice' if one(missing) else 'these choices'}: {'; '.join(missing)}.")
    return words


def _measured_with(choice, claim, evidence, wanted):
    """Returns a number, NaN if a run that made this choice gave none, or None if no run made it."""
    try:
        otherwise = {key: other for key, other in choice.items() if key not in ("says", "measure")}
        specs = choice.get("measure", claim["measure"])
        specs = specs if isinstance(specs, list) else [specs]
        every = set(otherwise) <= {"membrane"}  # all that a claim measures has one; other keys are of the first
        found = evidence.measure([{**spec, **otherwise} for spec in (specs if every else specs[:1])], wanted)
    except EvidenceError:  # a table without the column, because it is older
        return None
    return found.value if found else None


def _known_before(claim, evidence, wanted):
    """Returns in words the number that a run had given when the claim's band was set; empty if there was none, or if
    the band leaves no choice."""
    if claim["band"] == "stored":
        return ""
    earlier = evidence.before(claim["band_set"])
    found = earlier.measure(claim["measure"], wanted)
    return f"{found.value:.9g} ({found.source})" if found else claim.get("band_after", "")


def _elsewhere(claim, evidence):
    """Returns sentences about what is missing, and about the same measure in windows or at a smaller scale. This is no
    verdict, but worth knowing."""
    notes = [f"It waits for {claim['waits_for']}."] if "waits_for" in claim else []
    if claim.get("run", {}).get("backend", claim.get("backend")) == "cpu":
        notes.append(evidence.windows({"scene": claim["scene"], **claim["run"]}))
    for scale in STATES:
        found = at_another_scale(claim, evidence, scale)
        if found and claim.get("band") != "stored" and claim.get("unit") == "1":
            notes.append(f"At scale {scale} it is {found.value:.3g}, which is not judged.")
    return _said(*notes)


def at_another_scale(claim, evidence, scale):
    """Returns the value of the claim's measure at another scale than the claim's, or None. This is no verdict."""
    wanted = {"scene": claim["scene"], **claim.get("run", {}), "scale": scale}
    wanted = {key: value for key, value in wanted.items() if key not in ("steps", "device", "audited_states")}
    try:
        return evidence.measure(claim["measure"], wanted)
    except EvidenceError:  # a table without the column, because it is older
        return None


def judge_all(evidence=None, claims=None):
    evidence = evidence or Evidence()
    return [judge(claim, evidence) for claim in claims or load()]


def counts(judgements, names=VERDICTS):
    return {verdict: sum(j.verdict == verdict for j in judgements) for verdict in names}


def apart(judgements):
    """Returns (judgements about results, judgements about settings)."""
    return [[j for j in judgements if (j.claim["kind"] == RESULT) == wanted] for wanted in (True, False)]


def by_origin(judgements):
    """Returns (judgements about the paper's own results, those about results of our studies of it)."""
    results = apart(judgements)[0]
    return [[j for j in results if j.claim["study"] == wanted] for wanted in (False, True)]


def headline(judgements):
    """Returns the first lines of the report: the paper's own results count; our studies and settings stand beside."""
    given = apart(judgements)[1]
    settings = counts(given, AS_SET)
    beside = ", ".join(f"{settings[name]} {name}" for name in AS_SET)
    own, studies = map(_in_words, by_origin(judgements))
    return (f"Of the paper's own {own}. Of our studies' {studies}. "
            f"Beside them stand {len(given)} settings and counts of meshes, which are no results: {beside}.")


def _in_words(results):
    found, late = counts(results), sum(j.late for j in results if j.verdict == "reproduced")
    mark = f" ({late} by a band set after a run)" if late else ""
    return (f"{len(results)} claims about results {found['reproduced']} are reproduced{mark}, "
            f"{found['refuted']} refuted, " + ", ".join(f"{found[name]} {name}" for name in UNDECIDED))


def unjudged(judgements):
    """Returns claims that are not yet run, of scenes with accepted results, unless they name what they wait for or what
    is not varied; and claims that name it although they are judged."""
    judged = {j.claim["scene"] for j in judgements if j.measured or "is not judged" in j.note}
    silent = [j.claim["id"] for j in judgements if j.verdict == "not yet run" and j.claim["scene"] in judged
              and not {"waits_for", "not_varied"} & set(j.claim) and REPEATS not in j.note and UNMADE not in j.note]
    stale = [j.claim["id"] for j in judgements if j.verdict != "not yet run"
             and {"waits_for", "not_varied"} & set(j.claim)]
    return silent, stale


def band_in_words(claim):
    band = claim.get("band")
    if band is None:
        return "none"
    if band == "stored":
        return "rounded to single precision"
    low, high = band
    if low == high:
        return f"exactly {low:g}"
    return f"at least {low:g}" if high is None else f"at most {high:g}" if low is None else f"{low:g} to {high:g}"


def as_table(judgements):
    """Returns CSV with a row for each claim: results first, settings and counts of meshes below them."""
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(["claim", "kind", "verdict", "of", "paper", "unit", "band", "band set after a run",
                     "ours", "device", "commit", "source", "note"])
    for j in (j for group in apart(judgements) for j in group):
        m = j.measured
        paper = (f"{j.claim['value']:g}", j.claim["unit"], band_in_words(j.claim), "yes" if j.late else "")
        ours = (f"{m.value:.6g}", m.device, m.commit, m.source) if m else ("",) * 4
        of = "study" if j.claim["study"] else "paper"
        writer.writerow([j.claim["id"], j.claim["kind"], j.verdict, of, *paper, *ours, j.note])
    return out.getvalue()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--write", action="store_true", help="keep the table in results/verdicts.csv")
    parser.add_argument("--runs", help="judge the run folders below this folder instead of the accepted results")
    arguments = parser.parse_args()
    try:
        judgements = judge_all(Evidence(arguments.runs) if arguments.runs else None)
    except EvidenceError as error:
        sys.exit(f"verdicts: {error}")
    if arguments.write:
        KEPT.write_text(as_table(judgements))
    else:
        sys.stdout.write(as_table(judgements))
    print(headline(judgements), file=sys.stderr)


if __name__ == "__main__":
    main()
