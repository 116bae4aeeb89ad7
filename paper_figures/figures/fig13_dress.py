"""Fig. 13: a dress of 14 stitched panels on a moving body. Draws time, contacts, the body's lag and four frames, for
the stand-in or for Codimensional IPC's dress and dancer (ogc run dress --set data=DIR)."""

from paper_figures.workflow.common import main

CAMERAS = {"bodice1": ((1.3, 0.95, 2.85), (0, 0.92, 0), (0, 1, 0)),
           "panel0": ((0.85, 0.3, 2.4), (0, 0.165, 0), (0, 1, 0))}  # camera by the name of the first body


def camera(run):
    return CAMERAS[run.manifest["scene"]["bodies"][0]["name"]]


if __name__ == "__main__":
    main("dress", frames=(0, 320, 640, 968), camera=camera, driven=True)
