"""Recomputes the verdict of every claim and holds the kept table against it; a verdict that no result supports, or a
result that leaves a claim unjudged, fails.

Usage: claims.py SOURCE_DIR. The standard library is enough.
"""

import copy
import csv
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from types import SimpleNamespace
from unittest import mock

SOURCE = Path(sys.argv.pop(1)) if len(sys.argv) > 1 and not sys.argv[1].startswith("-") else Path(__file__).parents[2]
sys.path.insert(0, str(SOURCE))
from paper_figures.workflow import ratios, verdicts  # noqa: E402
from paper_figures.workflow.evidence import RESULTS, Evidence, EvidenceError, manifest_at, value_of  # noqa: E402
from paper_figures.workflow.thinned import Hundreds  # noqa: E402


GUARANTEE = {"measure": {"guarantee": "penetration-free"}, "band": [0, 0]}


def claim(**changes):
    return {"id": "s.c", "scene": "cloth_on_sphere", "figures": [], "study": False, "band_set": "2000-01-01",
            "value": 1, "unit": "1",
            "place": "p", "says": "w", "why": "y",
            "kind": verdicts.RESULT, "run": {"scale": "paper", "backend": "cuda"},
            "measure": {"steps": "wall", "statistic": "mean"}, "band": [0, 1], **changes}


class Accepted(unittest.TestCase):
    def test_kept_verdicts_are_those_of_the_accepted_results(self):
        self.assertEqual(verdicts.KEPT.read_text(), verdicts.as_table(verdicts.judge_all()),
                         "run: python3 -m paper_figures.workflow.verdicts --write, and look at what changed")

    def test_no_scene_with_accepted_results_has_an_unjudged_claim(self):
        silent, stale = verdicts.unjudged(verdicts.judge_all())
        self.assertEqual(silent, [], "judge these claims, or write waits_for into them: what is missing")
        self.assertEqual(stale, [], "these are judged now: remove waits_for")

    def test_every_claim_has_a_place_a_reason_and_a_verdict_of_its_kind(self):
        for judgement in verdicts.judge_all():
            allowed = verdicts.VERDICTS if judgement.claim["kind"] == verdicts.RESULT else verdicts.AS_SET
            self.assertIn(judgement.verdict, allowed, judgement.claim["id"])
            self.assertTrue(judgement.claim["place"] and judgement.claim["why"], judgement.claim["id"])


class Kinds(unittest.TestCase):
    """What is a result, and what whoever set the run up decided."""

    def test_no_claim_lacks_a_kind(self):
        self.assertEqual([each["id"] for each in verdicts.load() if each["kind"] not in verdicts.KINDS], [])

    def test_what_does_not_change_when_everything_that_the_program_computed_does_is_no_result(self):
        """Every number of the rows and the audit's answer are changed, settings, materials and scene are not."""
        tried = {kind: 0 for kind in verdicts.KINDS}
        evidence = Evidence()
        for each in verdicts.load():
            specs = each.get("measure", [])
            for spec in specs if isinstance(specs, list) else [specs]:
                wanted = {"scene": each["scene"], **each.get("run", {}), **spec.get("run", {})}
                runs = [] if {"table", "ratio"} & set(spec) else evidence.runs_as(wanted)
                if runs:
                    same = value_of(runs[-1], spec) == value_of(self.changed(runs[-1]), spec)
                    self.assertEqual(same, each["kind"] != verdicts.RESULT, each["id"])
                    tried[each["kind"]] += 1
        self.assertGreater(min(tried.values()), 10, tried)

    @staticmethod
    def changed(run):
        other = copy.copy(run)
        other.manifest, other.afterwards = {**run.manifest, "guarantee_kept": run.guarantee_kept is not True}, {}
        if run.thinned:
            whole = run.manifest["whole_run"]
            changed = {kind: {name: 3 * value + 1 for name, value in whole[kind].items()}
                       for kind in ("mean", "largest")}
            texts = {name: cells if name in ("of", "rows") else [str(3 * float(cell or "nan") + 1) for cell in cells]
                     for name, cells in run.columns.texts.items()}
            other.thinned = Hundreds(texts, {**whole, **changed})
        else:
            other.columns = {name: [3 * value + 1 for value in run.column(name)] for name in run.columns}
        return other

    def test_the_headline_counts_results_alone(self):
        setting = {"kind": verdicts.SETTING, "measure": {"setting": "iterations"}, "band": [40, 40]}
        count = {"kind": verdicts.MESH_COUNT, "measure": {"scene": "vertices"}, "band": [1, 2]}
        judged = [verdicts.judge(claim(**changes), Evidence())
                  for changes in ({"band": [0, 100]}, {"band": [50, 100]}, setting, count)]
        self.assertEqual([j.verdict for j in judged], ["reproduced", "refuted", "as printed", "not as printed"])
        words = verdicts.headline(judged)
        self.assertRegex(words, "^Of the paper's own 2 claims about results 1 are reproduced.* 1 refuted")
        self.assertRegex(words, "2 settings and counts of meshes.*1 as printed, 1 not as printed")
        kinds = [line.split(",")[1] for line in verdicts.as_table(judged[::-1]).splitlines()[1:]]
        self.assertEqual(kinds[:2], [verdicts.RESULT] * 2, "what was set stands below the results")


