"""Fig. 18 without IPC and Newton: VBD-OGC on one layer of cloth on a sphere. Draws time and detections in each step,
and frames 0, 25, 50 and 75."""

from paper_figures.workflow.common import main

CAMERA = ((1.34, 0.8, 1.62), (-0.05, -0.06, 0.0), (0, 1, 0))

if __name__ == "__main__":
    main("cloth_on_sphere", frames=(0, 25, 50, 75), camera=CAMERA)
