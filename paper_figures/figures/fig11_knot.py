"""Fig. 11: a long strip with four overhand knots, pulled at both ends; time, contacts, distances, four frames."""

from paper_figures.workflow.common import main

CAMERA = ((-0.3, 0.0, 2.15), (-0.3, -0.13, 0), (0, 1, 0))

if __name__ == "__main__":
    main("knot", frames=(0, 3550, 7100, 10650), camera=CAMERA)
