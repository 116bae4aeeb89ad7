"""Vertices that single precision can't move by their bounds are found, others are not; so are triangles without area
and the vertices beside them.

Usage: standing_still.py SOURCE_DIR. Exit status 77: skipped, numpy or h5py is missing.
"""

import sys
import unittest
from pathlib import Path

SOURCE = Path(sys.argv.pop(1)).resolve()
sys.path.insert(0, str(SOURCE))
try:
    import numpy as np

    from plots import standing_still
except ImportError as missing:
    print(f"SKIPPED: {missing}")
    sys.exit(77)


class StandingStill(unittest.TestCase):
    def test_bounds_are_held_against_the_spacing_at_the_coordinates(self):
        # spacings 2^-23; 2^-23, none to speak of, 2^-25; 2^-21 … 2^-24
        positions = np.array([[1, 1, 1], [1, 0, 0.25], [4, 1, 0.5], [1, 1, 1]], dtype=np.float32)
        bounds = np.array([2.0**-24, 2.0**-24, 2.0**-24.5, 2.0**-22], dtype=np.float32)
        still, along = standing_still.standing(positions, bounds)
        self.assertEqual((still.tolist(), along.tolist()), ([True, False, True, False], [True, True, True, False]))

    def test_a_vertex_that_is_said_to_stand_still_does(self):
        """No neighbour on the grid of single precision lies in the ball of the bound."""
        random = np.random.default_rng(1)
        for _ in range(200):
            x = random.uniform(-2, 2, 3).astype(np.float32)
            bound = np.float32(10.0 ** random.uniform(-9, -6))
            nearest = min(abs(float(np.nextafter(c, np.float32(toward))) - float(c)) for c in x for toward in (-4, 4))
            if not standing_still.standing(x[None], np.array([bound]))[0][0]:
                self.assertLessEqual(nearest, float(bound))
            elif nearest <= float(bound):  # towards 0 the spacing below a power of two is half of that above it
                self.assertTrue(any(abs(c) == 2.0 ** np.round(np.log2(abs(c))) for c in x))

    def test_a_collapsed_triangle_is_found_and_what_is_beside_it(self):
        """A strip of five triangles. The first one has its third corner on its first edge."""
        positions = np.array([[0, 0, 0], [0, 1, 0], [0, 0.5, 1e-6], [1, 1, 0], [2, 0, 0], [2, 1, 0], [3, 0, 0]])
        triangles = np.array([[0, 1, 2], [1, 2, 3], [2, 3, 4], [3, 4, 5], [4, 5, 6]])
        area = standing_still.areas(positions, triangles)
        self.assertAlmostEqual(area[0], 0.5e-6)
        self.assertEqual(area[3:].tolist(), [0.5, 0.5])
        near = standing_still.beside(triangles, area < standing_still.COLLAPSED, len(positions))
        self.assertEqual(near.tolist(), [True, True, True, True, True, False, False])
        self.assertFalse(standing_still.beside(triangles, np.zeros(5, dtype=bool), len(positions)).any())


if __name__ == "__main__":
    unittest.main()
