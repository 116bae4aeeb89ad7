"""Fig. 11: a long strip with four overhand knots, pulled at both ends, with planes. Draws time, contacts, distances,
four frames, and a close view of the tight knot in the last state."""

import numpy as np

from paper_figures.workflow.common import main

CAMERA = ((-0.3, 0.0, 2.15), (-0.3, -0.13, 0), (0, 1, 0))
REACH = 0.06  # size of the close view, about that of the tight knot [m]
ROUNDS = 10  # iterations of the mean shift, which converges after a few


def near(positions):
    """Returns the camera that looks along −z at the place where most vertices lie close together."""
    _, cell, counts = np.unique(np.floor(positions / REACH), axis=0, return_inverse=True, return_counts=True)
    centre = positions[cell.ravel() == np.argmax(counts)].mean(axis=0)
    for _ in range(ROUNDS):
        centre = positions[np.linalg.norm(positions - centre, axis=1) < REACH].mean(axis=0)
    return (centre + REACH * np.array([0, 0.5, 5])).tolist(), centre.tolist(), (0, 1, 0)


if __name__ == "__main__":
    main("knot", frames=(0, 3550, 7100, 10650), camera=CAMERA, near=near)
