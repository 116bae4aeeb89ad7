"""Fig. 10: fifty square cloths fall onto a cylinder, collide, slide to the ground and come to rest. Draws time,
contacts, distances and four frames."""

from paper_figures.workflow.common import main

CAMERA = ((2.05, 1.05, 2.65), (0.05, -0.2, 0.12), (0, 1, 0))

if __name__ == "__main__":
    main("fifty_layers", frames=(0, 1600, 3200, 4800), camera=CAMERA)
