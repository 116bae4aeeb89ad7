"""Recomputes the verdict of every claim and holds the kept table against it; a verdict that no result supports, or a
result that leaves a claim unjudged, fails.

Usage: claims.py SOURCE_DIR. The standard library is enough.
"""

import copy
import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from types import SimpleNamespace

SOURCE = Path(sys.argv.pop(1)) if len(sys.argv) > 1 and not sys.argv[1].startswith("-") else Path(__file__).parents[2]
sys.path.insert(0, str(SOURCE))
from paper_figures.workflow import verdicts  # noqa: E402
from paper_figures.workflow.evidence import RESULTS, Evidence, EvidenceError, manifest_at, value_of  # noqa: E402
from paper_figures.workflow.thinned import Hundreds  # noqa: E402


GUARANTEE = {"measure": {"guarantee": "penetration-free"}, "band": [0, 0]}


def claim(**changes):
    return {"id": "s.c", "scene": "cloth_on_sphere", "figures": [], "band_set": "2000-01-01", "value": 1, "unit": "1",
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
        self.assertRegex(words, "^1 of 2 claims about results are reproduced.* 1 refuted")
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
        for each in verdicts.load():
            states = [(date, bands.get(each["id"])) for date, bands, _ in commits if each["id"] in bands]
            if not states or each.get("band") in (None, "stored"):
                continue
            changes = [date for (date, band), (_, before) in zip(states[1:], states) if band != before]
            if states[-1][1] == band_of(each):
                last = changes[-1] if changes else states[0][0]
                self.assertGreaterEqual(each["band_set"], last, f"{each['id']}: changed later than band_set says")
            known = next((date for date, _, judged in commits if each["id"] in judged), "9999")
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


def history(claims, kept):
    """[(date, {claim: its band}, claims with a number)] of every commit that changed either, the oldest first; skips
    the test where the checkout has no whole history."""
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
        result.append((date, bands, judged))
    return result


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
            self.assertEqual(judged([0, 2]), ("refuted",
                                              "not with the printed parameters, with κ = b: 1, not with κ = c: 7"))
            self.assertEqual(judged([8, 9]), ("refuted",
                                              "not with the printed parameters, nor with κ = b: 1; κ = c: 7"))
            no_number = [{"says": "κ = n", "where": {"kind": "n"}}]
            self.assertEqual(judged([8, 9], more=no_number), judged([8, 9]), "it was varied")
            for missing in ({"where": {"kind": "x"}}, {"column": "older than it"}):
                more = [{"says": "κ = z", **missing}]
                self.assertEqual(judged([8, 9], more=more), ("refuted", f"{judged([8, 9])[1]}; no row with κ = z"))
                self.assertEqual(judged([3, 5], more=more), ("reproduced", ""))
            self.assertEqual(judged([3, 5]), ("reproduced", ""))
            self.assertEqual(judged([8, 9], [measure]), judged([8, 9]),
                             "the first of several places is the printed one")
            waiting = verdicts.judge(claim(measure=measure, band=[8, 9], choices=choices, not_varied="ε"),
                                     Evidence(name))
            self.assertEqual((waiting.verdict, waiting.note),
                             ("not yet run", f"outside of the band: 4 (fig99_paper.csv); {judged([8, 9])[1]}; "
                                             "not varied: ε"))

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

    def test_a_wait_that_is_not_declared_and_one_that_is_over_are_found(self):
        judged, waiting = claim(), claim(id="s.d", run={"scale": "paper", "steps": 100000})
        found = [verdicts.judge(each, Evidence()) for each in (judged, waiting, {**judged, "waits_for": "x"})]
        self.assertEqual(verdicts.unjudged(found), (["s.d"], ["s.c"]))

    def test_a_claim_with_a_choice_that_is_not_varied_is_not_refuted_and_names_the_number_that_lies_outside(self):
        ours = verdicts.judge(claim(), Evidence()).measured
        found = verdicts.judge(claim(band=[ours.value + 1, None], not_varied="membrane"), Evidence())
        self.assertEqual((found.verdict, found.measured, found.note), ("not yet run", None,
                         f"outside of the band: {ours.value:.3g} ({ours.source}); not varied: membrane"))
        within = verdicts.judge(claim(band=[ours.value, None], not_varied="membrane"), Evidence())
        self.assertEqual(within.verdict, "reproduced")
        self.assertEqual(verdicts.unjudged([found, within]), ([], ["s.c"]))


class Runs(unittest.TestCase):
    """A copy of one accepted run, changed."""

    def judged(self, change, **changes):
        with tempfile.TemporaryDirectory() as name:
            shutil.copy(RESULTS / "h200/sphere_cuda_steps.csv", Path(name) / "steps.csv")
            manifest = manifest_at(RESULTS / "h200/sphere_cuda_run.json")
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
                self.assertRegex(j.note, r"^[1-9]\d* states audited, \d+ steps", j.claim["id"])

    def test_an_audit_afterwards_counts_as_one_beside_the_run(self):
        said = "61 states audited, 100 steps; membrane: st_venant_kirchhoff"
        wanted = {"run": {"scale": "paper", "steps": 100, "audited": True}}
        for found, verdict, note in ((None, "not yet run", ""), ({"states": 61, "clean": True}, "reproduced", said),
                                     ({"states": 61, "clean": False}, "refuted", said),
                                     ({"states": 0, "clean": True}, "not yet run", "")):
            with tempfile.TemporaryDirectory() as name:
                shutil.copy(RESULTS / "h200/sphere_cpu_steps.csv", Path(name) / "steps.csv")
                manifest = manifest_at(RESULTS / "h200/sphere_cpu_run.json")
                self.assertEqual(manifest["audited_states"], "0")
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
        manifest = manifest_at(RESULTS / "h200/sphere_cuda_run.json")
        for body in manifest["scene"]["bodies"]:
            body["material"]["membrane"] = membrane
        (self.folder / name).mkdir()
        (self.folder / name / "run.json").write_text(json.dumps({**manifest, "ended": name, **changes}))
        head, *rows = [line.split(",") for line in (RESULTS / "h200/sphere_cuda_steps.csv").read_text().splitlines()]
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

    def test_the_membrane_is_said_and_the_other_one_is_a_choice(self):
        about = next(each for each in verdicts.load() if each["id"] == "cloth_on_sphere.cuda_steady")
        narrow = {**about, "band": [1, 1.001]}
        self.make("1_old", "st_venant_kirchhoff", 1)
        note = verdicts.judge(narrow, Evidence(self.folder)).note
        self.assertRegex(note, "^membrane: st_venant_kirchhoff; .*no row with stable Neo-Hookean$")
        self.make("2_new", "stable_neo_hookean", 2)
        judged = verdicts.judge(narrow, Evidence(self.folder))
        self.assertEqual(judged.measured.source, "2_new/run.json")
        self.assertRegex(judged.note, r"^membrane: stable_neo_hookean; .*nor with St. Venant–Kirchhoff: [\d.]+$")
        self.assertNotIn("with stable", judged.note)

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
        self.assertEqual(len(found), 2)
        for note in found.values():
            self.assertRegex(note, r"^each on \d+ threads")

    def test_a_ratio_is_of_the_same_materials(self):
        cpu = {"backend": "cpu", "device": "8 threads"}
        self.make("1_ipc", "stable_neo_hookean", 6, solver="ipc", **cpu)
        self.make("2_fig18", "stable_neo_hookean", 2, **cpu)
        self.make("3_table", "st_venant_kirchhoff", 1, **cpu)
        ratio = next(each for each in verdicts.load() if each["id"] == "cloth_on_sphere.ipc_over_vbd")
        found = verdicts.judge(ratio, Evidence(self.folder)).measured
        self.assertAlmostEqual(found.value, 3)
        self.assertEqual(found.source, "1_ipc/run.json / 2_fig18/run.json")


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
