"""Renders meshes off-screen, all in one look: smooth normals, soft lights, ambient occlusion, two calm colours for the
sides of sheets, rims and seams as lines, a floor that fades into the background, and a scale bar. Needs PyVista, and
imageio for movies; `available()` checks for them.

A body is (points [n, 3], triangles [m, 3], front colour, back colour). The front may be an array with the RGB of each
point [n, 3] if the back is never visible.
"""

from dataclasses import dataclass

import numpy as np

from plots import style

ANGLE = 30  # vertical angle of view [degrees]
# A picture is rendered so many times as large and then reduced, against stairs and noise; less for movies, of which
# each second takes thirty.
FINER, FINER_IN_MOVIES = 2, 1.5
# Each light has a place around the camera (right, up, back) and an intensity: the key, a fill, and one from behind.
LIGHTS = (((-1.0, 1.6, 0.8), 0.80), ((1.2, 0.1, 1.2), 0.38), ((0.3, 1.0, -1.6), 0.25))
AMBIENT, DIFFUSE, SPECULAR, SHININESS = 0.34, 0.80, 0.10, 25
OCCLUSION = 0.045  # reach of ambient occlusion in diagonals of the subject
FLOOR_SIZE, FLOOR_PIXELS = 12, 1536  # side of the floor in diagonals of the subject; pixels of its texture
SHADOW, SHADOW_BLUR = 0.26, 0.035  # darkness of the shadow on the floor; its blur in diagonals of the subject
BAR_SHARE, ROUND_LENGTHS = 0.24, (5, 2, 1)  # the most of the picture's width that a scale bar takes; its first digit
UNITS = ((1, "m"), (1e-2, "cm"), (1e-3, "mm"), (1e-6, "µm"))
SHARP = 60  # angle of an edge of a closed body above which its sides are shaded apart [degrees]


@dataclass(frozen=True)
class View:
    """Describes a camera by the direction from the subject to the eye; `fit` places it so that the subject fills the
    picture. `margin`: share of the picture that stays free at each side."""

    towards_eye: tuple = (0.55, 0.35, 1.0)
    up: tuple = (0, 1, 0)
    margin: float = 0.05

    def axes(self):
        """Returns the camera's unit vectors to the right, up and back [3, 3]."""
        back = np.asarray(self.towards_eye, float) / np.linalg.norm(self.towards_eye)
        right = np.cross(self.up, back)
        right /= np.linalg.norm(right)
        return np.stack([right, np.cross(back, right), back])

    def fit(self, points, size):
        """Returns (eye, target, up) of the nearest camera that shows all `points` [n, 3] in a picture of this size. A
        point at (x, y, z) along the axes is inside if |x − eye x| ≤ (eye z − z) tan(half an angle), and likewise y."""
        axes = self.axes()
        x, y, z = axes @ np.asarray(points, float).T
        tangent = np.tan(np.radians(ANGLE / 2)) * (1 - 2 * self.margin)
        tangents = tangent * size[0] / size[1], tangent
        ends = [((a + z * t).max(), (a - z * t).min()) for a, t in zip((x, y), tangents)]
        far = max((high - low) / (2 * t) for (high, low), t in zip(ends, tangents))
        eye = np.array([*((high + low) / 2 for high, low in ends), far])
        target = np.array([eye[0], eye[1], (z.min() + z.max()) / 2])
        return tuple(eye @ axes), tuple(target @ axes), tuple(self.up)


def shape_of(view, points, width, flattest=0.38, tallest=0.8):
    """Returns the size (width, height) of a picture with about the shape of the `points` [n, 3] seen from afar."""
    x, y, _ = view.axes() @ np.asarray(points, float).T
    ratio = np.clip(np.ptp(y) / max(np.ptp(x), 1e-9) * 1.12, flattest, tallest)
    return width, int(round(width * ratio / 16)) * 16


def available():
    """Returns (True, "") or (False, the reason in words)."""
    try:
        import pyvista  # noqa: F401
    except ImportError as error:
        return False, f"PyVista can't be imported ({error}); install plots/requirements.txt to render meshes"
    return True, ""


def rims(triangles):
    """Returns the edges [k, 2] that belong to one triangle only."""
    edges = np.sort(triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    found, counts = np.unique(edges, axis=0, return_counts=True)
    return found[counts == 1]


def poly(points, triangles):
    """Returns the PyVista mesh of points and triangles."""
    import pyvista as pv

    return pv.PolyData(np.asarray(points, dtype=np.float32),
                       np.hstack([np.full((len(triangles), 1), 3), triangles]).ravel())


def _plotter(size, finer):
    import pyvista as pv
    from vtkmodules.vtkCommonCore import vtkLogger

    vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_ERROR)  # hides VTK's message that there is no display
    pv.OFF_SCREEN = True
    plotter = pv.Plotter(off_screen=True, window_size=[round(finer * pixels) for pixels in size], lighting="none")
    plotter.set_background(style.GROUND)
    return plotter


