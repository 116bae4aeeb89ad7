"""Accepting results and checking new runs against them: what is no evidence is refused in words, a change that the
bands don't allow is found, and what is kept of a long run says what every row said.

Usage: accepted.py SOURCE_DIR. Exit status 77: skipped, PyYAML, Pillow or numpy is missing.
"""

import csv
import dataclasses
import gzip
import hashlib
import io
import json
import shutil
import sys
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(sys.argv.pop(1)).resolve()
sys.path.insert(0, str(SOURCE))
try:
    import yaml  # noqa: F401
    from PIL import Image, ImageStat
except ImportError as missing:
    print(f"SKIPPED: {missing}")
    sys.exit(77)
from paper_figures.workflow import accept, captions, check, contents, kept, recipes, step_costs  # noqa: E402
from paper_figures.workflow.evidence import (RESULTS, Evidence, EvidenceError, RunEvidence, manifest_at,  # noqa: E402
                                             run_at)

SPHERE = "h200/cloth_on_sphere"


def picture(colour=0):
    """A small PNG of another content for each colour."""
    out = io.BytesIO()
    Image.new("RGB", (2, 2), (colour, 0, 0)).save(out, "PNG")
    return out.getvalue()


def run_evidence(stem):
    return RunEvidence(RESULTS / f"{stem}_run.json", RESULTS / f"{stem}_steps.csv", stem)


class Scratch(unittest.TestCase):
    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory()
        self.runs = Path(self.scratch.name) / "runs"
        self.results = Path(self.scratch.name) / "results"

    def tearDown(self):
        self.scratch.cleanup()

    def make_run(self, folder, rows=lambda text: text, **changes):
        """A copy of an accepted run as a run folder, changed."""
        folder = self.runs / folder
        folder.mkdir(parents=True)
        audited = {"audit": "every", "audited_states": 100, "guarantee_kept": True}
        manifest = {**manifest_at(RESULTS / f"{SPHERE}_run.json"), **audited}
        (folder / "run.json").write_text(json.dumps({**manifest, **changes}))
        (folder / "steps.csv").write_text(rows((RESULTS / f"{SPHERE}_steps.csv").read_text()))
        return folder


def scaled(column, factor):
    """A function that multiplies a column of steps.csv."""
    def change(text):
        head, *rows = list(csv.reader(text.splitlines()))
        at = next(i for i, name in enumerate(head) if name.partition("[")[0].strip() == column)
        lines = [",".join(row[:at] + [repr(float(row[at]) * factor)] + row[at + 1:]) for row in rows]
        return "\n".join([",".join(head), *lines]) + "\n"
    return change