class Bands(unittest.TestCase):
    """A band that was chosen when its run was known says so, whatever run judges it now."""

    def test_a_band_younger_than_any_run_that_answers_its_claim_is_marked(self):
        old = Evidence().runs_as({"scene": "cloth_on_sphere", **claim()["run"]})[0]  # the newest is the last
        for band_set, late in ((old.manifest["ended"], False), (old.manifest["ended"].replace("Z", "Z+"), True)):
            judged = verdicts.judge(claim(band_set=band_set), Evidence())
            self.assertGreater(judged.measured.ended, band_set, "a newer run judges")
            self.assertEqual((judged.late, "when this was known" in judged.note), (late, late))

    def test_the_mark_stands_in_the_table_and_in_the_headline(self):
        judged = verdicts.judge(claim(band_set="2999-01-01", band=[0, 100]), Evidence())
        self.assertIn("(1 by a band set after a run)", verdicts.headline([judged]))
        self.assertIn(",0 to 100,yes,", verdicts.as_table([judged]))

    def test_a_known_run_that_is_gone_is_named_by_the_claim(self):
        self.assertTrue(verdicts.judge(claim(band_after="3.99 s of a run that was replaced"), Evidence()).late)

    def test_no_band_is_younger_than_it_says_nor_than_a_number_that_no_mark_tells_of(self):
        """By the history of the claims and of the kept verdicts; skipped where there is none."""
        commits = history("paper_figures/claims", "paper_figures/results/verdicts.csv")
        # or no run judges it now
        marked = {j.claim["id"] for j in verdicts.judge_all() if j.late or "band_after" in j.claim}
        told = set().union(*(told for *_, told in commits))
        for each in verdicts.load():
            states = [(date, bands.get(each["id"])) for date, bands, *_ in commits if each["id"] in bands]
            if not states or each.get("band") in (None, "stored"):
                continue
            if (each["id"], each["band_set"][:10]) in told:
                self.assertIn(each["id"], marked, "its mark went with the result that it told of: use band_after")
            changes = [date for (date, band), (_, before) in zip(states[1:], states) if band != before]
            if states[-1][1] == band_of(each):
                last = changes[-1] if changes else states[0][0]
                self.assertGreaterEqual(each["band_set"], last, f"{each['id']}: changed later than band_set says")
            known = next((date for date, _, judged, _ in commits if each["id"] in judged), "9999")
            if states[-1][1] != band_of(each) or changes and known < changes[-1]:
                self.assertTrue(known == "9999" or each["id"] in marked,
                                f"{each['id']}: a number of {known} was known; say so in band_after")


def band_of(each):
    return json.dumps([each["value"], each.get("band"), [other.get("band") for other in each.get("also", [])]])


def git(*words, **options):
    utc = {**os.environ, "TZ": "UTC"}
    return subprocess.run(["git", "-C", SOURCE, *words], capture_output=True, check=True, env=utc, **options).stdout


def versions(names):
    """The text of each COMMIT:PATH of `names`, empty where there is none."""
    answer, texts = git("cat-file", "--batch", input="\n".join(names).encode()), []
    for _ in names:
        head, _, answer = answer.partition(b"\n")
        size = 0 if head.endswith(b" missing") else int(head.rsplit(b" ", 1)[1])
        texts.append(answer[:size].decode())
        answer = answer[size + 1:] if size else answer
    return texts


KNOWN = re.compile(r"The band was set on (\S+), when this was known")


def history(claims, kept):
    """[(date, {claim: its band}, claims with a number, {(claim, day of its band)} of those marked as known)] of every
    commit that changed either, the oldest first; skips the test where the checkout has no whole history."""
    try:
        if git("rev-parse", "--is-shallow-repository").strip() != b"false":
            raise unittest.SkipTest("a checkout without its history")
        words = ("--reverse", "--date=format-local:%Y-%m-%dT%H:%M:%SZ", "--format=%H %ad", "--", claims, kept)
        commits = [line.split() for line in git("log", *words).decode().splitlines()]
    except (OSError, subprocess.CalledProcessError) as error:
        raise unittest.SkipTest("no git repository") from error
    files = [*(f"{claims}/{path.name}" for path in sorted((SOURCE / claims).glob("*.json"))), kept]
    texts = iter(versions([f"{commit}:{name}" for commit, _ in commits for name in files]))
    result = []
    for _, date in commits:
        *documents, rows = [next(texts) for _ in files]
        decided = {*verdicts.VERDICTS[:2], *verdicts.AS_SET[:2]}
        judged = {row[0] for row in (line.split(",") for line in rows.splitlines()) if decided & set(row[1:3])}
        claims_then = [each for text in documents if text for each in json.loads(text)["claims"]]
        bands = {each["id"]: band_of(each) for each in claims_then if "id" in each}
        told = {(line.split(",")[0], day[1]) for line in rows.splitlines() if (day := KNOWN.search(line))}
        result.append((date, bands, judged, told))
    return result


def audited(stem):
    """The manifest of an accepted run, as if each of its states had been audited beside it."""
    return {**manifest_at(RESULTS / f"{stem}_run.json"), "audit": "every", "audited_states": 100,
            "guarantee_kept": True}


