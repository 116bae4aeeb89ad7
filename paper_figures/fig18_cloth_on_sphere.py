"""Fig. 18 as far as it exists: time and detections a step of VBD-OGC on one layer of cloth on a sphere, and frames 0, 25, 50, 75."""

from paper_figures.common import main

CAMERA = ((1.2, 0.72, 1.45), (-0.08, -0.06, 0.0), (0, 1, 0))

if __name__ == "__main__":
    main("cloth_on_sphere", frames=(0, 25, 50, 75), camera=CAMERA)