class Checking(Scratch):
    def said(self, **options):
        self.make_run("fig18-paper-cuda/run", **options)
        lines, met = check.check(self.runs)
        return met, next(line for line in lines if line.startswith("fig18-paper-cuda/run"))

    def test_no_manifest_names_a_folder_of_the_machine_that_made_it(self):
        for path in sorted((SOURCE / "paper_figures/results").rglob("*run.json")):
            manifest = json.loads(path.read_text())
            for key in ("command", "from_state"):
                self.assertNotRegex(manifest.get(key, ""), r"(?<![^\s=])/\S", f"{path.name}: {key}")

    def test_the_same_program_must_give_the_same_bits(self):
        words = f"fig18-paper-cuda/run/run.json: the bits of {SPHERE}_run.json"
        self.assertEqual(self.said(), (True, words))

    def test_other_bits_of_the_same_program_are_found(self):
        met, words = self.said(final_hash="0" * 16)
        self.assertFalse(met)
        self.assertRegex(words, "NOT the bits of the accepted run")

    def test_another_program_is_held_to_the_bands(self):
        met, words = self.said(commit="f" * 40, final_hash="0" * 16)
        self.assertTrue(met, words)
        self.assertIn("within the bands of", words)

    def test_a_mean_outside_its_band_is_named(self):
        for column, band in check.bands().items():
            for factor, good in ((1 + 0.9 * band, True), (1 + 1.1 * band, False), (1 - 1.1 * band, False)):
                with self.subTest(column=column, factor=factor):
                    met, words = self.said(commit="f" * 40, rows=scaled(column, factor))
                    shutil.rmtree(self.runs)
                    self.assertEqual(met, good, words)
                    self.assertEqual(f"mean {column}" in words, not good, words)

    def test_a_failed_audit_an_unfinished_run_and_missing_steps_are_not_met(self):
        for changes, words in (({"guarantee_kept": False, "status": "failed: intersection"}, "its audit FAILED"),
                               ({"status": "running"}, "not finished"),
                               ({"commit": "f" * 40, "rows": lambda text: "\n".join(text.splitlines()[:50]) + "\n"},
                                "49 steps, not 100")):
            met, said = self.said(**changes)
            shutil.rmtree(self.runs)
            self.assertFalse(met)
            self.assertIn(words, said)

    def test_runs_that_no_accepted_result_is_about_are_said_to_be_so(self):
        self.make_run("other/run", scale="smoke", scene={"name": "nothing", "bodies": []})
        lines, met = check.check(self.runs)
        self.assertTrue(met)
        self.assertRegex(lines[0], "1 runs, none of which an accepted result")

    def test_illustrations_are_the_same_data(self):
        (self.runs / "illustrations").mkdir(parents=True)
        (self.results / "m").mkdir(parents=True)
        for name in ("fig07", "fig02_models"):
            (self.results / f"m/{name}.json.gz").write_bytes(gzip.compress(b"{}"))
            for data, good in ((b"{}", True), (b"{ }", False)):
                (self.runs / f"illustrations/{name}.json").write_bytes(data)
                self.assertEqual([met for _, met in check.compare_illustrations(self.runs, self.results)], [good])
            (self.runs / f"illustrations/{name}.json").unlink()

    def test_a_claim_at_a_smaller_scale_is_held_to_its_band_moved_to_the_accepted_number(self):
        claim = {"id": "s.c", "scene": "s", "value": 5, "band": [4.5, 5.5],
                 "measure": {"table": "fig99", "column": "n", "where": {"kind": "a"}}, "run": {"scale": "paper"}}
        for accepted, ours, good in ((1.59, 1.59, True), (1.59, 1.7, True), (1.59, 1.8, False), (1.59, 1.4, False),
                                     (1.59, "nan", False), ("nan", "nan", True), ("nan", 3, True)):
            for folder, number in ((self.results, accepted), (self.runs / "fig99-small-cpu", ours)):
                folder.mkdir(parents=True, exist_ok=True)
                name = "fig99_small.csv" if folder == self.results else "fig99.csv"
                (folder / name).write_text(f"kind,n,commit,device\na,{number},c,d\n")
            found = list(check.compare_smaller(claim, Evidence(self.runs), Evidence(self.results)))
            self.assertEqual([met for _, met in found], [good], found)

    def test_that_nothing_happens_is_held_at_each_scale(self):
        claim = {"id": "s.c", "scene": "cloth_on_sphere", "value": 0, "band": [0, 0],
                 "measure": {"guarantee": "penetration-free"},
                 "run": {"scale": "paper", "solver": "vbd", "audited": True}}
        self.assertTrue(check.movable(claim))
        self.make_run("fig18-small-cuda/window", scale="small", guarantee_kept="not checked",
                      ended="2999-01-01T00:00:00Z")
        for status, good in (({}, [True]), ({"guarantee_kept": False, "status": "failed: intersection"}, [False])):
            self.make_run("fig18-small-cuda/run", scale="small", **status)
            found = list(check.compare_smaller(claim, Evidence(self.runs), Evidence(RESULTS)))
            self.assertEqual([met for _, met in found], good, found)
            shutil.rmtree(self.runs / "fig18-small-cuda/run")

    def test_a_band_that_says_nothing_at_another_scale_is_not_moved(self):
        claim = {"value": 5, "band": [4, 6], "measure": {"table": "fig99", "column": "n"}}
        self.assertTrue(check.movable(claim))
        self.assertTrue(check.movable({**claim, "band": [5, 5]}))
        for changes in ({"band": [0, 5]}, {"band": [1, None]}, {"band": "stored"}, {"value": 0},
                        {"measure": {"steps": "wall", "statistic": "mean"}}, {"measure": {"scene": "vertices"}}):
            self.assertFalse(check.movable({**claim, **changes}), changes)

    def test_the_bands_are_what_the_accepted_pairs_say(self):
        document = json.loads(check.BANDS.read_text())
        self.assertEqual(document["factor"], 3)
        for name, entry in document["columns"].items():
            means = [[sum(run_evidence(stem).column(name)) for stem in pair] for pair in document["pairs"]]
            self.assertAlmostEqual(entry["spread"], max(abs(b / a - 1) for a, b in means), delta=5e-5, msg=name)


