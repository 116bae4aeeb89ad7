"""Fig. 18 without IPC and Newton: VBD-OGC on one layer of cloth on a sphere. Draws the states at steps 0, 25, 50 and
75, time, detections and distances."""

from paper_figures.workflow.common import main

TITLE = "Fig. 18, VBD-OGC alone. A cloth falls onto a sphere"
ALT = ("Four renderings of a square cloth that falls onto a sphere, wraps it and hangs down on all sides in folds.")

if __name__ == "__main__":
    main("cloth_on_sphere", (0, 25, 50, 75), TITLE, ALT)
