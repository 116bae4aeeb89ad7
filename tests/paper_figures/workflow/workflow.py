"""The workflow with a stand-in for `ogc`: what is finished is not run again, a changed parameter or program is, a job
that fails says so in words.

Usage: workflow.py SOURCE_DIR. Exit status 77: skipped, PyYAML or matplotlib is missing; without Snakemake its part is
left out, and the test says so.
"""

import importlib.util
import itertools
import json
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

SOURCE = Path(sys.argv.pop(1)).resolve()
sys.path.insert(0, str(SOURCE))
try:
    from paper_figures.figures.ablations import gather, study
    from paper_figures.workflow import job, parts, recipes
except ImportError as missing:
    print(f"SKIPPED: {missing}")
    sys.exit(77)

OGC = """#!/bin/sh
echo "stand-in: $*"
for last; do :; done
[ -z "$OGC_FAIL" ] || { echo "no such scene"; exit 2; }
mkdir -p "$last" && echo '{}' > "$last/fig07.json" && echo '{}' > "$last/run.json"
echo x >> "$last/../calls"
"""


class Scratch(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.runs = Path(self.folder.name)
        self.ogc = self.runs / "ogc"
        self.ogc.write_text(OGC)
        self.ogc.chmod(0o755)

    def tearDown(self):
        self.folder.cleanup()

    def calls(self):
        path = self.runs / "calls"
        return len(path.read_text().split()) if path.is_file() else 0


class Recipes(unittest.TestCase):
    def test_every_script_exists_and_every_output_has_its_inputs(self):
        book = recipes.load()
        for recipe in book.values():
            for backend in recipe.backends:
                made = {recipes.PROGRAM, *(step.output for name in recipes.shown_of(recipe.body)
                                           for step in recipes.steps(book[name], "smoke", backend, "ogc"))}
                for step in recipes.steps(recipe, "smoke", backend, "ogc"):
                    self.assertTrue(all(path in made or Path(path).is_file() for path in step.inputs),
                                    (recipe.name, step.inputs))
                    self.assertEqual(step.gpu, int(backend == "cuda" and step.inputs[0] == recipes.PROGRAM
                                                   and "illustration" not in recipe.body), step)
                    made.add(step.output)
                self.assertLessEqual(set(recipe.outputs("smoke", backend)), made)

    def test_names_are_figures_scenes_or_all(self):
        book = recipes.load()
        names = lambda *words, backend="cpu": [r.name for r in recipes.choose(words, book, backend)]  # noqa: E731
        drawn = names("illustrations")
        self.assertEqual(sorted(names("quick")), sorted((*recipes.QUICK, *drawn)))
        self.assertGreater(len(drawn), 3)
        self.assertEqual(names(), ["fig18"])
        self.assertEqual(names("twist", "fig07", "fig12"), ["fig12", "fig07"])
        self.assertNotIn("fig18_solvers", names("all", backend="cuda"))
        self.assertEqual(names("fig01"), ["fig10", "fig11", "fig12", "fig13", "fig16", "fig19", "fig01"])
        self.assertEqual(names("all")[-1], "fig01")
        studies = [path.stem for path in sorted((recipes.FIGURES / "ablations").glob("*.yaml"))]
        self.assertGreaterEqual(len(studies), 5)
        self.assertEqual(names("ablations", backend="cuda"), studies)
        self.assertFalse(set(studies) & set(names("all")))
        beyond = [name for name, recipe in book.items() if "beyond" in recipe.body]
        self.assertEqual(beyond, ["fig16_rest", "growth", "minimiser", "quality"])
        self.assertFalse(set(beyond) & set(names("all")), "the paper does not have them")
        self.assertEqual(names(*beyond), beyond)
        self.assertEqual(names("yarn_twist", "fig15"), ["fig16", "fig15"])
        for wrong, words in ((("fig99",), "no figure or scene 'fig99'; there are: .*fig01"),
                             (("fig18_solvers", "cuda"), "no backend 'cuda'")):
            with self.assertRaisesRegex(recipes.RecipeError, words):
                recipes.choose(wrong[:1], book, wrong[1] if len(wrong) > 1 else "cpu")

    def test_a_key_that_nobody_reads_is_refused(self):
        with tempfile.TemporaryDirectory() as name:
            (Path(name) / "fig99.yaml").write_text("title: x\nsolvers: [vbd]\n")
            with self.assertRaisesRegex(recipes.RecipeError, "fig99.yaml: unknown key solvers; there are: backends"):
                recipes.load(name)

    def test_a_row_is_a_step_whose_output_is_its_last_run_and_a_figure_shares_it(self):
        book, made = recipes.load(), {}
        for scale, backend in itertools.product(("small", "paper"), ("cpu", "cuda")):
            *rows, _ = recipes.steps(book["table1"], scale, backend, "ogc")
            made[scale, backend] = {step.name.removeprefix("table1_"): step for step in rows}
        self.assertEqual(set(made["paper", "cpu"]), set(parts.ROWS))
        self.assertNotIn("fifty_layers_1m", made["small", "cpu"], "they are no million vertices there")
        words = lambda scale, backend, row="twist": made[scale, backend][row].command  # noqa: E731
        self.assertNotIn("windows_twist", words("paper", "cpu"), "its whole runs are of the CPU")
        self.assertIn("windows_twist", words("paper", "cuda"))
        self.assertTrue(made["small", "cpu"]["twist"].output.endswith("/twist/residual_100/run.json"))
        self.assertTrue(made["paper", "cpu"]["fifty_layers_1m"].output.endswith("/whole/run.json"))
        self.assertTrue(made["paper", "cuda"]["twist"].output.endswith("/twist/cpu_100/run.json"))
        for recipe in (recipe for recipe in book.values() if "row" in recipe.body):
            part = parts.book(parts.Wanted("small", "cpu"))[recipe.name]
            run = recipes.steps(recipe, "small", "cpu", "ogc")[0]
            self.assertEqual((run.command[-1], run.output), (recipe.name, f"{part.shown_as}/run.json"))
            self.assertEqual(part.jobs[0].name, f"{recipe.body['row']}/whole")

    def test_the_list_says_what_is_done(self):
        with tempfile.TemporaryDirectory() as name:
            book = recipes.load()
            (Path(name) / "fig18-smoke-cpu").mkdir()
            (Path(name) / "fig18-smoke-cpu/fig18.png").write_text("")
            done = {line.split()[0]: " yes " in line for line in recipes.table(book, "smoke", "cpu", Path(name))[1:]}
            self.assertEqual([figure for figure in book if done[figure]], ["fig18"])

    def test_a_figure_that_is_not_there_yet_is_listed_and_refused_with_what_is_missing(self):
        with tempfile.TemporaryDirectory() as name:
            (Path(name) / "fig98.yaml").write_text("title: x\nscene: twist\nscript: fig12_twist\nrun: []\n")
            (Path(name) / "fig99.yaml").write_text("title: y\nscene: hair\nmissing: strands, of which it is made\n")
            book = recipes.load(name)
            self.assertEqual([recipe.name for recipe in recipes.choose(["all"], book, "cpu")], ["fig98"])
            for asked in ("fig99", "hair"):
                said = r"fig99 \(hair\) is not there yet: the program has no strands, .* There are: fig98"
                with self.assertRaisesRegex(recipes.RecipeError, said):
                    recipes.choose([asked], book, "cpu")
            self.assertEqual(recipes.steps(book["fig99"], "smoke", "cpu", "ogc"), [])
            lines = recipes.table(book, "smoke", "cpu", Path(name))
            self.assertEqual([line.split()[0] for line in lines if "not there yet" in line], ["fig99"])

    def parsed(self, *words):
        """What the front says to words that it only parses."""
        done = subprocess.run([SOURCE / "experiments/reproduce", *words], capture_output=True, text=True, check=False,
                              env={**os.environ, "OGC_PARSE_ONLY": "1"})
        return done.returncode, done.stderr

    def test_a_limit_is_for_figures_with_runs_and_a_number(self):
        for words in (("fig12", "--time-limit", "500", "--pack", "x"), ("table1", "--unpack", "/"),
                      ("--time-limit", "9")):
            self.assertEqual(self.parsed(*words), (0, ""), words)
        for words, said in ((("fig07", "--time-limit", "500"), "fig07 has no runs that a limit could stop"),
                            (("fig12", "--time-limit", "soon"), "need a whole number above 0, not 'soon'"),
                            (("fig12", "--pack", "x", "--slurm"), "go with neither --slurm nor --dry-run")):
            status, words_said = self.parsed(*words)
            self.assertEqual((status, said in words_said), (2, True), words_said)

    def test_every_recipe_of_several_runs_can_be_made_under_a_limit(self):
        book = recipes.load()
        there = {part.recipe for part in parts.book(parts.Wanted()).values()} - {""}
        simulated = {name for name, recipe in book.items() if recipe.scene
                     and "missing" not in recipe.body}
        self.assertEqual(there, simulated | {"table1"})


class Studies(Scratch):
    """Studies of the method's parts, with a stand-in for `ogc`."""

    ABLATE = """#!/bin/sh
case "$OGC_STOP" in "$2") exit 130;; esac
for out; do :; done
echo "$2" >> "$(dirname "$0")/calls"
mkdir -p "$out/default,seed=1"
echo '{"commit": "0123456789ab", "dirty": false, "device": "2 threads", "scene": {"bodies": [{"fixed": false,
  "vertex_count": 4, "triangle_count": 2, "material": {"membrane": "rubber"}}]}}' > "$out/default,seed=1/run.json"
printf 'metric,iterations,unit,runs,finished,median,smallest,largest\\n' > "$out/ablation_medians.csv"
for metric in median_step,,ms median_step,5,ms detections_a_step,,1 detections_a_step,5,1; do
    echo "$metric,2,2,3,2,4" >> "$out/ablation_medians.csv"
done
printf 'iterations,seed,status,guarantee_kept\\n,1,finished,yes\\n5,1,failed,no\\n' > "$out/ablation.csv"
for metric in median_step detections_a_step; do
    echo "$metric: iterations=5 is 2.33 times default"
done > "$out/ablation_findings.txt"
"""

    def study(self, name, **environment):
        self.ogc.write_text(self.ABLATE)
        command = [sys.executable, "-m", "paper_figures.figures.ablations.study", self.runs / "study", "--study", name,
                   "--ogc", self.ogc]
        done = subprocess.run(command, capture_output=True, text=True, check=False,
                              env={**os.environ, "PYTHONPATH": str(SOURCE), **environment})
        return done.returncode, done.stderr

    def test_every_study_asks_for_points_that_differ_from_ten_seeds(self):
        for name in (recipe.name for recipe in recipes.load().values() if "study" in recipe.body):
            body = study.load(name)
            self.assertEqual(body["repeat"], {"smoke": 10, "small": 10, "paper": 3})
            for scene, of_scene in body["scenes"].items():
                for scale in of_scene.get("scales", ("smoke", "small", "paper")):
                    points = study.points_at(of_scene, scale)
                    self.assertGreater(len(set(points)), 1, (name, scene))
                    words = study.command(body, scene, scale, "cuda")
                    who = ("--solver", body["solver"]) if "solver" in body else ("--backend", "cuda")
                    self.assertEqual(words[words.index(who[0]) + 1], who[1])
                    self.assertEqual(len({"--solver", "--backend"} & set(words)), 1)
                    self.assertEqual(words.count("--point"), len(points))
                self.assertIn(words[words.index("--audit") + 1], ("off", "end", "frame"))

    def test_the_published_dress_is_read_where_its_data_are_named_and_by_no_other_scene(self):
        body = study.load("ablation_policy")
        words = {scene: study.command(body, scene, "paper", "cuda", "folder") for scene in body["scenes"]}
        self.assertEqual([scene for scene in words if "data=folder" in words[scene]], ["dress"])
        self.assertNotIn("data", " ".join(study.command(body, "dress", "paper", "cuda")))

    def test_a_studys_picture_has_room_for_names_and_titles_and_no_row_that_no_scene_has(self):
        settings = {"default": (1, 0, 2), "membrane=stable_neo_hookean, bounds_relaxation=0.25": (3, 2, 4)}
        metrics = {"median_step": ("ms", settings), "largest_momentum_lost_end": ("1", settings)}
        with mock.patch.object(study.style, "save") as save:
            study.draw({"twist": metrics}, ["median_step", "median_residual", "largest_momentum_lost_end"], "T", "out")
        figure = save.call_args[0][0]
        figure.canvas.draw()
        self.assertEqual([axes.get_title("left") for axes in figure.axes],
                         ["twist\nmedian step [ms]", "largest momentum lost end [1]"])
        for axes in figure.axes:
            for text in (axes._left_title, *axes.get_yticklabels()):
                extent = text.get_window_extent()
                self.assertTrue(0 <= extent.x0 and extent.x1 <= figure.bbox.x1, text.get_text())

    def test_a_study_that_was_stopped_goes_on_and_ends_in_a_table_findings_and_a_picture(self):
        name = "ablation_policy"
        scenes = study.scenes_at(study.load(name), "smoke")
        status, said = self.study(name, OGC_STOP=scenes[1])
        self.assertEqual(status, 1)
        self.assertIn("exit status 130; call it again to go on", said)
        self.assertFalse((self.runs / f"study/{name}.png").exists())
        self.assertEqual(self.study(name), (0, ""))
        self.assertEqual((self.runs / "calls").read_text().split(), [scenes[0], *scenes])  # ogc keeps what is done
        rows = (self.runs / "study/ablations.csv").read_text().splitlines()
        self.assertEqual(rows[:2],
                         ["study,scene,metric,point,unit,runs,finished,median,smallest,largest,commit,device,membrane",
                          f"{name},{scenes[0]},detections_a_step,default,1,2,2,3,2,4,0123456789,2 threads,rubber"])
        self.assertEqual(rows[3:5], [f"{name},{scenes[0]},guarantee_kept,{point},1,1,{kept},{kept},{kept},{kept},"
                                     "0123456789,2 threads,rubber"
                                     for point, kept in (("default", 1), ("iterations=5", 0))])
        self.assertEqual(len(rows), 1 + 4 * len(scenes))
        self.assertEqual((self.runs / f"study/{name}.txt").read_text().splitlines(),
                         [f"{scene}: detections_a_step: iterations=5 is 2.33 times default" for scene in scenes])
        self.assertTrue((self.runs / f"study/{name}.png").is_file())

    def test_times_stand_in_the_table_of_a_study_that_has_the_machine_for_itself(self):
        self.assertEqual(self.study("ablation_overhead"), (0, ""))
        for name in ("study/ablations.csv", "study/ablation_overhead.txt"):
            self.assertIn("median_step", (self.runs / name).read_text())

    def test_a_gathered_table_has_what_tells_points_apart_and_who_kept_the_guarantee(self):
        self.assertEqual(self.study("ablation_policy")[0], 0)
        table = self.runs / "study/ablations.csv"
        same = "ablation_policy,twist,largest_lag,{},m,2,2,0,0,0,0123456789,2 threads\n"
        table.write_text(table.read_text() + same.format("default") + same.format("iterations=5"))
        out = self.runs / "ablations_smoke.csv"

        def gathered(*folders):
            words = [sys.executable, "-m", "paper_figures.figures.ablations.gather", *folders, "--out", out]
            return subprocess.run(words, capture_output=True, text=True, check=False,
                                  env={**os.environ, "PYTHONPATH": str(SOURCE)})

        self.assertEqual(gathered(table.parent).returncode, 0)
        self.assertNotIn("largest_lag", out.read_text())
        for metric in ("detections_a_step", "guarantee_kept"):
            self.assertEqual(out.read_text().count(f"twist,{metric},"), 2)
        self.assertIn(f"no ablations.csv in {self.runs}: run the study first", gathered(self.runs).stderr)

    def test_the_time_of_a_scene_is_that_of_its_runs_together_and_stays_when_tables_are_gathered(self):
        folder = self.runs / "twist"
        for seed, ended in ((1, "2026-01-01T00:00:30Z"), (2, "2026-01-01T00:01:30Z")):
            (folder / f"seed={seed}").mkdir(parents=True)
            (folder / f"seed={seed}/run.json").write_text(json.dumps(
                {"started": "2026-01-01T00:00:00Z", "ended": ended, "scene": {"name": "twist", "bodies": []}}))
        (folder / "ablation.csv").write_text("iterations,seed,status\n,1,finished\n,2,finished\n")
        about = {"study": "s", "scene": "twist", "commit": "c", "device": "d"}
        (row,) = study.time_of(folder, about)
        self.assertEqual([row[key] for key in ("metric", "point", "unit", "runs", "median")],
                         ["time_of_all_runs", "default", "s", 2, 120.0])
        self.assertEqual(gather.told([row]), [row])
        (folder / "seed=2/run.json").write_text(json.dumps({"started": "2026-01-01T00:00:00Z", "ended": "",
                                                            "scene": {"name": "twist", "bodies": []}}))
        self.assertEqual(list(study.time_of(folder, about)), [])

    def test_a_study_that_audits_nothing_counts_nobody_who_kept_the_guarantee(self):
        audited = self.ABLATE
        self.ABLATE = audited.replace("finished,yes", "finished,not checked").replace("failed,no", "failed,not checked")
        self.assertNotEqual(self.ABLATE, audited)
        self.assertEqual(self.study("ablation_overhead")[0], 0)
        self.assertNotIn("guarantee_kept", (self.runs / "study/ablations.csv").read_text())

    def test_runs_of_another_program_are_made_again(self):
        stamp = self.runs / "stamp"
        stamp.write_text("one")
        self.assertEqual(self.study("ablation_policy", OGC_STAMP=str(stamp))[0], 0)
        kept = self.runs / "study/twist/kept"
        kept.write_text("")
        self.assertEqual(self.study("ablation_policy", OGC_STAMP=str(stamp))[0], 0)
        self.assertTrue(kept.exists())
        stamp.write_text("two")
        self.assertEqual(self.study("ablation_policy", OGC_STAMP=str(stamp))[0], 0)
        self.assertFalse(kept.exists())

    def test_a_study_that_is_not_there_is_refused_with_those_that_are(self):
        status, said = self.study("ablation_nothing")
        self.assertEqual(status, 1)
        self.assertIn("no study 'ablation_nothing'; there are: ablation_activation", said)


class Jobs(Scratch):
    def test_a_failed_job_shows_its_command_and_the_end_of_its_log(self):
        program = [sys.executable, "-c", "import sys; print(*range(100), sep='\\n'); sys.exit(3)"]
        done = subprocess.run([sys.executable, "-m", "paper_figures.workflow.job", "a/job.log", "a/out", *program],
                              cwd=self.runs, env={**os.environ, "PYTHONPATH": str(SOURCE)}, capture_output=True,
                              text=True)
        self.assertEqual(done.returncode, 3)
        self.assertRegex(done.stderr, r"exit status 3.*import sys")
        self.assertIn("\n  99\n", done.stderr)
        self.assertNotIn("\n  79\n", done.stderr)

    def test_a_command_without_its_output_has_failed(self):
        with self.assertRaisesRegex(job.StepFailure, "no .*none"):
            job.run(self.runs / "l", self.runs / "none", ["true"])

    def test_of_a_link_to_a_run_the_link_goes_alone(self):
        run = self.runs / "table1/run"
        run.mkdir(parents=True)
        (self.runs / "run").symlink_to(run)
        job.clear(self.runs / "run/run.json")
        self.assertEqual(((self.runs / "run").is_symlink(), run.is_dir()), (False, True))

    def test_what_an_interrupted_run_left_goes(self):
        left = self.runs / "run/frames"
        left.mkdir(parents=True)
        job.clear(self.runs / "run/run.json")
        self.assertFalse(left.exists())

    def test_a_run_that_was_stopped_for_good_counts_no_seconds(self):
        manifest = self.runs / "run.json"
        for ended, seconds in (("", 0), ("2026-01-01T00:01:30Z", 90)):
            manifest.write_text(json.dumps({"started": "2026-01-01T00:00:00Z", "ended": ended}))
            self.assertEqual(recipes.seconds_of_run(manifest), seconds)

    def test_what_a_run_waited_until_it_was_resumed_does_not_count(self):
        manifest, about = self.runs / "run.json", {"started": "2026-01-01T00:00:00Z", "ended": "2026-01-01T09:00:00Z"}
        (self.runs / "steps.csv").write_text("step [1],wall [ms]\n1,1500\n2,2500\n")
        for resumed, seconds in (({}, 9 * 3600), ({"resumed": "2026-01-01T08:59:00Z after step 1"}, 4)):
            manifest.write_text(json.dumps({**about, **resumed}))
            self.assertEqual(recipes.seconds_of_run(manifest), seconds)

    def test_the_stamp_is_rewritten_for_another_program_alone(self):
        stamp = self.runs / recipes.PROGRAM
        recipes.program_stamp(self.runs, self.ogc)
        first, written = stamp.read_text(), stamp.stat().st_mtime_ns
        recipes.program_stamp(self.runs, self.ogc)
        self.assertEqual(stamp.stat().st_mtime_ns, written)
        self.ogc.write_text(OGC + "#")
        recipes.program_stamp(self.runs, self.ogc)
        self.assertNotEqual(stamp.read_text(), first)


@unittest.skipUnless(importlib.util.find_spec("snakemake"), "Snakemake is not installed: its part is left out")
class Snakemake(Scratch):
    def workflow(self, *options, figures="fig07", **variables):
        command = [sys.executable, "-m", "snakemake", "-s", str(SOURCE / "paper_figures/workflow/Snakefile"), "-d",
                   str(self.runs), "--nolock", "--cores", "1", *options,
                   "--config", f"figures={figures}", f"ogc={self.ogc}"]
        done = subprocess.run(command, capture_output=True, text=True,
                              env={**os.environ, **variables, "PYTHONPATH": str(SOURCE),
                                   "XDG_CACHE_HOME": str(self.runs / "cache")})
        return done.returncode, done.stdout + done.stderr

    def test_only_what_is_missing_or_changed_is_run(self):
        data = ("illustrations/fig07.json",)
        status, said = self.workflow(*data, OGC_FAIL="yes")
        self.assertNotEqual(status, 0)
        self.assertRegex(said, r"FAILED \(exit status 2\): \S*/ogc illustrate fig07 --out illustrations\n  stand-in: "
                               r"illustrate fig07.*\n  no such scene")
        status, said = self.workflow(*data)
        self.assertEqual((status, self.calls()), (0, 1), said)
        status, said = self.workflow("--dry-run", *data)
        self.assertIn("Nothing to be done", said)
        self.ogc.write_text(OGC + "# another program\n")
        status, said = self.workflow("--dry-run", *data)
        self.assertIn("Updated input files: program.txt", said)
        self.assertEqual(json.loads((self.runs / "illustrations/fig07_data.log.json").read_text())["command"][1:3],
                         ["illustrate", "fig07"])

    def test_without_a_name_it_is_the_representative_figure(self):
        status, said = self.workflow("--dry-run", figures="")  # as `experiments/reproduce` says it
        self.assertEqual(status, 0, said)
        self.assertIn(f"rule {recipes.REPRESENTATIVE}_run:", said)


if __name__ == "__main__":
    unittest.main()
