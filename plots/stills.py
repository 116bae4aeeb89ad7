"""Pictures and movies of motions without a display, in the look of plots/render.py."""

import numpy as np

from ogc_testbed.motion import CONTACTS, PLANES, SCALE, Motion, rgb, scaled
from ogc_testbed.page import placed
from plots import bodies, render

VIEW = render.View()
SIZE = (1280, 720)
EDGE = 0.15  # radius of loose edges, in contact radii
THREE = 2 * np.pi / 3 * np.arange(3)


def prisms(segments, radius):
    """Returns points and triangles of a three-sided prism around each segment (n, 2, 3)."""
    ends = np.asarray(segments, float)
    along = ends[:, 1] - ends[:, 0]
    along /= np.maximum(np.linalg.norm(along, axis=1, keepdims=True), 1e-300)
    first = np.cross(along, np.eye(3)[np.abs(along).argmin(axis=1)])
    first /= np.maximum(np.linalg.norm(first, axis=1, keepdims=True), 1e-300)
    spokes = radius * (np.cos(THREE)[:, None, None] * first + np.sin(THREE)[:, None, None] * np.cross(along, first))
    points = (ends.transpose(1, 0, 2)[:, None] + spokes).transpose(2, 0, 1, 3).reshape(-1, 3)
    one = np.array([[k, (k + 1) % 3, k + 3] for k in range(3)] + [[(k + 1) % 3, (k + 1) % 3 + 3, k + 3]
                                                                  for k in range(3)] + [[2, 1, 0], [3, 4, 5]])
    return points, (6 * np.arange(len(ends))[:, None, None] + one).reshape(-1, 3)


