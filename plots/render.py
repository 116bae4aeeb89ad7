"""Renders meshes off-screen. Needs PyVista, and imageio for movies; `available()` checks for them."""

import numpy as np


def available():
    """Returns (True, "") or (False, the reason in words)."""
    try:
        import pyvista  # noqa: F401
    except ImportError as error:
        return False, f"PyVista can't be imported ({error}); install plots/requirements.txt to render meshes"
    return True, ""


def picture(bodies, camera, size=(640, 480)):
    """Returns an RGB image of `bodies`, each (points [n, 3], triangles [m, 3], front colour, back colour), seen from
    camera = (eye, target, up). The front colour may be an array with the RGB of each point [n, 3] if the body is a
    closed surface, whose back is never visible.

    Front and back of sheets have different colours, so that folds are visible; ambient occlusion makes contacts
    readable.
    """
    import pyvista as pv
    from vtkmodules.vtkCommonCore import vtkLogger

    # without a display VTK warns and continues
    vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_ERROR)
    pv.OFF_SCREEN = True
    plotter = pv.Plotter(off_screen=True, window_size=list(size))
    plotter.set_background("white")
    for points, triangles, front, back in bodies:
        faces = np.hstack([np.full((len(triangles), 1), 3), triangles]).ravel()
        mesh = pv.PolyData(np.asarray(points, dtype=float), faces)
        colour = ({"color": front, "backface_params": {"color": back}} if isinstance(front, str)
                  else {"scalars": front, "rgb": True})
        plotter.add_mesh(mesh, smooth_shading=True, ambient=0.25, diffuse=0.85, specular=0.1, **colour)
    extent = np.linalg.norm(np.ptp(np.concatenate([points for points, *_ in bodies]), axis=0))
    # a close camera sees only a part of the scene, which limits the scale of ambient occlusion
    extent = min(extent, 2 * np.linalg.norm(np.subtract(camera[0], camera[1])))
    plotter.enable_ssao(radius=0.05 * extent, bias=0.001 * extent, kernel_size=64, blur=True)
    plotter.enable_anti_aliasing("ssaa")
    plotter.camera_position = [tuple(camera[0]), tuple(camera[1]), tuple(camera[2])]
    image = plotter.screenshot(return_img=True)
    plotter.close()
    return image


def write_movie(scenes, camera, out, frames_per_second, size=(640, 480)):
    """Writes an MP4 (H.264) with a picture of each element of `scenes`; elements are like `bodies` of `picture`.
    Returns the result of `available`."""
    usable, reason = available()
    try:
        import imageio
        import imageio_ffmpeg  # the encoder, which imageio finds by itself
    except ImportError as error:
        return False, f"a package for movies can't be imported ({error}); install plots/requirements.txt"
    if usable:
        with imageio.get_writer(out, fps=frames_per_second, codec="libx264", quality=5, macro_block_size=16,
                                ffmpeg_log_level="error") as writer:
            for bodies in scenes:
                writer.append_data(picture(bodies, camera, size))
    return usable, reason
