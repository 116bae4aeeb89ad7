"""Judges every claim of claims/*.json by the accepted results, or by run folders. The verdict is computed, never written by hand.

  reproduced      the number lies within the claim's band
  refuted         it lies outside; the evidence is named
  not comparable  the claim is about another machine or another program; ours is given, and the claim that is comparable is named
  not yet run     no accepted run is of the kind that the claim needs

`python3 -m paper_figures.verdicts` prints all, `--write` keeps them in results/verdicts.csv, `--runs FOLDER` judges run folders instead.
"""

import argparse
import csv
import io
import json
import sys
from dataclasses import dataclass
from pathlib import Path

from paper_figures.evidence import RESULTS, Evidence, EvidenceError

CLAIMS = Path(__file__).parent / "claims"
KEPT = RESULTS / "verdicts.csv"
VERDICTS = ("reproduced", "refuted", "not comparable", "not yet run")
STATES = ("smoke", "small")
# Relative rounding of a number stored in single precision.
SINGLE = 2.0**-24


@dataclass(frozen=True)
class Judgement:
    """A claim (as its file has it, with scene and figures), its verdict, our number or None, and what else must be said."""

    claim: dict
    verdict: str
    measured: object
    note: str


def load(folder=CLAIMS):
    """All claims; each knows its scene, its figures and when its band was set. Throws EvidenceError where a file is wrong."""
    result = []
    for path in sorted(Path(folder).glob("*.json")):
        document = json.loads(path.read_text())
        for claim in document["claims"]:
            result.append({**claim, "scene": document["scene"], "figures": document["figures"], "band_set": claim.get("band_set", document["bands_set"])})
            _check(result[-1], path)
    twice = {claim["id"] for claim in result if sum(other["id"] == claim["id"] for other in result) > 1}
    unknown = {claim["instead"] for claim in result if "instead" in claim} - {claim["id"] for claim in result}
    if twice or unknown:
        raise EvidenceError(f"claims: {', '.join(sorted(twice)) or 'none'} twice; named as comparable, but missing: {', '.join(sorted(unknown)) or 'none'}")
    return result


def _check(claim, path):
    missing = [key for key in ("id", "value", "unit", "place", "says", "why") if key not in claim]
    if missing:
        raise EvidenceError(f"{path.name}: claim {claim.get('id', '?')} lacks {', '.join(missing)}")
    if "band" in claim and "measure" not in claim:
        raise EvidenceError(f"{path.name}: claim {claim['id']} has a band, but nothing is measured")
    if "band" not in claim and "instead" not in claim and "devices" not in json.dumps(claim.get("measure", "")):
        raise EvidenceError(f"{path.name}: claim {claim['id']} has no band, so it must name the claim that is comparable (instead)")


def within(value, printed, band):
    """Whether `value` lies in the band; "stored" is the printed number rounded to single precision, None an open end."""
    if band == "stored":
        return abs(value - printed) <= SINGLE * abs(printed)
    low, high = band
    return (low is None or value >= low) and (high is None or value <= high)


def judge(claim, evidence):
    if "measure" not in claim:
        return Judgement(claim, "not comparable", None, claim["why"])
    wanted = {"scene": claim["scene"], **claim.get("run", {})}
    measured = evidence.measure(claim["measure"], wanted)
    if measured is None:
        return Judgement(claim, "not yet run", None, _elsewhere(claim, evidence, wanted))
    late = f"the band was set on {claim['band_set'][:10]}, after this run" if measured.ended and measured.ended < claim["band_set"] and claim.get("band") not in (None, "stored") else ""
    if "band" not in claim:
        return Judgement(claim, "not comparable", measured, f"ours over the paper's: {measured.value / claim['value']:.3g}")
    also = [other for other in claim.get("also", []) if "band" in other]
    hit = within(measured.value, claim["value"], claim["band"])
    others = [other["place"] for other in also if within(measured.value, other["value"], other["band"])]
    if not hit and others:
        late = "; ".join(filter(None, [f"as in {', '.join(others)}; the paper says it in two ways", late]))
    return Judgement(claim, "reproduced" if hit or others else "refuted", measured, late)


def _elsewhere(claim, evidence, wanted):
    """What the same measure gives at a smaller scale: no verdict, but worth knowing."""
    notes = [claim["waits_for"]] if "waits_for" in claim else []
    for scale in STATES:
        fewer = {key: value for key, value in wanted.items() if key not in ("steps", "device")}
        try:
            found = evidence.measure(claim["measure"], {**fewer, "scale": scale})
        except EvidenceError:  # a table older than the column: nothing to show beside a claim that waits anyway
            continue
        if found and claim.get("band") != "stored" and claim.get("unit") == "1":
            notes.append(f"at {scale}, not judged: {found.value:.3g}")
    return "; ".join(notes)


def judge_all(evidence=None, claims=None):
    evidence = evidence or Evidence()
    return [judge(claim, evidence) for claim in claims or load()]


def counts(judgements):
    return {verdict: sum(j.verdict == verdict for j in judgements) for verdict in VERDICTS}


def headline(judgements):
    """The first line of the report."""
    found = counts(judgements)
    return f"{found['not yet run']} of {len(judgements)} claims are not yet run; {found['reproduced']} reproduced, {found['refuted']} refuted, {found['not comparable']} not comparable."


def unjudged(judgements):
    """Claims not yet run of a scene that has accepted results, unless they say what they wait for; and claims that wait although they are judged."""
    judged = {j.claim["scene"] for j in judgements if j.measured or "not judged" in j.note}
    silent = [j.claim["id"] for j in judgements if j.verdict == "not yet run" and j.claim["scene"] in judged and "waits_for" not in j.claim]
    stale = [j.claim["id"] for j in judgements if j.verdict != "not yet run" and "waits_for" in j.claim]
    return silent, stale


def band_in_words(claim):
    band = claim.get("band")
    if band is None:
        return "none"
    if band == "stored":
        return "as printed"
    low, high = band
    if low == high:
        return f"exactly {low:g}"
    return f"at least {low:g}" if high is None else f"at most {high:g}" if low is None else f"{low:g} to {high:g}"


def as_table(judgements):
    """CSV with a row a claim."""
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(["claim", "verdict", "paper", "unit", "band", "ours", "device", "commit", "source", "note"])
    for j in judgements:
        m = j.measured
        writer.writerow([j.claim["id"], j.verdict, f"{j.claim['value']:g}", j.claim["unit"], band_in_words(j.claim), f"{m.value:.6g}" if m else "",
                         *((m.device, m.commit, m.source) if m else ("", "", "")), j.note])
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
