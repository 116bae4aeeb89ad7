"""The look of the figures: colours that colour-blind readers tell apart, cameras that show all of a subject, scale bars
of a round length, names beside lines that do not touch.

Usage: look.py SOURCE_DIR. Exit status 77: skipped, matplotlib is missing.
"""

import itertools
import sys
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(sys.argv.pop(1)).resolve()
sys.path.insert(0, str(SOURCE))
try:
    import numpy as np
    from plots import render, style
except ImportError as missing:
    print(f"SKIPPED: {missing}")
    sys.exit(77)

# ΔE (CIE 1976) of about 2.3 is just noticeable beside one another; four times that is told apart across a picture.
APART = 4 * 2.3
WHITE = np.array([0.95047, 1.0, 1.08883])  # D65


def linear(colour):
    rgb = np.array(style.rgb(colour))
    return np.where(rgb <= 0.04045, rgb / 12.92, ((rgb + 0.055) / 1.055) ** 2.4)


def lab(rgb):
    """CIE L*a*b* of linear sRGB."""
    xyz = np.array([[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]]) @ rgb / WHITE
    x, y, z = np.where(xyz > 0.008856, np.cbrt(xyz), 7.787 * xyz + 16 / 116)
    return np.array([116 * y - 16, 500 * (x - y), 200 * (y - z)])


def seen(colour, simulation):
    return lab(np.clip(np.array(simulation) @ linear(colour), 0, 1))


def nearest(colours, simulation):
    """The smallest ΔE of two of the colours, and those two."""
    return min((float(np.linalg.norm(seen(a, simulation) - seen(b, simulation))), a, b)
               for a, b in itertools.combinations(colours, 2))


class Colours(unittest.TestCase):
    SETS = {"lines": style.COLOURS, "sides of a sheet and a body": (style.FRONTS[0], style.BACKS[0], style.BODY),
            "ours, a baseline and the paper's": (style.OURS, style.BASELINE, style.PAPER),
            "marks on sheets": (style.MARK, style.FRONTS[0], style.BACKS[0], style.BODY)}

    def test_readers_with_and_without_all_cones_tell_them_apart(self):
        for simulation in (np.eye(3), style.DEUTERANOPIA):
            for name, colours in self.SETS.items():
                self.assertGreater(nearest(colours, simulation)[0], APART, (name, nearest(colours, simulation)))

    def test_red_and_green_of_one_lightness_would_be_found(self):
        self.assertGreater(nearest(("#C8553D", "#4C8B2B"), np.eye(3))[0], APART)
        self.assertLess(nearest(("#B0702B", "#7D8A2B"), style.DEUTERANOPIA)[0], APART)

    def test_the_simulation_keeps_greys(self):
        """Each row of the matrix sums to 1."""
        np.testing.assert_allclose(np.sum(style.DEUTERANOPIA, axis=1), 1, atol=2e-6)


class Cameras(unittest.TestCase):
    def places(self, camera, points, size):
        """x and y of the points in the picture, from −1 to 1."""
        eye, target, up = map(np.array, camera)
        back = (eye - target) / np.linalg.norm(eye - target)
        right = np.cross(up, back) / np.linalg.norm(np.cross(up, back))
        away = points - eye
        deep = -(away @ back) * np.tan(np.radians(render.ANGLE / 2))
        return np.stack([away @ right / deep * size[1] / size[0], away @ np.cross(back, right) / deep])

    def test_all_of_the_subject_is_inside_the_margin_and_touches_it(self):
        random = np.random.default_rng(3)
        for towards, size in itertools.product(((0.5, 0.3, 1), (0, 1, 0.01), (-1, 0.2, 0.1)), ((960, 640), (480, 720))):
            view = render.View(towards, margin=0.05)
            points = random.uniform(-1, 1, (200, 3)) * (2, 0.3, 0.7) + (5, 1, -3)
            places = np.abs(self.places(view.fit(points, size), points, size))
            self.assertLessEqual(places.max(), 1 - 2 * view.margin + 1e-9)
            self.assertAlmostEqual(places.max(), 1 - 2 * view.margin, places=9, msg="nearer would still show all")

    def test_a_picture_has_the_shape_of_its_subject_within_limits(self):
        square = np.array([[0, 0, 0], [1, 1, 0]])
        for scale, expected in (((1, 1, 1), 0.8), ((1, 0.01, 1), 0.38), ((1, 0.5, 1), 0.56)):
            width, height = render.shape_of(render.View((0, 0, 1)), square * scale, 960)
            self.assertEqual((width, height % 16), (960, 0))
            self.assertAlmostEqual(height / width, expected, delta=0.02)


class Bars(unittest.TestCase):
    def test_lengths_are_round_and_take_between_a_tenth_and_a_quarter_of_the_width(self):
        for metre in np.geomspace(1e-4, 90, 300):
            length, words = render.bar_of(metre)
            number, unit = words.split()
            self.assertIn(number.lstrip("0.").rstrip("0") or number, {"1", "2", "5"})
            self.assertAlmostEqual(float(number) * {"m": 1, "cm": 1e-2, "mm": 1e-3, "µm": 1e-6}[unit], length)
            self.assertTrue(render.BAR_SHARE / 2.5 - 1e-9 <= length / metre <= render.BAR_SHARE + 1e-9, (metre, words))


class Pages(unittest.TestCase):
    def test_names_beside_lines_do_not_touch(self):
        style.use()
        figure, ((axes,),) = style.page([(2.5, [(1, "plot")])], "A clause", "words")
        for number in range(5):
            axes.plot([0, 1], [0, 0.01 * number], label=f"line {number}")
        style.label_ends(axes)
        figure.canvas.draw()
        boxes = sorted((text.get_window_extent() for text in axes.texts), key=lambda box: box.y0)
        self.assertEqual(len(boxes), 5)
        for low, high in zip(boxes, boxes[1:]):
            self.assertLessEqual(low.y1, high.y0 + 2)  # pixels
        self.assertGreater(min(box.x0 for box in boxes), axes.get_window_extent().x1, "off the data")

    def test_names_beside_lines_stay_beside_their_panel(self):
        style.use()
        figure, ((axes,),) = style.page([(1.6, [(0.5, "plot")])], "title")
        for number in range(9):
            axes.plot([0, 1], [0, 1e-3 * number], label=f"a name of\nline {number}")
        axes.set_ylim(0, 9)
        style.label_ends(axes)
        figure.canvas.draw()
        inside = axes.get_window_extent()
        for text in axes.texts:
            box = text.get_window_extent()
            self.assertGreater(box.y0, inside.y0 - 0.02 * inside.height, text.get_text())
            self.assertLess(box.y1, inside.y1 + 0.02 * inside.height, text.get_text())
        style.plt.close(figure)

    def test_a_picture_fills_its_place_and_a_caption_lies_beside_the_file(self):
        style.use()
        figure, (row,) = style.page([style.pictures(2, (300, 200))], "A clause")
        for axes in row:
            box = axes.get_window_extent()
            self.assertAlmostEqual(box.height / box.width, 200 / 300, places=3)
        with tempfile.TemporaryDirectory() as folder:
            out = Path(folder) / "fig.png"
            style.save(figure, out, "A clause", "what is seen", "ogc run; commit 1")
            self.assertIn("what is seen", out.with_suffix(style.CAPTION).read_text())
            self.assertTrue(out.is_file() and out.with_suffix(".pdf").is_file())


if __name__ == "__main__":
    unittest.main()
