"""Draws what intersects, from a file that `ogc audit --show` wrote: inside the whole mesh where that is named, and from
near. Triangles are vermilion, edges that intersect one are blue, and the rest is grey.

Usage: python3 -m plots.offenders crossings/frame_3.vtp [--mesh frame_3.obj] [--out PNG]
"""

import argparse
import sys
from pathlib import Path

from plots import render

FROM = (1, 0.7, 1)  # direction of view


def draw(part, whole, out):
    """Draws the intersections. `part`: file of `ogc audit --show`; `whole`: file of the mesh, or None; `out`: PNG."""
    import pyvista as pv
    from vtkmodules.vtkCommonCore import vtkLogger

    vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_ERROR)  # hides VTK's message that there is no display
    offenders = pv.read(part)
    around = [] if whole is None else [pv.read(whole).extract_surface(algorithm=None)]
    plotter = pv.Plotter(off_screen=True, shape=(1, 1 + len(around)), window_size=(640 * (1 + len(around)), 480))
    plotter.set_background("white")
    for column, target in enumerate([*around, offenders]):
        plotter.subplot(0, column)
        for mesh in around:
            plotter.add_mesh(mesh, color="#B0B0B0", opacity=0.4)
        plotter.add_mesh(pv.PolyData(offenders.points, faces=offenders.faces), color="#D55E00", ambient=0.3)
        plotter.add_mesh(pv.PolyData(offenders.points, lines=offenders.lines), color="#0072B2", line_width=4)
        plotter.view_vector(FROM)
        plotter.reset_camera(bounds=target.bounds)
    plotter.screenshot(out)
    plotter.close()


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("part", type=Path, help="a .vtp of `ogc audit --show`")
    parser.add_argument("--mesh", type=Path, help="the audited mesh (OBJ, PLY, STL, VTP, VTU), drawn around it")
    parser.add_argument("--out", type=Path, help="PNG to write (default: beside the .vtp)")
    options = parser.parse_args()
    usable, reason = render.available()
    for path in (path for path in (options.part, options.mesh) if path and not path.is_file()):
        parser.error(f"there is no file {path}")
    if not usable:
        sys.exit(f"offenders: {reason}")
    draw(options.part, options.mesh, options.out or options.part.with_suffix(".png"))


if __name__ == "__main__":
    main()