class Accepting(Scratch):
    BOOK = recipes.load()

    def accept(self, *names):
        return accept.accept([self.BOOK[name] for name in names], "paper", "cuda", self.runs, "machine", "no program",
                             self.results)

    def finished(self, **changes):
        folder = self.make_run("fig18-paper-cuda/run", **changes)
        (folder.parent / "fig18.png").write_bytes(picture())

    def test_data_picture_and_provenance_are_kept(self):
        self.finished(command="/somewhere/build/default/ogc run cloth_on_sphere --from-state=/else/where/frame.h5 "
                              "--out fig18-paper-cuda/run", from_state="/else/where/frame.h5")
        self.accept("fig18")
        kept = self.results / "machine"
        self.assertEqual({path.name for path in kept.iterdir()},
                         {"fig18_paper.png", "fig18_paper_run.json", "fig18_paper_steps.csv", "provenance.csv",
                          "durations.csv"})
        manifest = json.loads((kept / "fig18_paper_run.json").read_text())
        self.assertEqual(manifest["command"], "ogc run cloth_on_sphere --from-state=frame.h5 --out "
                                              "fig18-paper-cuda/run")
        self.assertEqual(manifest["from_state"], "frame.h5")
        with (kept / "provenance.csv").open(newline="") as file:
            rows = {row["file"]: row for row in csv.DictReader(file)}
        self.assertEqual((rows["fig18_paper.png"]["redo"], rows["fig18_paper.png"]["commit"]),
                         ("experiments/reproduce fig18 --scale paper --backend cuda", manifest["commit"]))

    def test_an_audit_after_the_run_is_kept_and_one_that_failed_is_refused(self):
        for clean in (True, False):
            self.finished(audited_states="0", guarantee_kept="not checked")
            (self.runs / "fig18-paper-cuda/run/audit.json").write_text(json.dumps({"states": 101, "clean": clean}))
            if clean:
                self.accept("fig18")
                self.assertEqual(Evidence(self.results).runs[0].audit_in_words, "101 states of 100 steps were audited.")
            else:
                with self.assertRaisesRegex(accept.AcceptError, "failed its audit"):
                    self.accept("fig18")
            shutil.rmtree(self.runs)

    def test_runs_without_logs_of_steps_took_what_their_manifests_say(self):
        self.finished(started="2026-11-22T10:00:00Z", ended="2026-11-22T10:01:30Z")
        self.accept("fig18")
        self.assertEqual((self.results / "machine/durations.csv").read_text().splitlines()[1:],
                         ["fig18,paper,cuda,90.0,machine"])

    def test_a_run_behind_a_link_is_the_figures_too(self):
        self.finished(started="2026-11-22T10:00:00Z", ended="2026-11-22T10:01:30Z")
        run, row = self.runs / "fig18-paper-cuda/run", self.runs / "table1-paper-cuda/sphere/whole"
        row.parent.mkdir(parents=True)
        run.rename(row)
        run.symlink_to(row)
        rows = {row["file"]: row["device"] for row in self.accept("fig18")}
        self.assertIn("fig18_paper_run.json", rows)
        self.assertRegex(rows["fig18_paper.png"], "H200")
        self.assertIn("fig18,paper,cuda,90.0,machine", (self.results / "machine/durations.csv").read_text())

    def test_a_picture_is_of_its_own_backend_where_later_windows_on_the_cpu_lie_beside_its_run(self):
        self.finished(ended="2026-11-22T10:00:00Z")
        self.make_run("fig18-paper-cuda/cpu_0", backend="cpu", device="16 threads", ended="2026-11-22T11:00:00Z")
        rows = {row["file"]: row["device"] for row in self.accept("fig18")}
        self.assertEqual(set(rows), {"fig18_paper.png",
                                     *(f"fig18_paper/{run}_{what}" for run in ("run", "cpu_0")
                                       for what in ("run.json", "steps.csv"))})
        self.assertRegex(rows["fig18_paper.png"], "H200")

    def test_a_missing_movie_is_refused_unless_said_so(self):
        folder = self.make_run("fig11-paper-cuda/run")
        (folder.parent / "fig11.png").write_bytes(picture())
        with self.assertRaisesRegex(accept.AcceptError, "fig11.mp4 is missing"):
            self.accept("fig11")
        accept.accept([self.BOOK["fig11"]], "paper", "cuda", self.runs, "machine", "no program", self.results,
                      incomplete=True)
        self.assertEqual({path.name for path in (self.results / "machine").glob("fig11*")},
                         {"fig11_paper.png", "fig11_paper_run.json", "fig11_paper_steps.csv"})

    def test_files_of_an_earlier_acceptance_of_the_figure_go(self):
        """Else the runs of two programs lie in one folder, and claims are judged by either."""
        for name in ("first", "second"):
            for run in (name, "both"):
                self.make_run(f"fig17-paper-cuda/{run}")
            (self.runs / "fig17-paper-cuda/fig17.png").write_bytes(picture())
            self.accept("fig17")
            shutil.rmtree(self.runs)
        self.finished()
        self.accept("fig18")
        kept = self.results / "machine"
        self.assertEqual({path.name for path in (kept / "fig17_paper").iterdir()},
                         {f"{run}_{what}" for run in ("second", "both") for what in ("run.json", "steps.csv")})
        with (kept / "provenance.csv").open(newline="") as file:
            files = {row["file"] for row in csv.DictReader(file)}
        self.assertEqual(files, {path.relative_to(kept).as_posix() for path in kept.rglob("*")
                                 if path.is_file()} - {"provenance.csv", "durations.csv"})

    def test_of_a_figure_that_says_so_only_some_runs_are_kept_and_all_are_checked(self):
        for run, commit in (("runs/contact_activation=ogc", "a"), ("newton_ipc_log", "a"),
                            ("runs/contact_activation=cubic", "a"), ("vbd_ipc_log_kappa2", "a")):
            self.make_run(f"fig21-paper-cuda/{run}", commit=commit * 40)
        (self.runs / "fig21-paper-cuda/fig21.png").write_bytes(picture())
        self.accept("fig21")
        kept = {path.name for path in (self.results / "machine/fig21_paper").iterdir()}
        self.assertEqual(kept, {f"{run}_{what}" for run in ("contact_activation=ogc", "newton_ipc_log")
                                for what in ("run.json", "steps.csv")})
        self.make_run("fig21-paper-cuda/vbd_ogc_weak", commit="b" * 40)
        with self.assertRaisesRegex(accept.AcceptError, "mixes runs of commits"):
            self.accept("fig21")

    def test_rows_of_many_bytes_are_kept_compressed_and_read_again(self):
        self.finished()
        rows = (self.runs / "fig18-paper-cuda/run/steps.csv").read_text()
        wide = "\n".join(line + "," + "0" * 99 for line in rows.splitlines()) + "\n"
        (self.runs / "fig18-paper-cuda/run/steps.csv").write_text(wide)
        self.assertGreater(len(wide), kept.LONG)
        self.accept("fig18")
        self.assertTrue((self.results / "machine/fig18_paper_steps.csv.gz").is_file())
        new, old = check.runs_in(self.runs)[0], Evidence(self.results).runs[0]
        self.assertEqual(new.columns["kinetic_energy"], old.columns["kinetic_energy"])

    def test_a_long_run_is_thinned_and_its_statistics_are_those_of_every_row(self):
        self.finished()
        folder = self.runs / "fig18-paper-cuda/run"
        head, *rows = (folder / "steps.csv").read_text().splitlines()
        longer = [f"{100 * n + i + 1},{line.partition(',')[2]}" for n in range(3) for i, line in enumerate(rows)][:270]
        (folder / "steps.csv").write_text("\n".join([head, *longer]) + "\n")
        self.accept("fig18")
        self.assertFalse((self.results / "machine/fig18_paper_steps.csv").exists())
        whole, old = run_at(folder), Evidence(self.results).runs[0]
        self.assertEqual((old.step_count, old.first_step, old.course("step")[0]), (270, 1, [100, 200, 270]))
        for name in ("wall", "discrete_detections", "kinetic_energy"):
            self.assertEqual((old.mean(name), old.largest(name)), (whole.mean(name), whole.largest(name)), name)
            self.assertEqual(old.course(name)[1], [whole.column(name)[i] for i in (99, 199, 269)], name)
            for steps in (100, 200):
                self.assertAlmostEqual(old.first(steps).mean(name) / whole.first(steps).mean(name), 1, places=8)
                self.assertAlmostEqual(old.first(steps).largest(name) / whole.first(steps).largest(name), 1, places=8)
        self.assertEqual(step_costs.costs(old), step_costs.costs(whole))
        with self.assertRaisesRegex(EvidenceError, "first 150 steps end between two hundreds"):
            old.first(150)
        with self.assertRaisesRegex(EvidenceError, "keeps a row of each hundred steps"):
            old.column("wall")

    def test_a_scene_is_kept_once_and_goes_with_its_last_run(self):
        for name in ("one", "two"):
            self.make_run(f"fig17-paper-cuda/{name}")
        (self.runs / "fig17-paper-cuda/fig17.png").write_bytes(picture())
        self.accept("fig17")
        scene, = (self.results / "scenes").iterdir()
        self.assertEqual(hashlib.sha256(scene.read_bytes()).hexdigest()[:16], scene.stem)
        self.assertEqual(Evidence(self.results).runs[0].manifest["scene"]["vertices"], 5542)
        for name in ("one", "two"):
            shutil.rmtree(self.runs / f"fig17-paper-cuda/{name}")
            self.make_run(f"fig17-paper-cuda/{name}", scene={"name": "another", "bodies": []})
        self.accept("fig17")
        self.assertEqual([path.name for path in (self.results / "scenes").iterdir()].count(scene.name), 0)
        scene, = (self.results / "scenes").iterdir()
        scene.unlink()
        with self.assertRaisesRegex(EvidenceError, f"its scene {scene.name} is in no folder"):
            Evidence(self.results)

    def test_a_run_that_another_figure_keeps_is_not_kept_twice(self):
        self.make_run("table1-paper-cuda/cloth_on_sphere/whole")
        (self.runs / "table1-paper-cuda/table1_paper.csv").write_text("scene\n")
        self.finished()
        self.accept("table1")
        self.accept("fig18")
        there = {path.name for path in (self.results / "machine").rglob("*run.json")}
        self.assertEqual(there, {"table1_paper_run.json"})
        self.assertTrue((self.results / "machine/fig18_paper.png").is_file())
        shutil.rmtree(self.results)
        rows = {row["file"] for row in self.accept("fig18", "table1")}
        self.assertEqual({name for name in rows if name.endswith("run.json")}, {"fig18_paper_run.json"})

    def test_a_drawing_is_kept_without_loss_and_a_rendering_as_webp(self):
        """A few flat colours are the same in every pixel; thousands of shades are a tenth as large, and their mean
        colour is within a level of 255."""
        flat = Image.new("RGB", (200, 200), "white")
        flat.paste((0, 114, 178), (20, 20, 180, 24))
        grey = Image.effect_noise((400, 400), 6)
        shades = Image.merge("RGB", [Image.linear_gradient("L").resize((400, 400)), grey, grey])
        for image, suffix in ((flat, ".png"), (shades, ".webp")):
            out = io.BytesIO()
            image.save(out, "PNG")
            found, data = kept.picture(out.getvalue())
            self.assertEqual(found, suffix)
            again = Image.open(io.BytesIO(data)).convert("RGB")
            if suffix == ".png":
                self.assertEqual(again.tobytes(), image.tobytes())
            else:
                self.assertLess(len(data), len(out.getvalue()) / 2)
                for ours, theirs in zip(ImageStat.Stat(again).mean, ImageStat.Stat(image).mean):
                    self.assertAlmostEqual(ours, theirs, delta=1)

    def test_what_is_no_picture_is_refused(self):
        self.finished()
        (self.runs / "fig18-paper-cuda/fig18.png").write_bytes(b"no picture")
        with self.assertRaisesRegex(accept.AcceptError, "no PNG"):
            self.accept("fig18")

    def test_the_caption_that_lies_beside_a_picture_is_kept_with_it(self):
        self.finished()
        caption = {"title": "A clause", "alt": "What is seen", "source": "ogc run; commit 1"}
        (self.runs / "fig18-paper-cuda/fig18.caption.json").write_text(json.dumps(caption))
        self.accept("fig18")
        folder = self.results / "machine"
        self.assertEqual(captions.rows_of(folder), {"fig18_paper.png": {"file": "fig18_paper.png", **caption}})
        self.assertEqual(captions.kept(folder / "fig18_paper.mp4")["alt"], "What is seen")

    def test_pictures_alone_leave_the_runs_that_were_accepted_before(self):
        self.finished()
        self.accept("fig18")
        before = {path.name: path.read_bytes() for path in (self.results / "machine").glob("fig18_paper_*")}
        shutil.rmtree(self.runs)
        self.finished(final_hash="another")
        (self.runs / "fig18-paper-cuda/fig18.png").write_bytes(picture(200))
        accept.accept([self.BOOK["fig18"]], "paper", "cuda", self.runs, "machine", "no program", self.results,
                      pictures=True)
        after = {path.name: path.read_bytes() for path in (self.results / "machine").glob("fig18_paper_*")}
        self.assertEqual(before, after)
        rows = {row["file"]: row for row in contents.rows_of(self.results / "machine/provenance.csv")}
        self.assertEqual(set(rows), {"fig18_paper.png", *before})
        self.assertEqual(rows["fig18_paper.png"]["sha256"],
                         hashlib.sha256((self.results / "machine/fig18_paper.png").read_bytes()).hexdigest()[:16])

    def test_what_is_no_evidence_is_refused_in_words_and_nothing_is_written(self):
        for changes, words in (({"dirty": True}, "uncommitted changes"),
                               ({"guarantee_kept": False}, "failed its audit"),
                               ({"status": "running"}, "not finished")):
            self.finished(**changes)
            with self.assertRaisesRegex(accept.AcceptError, words):
                self.accept("fig18")
            shutil.rmtree(self.runs)
        self.assertFalse(self.results.exists())

    def test_a_table_of_two_programs_or_of_a_changed_one_is_refused(self):
        table = self.runs / "fig18-paper-cuda/fig18.csv"
        for commits, words in (("cccccccccc dddddddddd", "mixes rows of commits cccccccccc, dddddddddd"),
                               ("cccccccccc - cccccccccc", ""), ("cccccccccc cccccccccc(dirty)", "is no commit"),
                               ("cccccccccc unknown", "rows of unknown, which is no commit")):
            self.finished()
            table.write_text("\n".join(["commit,device", *(f"{commit},d" for commit in commits.split())]) + "\n")
            if words:
                with self.assertRaisesRegex(accept.AcceptError, words):
                    self.accept("fig18")
                self.assertFalse((self.results / "machine/fig18_paper.csv").exists())
            else:
                self.accept("fig18")
                shutil.rmtree(self.results)
            shutil.rmtree(self.runs)

    def test_the_paper_sized_table_1_of_a_call_is_not_kept_beside_the_one_of_kept_runs(self):
        for scale, there in (("paper", False), ("small", True)):
            self.make_run(f"table1-{scale}-cuda/twist/whole")
            (self.runs / f"table1-{scale}-cuda/table1_{scale}.csv").write_text("scene,commit\ntwist,\n")
            accept.accept([self.BOOK["table1"]], scale, "cuda", self.runs, "machine", "no program", self.results)
            self.assertEqual((self.results / f"machine/table1_{scale}.csv").is_file(), there)

    def test_a_mixture_of_commits_and_a_missing_picture_are_refused(self):
        for number, commit in enumerate("ab"):
            self.make_run(f"fig17-paper-cuda/run_{number}", commit=commit * 40)
        with self.assertRaisesRegex(accept.AcceptError, "mixes runs of commits aaaaaaaaaa, bbbbbbbbbb: remove it"):
            self.accept("fig17")
        with self.assertRaisesRegex(accept.AcceptError,
                                    "fig12.png is missing: make it with experiments/reproduce fig12"):
            self.make_run("fig12-paper-cuda/run")
            self.accept("fig12")

    def solved(self, status):
        folder = self.make_run("fig18_solvers-paper-cpu/ipc", status=status)
        (folder / "processor_time.json").write_text('{"user [s]": 1, "system [s]": 0}')
        (folder.parent / "fig18_solvers.png").write_bytes(picture())
        recipe = self.BOOK["fig18_solvers"]
        return accept.accept([recipe], "paper", "cpu", self.runs, "machine", "no program", self.results)

    def test_processor_time_is_kept_of_a_run_that_has_it(self):
        self.assertIn("fig18_solvers_paper_processor_time.json", {row["file"] for row in self.solved("finished")})

    def test_a_run_that_was_stopped_is_refused(self):
        for status in ("interrupted", "running", "failed: no convergence"):
            with self.assertRaisesRegex(accept.AcceptError, "ipc is not finished"):
                self.solved(status)
            shutil.rmtree(self.runs)
        self.assertFalse(self.results.exists())

    def test_half_a_figure_is_not_taken_for_a_whole_one(self):
        self.finished()
        rows = ("activation,status", "ogc,finished", f"cubic,{accept.NOT_RUN}", f"quadratic,{accept.NOT_RUN}")
        (self.runs / "fig18-paper-cuda/fig18.csv").write_text("\n".join(rows) + "\n")
        with self.assertRaisesRegex(accept.AcceptError, "fig18 was drawn without cubic, quadratic: run them"):
            self.accept("fig18")
        accept.accept([self.BOOK["fig18"]], "paper", "cuda", self.runs, "machine", "no program", self.results,
                      incomplete=True, by_hand="script --without")
        self.assertTrue((self.results / "machine/fig18_paper.csv").is_file())
        self.assertIn(",script --without,", (self.results / "machine/provenance.csv").read_text())

    def test_a_picture_of_other_figures_runs_leaves_how_these_are_made_as_it_was(self):
        teaser = dataclasses.replace(self.BOOK["fig01"], body={**self.BOOK["fig01"].body, "of": ["fig18"]})
        (self.runs / "fig01-paper-cuda").mkdir(parents=True)
        (self.runs / "fig01-paper-cuda/fig01.png").write_bytes(picture())

        def redo_after(*recipes, by_hand):
            accept.accept(recipes, "paper", "cuda", self.runs, "machine", "no program", self.results, by_hand=by_hand)
            return {row["file"]: row["redo"] for row in contents.rows_of(self.results / "machine/provenance.csv")}

        self.finished()
        redo_after(self.BOOK["fig18"], by_hand="on the device")
        found = redo_after(teaser, self.BOOK["fig18"], by_hand="the teaser")
        self.assertEqual((found["fig01_paper.png"], found["fig18_paper.png"], found["fig18_paper_run.json"]),
                         ("the teaser", "on the device", "on the device"))
        shutil.rmtree(self.runs / "fig18-paper-cuda")
        self.finished(final_hash="another")  # what was said is of another run
        found = redo_after(teaser, self.BOOK["fig18"], by_hand="the teaser")
        self.assertEqual(found["fig18_paper_run.json"], "experiments/reproduce fig18 --scale paper --backend cuda")

    def test_runs_of_the_same_name_in_different_folders_stay_apart(self):
        for name in ("twist/whole", "knot/whole"):
            folder = self.make_run(f"table1-paper-cuda/{name}")
        (folder.parent.parent / "table1_paper.csv").write_text("scene\n")
        self.accept("table1")
        self.assertEqual({path.name for path in (self.results / "machine/table1_paper").glob("*run.json")},
                         {"twist_whole_run.json", "knot_whole_run.json"})

    def test_rows_of_other_figures_stay(self):
        table = self.results / "t.csv"
        self.results.mkdir()
        contents.merge(table, ("file", "n"), [{"file": "b", "n": 1}, {"file": "a", "n": 1}], ("file",))
        contents.merge(table, ("file", "n"), [{"file": "b", "n": 2}], ("file",))
        self.assertEqual(table.read_text(), "file,n\na,1\nb,2\n")


class Figures(unittest.TestCase):
    def test_a_script_makes_the_picture_that_the_workflow_waits_for(self):
        for recipe in recipes.load().values():
            if "script" in recipe.body and not {"run", "row", "of", "study"} & set(recipe.body):
                text = (SOURCE / f"paper_figures/figures/{recipe.body['script'].replace('.', '/')}.py").read_text()
                self.assertIn(f'"{recipe.name}.png"', text, recipe.name)


if __name__ == "__main__":
    unittest.main()