class Judging(unittest.TestCase):
    def verdict(self, **changes):
        return verdicts.judge(claim(**changes), Evidence()).verdict

    def test_the_band_decides(self):
        ours = verdicts.judge(claim(), Evidence()).measured.value
        self.assertEqual(self.verdict(band=[ours, ours]), "reproduced")
        self.assertEqual(self.verdict(band=[None, ours * (1 - 1e-12)]), "refuted")
        self.assertEqual(self.verdict(band=[ours * (1 + 1e-12), None]), "refuted")

    def test_another_machine_has_no_band_and_a_missing_run_no_verdict(self):
        self.assertEqual(verdicts.judge({k: v for k, v in claim(instead="s.c").items() if k != "band"},
                                        Evidence()).verdict, "not comparable")
        self.assertEqual(self.verdict(run={"scale": "paper", "steps": 100000}), "not yet run")
        self.assertEqual(self.verdict(run={"scale": "paper", "solver": "ipc", "backend": "cuda"}), "not yet run")

    def test_the_second_of_two_printed_values_counts(self):
        ours = verdicts.judge(claim(), Evidence()).measured.value
        self.assertEqual(self.verdict(band=[0, 0], also=[{"value": ours, "place": "elsewhere", "band": [ours, ours]}]),
                         "reproduced")

    def test_a_setting_is_the_printed_one_to_single_precision(self):
        self.assertTrue(verdicts.within(0.009999999776482582, 0.01, "stored"))
        self.assertFalse(verdicts.within(0.01000001, 0.01, "stored"))

    def test_unknown_columns_and_mixed_commits_are_refused_in_words(self):
        with self.assertRaisesRegex(EvidenceError, "has no column 'wallet'; it has: step, wall"):
            self.verdict(measure={"steps": "wallet", "statistic": "mean"})
        with tempfile.TemporaryDirectory() as name:
            (Path(name) / "fig99_paper.csv").write_text("kind,time,commit,device\na,1,c1,d\nb,2,c2,d\n")
            with self.assertRaisesRegex(EvidenceError, "mixes commits c1, c2"):
                verdicts.judge(claim(measure={"table": "fig99", "column": "time", "over": {"kind": "a"},
                                              "under": {"kind": "b"}}), Evidence(name))

    def test_choices_that_are_varied_and_those_that_are_not_are_named_where_the_printed_parameters_refute(self):
        with tempfile.TemporaryDirectory() as name:
            rows = "a,4,c1,d\nb,1,c1,d\nc,7,c1,d\nn,never,c1,d\n"
            (Path(name) / "fig99_paper.csv").write_text(f"kind,time,commit,device\n{rows}")
            choices = [{"says": f"κ = {kind}", "where": {"kind": kind}} for kind in "bc"]
            measure = {"table": "fig99", "column": "time", "where": {"kind": "a"}}

            def judged(band, measure=measure, more=()):
                about = claim(measure=measure, band=band, choices=[*choices, *more])
                found = verdicts.judge(about, Evidence(name))
                return found.verdict, found.note
            self.assertEqual(judged([0, 2]), ("refuted", "This other choice brings it into the band: κ = b (1). "
                                              "This one does not: κ = c (7)."))
            self.assertEqual(judged([8, 9]), ("refuted", "These other choices do not bring it into the band: "
                                              "κ = b (1); κ = c (7)."))
            no_number = [{"says": "κ = n", "where": {"kind": "n"}}]
            self.assertEqual(judged([8, 9], more=no_number), judged([8, 9]), "it was varied")
            for missing in ({"where": {"kind": "x"}}, {"column": "older than it"}):
                more = [{"says": "κ = z", **missing}]
                self.assertEqual(judged([8, 9], more=more),
                                 ("not yet run", "Our number, 4, lies outside of the band (fig99_paper.csv). "
                                  f"{judged([8, 9])[1]} No run made this choice: κ = z. {verdicts.UNMADE}"))
                self.assertEqual(judged([3, 5], more=more), ("reproduced", ""))
            self.assertEqual(judged([3, 5]), ("reproduced", ""))
            self.assertEqual(judged([8, 9], [measure]), judged([8, 9]),
                             "the first of several places is the printed one")
            waiting = verdicts.judge(claim(measure=measure, band=[8, 9], choices=choices, not_varied="ε"),
                                     Evidence(name))
            self.assertEqual((waiting.verdict, waiting.note),
                             ("not yet run", "Our number, 4, lies outside of the band (fig99_paper.csv). "
                                             f"{judged([8, 9])[1]} It is not called refuted before this is varied: ε."))

    def test_a_choice_may_have_a_measure_and_a_scale_of_its_own_and_a_membrane_is_one_of_all_places(self):
        with tempfile.TemporaryDirectory() as name:
            head = "kind,time,membrane,commit,device\n"
            (Path(name) / "fig98_small.csv").write_text(f"{head}a,2,x,c1,d\n")
            (Path(name) / "fig99_paper.csv").write_text(f"{head}a,4,x,c1,d\nb,6,y,c1,d\n")
            places = [{"table": "fig98", "column": "time", "where": {"kind": "a"}},
                      {"table": "fig99", "column": "time", "where": {"kind": "a"}}]
            small = {"table": "fig98", "scale": "small", "column": "time", "where": {"kind": "a"}}
            other = {"says": "y", "membrane": "y", "measure": [*places, {**places[1], "where": {"kind": "b"}}]}

            def note(choice):
                return verdicts.judge(claim(measure=places, band=[5, 9], choices=[choice]), Evidence(name)).note
            self.assertIn("bring it into the band: small (2).", note({"says": "small", "measure": small}))
            self.assertIn("This other choice brings it into the band: y (6).", note(other))
            self.assertIn("No run made this choice: y.", note({"says": "y", "membrane": "y"}))
            self.assertIn("No run made this choice: b.", note({"says": "b", "where": {"kind": "b"}}),
                          "what is no membrane is a choice of the first place alone")

    def test_a_run_is_told_from_others_by_its_activation(self):
        runs = Evidence().runs_as({"scene": "activation_drop", "scale": "small"})
        for name in ("ogc", "ipc_log"):
            found = [run for run in runs if run.matches({"contact_activation": name})]
            self.assertTrue(found)
            self.assertEqual({run.manifest["settings"]["contact_activation"]["value"] for run in found}, {name})

    def test_a_row_about_a_run_that_was_left_out_is_no_evidence(self):
        with tempfile.TemporaryDirectory() as name:
            (Path(name) / "fig99_paper.csv").write_text("kind,time,status,commit,device\na,1,finished,c1,d\nb,,not "
                                                        "run,-,\n")
            found = [verdicts.judge(claim(measure={"table": "fig99", "column": "time", "where": {"kind": kind}}),
                                    Evidence(name)).verdict for kind in "ab"]
        self.assertEqual(found, ["reproduced", "not yet run"])

    def test_the_newer_of_two_machines_tables_counts(self):
        with tempfile.TemporaryDirectory() as name:
            for machine, time, ended in (("a", 1, "2026-02-01"), ("b", 2, "2026-01-01"), ("c", 3, "")):
                (Path(name) / machine).mkdir()
                (Path(name) / machine / "fig99_paper.csv").write_text(f"kind,time,commit,device\na,{time},c1,d\n")
                if ended:
                    (Path(name) / machine / "provenance.csv").write_text(f"file,ended\nfig99_paper.csv,{ended}\n")
            found = verdicts.judge(claim(measure={"table": "fig99", "column": "time", "where": {"kind": "a"}}),
                                   Evidence(name))
        self.assertEqual((found.measured.value, found.measured.source), (1, "a/fig99_paper.csv"))

    def test_a_ratio_of_counts_is_of_any_machines_and_one_of_times_of_one(self):
        with tempfile.TemporaryDirectory() as name:
            (Path(name) / "a").mkdir()
            (Path(name) / "a/fig99_paper.csv").write_text(
                "kind,sweeps [1],step [ms],commit,device\na,6,6,c1,10 threads\nb,3,3,c1,2 threads\n")
            for column, expected in (("sweeps [1]", 2), ("step [ms]", None)):
                spec = {"table": "fig99", "column": column, "over": {"kind": "a"}, "under": {"kind": "b"}}
                measured = verdicts.judge(claim(measure=spec), Evidence(name)).measured
                self.assertEqual(measured and measured.value, expected)

    def test_a_wait_that_is_not_declared_and_one_that_is_over_are_found(self):
        judged, waiting = claim(), claim(id="s.d", run={"scale": "paper", "steps": 100000})
        found = [verdicts.judge(each, Evidence()) for each in (judged, waiting, {**judged, "waits_for": "x"})]
        self.assertEqual(verdicts.unjudged(found), (["s.d"], ["s.c"]))

    def test_a_claim_with_a_choice_that_is_not_varied_is_not_refuted_and_names_the_number_that_lies_outside(self):
        ours = verdicts.judge(claim(), Evidence()).measured
        found = verdicts.judge(claim(band=[ours.value + 1, None], not_varied="membrane"), Evidence())
        self.assertEqual((found.verdict, found.measured, found.note), ("not yet run", None,
                         f"Our number, {ours.value:.3g}, lies outside of the band ({ours.source}). "
                         "It is not called refuted before this is varied: membrane."))
        within = verdicts.judge(claim(band=[ours.value, None], not_varied="membrane"), Evidence())
        self.assertEqual(within.verdict, "reproduced")
        self.assertEqual(verdicts.unjudged([found, within]), ([], ["s.c"]))