def _light(plotter, camera):
    import pyvista as pv

    eye, target, up = (np.asarray(part, float) for part in camera)
    axes = View(tuple(eye - target), tuple(up)).axes()
    for place, intensity in LIGHTS:
        light = pv.Light(position=tuple(target + np.asarray(place) @ axes * np.linalg.norm(eye - target)),
                         focal_point=tuple(target), intensity=intensity, light_type="scene light")
        light.positional = False
        plotter.add_light(light)
    return np.asarray(LIGHTS[0][0]) @ axes


def _add_body(plotter, body, wide):
    points, triangles, front, back = body
    if not len(triangles):
        return
    sheet = isinstance(front, str) and back is not None and front != back
    shade = {"ambient": AMBIENT, "diffuse": DIFFUSE, "specular": SPECULAR, "specular_power": SHININESS}
    if isinstance(front, str):
        colour = {"color": front, **({"backface_params": {"color": back, **shade}} if sheet else {}),
                  **({} if sheet else {"split_sharp_edges": True, "feature_angle": SHARP})}
    else:
        colour = {"scalars": np.asarray(front, np.uint8), "rgb": True}
    plotter.add_mesh(poly(points, triangles), smooth_shading=True, **shade, **colour)
    edges = rims(triangles) if sheet else ()
    if len(edges):
        _add_lines(plotter, points, edges, style.RIM, wide)


def _add_lines(plotter, points, edges, colour, wide):
    import pyvista as pv

    lines = pv.PolyData(np.asarray(points, np.float32), lines=np.hstack([np.full((len(edges), 1), 2), edges]).ravel())
    actor = plotter.add_mesh(lines, color=colour, line_width=wide, lighting=False)
    actor.mapper.SetResolveCoincidentTopologyToPolygonOffset()
    actor.mapper.SetRelativeCoincidentTopologyLineOffsetParameters(-1, -1)


def _shadow(points, triangles, light, height, corner, side):
    """Returns how dark the shadow is at each pixel of the floor's texture, from 0 to 1: triangles, as their corners and
    middles, are projected along the light."""
    corners = points[triangles].astype(float)
    places = np.concatenate([points, corners.mean(axis=1), (corners[:, 0] + corners[:, 1]) / 2])
    places = places[places[:, 1] >= height - 1e-6 * side]
    steep = max(light[1], 0.4 * np.linalg.norm(light))
    flat = places[:, [0, 2]] - (places[:, 1:2] - height) / steep * light[[0, 2]] * 0.5
    pixels = np.floor((flat - corner) / side * FLOOR_PIXELS).astype(int)
    inside = np.all((pixels >= 0) & (pixels < FLOOR_PIXELS), axis=1)
    hit = np.zeros((FLOOR_PIXELS, FLOOR_PIXELS), np.uint8)
    hit[pixels[inside, 1], pixels[inside, 0]] = 255
    return hit


def _add_floor(plotter, bodies, light, height):
    """Adds a floor at this height, with the shadow of the bodies, that fades into the background."""
    import pyvista as pv
    from PIL import Image, ImageFilter

    points = np.concatenate([np.asarray(body[0], float) for body in bodies])
    middle, diagonal = (points.min(axis=0) + points.max(axis=0)) / 2, np.linalg.norm(np.ptp(points, axis=0))
    side = FLOOR_SIZE * diagonal
    corner = middle[[0, 2]] - side / 2
    hit = np.zeros((FLOOR_PIXELS, FLOOR_PIXELS), np.uint8)
    for body in bodies:
        np.maximum(hit, _shadow(np.asarray(body[0], float), body[1], light, height, corner, side), out=hit)
    image = Image.fromarray(hit).filter(ImageFilter.MaxFilter(5)).filter(ImageFilter.MinFilter(3))
    dark = np.asarray(image.filter(ImageFilter.GaussianBlur(SHADOW_BLUR * FLOOR_PIXELS / FLOOR_SIZE)), float) / 255
    grid = (np.arange(FLOOR_PIXELS) + 0.5) / FLOOR_PIXELS - 0.5
    far = np.clip(np.hypot(*np.meshgrid(grid, grid)) / 0.5, 0, 1)
    fade = np.clip((far - 0.12) / 0.8, 0, 1)[..., None] ** 0.7
    colour = np.asarray(style.rgb(style.FLOOR)) * (1 - SHADOW * dark[..., None])
    colour = colour * (1 - fade) + np.asarray(style.rgb(style.GROUND)) * fade
    x0, z0 = corner
    low = height - 1e-4 * diagonal  # a sheet that rests on the floor covers it
    quad = pv.PolyData(np.array([[x0, low, z0], [x0 + side, low, z0], [x0 + side, low, z0 + side],
                                 [x0, low, z0 + side]], np.float32), faces=[4, 0, 1, 2, 3])
    quad.active_texture_coordinates = np.array([[0, 0], [1, 0], [1, 1], [0, 1]], np.float32)
    texture = pv.Texture((255 * colour[::-1]).astype(np.uint8))
    plotter.add_mesh(quad, texture=texture, lighting=False)


