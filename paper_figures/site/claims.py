"""Words for claims and verdicts: what a page says of a claim, in plain sentences, and what stands behind it."""

import math
from dataclasses import dataclass

from paper_figures.workflow import verdicts
from paper_figures.workflow.recipes import RecipeError, choose

MEANING = {
    "reproduced": "Our number lies in the band.",
    "refuted": "Our number lies outside of the band.",
    "not comparable": "The claim is about another machine or another program.",
    "not yet run": "No accepted run is of the kind that the claim needs, or a choice that the paper leaves open is not "
                   "varied yet.",
    "as printed": "What we set is what the paper prints.",
    "not as printed": "What we set differs from what the paper prints.",
}
NO_UNIT = ("1", "", "not printed")


def number(value, unit="1"):
    """Returns a number with its unit, in four digits."""
    if value is None or math.isnan(value):
        return ""
    text = f"{value:,.0f}" if abs(value) >= 1e4 and value == round(value) else f"{value:.4g}"
    return text if unit in NO_UNIT else f"{text} {unit}"


def slug(verdict):
    return verdict.replace(" ", "-")


@dataclass(frozen=True)
class Claim:
    """Holds a claim as pages show it. `ours` and `fresh` are numbers in words, empty if there is none; `origins`: of
    our number; `redo`: the command that would make one where there is none."""

    judgement: object
    paper: str
    ours: str
    sentence: str
    origins: tuple
    redo: str
    fresh: str = ""

    @property
    def id(self):
        return self.judgement.claim["id"]

    @property
    def about(self):
        return self.judgement.claim

    @property
    def verdict(self):
        return self.judgement.verdict

    @property
    def band(self):
        return verdicts.band_in_words(self.about)

    @property
    def says(self):
        """Returns what the paper says; a sentence begins with a capital, a formula as it is."""
        text = self.about["says"]
        return text if "=" in text else f"{text[0].upper()}{text[1:]}"

    @property
    def note(self):
        """Returns the further remarks as sentences."""
        return self.judgement.note

    @property
    def figure(self):
        return self.about["figures"][0]

    @property
    def is_result(self):
        return self.about["kind"] == verdicts.RESULT


def sentence_of(judgement):
    """Returns why the verdict is what it is, as a sentence."""
    claim, found, band = judgement.claim, judgement.measured, verdicts.band_in_words(judgement.claim)
    ours = number(found.value, claim["unit"]) if found else ""
    if judgement.verdict == "reproduced":
        also = "" if verdicts.within(found.value, claim["value"], claim["band"]) else ", by the paper's other wording"
        return f"{ours} lies in the band ({band}){also}."
    if judgement.verdict == "refuted":
        return f"{ours} lies outside of the band ({band})." if ours else \
            f"Our run never comes to what is claimed (the band: {band})."
    if judgement.verdict == "not comparable":
        if not ours:
            return ""  # the note says why
        if claim["kind"] == verdicts.RESULT:
            return f"The paper's number is of another machine or program; ours is {ours}."
        return f"Ours is {ours}" + ("; the paper prints no unit." if claim["unit"] == "not printed" else ".")
    if judgement.verdict == "not yet run":
        return MEANING["not yet run"] if not judgement.note else ""
    return f"We set {ours}."


def redo_of(claim, book):
    """Returns the command that makes the run of a claim."""
    wanted = claim.get("run", {})
    names = [name for name in claim["figures"] if name in book] or [claim["scene"]]
    backend = wanted.get("backend", "cuda")
    try:
        recipe = choose(names[:1], book, backend)[0]
    except RecipeError:  # a figure of the processor alone
        recipe, backend = book[names[0]], "cpu"
    return command(recipe, wanted.get("scale", "paper"), backend)


def command(recipe, scale, backend):
    """Returns the command that makes a figure."""
    if "illustration" in recipe.body:
        return f"experiments/reproduce {recipe.name}"
    return f"experiments/reproduce {recipe.name} --scale {scale}" + (" --backend cuda" if backend == "cuda" else "")


def all_claims(judgements, origins, book, fresh=None):
    """Returns every claim, in the order of the judgements. `fresh`: what was just made (report.JustMade), or None."""
    found = []
    for judgement in judgements:
        claim, measured = judgement.claim, judgement.measured
        found.append(Claim(judgement, number(claim["value"], claim["unit"]),
                           number(measured.value, claim["unit"]) if measured else "", sentence_of(judgement),
                           tuple(origins.of(measured)) if measured else (), redo_of(claim, book),
                           fresh.about(claim) if fresh else ""))
    return found


def summary(claims):
    """Returns what the first page says of the claims, as counts by name; the paper's own stand alone, `studies` is of
    our studies."""
    own, studies = ([claim for claim in claims if claim.is_result and claim.about["study"] == wanted]
                    for wanted in (False, True))
    count = lambda found: {slug(name).replace("-", "_"): sum(claim.verdict == name for claim in found)  # noqa: E731
                           for name in verdicts.VERDICTS}
    return {**count(own), "results": len(own), "studies": {**count(studies), "results": len(studies)},
            "settings": sum(not claim.is_result for claim in claims),
            "late": sum(claim.judgement.late and claim.verdict == "reproduced" for claim in own)}