class OtherPrograms(unittest.TestCase):
    """One rule for ratios with other programs: both sides on one machine, each of a program whose version is named."""

    AGAINST = {"measure": {"table": "fig99", "column": "mean [ms]", "over": {"solver": "ipc"},
                           "under": {"solver": "vbd"}}, "band": [4, None], "value": 5, "against": "C-IPC"}

    def judged(self, theirs, ours="ogc,c1,vbd,2,GPU,c1", **changes):
        head = "program,version,solver,mean [ms],device,commit"
        with tempfile.TemporaryDirectory() as name:
            (Path(name) / "fig99_paper.csv").write_text("\n".join([head, theirs, ours]) + "\n")
            return verdicts.judge(claim(**{**self.AGAINST, **changes}), Evidence(name))

    def test_both_sides_on_one_machine_with_named_versions_are_comparable(self):
        for theirs, verdict in (("C-IPC,1.2,ipc,10,GPU,-", "reproduced"), ("C-IPC,1.2,ipc,6,GPU,-", "refuted"),
                                ("C-IPC,1.2,ipc,10,\"GPU, CUDA 13.0\",-", "reproduced")):
            self.assertEqual(self.judged(theirs).verdict, verdict, theirs)

    def test_anything_else_is_not_whatever_the_ratio_and_ours_stands_beside_it(self):
        for theirs, words in (("ogc,c1,ipc,10,GPU,c1", "No run of C-IPC .* own ratio, .* is 5, where the paper prints"),
                              ("ogc,c1,ipc,1,GPU,c1", "No run of C-IPC .* is 0.5, where the paper prints 5"),
                              ("C-IPC,,ipc,10,GPU,-", "version of C-IPC is not named"),
                              ("C-IPC,unknown,ipc,10,GPU,-", "version of C-IPC is not named"),
                              ("C-IPC,1.2,ipc,10,GPU 2,-", "No run of C-IPC")):
            found = self.judged(theirs)
            self.assertEqual(found.verdict, "not comparable", theirs)
            self.assertRegex(found.note, words)

    def test_machines_are_told_apart_without_their_drivers(self):
        ours, alike, other = (ratios.Side("ogc", "c1", device) for device in ("GPU, CUDA 13.0", "GPU", "GPU 2"))
        theirs = lambda side: ratios.Side("newton", "1.8.0", side.device)  # noqa: E731
        self.assertEqual(ratios.obstacle((ours, theirs(alike)), "newton"), "")
        self.assertRegex(ratios.obstacle((ours, theirs(other)), "newton"), "different machines: ogc on GPU, newton on")
        self.assertRegex(ratios.obstacle((theirs(alike),), "newton"), "Only newton ran")

    def test_without_a_run_or_a_measure_the_rule_is_the_same(self):
        for changes in ({"measure": {**self.AGAINST["measure"], "table": "fig98"}}, {"measure": None, "band": None}):
            changed = {key: value for key, value in changes.items() if value is not None}
            about = {key: value for key, value in claim(**{**self.AGAINST, **changed}).items() if key not in changes
                     or key in changed}
            with tempfile.TemporaryDirectory() as name:
                found = verdicts.judge(about, Evidence(name))
            self.assertEqual((found.verdict, found.measured), ("not comparable", None))
            self.assertRegex(found.note, "^No run of C-IPC")

    def test_every_claim_that_names_another_program_is_under_the_rule(self):
        """A claim of the paper about a time of C-IPC, GIPC or IPC's release, or a ratio with one."""
        other = {each["id"] for each in verdicts.load()
                 if re.search("IPC's time|, C-IPC|step of G?IPC", each["quantity"])}
        self.assertGreaterEqual(len(other), 8)
        self.assertEqual(other, {each["id"] for each in verdicts.load() if "against" in each})

    def test_a_claim_is_not_said_to_be_comparable_by_one_against_another_program(self):
        first, second = claim(against="IPC"), claim(id="s.d", instead="s.c")
        document = {"scene": "s", "figures": [], "bands_set": "2000",
                    "claims": [{k: v for k, v in each.items() if k not in ("kind", "study")}
                               for each in (first, {k: v for k, v in second.items() if k != "band"})]}
        with tempfile.TemporaryDirectory() as name:
            (Path(name) / "s.json").write_text(json.dumps(document))
            with self.assertRaisesRegex(EvidenceError, "against another program: s.c"):
                verdicts.load(name)

    def test_ratios_with_newton_physics_on_the_gpu_are_comparable_and_others_are_not_called_so(self):
        found = {}
        for path in (RESULTS / "h200/peers_newton_gpu.csv", RESULTS / "two_cores/peers_trajectories.csv"):
            with path.open(newline="") as file:
                rows = list(csv.DictReader(file))
            for row in rows:
                ours = [other for other in rows if other["program"] == "ogc"
                        and (other["scene"], other["scale"]) == (row["scene"], row["scale"])]
                if row["program"] != "ogc":
                    pairs = {ratios.obstacle((ratios.side_of(each), ratios.side_of(row)), "newton") for each in ours}
                    found.setdefault(path.stem, set()).update(pairs)
        self.assertEqual(found["peers_newton_gpu"], {""})
        self.assertEqual(found["peers_trajectories"], {"The sides ran on different machines: ogc on 2 threads, newton "
                                                       "on CPU."})


