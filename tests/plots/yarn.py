"""Yarn is drawn as tubes of its diameter whose plies turn with the frames, and lie on a helix of one hand however its
segments are numbered; the picture of a run has it, and frames that are twisted change what is seen, not its outline.

Usage: yarn.py SOURCE_DIR OGC. Exit status 77: skipped, numpy or h5py is missing; without PyVista pictures are left out.
"""

import dataclasses
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SOURCE, OGC = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
del sys.argv[1:3]
sys.path.insert(0, str(SOURCE))
try:
    import numpy as np

    from plots import camera, render, style, yarn
    from ogc_testbed.runs import Run, RunError
    from plots.bodies import bodies_of
except ImportError as missing:
    print(f"SKIPPED: {missing}")
    sys.exit(77)

ALONG_X = (0, 0.5**0.5, 0, 0.5**0.5)  # turns e₃ to e₁
DIAMETER = 0.2


def product(p, q):
    """Of quaternions x, y, z, w [n, 4]."""
    v = p[:, 3:] * q[:, :3] + q[:, 3:] * p[:, :3] + np.cross(p[:, :3], q[:, :3])
    return np.hstack([v, p[:, 3:] * q[:, 3:] - np.sum(p[:, :3] * q[:, :3], axis=1, keepdims=True)])


def turned(orientations, angles):
    """Each frame about its own director."""
    half = np.asarray(angles)[:, None] / 2 * np.ones((len(orientations), 1))
    return product(orientations, np.hstack([0 * half, 0 * half, np.sin(half), np.cos(half)]))


class Tubes(unittest.TestCase):
    def setUp(self):
        count = 9
        self.positions = np.stack([np.linspace(0, 1, count), np.zeros(count), np.zeros(count)], axis=1)
        self.segments = np.stack([np.arange(count - 1), np.arange(1, count)], axis=1)
        self.orientations = np.tile(ALONG_X, (count - 1, 1))

    def tubes(self, segments, orientations, pitch=1.0):
        lengths = np.linalg.norm(self.positions[segments[:, 1]] - self.positions[segments[:, 0]], axis=1)
        chains = yarn.chains(segments, len(self.positions))
        colours = np.tile(yarn.plies_of("#0072B2"), (len(segments), 1, 1))
        return yarn.tubes(self.positions, segments, orientations, yarn.angles_of(chains, lengths, pitch), DIAMETER,
                          colours)

    def helix(self, points, pitch=1.0):
        """(place along the yarn, angle about it less that of a right-handed helix, modulo a turn of the plies)."""
        return np.mod(np.arctan2(points[:, 2], points[:, 1]) - 2 * np.pi * points[:, 0] / pitch, 2 * np.pi / yarn.PLIES)

    def test_its_surface_reaches_as_far_as_its_diameter_and_no_farther(self):
        points, triangles, colours = self.tubes(self.segments, self.orientations)
        reach = np.hypot(points[:, 1], points[:, 2])
        self.assertAlmostEqual(reach.max(), DIAMETER / 2, delta=0.02 * DIAMETER)
        self.assertLessEqual(reach.max(), DIAMETER / 2 * (1 + 1e-12))
        self.assertGreaterEqual(reach.min(), DIAMETER / 2 * (1 - yarn.GROOVE) * (1 - 1e-12))
        self.assertLess(triangles.max(), len(points))
        self.assertEqual({tuple(c) for c in colours.tolist()},
                         {tuple(c) for c in yarn.plies_of("#0072B2").astype(np.uint8).tolist()})

    def test_the_helix_turns_once_a_pitch_with_one_hand_whichever_way_segments_point(self):
        reversed_ones = self.segments.copy()
        reversed_ones[::2] = reversed_ones[::2, ::-1]
        half_turn = np.tile((0.0, 0.0, 0.0, 1.0), (len(self.segments), 1))
        half_turn[::2] = (0.0, 1.0, 0.0, 0.0)  # e₃ to −e₃, e₂ stays
        # Reversed frames: half a turn about e₂, so that R e₃ points along the segment.
        for segments, frames in ((self.segments, self.orientations),
                                 (reversed_ones, product(self.orientations, half_turn))):
            points, _, _ = self.tubes(segments, frames)
            backs = points[np.hypot(points[:, 1], points[:, 2]) > 0.99 * DIAMETER / 2]
            phase = np.exp(1j * yarn.PLIES * self.helix(backs))
            self.assertGreater(abs(phase.mean()), 0.95)  # angles lie within a side of the tube of the helix

    def test_turned_frames_turn_the_plies_as_far(self):
        quarter = turned(self.orientations, np.full(len(self.orientations), np.pi / 2))
        before, _, colours = self.tubes(self.segments, self.orientations)
        after, _, same = self.tubes(self.segments, quarter)
        self.assertTrue((colours == same).all())
        # About x, along which the tube lies: y to z.
        self.assertTrue(np.allclose(after, np.stack([before[:, 0], -before[:, 2], before[:, 1]], axis=1), atol=1e-12))

    def test_frames_of_a_start_lie_along_their_segments_and_have_no_twist(self):
        bent = self.positions + np.stack([np.zeros(9), np.sin(np.arange(9)), np.cos(np.arange(9))], axis=1)
        chains = yarn.chains(self.segments, 9)
        frames = yarn.untwisted(chains, bent, self.segments)
        directions = np.diff(bent, axis=0)
        directions /= np.linalg.norm(directions, axis=1)[:, None]
        self.assertTrue(np.allclose(yarn.rotated(frames, 2), directions, atol=1e-12))
        turns = product(frames[1:], frames[:-1] * (-1, -1, -1, 1))  # about no part of the bisector
        self.assertTrue(np.allclose(np.sum(turns[:, :3] * (directions[1:] + directions[:-1]), axis=1), 0, atol=1e-12))

    def test_chains_end_where_not_two_segments_meet_and_rings_close(self):
        star = np.array([[0, 1], [1, 2], [3, 1], [4, 5], [5, 6], [6, 4]])
        found = sorted(sorted(e for e, _ in links) for links in yarn.chains(star, 8))
        self.assertEqual(found, [[0], [1], [2], [3, 4, 5]])


