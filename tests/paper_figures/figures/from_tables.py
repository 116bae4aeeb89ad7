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
    from paper_figures.workflow import common, half_turn, untitled
    from paper_figures.workflow.evidence import RESULTS
    from paper_figures.workflow.jobs import ENDED_BY_TIME
    from paper_figures.workflow.runs import Iterations
    from ogc_testbed.runs import RunError
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
        """From its table, or with the runs behind it."""
        for name in from_tables.DRAWN:
            machine, _, stem = name.partition("/")
            with (RESULTS / machine / "provenance.csv").open(newline="", encoding="utf-8") as file:
                commands = [row["redo"] for row in csv.DictReader(file)
                            if Path(row["file"]).stem == stem and row["file"].endswith((".png", ".webp"))]
            again = (f".venv/bin/python -m paper_figures.figures.from_tables OUT {name}",
                     f"experiments/evidence cores {stem.removesuffix('_small')}")
            self.assertTrue(len(commands) == 1 and commands[0] in again, f"{name}: {commands}")

    def test_all_can_be_drawn(self):
        with tempfile.TemporaryDirectory() as folder, mock.patch("builtins.print"):
            from_tables.main(folder, ["two_cores/fig16_rest_small", "two_cores/falling"])
            self.assertEqual({path.name for path in Path(folder).rglob("*.png")},
                             {"fig16_rest_small.png", "falling.png"})
        for name, draw in from_tables.DRAWN.items():
            figure, title = drawn(draw, rows_of(name))
            self.assertTrue(title and any(axes.has_data() for axes in figure.axes), name)

    def test_an_unknown_picture_is_named_with_what_there_is(self):
        with self.assertRaisesRegex(SystemExit, "no picture h200/none; there are: h200/quality_paper"):
            from_tables.main("unused", ["h200/none"])

    def test_numbers_become_numbers_and_words_stay(self):
        row, = from_tables.numbers([{"a": "12", "b": "1.5e-3", "c": "cuda", "d": "", "commit": "0123"}])
        self.assertEqual(row, {"a": 12, "b": 1.5e-3, "c": "cuda", "d": "", "commit": "0123"})

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
    def rows_of_fig_2(self, **values):
        row = {"angle defect of OGC then [rad]": 0.01, "stretch median of OGC then [1]": 1.0}
        return {name: {**row, "angle defect [rad]": defect, "stretch median [1]": stretch}
                for name, (defect, stretch) in values.items()}

    def test_fig_2_says_what_contacts_do_to_the_sheet(self):
        title = lambda **values: fig02.title_of(self.rows_of_fig_2(**values))  # noqa: E731
        self.assertEqual(title(vbd=(0.01, 1.0), ipc=(0.01, 1.0)),
                         "Fig. 2. IPC's contact set leaves the sheet smooth; OGC's leaves it smooth")
        self.assertIn("IPC's contact set at OGC's stiffness bulges the sheet",
                      title(vbd=(0.01, 1.0), ipc=(0.01, 1.0), pairs=(0.3, 1.0)))
        self.assertIn("stretches the sheet by 26 %", title(vbd=(0.01, 1.0), pairs=(0.3, 1.26)))
        self.assertIn("OGC's bulges it only by its own neighbours",
                      title(vbd=(0.2, 1.0), vbd_rings=(0.05, 1.0), ipc=(0.01, 1.0)))
        self.assertEqual(title(vbd=(0.2, 1.0), vbd_rings=(0.19, 1.0)), "Fig. 2. OGC's contact set bulges the sheet")
        for longer, words in ((1.1, "with r of ten edges, too"),
                              (3.9, "with r of ten edges it blows it up, edges 3.9 times as long")):
            self.assertEqual(title(vbd=(0.01, 1.0), vbd_wide=(1.0, longer)),
                             f"Fig. 2. OGC's contact set leaves the sheet smooth; {words}")

    def test_angle_defects_see_bulges_and_no_folds(self):
        side = 9
        grid = np.array([[x, y, 0.0] for x in range(side) for y in range(side)])
        at = lambda x, y: x * side + y  # noqa: E731
        triangles = np.array([corners for x in range(side - 1) for y in range(side - 1)
                              for corners in ((at(x, y), at(x + 1, y), at(x + 1, y + 1)),
                                              (at(x, y), at(x + 1, y + 1), at(x, y + 1)))])
        folded = grid.copy()
        beyond = folded[:, 0] > 4
        folded[beyond, 2], folded[beyond, 0] = folded[beyond, 0] - 4, 4
        self.assertLess(fig02.angle_defects(folded, triangles).max(), 1e-14, "rounding of a sum of six angles")
        for height in (0.05, 0.1):  # 3 a², less a term of a⁴: all angles are analytic in a²
            bulged = grid.copy()
            bulged[at(4, 4), 2] = height
            defect = fig02.angle_defects(bulged, triangles).max()
            self.assertLess(abs(defect - 3 * height**2), 3 * height**4)
        self.assertEqual(len(fig02.angle_defects(grid, triangles)), (side - 2) ** 2)

    def test_runs_of_fig_2_leave_out_the_neighbours_within_reach(self):
        pairs = list(half_turn.near_pairs(4, 1.5))
        self.assertIn([5, 10], pairs)
        self.assertIn([5, 8], pairs)
        self.assertNotIn([5, 7], pairs)
        self.assertEqual(len(pairs), 2 * 12 + 2 * 9)  # sides and diagonals of nine cells
        jobs = half_turn.ogc("small")
        self.assertEqual([job.name for job in jobs if job.scene], ["vbd_rings", "vbd_wide_excluded"])
        self.assertEqual({job.name for job in (*jobs, *half_turn.ipc("small"))}, set(fig02.NAMES))

    def test_fig_2_goes_on_without_a_run_of_ipc_of_which_no_step_ended_in_its_time(self):
        def made(_ogc, job, _folder):
            if job.name == "ipc_stiff":
                raise RunError("no step yet")
            return job.name
        with tempfile.TemporaryDirectory() as name, mock.patch.object(fig02, "run_job", made):
            arguments = SimpleNamespace(folder=name, made=False, ogc="", scale="small", backend="cpu", membrane="m")
            with self.assertRaisesRegex(RunError, "no step yet"):
                fig02.runs_of(arguments)
            (Path(name) / "ipc_stiff").mkdir()
            (Path(name) / "ipc_stiff" / ENDED_BY_TIME).write_text("{}")
            self.assertEqual(set(fig02.NAMES) - set(fig02.runs_of(arguments)), {"ipc_stiff"})

    def test_fig_2_shows_ogc_where_ipc_ended_and_where_its_window_began(self):
        def run_of(solver, steps, frames):
            run = SimpleNamespace(frames=[Path(f"frame_{step:06d}.h5") for step in frames],
                                  column=lambda name: np.array(steps), frame=lambda path: int(path.stem[6:]),
                                  manifest={"solver": solver})
            run.frame_at_step = lambda step: min(frames, key=lambda other: abs(other - step))
            return run
        ogc = run_of("vbd", range(1, 61), (0, 20, 40, 60))
        ipc, window = run_of("ipc", range(1, 46), (0, 20, 40, 45)), run_of("ipc", range(21, 31), (20, 30))
        self.assertEqual([fig02.frame_beside(run, []) for run in (ogc, ipc, window)], [60, 45, 30])
        self.assertEqual([fig02.frame_beside(ogc, others) for others in ([ipc], [window], [ipc, window])],
                         [40, 20, 40])

    def test_fig_15_marks_the_first_meeting_of_the_kept_row_where_no_window_is(self):
        run = SimpleNamespace(steps={}, column=lambda name: np.arange(1, 4), setting=lambda name: 0.5,
                              manifest={"commit": "055befcaf0c39a"})
        rows = [{"run": "a", "first meeting at step": "", "mean tension there [N]": "", "commit": "055befcaf0"},
                {"run": "b", "first meeting at step": "6", "mean tension there [N]": "0.25", "commit": "055befcaf0"}]
        self.assertEqual(yarn.first_pull("b", run, {}, rows), (3.0, 0.25))
        self.assertIsNone(yarn.first_pull("a", run, {}, rows))
        other = [{**row, "commit": "2112a0acd6"} for row in rows]
        self.assertIsNone(yarn.first_pull("b", run, {}, other), "another program's threads meet elsewhere")

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

    def test_the_readers_answers_are_those_that_the_document_counts(self):
        rows = rows_of("answers")
        self.assertEqual([row["figure"] for row in rows], untitled.FIGURES)
        right = sum(row["right"] == "yes" for row in rows)
        self.assertIn(f"named {right} of the {len(rows)} claims", (RESULTS.parent / "README.md").read_text())
        self.assertTrue(all(len(row["answer"].split()) > 5 and (RESULTS / row["picture"]).is_file() for row in rows))

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
