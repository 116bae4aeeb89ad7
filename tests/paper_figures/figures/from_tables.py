"""Pictures that are drawn from accepted tables, without runs: each has its picture among the results, every row is in
the picture, and titles say what the rows say; pictures of Fig. 2, 11, 15 and 17 show what is known and name what is
not; a picture without its title keeps all below it.

Usage: from_tables.py SOURCE_DIR. Exit status 77: skipped, matplotlib, h5py or PyYAML is missing.
"""

import csv
import sys
import tempfile
import unittest
from pathlib import Path
from types import SimpleNamespace
from unittest import mock

SOURCE = Path(sys.argv.pop(1)).resolve()
sys.path[:0] = [str(SOURCE), str(SOURCE / "experiments/peers"), str(SOURCE / "experiments/python")]
try:
    import gaps
    import numpy as np
    from PIL import Image
    from paper_figures.figures import fig02_large_radius_twist as fig02
    from paper_figures.figures import fig17_three_cloths_on_sphere as fig17
    from paper_figures.figures import from_tables
    from paper_figures.figures.measured import yarn, yarn_rest, yarn_return
    from paper_figures.workflow import common, untitled
    from paper_figures.workflow.evidence import RESULTS
    from paper_figures.workflow.runs import Iterations
    from plots import style
except ImportError as missing:
    print(f"SKIPPED: {missing}")
    sys.exit(77)