def picture(bodies, camera, size=(640, 480), floor=None, bar=True, marks=None, lines=(),
            finer=FINER):
    """Returns an RGB image of `bodies` seen from camera = (eye, target, up).

    `floor`: height of a floor to draw [m]. `bar`: draws a scale bar, which holds at the camera's target. `marks`
    [n, 3]: points to show as dots. `lines`: more lines, each (points [n, 3], edges [k, 2], colour). `finer`: the
    picture is rendered so many times as large."""
    plotter = _plotter(size, finer)
    light = _light(plotter, camera)
    wide = max(1.0, size[1] / 500) * finer
    for body in bodies:
        _add_body(plotter, body, wide)
    for points, edges, colour in lines:
        _add_lines(plotter, points, edges, colour, wide)
    if floor is not None:
        _add_floor(plotter, bodies, light, floor)
    extent = np.linalg.norm(np.ptp(np.concatenate([np.asarray(body[0]) for body in bodies]), axis=0))
    distance = np.linalg.norm(np.subtract(camera[0], camera[1]))
    extent = min(extent, 1.2 * distance)  # a close camera sees only a part of the scene
    if marks is not None and len(marks):
        dots = _dots(marks, 0.006 * distance)
        plotter.add_mesh(dots, color=style.MARK, ambient=0.5, smooth_shading=True)
    plotter.enable_ssao(radius=OCCLUSION * extent, bias=0.03 * OCCLUSION * extent, kernel_size=96, blur=True)
    plotter.camera_position = [tuple(camera[0]), tuple(camera[1]), tuple(camera[2])]
    plotter.camera.view_angle = ANGLE
    plotter.reset_camera_clipping_range()
    image = plotter.screenshot(return_img=True)
    plotter.close()
    return _finished(image, camera, size, bar)


def _dots(places, radius):
    import pyvista as pv

    return pv.PolyData(np.asarray(places, np.float32)).glyph(
        geom=pv.Sphere(radius=radius, theta_resolution=12, phi_resolution=12), scale=False, orient=False)


def _finished(image, camera, size, bar):
    """Returns the image, reduced to `size`, with its scale bar."""
    from PIL import Image

    reduced = Image.fromarray(image).resize(tuple(size), Image.Resampling.LANCZOS)
    if bar:
        _draw_bar(reduced, np.linalg.norm(np.subtract(camera[0], camera[1])))
    return np.asarray(reduced)


def bar_of(metre):
    """Returns (length [m], words) of the longest round length that takes at most BAR_SHARE of a picture whose width is
    `metre`."""
    most = BAR_SHARE * metre
    power = 10.0 ** np.floor(np.log10(most))
    length = next(first * power for first in ROUND_LENGTHS if first * power <= most)
    factor, unit = next((factor, unit) for factor, unit in UNITS if length >= 0.999 * factor or factor == UNITS[-1][0])
    return length, f"{length / factor:g} {unit}"


def _draw_bar(image, distance):
    import matplotlib
    from PIL import ImageDraw, ImageFont

    width, height = image.size
    metre = 2 * distance * np.tan(np.radians(ANGLE / 2)) * width / height
    length, words = bar_of(metre)
    tall = max(min(height, 0.75 * width), width / 2)
    pixels, edge = round(length / metre * width), round(0.03 * tall)
    font = ImageFont.truetype(f"{matplotlib.get_data_path()}/fonts/ttf/DejaVuSans.ttf", max(10, round(0.042 * tall)))
    draw, line = ImageDraw.Draw(image), max(2, round(tall / 240))
    y = height - edge
    ends = [[(edge, y), (edge + pixels, y)], *([(x, y - 2 * line), (x, y + 2 * line)] for x in (edge, edge + pixels))]
    for colour, wider in ((style.GROUND, 2 * line), (style.RIM, 0)):  # a light edge, where it lies on the subject
        for way in ends:
            draw.line(way, fill=colour, width=line + wider)
    draw.text((edge + pixels / 2, y - 2 * line), words, fill=style.RIM, font=font, anchor="mb", stroke_width=line,
              stroke_fill=style.GROUND)


def write_movie(scenes, camera, out, frames_per_second, size=(1280, 720), hold=1, **look):
    """Writes an MP4 (H.264) with a picture of each element of `scenes`, which are like `bodies` of `picture`; each is
    shown for `hold` frames; `look`: other options of `picture`. Returns the result of `available`."""
    usable, reason = available()
    try:
        import imageio
        import imageio_ffmpeg  # the encoder, which imageio finds by itself
    except ImportError as error:
        return False, f"a package for movies can't be imported ({error}); install plots/requirements.txt"
    if usable:
        with imageio.get_writer(out, fps=frames_per_second, codec="libx264", quality=6, macro_block_size=16,
                                ffmpeg_log_level="error") as writer:
            for bodies in scenes:
                image = picture(bodies, camera, size, finer=FINER_IN_MOVIES, **look)
                for _ in range(hold):
                    writer.append_data(image)
    return usable, reason
