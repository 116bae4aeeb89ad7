"""Fig. 14: two grippers lift a T-shirt by its shoulders, shake it and fold it. Draws time, contacts, the grippers' lag
and four frames."""

from paper_figures.workflow.common import main

CAMERA = ((0.92, 0.72, 1.15), (0, 0.14, -0.28), (0, 1, 0))

if __name__ == "__main__":
    main("robot_shirt", frames=(0, 1200, 2220, 3600), camera=CAMERA, driven=True)