def rows_of(name):
    with (RESULTS / f"{name}.csv").open(newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def drawn(draw, rows):
    """Returns (figure, title) without writing a file."""
    with mock.patch.object(style, "save") as kept:
        draw(rows, Path("unused.png"))
    (figure, _, title, *_), _ = kept.call_args
    return figure, title


class FromTables(unittest.TestCase):
    def test_each_is_kept_with_the_command_that_draws_it(self):
        for name in from_tables.DRAWN:
            machine, _, stem = name.partition("/")
            with (RESULTS / machine / "provenance.csv").open(newline="", encoding="utf-8") as file:
                commands = [row["redo"] for row in csv.DictReader(file)
                            if Path(row["file"]).stem == stem and row["file"].endswith((".png", ".webp"))]
            self.assertEqual(commands, [f".venv/bin/python -m paper_figures.figures.from_tables OUT {name}"], name)

    def test_all_can_be_drawn(self):
        with tempfile.TemporaryDirectory() as folder, mock.patch("builtins.print"):
            from_tables.main(folder, ["h200/fig16_rest_small", "two_cores/minimiser_small"])
            self.assertEqual({path.name for path in Path(folder).rglob("*.png")},
                             {"fig16_rest_small.png", "minimiser_small.png"})
        for name, draw in from_tables.DRAWN.items():
            figure, title = drawn(draw, rows_of(name))
            self.assertTrue(title and any(axes.has_data() for axes in figure.axes), name)

    def test_an_unknown_picture_is_named_with_what_there_is(self):
        with self.assertRaisesRegex(SystemExit, "no picture h200/none; there are: h200/quality_paper"):
            from_tables.main("unused", ["h200/none"])

    def test_numbers_become_numbers_and_words_stay(self):
        row, = from_tables.numbers([{"a": "12", "b": "1.5e-3", "c": "cuda", "d": ""}])
        self.assertEqual(row, {"a": 12, "b": 1.5e-3, "c": "cuda", "d": ""})

    def test_a_return_counts_variants_within_a_row_and_names_each(self):
        rows = [row for row in rows_of("h200/yarn_return_paper") if row["turns [1]"] != "0"]
        within = sum(float(row["distance, nine vertices in ten within [m]"]) <= 0.01 for row in rows)
        figure, title = drawn(yarn_return.draw, rows_of("h200/yarn_return_paper"))
        self.assertIn(f"In {within} of {len(rows)} variants", title)
        names = [label.get_text() for label in figure.axes[0].get_yticklabels()]
        self.assertEqual((len(names), len(set(names))), (len(rows), len(rows)))

    def test_a_cloth_that_moves_has_the_distance_while_it_moves(self):
        row = {"distance, median [m]": "", "distance while it moves, median [m]": "0.25"}
        self.assertEqual(yarn_rest.cell_of(row, "median"), 0.25)
        self.assertEqual(yarn_rest.cell_of({**row, "distance, median [m]": "0.5"}, "median"), 0.5)
        self.assertTrue(np.isnan(yarn_rest.cell_of({"distance, median [m]": ""}, "median")))

    def test_gaps_name_the_filters_through_which_pairs_pass(self):
        base = {"place": "flat", "shape": "edge_edge", "gap_from_m": "1e-9", "pairs": "10"}
        rows = [{**base, "filter": "ball", "pass_through": "0"}, {**base, "filter": "newton", "pass_through": "4"}]
        rows += [{**row, "place": "turned"} for row in rows]
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "gaps.csv"
            with path.open("w", newline="") as file:
                table = csv.DictWriter(file, list(rows[0]))
                table.writeheader()
                table.writerows(rows)
            with mock.patch.object(style, "save") as kept:
                gaps.draw(SimpleNamespace(inputs=[path], out=None))
        (_, _, title, alt, _), _ = kept.call_args
        self.assertEqual(title, "Newton's rule let near pairs pass through, our balls none")
        self.assertIn(title, alt)
        self.assertEqual(gaps.shares(rows, "newton", "flat")[3], 40)
        self.assertTrue(np.isnan(gaps.shares(rows, "newton", "flat")[0]), "no pair of this gap")


class Curves(unittest.TestCase):
    def test_fig_2_says_how_far_it_was_turned_and_who_is_rougher(self):
        self.assertIn("Half a turn with a contact radius of one edge: IPC's cloth is rougher than OGC's",
                      fig02.title_of({"IPC": 2.0, "VBD-OGC": 1.0}))
        self.assertIn("about equally rough", fig02.title_of({"IPC": 1.1, "VBD-OGC": 1.0}))
        self.assertIn("2.1 s of half a turn", fig02.title_of({"IPC": 1.0, "VBD-OGC": 2.0}, "2.1 s of half a turn"))
        self.assertIn("in a window", fig02.title_of({"VBD-OGC": 1.0}))

    def run_of(self, steps, frames):
        run = SimpleNamespace(frames=[Path(f"frame_{step:06d}.h5") for step in frames],
                              column=lambda name: np.array(steps), frame=lambda path: int(path.stem[6:]))
        run.frame_at_step = lambda step: min(frames, key=lambda other: abs(other - step))
        return run

    def test_fig_2_shows_states_that_both_stored_and_a_window_beside_its_start(self):
        ogc = self.run_of(range(1, 61), (0, 20, 40, 60))
        self.assertEqual(fig02.frames_of((self.run_of(range(1, 46), (0, 20, 40, 45)), ogc)), (40, 40))
        self.assertEqual(fig02.frames_of((self.run_of(range(21, 31), (20, 30)), ogc)), (30, 20))
        self.assertEqual(fig02.frames_of((None, ogc)), (None, 60))

    def test_fig_15_marks_the_first_meeting_of_the_kept_row_where_no_window_is(self):
        run = SimpleNamespace(steps={}, column=lambda name: np.arange(1, 4), setting=lambda name: 0.5)
        rows = [{"run": "a", "first meeting at step": "", "mean tension there [N]": ""},
                {"run": "b", "first meeting at step": "6", "mean tension there [N]": "0.25"}]
        self.assertEqual(yarn.first_pull("b", run, {}, rows), (3.0, 0.25))
        self.assertIsNone(yarn.first_pull("a", run, {}, rows))

    def test_a_movie_of_fig_11_has_the_camera_of_its_figure(self):
        run = object()
        with (mock.patch.object(common, "run_of", return_value=run), mock.patch.object(common, "draw_movie") as movie,
              mock.patch.object(sys, "argv", ["fig11", "runs/knot", "--movie", "out.mp4"]),
              self.assertRaises(SystemExit)):
            common.draw_a_run("knot", None, seen=lambda of: ("camera", of))
        movie.assert_called_once_with(run, "out.mp4", ("camera", run))

    def test_fig_17_compares_measured_times_alone(self):
        curve = lambda **more: Iterations({"residual": np.array([1, 1e-2, 1e-4]), **more})  # noqa: E731
        timed = [("VBD, single", curve(wall=np.array([1, 2, 3])), 0.1)]
        kept = [("Newton, double", curve(iteration=np.arange(3)), 0.1)]
        self.assertEqual(fig17.time_to(timed, "VBD"), 3)
        self.assertIsNone(fig17.time_to(kept, "Newton"))
        both = [*timed, ("Newton, double", curve(wall=np.array([1, 2000, 5000])), 0.1)]
        self.assertIn("in 3 ms, Newton's method in 5 s (there)", fig17.title_of([*timed, *kept], both, " (there)"))
        self.assertNotIn(" ms", fig17.title_of([*timed, *kept], [], ""))
        files = [RESULTS / "two_cores" / name for name in ("fig17_newton_iterations.csv", "fig17_newton_paper.csv")]
        for label, rows, share in fig17.kept_newton(*files):
            self.assertTrue("wall" not in rows.columns and 0 < share < 1, label)


class Untitled(unittest.TestCase):
    def test_the_title_goes_and_what_is_below_stays(self):
        style.use()
        figure, ((axes,),) = style.page([(2.0, [(1.0, "plot")])], "A claim", "numbers " * 40)
        axes.plot([0, 1], [0, 1])
        axes.set_title("a panel")
        plain = style.plt.rc_context({"figure.constrained_layout.use": False})
        with tempfile.TemporaryDirectory() as folder, plain:
            figure.savefig(Path(folder) / "a.png")
            axes.set_title("")
            for text in figure.texts:
                text.set_visible(False)
            figure.savefig(Path(folder) / "b.png")
            whole, bare = (np.asarray(Image.open(Path(folder) / name).convert("L")) for name in ("a.png", "b.png"))
        cut = untitled.without_title(Image.fromarray(whole))
        begin = len(whole) - cut.height
        plot = np.flatnonzero((bare < 250).any(axis=1))[0]
        self.assertTrue(0.5 * style.HEAD * 160 < begin < plot, (begin, plot))
        panel = whole[begin:plot]
        self.assertTrue((panel < 128).any(), "the panel's title stays")
        self.assertFalse((whole[begin - 8:begin + 2] < 250).any(), "no line of the title is cut in two")

    def test_each_of_the_papers_figures_is_laid_out_once_under_a_number(self):
        figures = [f"fig{number:02d}" for number in range(1, 23)]
        self.assertEqual(sorted(untitled.pictures()), figures)
        with tempfile.TemporaryDirectory() as folder:
            untitled.lay_out(Path(folder) / "shown", Path(folder) / "key.csv", 7)
            names = sorted(path.name for path in (Path(folder) / "shown").iterdir())
            with (Path(folder) / "key.csv").open(newline="") as file:
                key = list(csv.DictReader(file))
        self.assertEqual(names, [f"{number:02d}.png" for number in range(1, 23)])
        self.assertEqual(sorted(row["figure"] for row in key), figures)
        self.assertNotEqual([row["figure"] for row in key], figures, "the order tells nothing")


if __name__ == "__main__":
    unittest.main()
