"""Fig. 10: fifty square cloths fall onto a cylinder, collide with each other, slide to the ground and rest; time, contacts, distances, four frames."""

from paper_figures.common import main

CAMERA = ((1.7, 0.9, 2.3), (-0.1, -0.1, 0), (0, 1, 0))

if __name__ == "__main__":
    main("fifty_layers", frames=(0, 1600, 3200, 4800), camera=CAMERA)