class Notes(unittest.TestCase):
    """A person reads them: sentences of a length that can be read aloud, lists apart, and no name of a setting."""

    def test_each_note_is_made_of_sentences(self):
        verbs = r"\b(is|are|was|were|has|had|ran|runs|waits|lies|takes|brings?|does?|do|made|prints?|quotes|say|says)\b"
        for judgement in verdicts.judge_all():
            for part in re.split(r"(?<!Fig\.)(?<!St\.)(?<=\.) (?=[A-Z0-9])", judgement.note) if judgement.note else ():
                self.assertRegex(part, r"^[A-Z0-9].*\.$", judgement.claim["id"])
                self.assertRegex(part, verbs, judgement.claim["id"])
                self.assertLessEqual(len(part.partition(":")[0].split()), 45, part)
            self.assertNotRegex(judgement.note, r"[a-z]_[a-z]+[^.\w]*(;|\.$)|\bnan\b", judgement.claim["id"])

    def test_a_waiting_claim_about_the_processor_says_what_windows_take(self):
        notes = {j.claim["id"]: j.note for j in verdicts.judge_all()}
        with (RESULTS / "h200/cpu_windows_paper.csv").open(newline="") as file:
            rows = [row for row in csv.DictReader(file) if row["row"] == "knot"]
        worst = max(float(row["worst step [ms]"]) for row in rows)
        self.assertRegex(notes["knot.cpu_average"],
                         f"^It waits for a whole run on 16 CPU threads. In windows of {rows[0]['steps']} steps from "
                         f"{len(rows)} .* and {worst:.3g} ms at most")