class Stage:
    """Motions beside each other, what colours them, and the camera. `colour`: name of a field. `segments`: "contacts"
    and "planes" that are drawn."""

    def __init__(self, shown, colour="body", segments=(), frames=None):
        self.shown, self.colour, self.segments = shown, colour, list(segments)
        for motion in shown:
            motion.field(colour)
            for name in segments:
                motion.segment(name)
        self.offsets, _, _ = placed(shown)
        count = len(shown[0])
        chosen = sorted({0, count // 3, 2 * count // 3, count - 1}) if frames is None else frames
        self.camera = VIEW.fit(np.concatenate([self._subject(i) for i in chosen]), SIZE)
        self.limits = None
        if colour != "body":
            ends = [motion.limits(colour, frames) for motion in shown]
            self.limits = min(low for low, _ in ends), max(high for _, high in ends)

    def bodies(self, i):
        """Returns the bodies of frame i of the first motion, and of the nearest in time of the others, as
        render.picture takes them."""
        return [body for part in self._parts(i) for body in self._bodies_of(*part)]

    def _parts(self, i):
        """Yields each motion, its frame at frame i of the first one, and its offset."""
        for n, (motion, offset) in enumerate(zip(self.shown, self.offsets)):
            frame = i if n == 0 else int(np.abs(motion.times - self.shown[0].times[i]).argmin())
            yield motion, frame, np.array(offset)

    def _subject(self, i):
        """Returns the points that the camera must see: of what moves by itself, of everything if nothing does."""
        found = []
        for motion, frame, offset in self._parts(i):
            moving = ~np.array(motion.still)[motion.body]
            found.append(motion.at(frame)[moving if moving.any() else ~moving].astype(float) + offset)
        return np.concatenate(found)

    def _bodies_of(self, motion: Motion, i, offset):
        x = motion.at(i).astype(float) + offset
        return self._plain(motion, i, x, offset) if self.colour == "body" else self._coloured(motion, i, x)

    def _plain(self, motion, i, x, offset):
        if motion.run is not None:  # as figures draw it, with plies of yarn
            frame = motion.run.frame_at_step(int(motion.steps[i]))
            return [(points + offset, *rest) for points, *rest in bodies.bodies_of(motion.run, frame)]
        corners = motion.body[motion.triangles[:, 0]]
        found = [(x[motion.body == b], motion.triangles[corners == b] - int((motion.body < b).sum()), front, back)
                 for b, (front, back) in enumerate(motion.colours()) if (corners == b).any()]
        colours = np.array([rgb(front) for front, _ in motion.colours()])[motion.body]
        return found + self._edges(motion, x, colours)

    def _coloured(self, motion, i, x):
        colours = scaled(motion.field(self.colour).of(i), self.limits)
        found = [(x, motion.triangles, colours, None)] if len(motion.triangles) else []
        return found + self._edges(motion, x, colours)

    @staticmethod
    def _edges(motion, x, colours):
        if not len(motion.edges):
            return []
        points, triangles = prisms(x[motion.edges], EDGE * motion.radius)
        return [(points, triangles, colours[motion.edges].repeat(3, axis=1).reshape(-1, 3), None)]

    def image(self, i, size=SIZE, finer=render.FINER):
        """Returns the picture of frame i, uint8 (height, width, 3), with segments above it, since surfaces hide them,
        and with a legend if a field colours it."""
        run = self.shown[0].run
        floor = bodies.floor_of(run) if run is not None and self.colour == "body" else None
        image = render.picture(self.bodies(i), self.camera, size, floor=floor, finer=finer)
        if self.limits is None and not self.segments:
            return image
        from PIL import Image, ImageDraw
        picture = Image.fromarray(np.ascontiguousarray(image))
        draw = ImageDraw.Draw(picture)
        for name, colour in (("planes", PLANES), ("contacts", CONTACTS)):
            for motion, frame, offset in self._parts(i) if name in self.segments else ():
                for ends in self._on_picture(motion.segment(name)(frame) + offset, size):
                    draw.line([tuple(ends[0]), tuple(ends[1])], fill=colour, width=2)
        if self.limits is not None:
            self._draw_legend(picture, draw)
        return np.asarray(picture)

    def _on_picture(self, ends, size):
        """Returns the pixels of segments (n, 2, 3)."""
        seen = (ends - np.array(self.camera[0])) @ VIEW.axes().T
        scale = size[1] / 2 / np.tan(np.radians(render.ANGLE / 2)) / -seen[..., 2:]
        return np.array(size) / 2 + seen[..., :2] * scale * np.array([1, -1])

    def _draw_legend(self, picture, draw):
        from PIL import Image, ImageFont
        font, field = ImageFont.load_default(16), self.shown[0].field(self.colour)
        stops = np.array([rgb(colour) for colour in SCALE], float)
        shares = np.linspace(0, len(stops) - 1, 240)
        bar = np.stack([np.interp(shares, np.arange(len(stops)), part) for part in stops.T], axis=1)
        picture.paste(Image.fromarray(np.broadcast_to(bar.round().astype(np.uint8), (12, 240, 3)).copy()), (16, 40))
        draw.rectangle((15, 39, 256, 52), outline="#606060")
        draw.text((16, 14), f"{self.colour} [{field.unit}]" if field.unit else self.colour, "#1a1a1a", font)
        draw.text((16, 58), f"{self.limits[0]:.3g}", "#1a1a1a", font)
        draw.text((256, 58), f"{self.limits[1]:.3g}", "#1a1a1a", font, anchor="ra")


def save_picture(stage, i, out):
    """Writes a picture in the format of the file's name."""
    from PIL import Image
    Image.fromarray(stage.image(i)).save(out)


def frames_per_second(times):
    """Returns the rate at which a movie is as long as the motion, at most 60; 30 for a motion without times."""
    gaps = np.diff(times)
    return float(np.clip(1 / np.median(gaps), 1, 60)) if len(gaps) and np.median(gaps) > 0 else 30.0


def save_movie(stage, out, rate, progress):
    """Writes an MP4 (H.264) of all frames of the first motion."""
    import imageio
    count = len(stage.shown[0])
    with imageio.get_writer(out, fps=rate, codec="libx264", quality=7, macro_block_size=16,
                            ffmpeg_log_level="error") as writer:
        for i in range(count):
            writer.append_data(stage.image(i, finer=render.FINER_IN_MOVIES))
            progress(i + 1, count)
