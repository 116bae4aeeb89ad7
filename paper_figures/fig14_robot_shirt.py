"""Fig. 14: two grippers lift a T-shirt by its shoulders, shake it, fold it; time, contacts, lag of the grippers, four frames."""

from paper_figures.common import main

CAMERA = ((1.3, 1.1, 1.7), (0, 0.3, -0.35), (0, 1, 0))

if __name__ == "__main__":
    main("robot_shirt", frames=(0, 1200, 2220, 3600), camera=CAMERA, driven=True)