class Runs(unittest.TestCase):
    """A copy of one accepted run, changed."""

    def judged(self, change, **changes):
        with tempfile.TemporaryDirectory() as name:
            shutil.copy(RESULTS / "h200/cloth_on_sphere_steps.csv", Path(name) / "steps.csv")
            manifest = audited("h200/cloth_on_sphere")
            change(manifest)
            (Path(name) / "run.json").write_text(json.dumps(manifest))
            return verdicts.judge(claim(**{"band": [0, 100], **changes}), Evidence(name)).verdict

    def test_unfinished_and_changed_programs_are_no_evidence(self):
        self.assertEqual(self.judged(lambda m: None), "reproduced")
        self.assertEqual(self.judged(lambda m: m.update(status="running")), "not yet run")
        self.assertEqual(self.judged(lambda m: m.update(dirty=True)), "not yet run")

    def test_a_start_that_was_moved_is_no_evidence_of_the_scene(self):
        self.assertEqual(self.judged(lambda m: m.update(jitter="1e-06", jitter_seed="7")), "not yet run")

    def test_bounds_that_a_claim_does_not_name_are_the_papers(self):
        planes = lambda m: m["settings"].update(bounds={"value": "planes", "unit": "1"})  # noqa: E731
        self.assertEqual(self.judged(planes), "not yet run")
        self.assertEqual(self.judged(planes, run={"scale": "paper", "bounds": "planes"}), "reproduced")
        self.assertEqual(self.judged(lambda m: None, run={"scale": "paper", "bounds": "planes"}), "not yet run")

    def test_bodies_that_may_be_entered_answer_claims_that_name_them_alone(self):
        volume = lambda m: m["scene"]["bodies"][-1].update(body_contact="volume")  # noqa: E731
        said = lambda m: [body.update(body_contact="surface") for body in m["scene"]["bodies"]]  # noqa: E731
        self.assertEqual(self.judged(volume), "not yet run")
        self.assertEqual(self.judged(said), "reproduced")
        wanted = {"run": {"scale": "paper", "body_contact": "volume"}}
        self.assertEqual(self.judged(volume, **wanted), "reproduced")
        for bounded in (said, lambda m: None):
            self.assertEqual(self.judged(bounded, **wanted), "not yet run")

    def test_a_failed_audit_refutes_the_guarantee_and_nothing_else(self):
        failed = lambda m: m.update(status="failed: intersection", guarantee_kept=False)  # noqa: E731
        guarantee = {**GUARANTEE, "run": {"scale": "paper", "steps": 1000}}
        self.assertEqual(self.judged(failed), "not yet run")
        self.assertEqual(self.judged(failed, **guarantee), "refuted")
        self.assertEqual(self.judged(lambda m: None, **{**guarantee, "run": {"scale": "paper", "steps": 100}}),
                         "reproduced")

    def test_a_verdict_about_penetrations_says_how_many_states_were_audited(self):
        for j in verdicts.judge_all():
            if j.measured and "guarantee" in j.claim["measure"]:
                self.assertRegex(j.note, r"^[1-9][\d,]* states of [\d,]+ steps were audited\.", j.claim["id"])

    def test_an_audit_afterwards_counts_as_one_beside_the_run(self):
        said = "61 states of 100 steps were audited. The membrane is stable Neo-Hookean."
        wanted = {"run": {"scale": "paper", "steps": 100, "audited": True}}
        for found, verdict, note in ((None, "not yet run", ""), ({"states": 61, "clean": True}, "reproduced", said),
                                     ({"states": 61, "clean": False}, "refuted", said),
                                     ({"states": 0, "clean": True}, "not yet run", "")):
            with tempfile.TemporaryDirectory() as name:
                shutil.copy(RESULTS / "two_cores/sphere_cpu_steps.csv", Path(name) / "steps.csv")
                manifest = manifest_at(RESULTS / "two_cores/sphere_cpu_run.json")
                self.assertEqual(int(manifest["audited_states"]), 0)
                (Path(name) / "run.json").write_text(json.dumps(manifest))
                if found:
                    (Path(name) / "audit.json").write_text(json.dumps(found))
                judged = verdicts.judge(claim(**GUARANTEE, **wanted), Evidence(name))
            self.assertEqual((judged.verdict, judged.note), (verdict, note))


