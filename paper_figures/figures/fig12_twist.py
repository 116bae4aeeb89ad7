"""Fig. 12: a square cloth twisted at its two ends, with planes. Draws time, contacts, distances and four frames."""

from paper_figures.workflow.common import main

CAMERA = ((0.7, 1.15, 2.15), (0, 0, 0), (0, 1, 0))

if __name__ == "__main__":
    main("twist", frames=(0, 3200, 6400, 9600), camera=CAMERA)
