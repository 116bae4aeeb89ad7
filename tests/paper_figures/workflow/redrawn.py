"""Pictures drawn again from accepted results: runs come back with every row, a picture goes into the results with its
provenance and its caption, Table 1 prints what the tables say, every study has a picture, and a picture of other
figures' runs finds them.

Usage: redrawn.py SOURCE_DIR. Exit status 77: skipped, PyYAML, Pillow, numpy or matplotlib is missing.
"""

import json
import sys
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(sys.argv.pop(1)).resolve()
sys.path.insert(0, str(SOURCE))
try:
    import yaml  # noqa: F401
    from PIL import Image
    from paper_figures.figures import table1_picture
    from paper_figures.figures.ablations import pictures
    from plots import style
except ImportError as missing:
    print(f"SKIPPED: {missing}")
    sys.exit(77)
from paper_figures.workflow import ablation_tables, accept, captions, contents, recipes, redrawn, restored  # noqa: E402
from paper_figures.workflow.evidence import RESULTS, EvidenceError, run_at, runs_in, same_sources  # noqa: E402

ORIGIN = {"commit": "c" * 40, "compiler": "GNU", "device": "d", "ended": "2026-01-01T00:00:00Z"}


class Restored(unittest.TestCase):
    def test_a_run_comes_back_with_its_scene_and_every_row(self):
        with tempfile.TemporaryDirectory() as name:
            names = restored.restore("h200", "fig18_solvers_paper", name)
            self.assertEqual(names, ["ipc", "newton", "vbd_cuda", "vbd"])
            kept = {run.source.rpartition("/")[2]: run for run in runs_in(RESULTS)
                    if run.source.startswith("h200/fig18_solvers_paper")}
            for which in names:
                again = run_at(Path(name) / which)
                self.assertEqual(again.column("wall"), kept[f"{which}_run.json"].column("wall"), which)
                self.assertEqual(again.manifest["scene"]["vertices"], 5542)

    def test_thinned_runs_are_refused(self):
        with tempfile.TemporaryDirectory() as name, self.assertRaisesRegex(EvidenceError, "a row for every step"):
            restored.restore("h200", "fig19_paper", name)


class Kept(unittest.TestCase):
    def keep(self, folder, image):
        path = Path(folder) / "drawn.png"
        image.save(path)
        caption = {"title": "A clause", "alt": "what is seen", "source": "commit"}
        path.with_suffix(style.CAPTION).write_text(json.dumps(caption))
        return redrawn.keep(path, "m", "fig99", "paper", "cuda", "a command", ORIGIN, Path(folder) / "results")

    def test_a_picture_replaces_one_of_another_kind_and_has_its_row_and_caption(self):
        with tempfile.TemporaryDirectory() as name:
            results = Path(name) / "results/m"
            results.mkdir(parents=True)
            noise = Image.merge("RGB", [Image.effect_noise((200, 200), 90 + 10 * k) for k in range(3)])
            for image, kept in ((Image.new("RGB", (9, 9), "red"), "fig99_paper.png"), (noise, "fig99_paper.webp")):
                self.assertEqual(self.keep(name, image), kept)
                self.assertEqual({path.name for path in results.iterdir()}, {kept, "provenance.csv", "captions.csv"})
                row, = contents.rows_of(results / "provenance.csv")
                self.assertEqual((row["file"], row["redo"], row["commit"]), (kept, "a command", ORIGIN["commit"]))
                self.assertEqual(captions.kept(results / kept)["alt"], "what is seen")