class Drawn(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        holder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(holder.cleanup)
        cls.folder = Path(holder.name) / "run"
        command = [OGC, "run", "yarn_twist", "--scale", "smoke", "--steps", "4", "--audit", "off", "--out", cls.folder]
        subprocess.run(list(map(str, command)), check=True, capture_output=True)
        cls.run_folder = Run(cls.folder)

    def picture(self, frame):
        seen = camera.of_ends(self.run_folder, (1280, 720))
        return render.picture(bodies_of(self.run_folder, frame), seen, bar=False).astype(int)

    def test_a_frame_has_an_orientation_of_each_segment_and_a_changed_one_is_damaged(self):
        import h5py
        path = self.run_folder.frames[-1]
        frame, body = self.run_folder.frame(path), self.run_folder.bodies()[0]
        self.assertEqual(len(frame.orientations), len(body["segments"]))
        directions = np.diff(frame.positions[body["segments"]].astype(float), axis=1)[:, 0]
        along = np.sum(directions * yarn.rotated(frame.orientations.astype(float), 2), axis=1)
        self.assertGreater((along / np.linalg.norm(directions, axis=1)).min(), 0.9)
        with tempfile.TemporaryDirectory() as name:
            copy = Path(name) / path.name
            copy.write_bytes(path.read_bytes())
            with h5py.File(copy, "r+") as file:
                file["orientations"][0] = (0, 0, 0, 1)
            with self.assertRaisesRegex(RunError, "damaged"):
                self.run_folder.frame(copy)

    @unittest.skipUnless(render.available()[0], "PyVista is not installed: pictures are left out")
    def test_the_picture_has_the_yarn_and_twisted_frames_change_what_is_seen_not_its_outline(self):
        frame = self.run_folder.frame(self.run_folder.frames[-1])
        count = len(frame.orientations)
        twisted = turned(frame.orientations.astype(float), np.linspace(0, 40 * np.pi, count))
        plain = self.picture(frame)
        other = self.picture(dataclasses.replace(frame, orientations=twisted))
        ground = np.round(255 * np.array(style.rgb(style.GROUND)))
        seen, seen_then = (np.abs(image - ground).max(axis=2) > 8 for image in (plain, other))
        self.assertGreater(seen.mean(), 0.03)
        self.assertLess(seen.mean(), 0.9)
        blue = plain[..., 2] - plain[..., 0] > 20  # of both plies
        self.assertGreater((blue & seen).sum() / seen.sum(), 0.5)
        changed = np.abs(plain - other).max(axis=2) > 40
        self.assertGreater((changed & seen & seen_then).sum() / seen.sum(), 0.15)
        self.assertLess((seen != seen_then).sum() / seen.sum(), 0.15)
        self.assertEqual(np.abs(plain - self.picture(frame)).max(), 0)  # and nothing else does


if __name__ == "__main__":
    unittest.main()