class Counts(unittest.TestCase):
    """Of a scene: simulated bodies, and those that are fixed or wholly prescribed."""

    def counted(self, what, *bodies):
        entries = [{"name": "b", "fixed": fixed, "vertex_count": n, "triangle_count": 2 * n,
                    **({} if prescribed is None else {"prescribed_vertices": prescribed})}
                   for n, fixed, prescribed in bodies]
        run = SimpleNamespace(manifest={"scene": {"name": "s", "bodies": entries}})
        return value_of(run, {"scene": what})

    def test_a_body_whose_vertices_all_follow_a_motion_counts_as_fixed(self):
        bodies = ((100, False, 0), (20, False, 3), (4, True, 0), (7, False, 7))
        self.assertEqual([self.counted(what, *bodies)
                          for what in ("vertices", "moving_bodies", "fixed_vertices", "fixed_triangles")],
                         [120, 2, 11, 22])

    def test_a_manifest_from_before_that_was_said_has_no_such_body(self):
        self.assertEqual([self.counted(what, (100, False, None), (4, True, None))
                          for what in ("vertices", "fixed_vertices")], [100, 4])


class OneSceneOfTwoFigures(unittest.TestCase):
    """Table 1's sphere and Fig. 18's are one scene; of Fig. 18's runs the last state alone is audited. They, the newer
    ones here, judge no claim of the table about the device, and which membrane was run is said."""

    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = Path(holder.name)

    def make(self, name, membrane, times, begin=1, **changes):
        """A copy of an accepted run with another membrane, steps that take `times` as long, and another first step."""
        manifest = audited("h200/cloth_on_sphere")
        for body in manifest["scene"]["bodies"]:
            body["material"]["membrane"] = membrane
        (self.folder / name).mkdir()
        (self.folder / name / "run.json").write_text(json.dumps({**manifest, "ended": name, **changes}))
        text = (RESULTS / "h200/cloth_on_sphere_steps.csv").read_text()
        head, *rows = [line.split(",") for line in text.splitlines()]
        step, wall = (next(i for i, title in enumerate(head) if title.partition(" ")[0] == name)
                      for name in ("step", "wall"))
        for row in rows:
            row[step], row[wall] = str(int(row[step]) - 1 + begin), repr(float(row[wall]) * times)
        (self.folder / name / "steps.csv").write_text("\n".join(map(",".join, [head, *rows])) + "\n")

    def sources(self, place=""):
        """The run that each claim about the scene whose place begins so is judged by."""
        evidence = Evidence(self.folder)
        found = (verdicts.judge(each, evidence) for each in verdicts.load() if each["scene"] == "cloth_on_sphere"
                 and each["place"].startswith(place))
        return {j.claim["id"].partition(".")[2]: j.measured and j.measured.source for j in found}

    def test_the_table_is_judged_by_its_own_runs_alone(self):
        times = ("cuda_average", "cuda_maximum", "cuda_steady")
        self.make("2_fig18", "stable_neo_hookean", 3, audited_states="1")
        self.assertEqual({self.sources("Table 1")[name] for name in times}, {None})
        self.make("1_table", "st_venant_kirchhoff", 1)
        sources = self.sources("Table 1")
        self.assertEqual({sources[name] for name in times}, {"1_table/run.json"})
        self.assertEqual({name for name, source in sources.items() if not source},
                         {"cpu_average", "cpu_maximum", "cpu_steady"})
        self.assertEqual(self.sources("§5, first")["penetration_free"], "1_table/run.json")

    def test_one_run_can_show_that_a_step_is_steady_and_not_that_it_is_not(self):
        about = next(each for each in verdicts.load() if each["id"] == "cloth_on_sphere.cuda_steady")
        self.make("run", "stable_neo_hookean", 1)
        found = [verdicts.judge({**about, "band": [1, most]}, Evidence(self.folder)) for most in (100, 1.001)]
        self.assertEqual([each.verdict for each in found], ["reproduced", "not yet run"])
        self.assertIn(verdicts.REPEATS, found[1].note)
        self.assertEqual(verdicts.unjudged(found), ([], []))
        (Path(self.folder) / "steady_paper.csv").write_text(
            "row,choice,largest median over mean [1],commit,device\ncloth_on_sphere,,1.5,c1,d\n")
        found = [verdicts.judge({**about, "band": [1, most]}, Evidence(self.folder)) for most in (2, 1.001)]
        self.assertEqual([each.verdict for each in found], ["reproduced", "refuted"])

    def test_the_membrane_is_said_and_the_other_one_is_a_choice(self):
        about = next(each for each in verdicts.load() if each["id"] == "cloth_on_sphere.cuda_steady")
        narrow = {**about, "measure": about["measure"][1], "band": [1, 1.001]}
        self.make("1_old", "st_venant_kirchhoff", 1)
        note = verdicts.judge(narrow, Evidence(self.folder)).note
        self.assertRegex(note, "The membrane is St. Venant–Kirchhoff. .*made this choice: stable Neo-Hookean. "
                               f"{verdicts.UNMADE}$")
        self.make("2_new", "stable_neo_hookean", 2)
        judged = verdicts.judge(narrow, Evidence(self.folder))
        self.assertEqual(judged.measured.source, "2_new/run.json")
        self.assertRegex(judged.note, r"^The membrane is stable Neo-Hookean. .*not .*St. Venant–Kirchhoff \([\d.]+\).$")
        self.assertNotIn("No run made", judged.note)

    def test_a_failed_audit_counts_with_any_material(self):
        self.make("1_table", "st_venant_kirchhoff", 1)
        self.make("2_fig18", "stable_neo_hookean", 1, guarantee_kept=False, status="failed: intersection")
        self.assertEqual(self.sources("§5, first")["penetration_free"], "2_fig18/run.json")

    def test_a_window_is_no_whole_run(self):
        self.make("1_table", "st_venant_kirchhoff", 1)
        self.make("2_window", "st_venant_kirchhoff", 3, begin=101)
        self.assertEqual(self.sources("Table 1")["cuda_average"], "1_table/run.json")

    def test_steps_beyond_the_end_of_the_scene_are_no_evidence(self):
        self.make("1_longer", "st_venant_kirchhoff", 1)
        rows = self.folder / "1_longer/steps.csv"
        head, *steps = rows.read_text().splitlines()
        wall = next(i for i, title in enumerate(head.split(",")) if title.startswith("wall"))
        average = sum(float(line.split(",")[wall]) for line in steps) / len(steps)
        later = [line.split(",") for line in steps]
        for line in later:
            line[0], line[wall] = str(int(line[0]) + len(steps)), "1000"
        rows.write_text("\n".join([head, *steps, *map(",".join, later)]) + "\n")
        claim = next(each for each in verdicts.load() if each["id"] == "cloth_on_sphere.cuda_average")
        self.assertEqual(claim["run"]["steps"], len(steps))
        self.assertAlmostEqual(verdicts.judge(claim, Evidence(self.folder)).measured.value, average)

    def test_a_ratio_of_times_says_what_both_ran_on(self):
        """Of the accepted results: threads stand beside each ratio of solvers."""
        judged = [j for j in verdicts.judge_all() if j.measured]
        found = {j.claim["id"]: j.note for j in judged if j.claim["id"].startswith("cloth_on_sphere.ipc_over")}
        self.assertEqual(set(found), {"cloth_on_sphere.ipc_over_vbd", "cloth_on_sphere.ipc_over_newton"})
        for note in found.values():
            self.assertRegex(note, r"\bBoth ran on \d+ threads\.")

    def test_a_ratio_is_of_the_same_materials(self):
        cpu = {"backend": "cpu", "device": "16 threads"}
        self.make("1_ipc", "stable_neo_hookean", 6, solver="ipc", **cpu)
        self.make("2_fig18", "stable_neo_hookean", 2, **cpu)
        self.make("3_table", "st_venant_kirchhoff", 1, **cpu)
        ratio = next(each for each in verdicts.load() if each["id"] == "cloth_on_sphere.ipc_over_vbd")
        found = verdicts.judge(ratio, Evidence(self.folder)).measured
        self.assertAlmostEqual(found.value, 3)
        self.assertEqual(found.source, "1_ipc/run.json / 2_fig18/run.json")

    def test_a_ratio_is_of_the_same_sources(self):
        cpu = {"backend": "cpu", "device": "16 threads"}
        names = {"first": "a" * 40, "same": "b" * 40, "other": "c" * 40, "unknown": "d" * 40}
        known = {names["first"]: "s", names["same"]: "s", names["other"]: "t"}
        ratio = next(each for each in verdicts.load() if each["id"] == "cloth_on_sphere.ipc_over_vbd")
        self.make("1_ipc", "stable_neo_hookean", 6, solver="ipc", commit=names["first"], **cpu)
        with mock.patch("paper_figures.workflow.evidence.sources_of", known.get):
            for name in ("same", "other", "unknown"):
                self.make(f"2_{name}", "stable_neo_hookean", 2, commit=names[name], **cpu)
                found = Evidence(self.folder)._ratio(ratio["measure"][1],
                                                     {"scene": "cloth_on_sphere", **ratio["run"]})
                self.assertEqual(found is not None, name == "same", name)
                shutil.rmtree(self.folder / f"2_{name}")


class Files(unittest.TestCase):
    def test_faulty_claim_files_are_refused(self):
        no_kind = "not one of result, setting, mesh count"
        for change, words in (({"place": None}, "lacks place"), ({"measure": None}, "nothing is measured"),
                              ({"band": None}, "must name the claim that is comparable"),
                              ({"kind": verdicts.SETTING}, "follows from what is measured"),
                              ({"measure": {"taste": "sweet"}}, no_kind),
                              ({"measure": [{"setting": "iterations"}, {"steps": "wall"}]}, no_kind),
                              ({"measure": None, "band": None, "instead": "s.c"}, "`kind` where nothing is measured")):
            broken = {k: v for k, v in {**claim(kind=None), **change}.items() if v is not None}
            with tempfile.TemporaryDirectory() as name, self.assertRaisesRegex(EvidenceError, words):
                document = {"scene": "s", "figures": [], "bands_set": "2000", "claims": [broken]}
                (Path(name) / "s.json").write_text(json.dumps(document))
                verdicts.load(name)


if __name__ == "__main__":
    unittest.main()
