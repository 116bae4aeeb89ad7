"""Fig. 13: a dress of 14 stitched panels on a body that moves; time, contacts, lag of the body, four frames. The run
may be of Codimensional IPC's dress and dancer (ogc run dress --set data=DIR) as well as of the stand-in."""

from paper_figures.workflow.common import main

CAMERAS = {"bodice1": ((1.3, 0.95, 2.85), (0, 0.92, 0), (0, 1, 0)),
           "panel0": ((0.85, 0.3, 2.4), (0, 0.165, 0), (0, 1, 0))}  # by the first body's name


def camera(run):
    return CAMERAS[run.manifest["scene"]["bodies"][0]["name"]]


if __name__ == "__main__":
    main("dress", frames=(0, 320, 640, 968), camera=camera, driven=True)