class Table1(unittest.TestCase):
    def test_each_cell_is_the_row_of_a_table_or_says_that_it_was_not_run(self):
        rows = table1_picture.rows_of(RESULTS / "h200/whole_runs.csv")
        whole = {(row["scene"], row["membrane"]): row for row in rows}
        quiet = {row["variant"]: row for row in table1_picture.rows_of(RESULTS / "h200/steady_paper.csv")}
        rows = list(table1_picture.table())
        self.assertEqual(len(rows), len(table1_picture.ROWS))
        for (texts, colours), (*_, name) in zip(rows, table1_picture.ROWS):
            for place, row in ((12, name), (13, f"{name}_planes")):
                found = [whole[key] for key in whole if key[0] == row]
                found = [r for r in found if r["membrane"] == "stable_neo_hookean"] or found
                repeated = found and row in quiet and quiet[row]["membrane"] == found[0]["membrane"]
                longest = quiet[row]["largest median [ms]"] if repeated else found and found[0]["worst [ms]"]
                expected = table1_picture.Time(float(found[0]["mean [ms]"]), float(longest)).words \
                    if found else "not run"
                self.assertEqual(texts[place], expected, row)
                if repeated:  # a host's hiccup lengthens a step of one run, and no median
                    self.assertLessEqual(float(longest), 1.05 * float(found[0]["worst [ms]"]), row)
                self.assertEqual(colours[place - 8] == "white", not found)
            self.assertRegex(texts[11], r"^[\d.]+ / [\d.]+$", "the paper prints a time on the GPU in every row")

    def test_a_whole_run_of_processors_goes_before_windows_which_have_a_star(self):
        cells = {name: texts[9] for (texts, _), (*_, name) in zip(table1_picture.table(), table1_picture.ROWS)}
        rows = table1_picture.rows_of(RESULTS / "h200/whole_runs.csv")
        windows = {row["row"]: row for row in table1_picture.rows_of(RESULTS / "h200/cpu_windows_paper.csv")}
        whole = {row["scene"].removesuffix("_cpu"): row for row in rows if row["scene"].endswith("_cpu")}
        old = {name for name, row in whole.items()
               if name in windows and not same_sources(row["commit"], windows[name]["commit"])}
        whole = {name: row for name, row in whole.items() if name not in old}
        self.assertLessEqual({"twist", "dress_volumes"}, set(whole))
        for name, text in cells.items():
            self.assertEqual(text.endswith("*"), name in windows and name not in whole, name)
            if name in whole:
                time = table1_picture.Time(float(whole[name]["mean [ms]"]), float(whole[name]["worst [ms]"]))
                self.assertEqual(text, time.words)

    def test_a_cell_is_blue_if_ours_takes_at_most_the_papers_mean_and_darker_the_slower(self):
        paper = table1_picture.Time(2.0, 3.0)
        shades = [table1_picture.shade(table1_picture.Time(mean), paper) for mean in (2.0, 2.1, 4.1, 8.1, None)]
        self.assertEqual(shades, [table1_picture.FASTER, *table1_picture.SLOWER, "white"])


class Studies(unittest.TestCase):
    def test_every_study_that_has_rows_has_a_picture_with_a_claim(self):
        defined = {path.stem for path in (SOURCE / "paper_figures/figures/ablations").glob("*.yaml")}
        self.assertEqual(set(pictures.TITLES), defined)
        self.assertEqual(set(pictures.TITLES), set(ablation_tables.SHOWN))
        for study in defined:
            for points in ablation_tables.largest_runs(study).values():
                self.assertTrue(pictures.shown(study, points), study)
                words = [pictures.in_words(point) for point in points]
                self.assertEqual(len(set(words)), len(words), "points with one name")


class Teaser(unittest.TestCase):
    def test_it_finds_the_runs_of_figures_that_make_several(self):
        book = recipes.load()
        self.assertEqual(recipes.shown_of({"of": ["fig10", "fig19/planes/whole"]}),
                         {"fig10": "run", "fig19": "planes/whole"})
        step, = recipes.steps(book["fig01"], "paper", "cuda", "ogc", "python")
        outputs = {other.output for name in recipes.shown_of(book["fig01"].body)
                   for other in recipes.steps(book[name], "paper", "cuda", "ogc", "python")}
        runs = [path for path in step.inputs if path.startswith("fig")]
        self.assertEqual(len(runs), 6)
        self.assertLessEqual(set(runs), outputs, "each is the output of a step")


if __name__ == "__main__":
    unittest.main()
