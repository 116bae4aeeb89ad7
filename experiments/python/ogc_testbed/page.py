"""One HTML file that shows motions in any browser, offline: a timeline, colours, contacts, and the row of a vertex.

Positions are whole multiples of a step, the largest extent over 65534 from the least coordinate on, so each coordinate
is off by at most half a step, and by the rounding of the browser's single precision. Values of fields are one of 255
between the least and the largest. Both are stored as differences between frames, deflated, in base64.

The page draws with WebGL 2 by its own page.js. Recordings of viser 1.1.1, whose client is one file, too, keep neither
its controls nor its clicks: nothing could be coloured otherwise or picked in them.
"""

import base64
import html
import json
import zlib
from pathlib import Path

import numpy as np

from ogc_testbed import motion as motions
from ogc_testbed.runs import Run, RunError

STEPS = 65534  # steps of the largest extent
BYTES_A_POSITION = 10  # size of the page's data for each vertex of each frame, beyond which fields are left out
LEAST_LIMIT = 10_000_000  # [bytes]
ANGLE = 0.6  # of view, from top to bottom [rad]


class Page:
    """The page of a motion, or of several beside each other.

    colour: what vertices are coloured by at first. segments: "contacts" and "planes" that are shown at first. frame:
    the first frame shown, the last one by default. limit: size of the file [bytes], beyond which fields and contacts
    are left out, as `left_out` says; by default 10 MB, or 10 bytes for each vertex of each frame. progress: called with
    the numbers of frames done and of all. Throws RunError for a colour that there is none of.
    """

    def __init__(self, *shown, colour="body", segments=(), frame=None, limit=None, progress=None):
        if not any(colour in motion.fields for motion in shown):
            shown[0].field(colour)
        for name in segments:
            shown[0].segment(name)
        count = sum(len(motion) * len(motion.body) for motion in shown)
        self.limit = limit or max(LEAST_LIMIT, BYTES_A_POSITION * count)
        self.left_out, self._size, self._work = [], 0, (progress or (lambda done, of: None), 0)
        self._of = sum(len(m) * (1 + len(m.fields)) for m in shown)
        offsets, target, radius = placed(shown)
        coded = [self._coded_mesh(motion, offset) for motion, offset in zip(shown, offsets)]
        for name in sorted({name for m in shown for name in m.fields} - {"body"}, key=lambda name: name != colour):
            for motion, code in zip(shown, coded):
                if name in motion.fields:
                    self._add_field(motion, code, name)
        for motion, code in zip(shown, coded):
            if motion.segments:
                self._add_contacts(motion, code)
        self.error = max(code["step"] for code in coded) / 2  # of a coordinate [m]
        title = " beside ".join(motion.name for motion in shown)
        self.data = {"title": title, "motions": coded, "scale": motions.SCALE, "none": motions.STILL, "target": target,
                     "radius": radius, "angle": ANGLE, "colour": colour, "shown": list(segments),
                     "frame": len(shown[0]) - 1 if frame is None else frame,
                     "contacts": motions.CONTACTS, "planes": motions.PLANES,
                     "error": f"Positions are within {self.error:.2g} m of the run's."}

    def html(self):
        """Returns the text of the file."""
        folder = Path(__file__).parent
        text = (folder / "page.html").read_text(encoding="utf-8")
        data = json.dumps(self.data, separators=(",", ":"), ensure_ascii=False).replace("<", "\\u003c")
        for word, value in (("TITLE", html.escape(self.data["title"])),
                            ("SCRIPT", (folder / "page.js").read_text(encoding="utf-8")), ("DATA", data)):
            text = text.replace(word, value, 1)
        return text

    def save(self, path):
        """Writes the file and returns its size [bytes]."""
        content = self.html().encode()
        Path(path).write_bytes(content)
        return len(content)

    def _repr_html_(self):
        """Shows the page in a notebook."""
        return (f'<iframe srcdoc="{html.escape(self.html())}" style="width:100%;height:600px;border:1px solid #ccc" '
                f'title="{html.escape(self.data["title"])}"></iframe>')

    def _done(self, frames=1):
        report, done = self._work
        self._work = report, done + frames
        report(done + frames, self._of)

    def _coded_mesh(self, motion, offset):
        low = np.full(3, np.inf)
        high = -low
        for i in range(len(motion)):
            x = motion.at(i)
            if not np.isfinite(x).all():
                raise RunError(f"{motion.name}: a position of frame {i} is not finite")
            low, high = np.minimum(low, x.min(axis=0)), np.maximum(high, x.max(axis=0))
        low, step = low.astype(float), float((high - low).max()) / STEPS or 1.0
        words = np.empty((len(motion), 3 * len(motion.body)), np.uint16)
        for i in range(len(motion)):
            words[i] = np.rint((motion.at(i).astype(float) - low) / step).ravel()
            self._done()
        colours = motion.colours()
        return {"name": motion.name, "vertices": len(motion.body), "steps": motion.steps.tolist(),
                "times": [round(float(t), 9) for t in motion.times], "low": low.tolist(), "step": step,
                "offset": offset, "contact_radius": motion.radius, "fields": [], "contacts": None,
                "bodies": [{"name": n, "front": c[0], "back": c[1]} for n, c in zip(motion.bodies, colours)],
                "positions": self._kept(_halves(_differences(words))),
                **{name: self._kept(np.ascontiguousarray(getattr(motion, name), "<i4").tobytes())
                   for name in ("triangles", "edges", "body")}}

    def _add_field(self, motion, code, name):
        field = motion.fields[name]
        low, high = motion.limits(name)
        bytes_of = np.zeros((len(motion), len(motion.body)), np.uint8)
        for i in range(len(motion)):
            values = field.of(i).astype(float)
            share = np.clip((values - low) / max(high - low, 1e-300), 0, 1)
            bytes_of[i] = np.where(np.isfinite(values), 1 + np.rint(254 * np.where(np.isfinite(share), share, 0)), 0)
            self._done()
        values = self._affordable(_differences(bytes_of).tobytes(), name)
        if values:
            code["fields"].append({"name": name, "unit": field.unit, "meaning": field.meaning, "low": low, "high": high,
                                   "frames": len(motion), "values": values})

    def _add_contacts(self, motion, code):
        low, step = np.array(code["low"]), code["step"]
        first, ends = [0], []
        for i in range(len(motion)):
            words = np.clip(np.rint((motion.segments["contacts"](i).astype(float) - low) / step), 0, 65535)
            ends.append(words.astype(np.uint16).ravel())
            first.append(first[-1] + len(words))
            if 12 * first[-1] > 20 * self.limit:  # deflating would not make that small enough
                self.left_out.append("contacts")
                return
        kept = self._affordable(_halves(np.concatenate(ends)), "contacts")
        if kept:
            code["contacts"] = {"first": self._kept(np.array(first, "<i4").tobytes()), "ends": kept}

    def _kept(self, content):
        text = base64.b64encode(zlib.compress(content, 6)).decode()
        self._size += len(text)
        return text

    def _affordable(self, content, name):
        """Returns the text of the content, or nothing, with a word in `left_out`, if the file would be too large."""
        before = self._size
        text = self._kept(content)
        if self._size > self.limit:
            self._size = before
            self.left_out.append(name)
            return None
        return text


def view(shown, triangles=None, edges=(), radius=None, **options):
    """Returns the page of a run's folder, or of frames, floats (F, V, 3) or (V, 3) [m], with triangles (T, 3) and edges
    without a triangle (E, 2). In a notebook it shows itself; `.save("view.html")` writes it.

    radius: contact radius of frames [m], by default a quarter of their median edge. Options are those of Page.
    RunError: no run, no frame, or shapes that do not fit.
    """
    if triangles is None:
        return Run(shown).view(**options)
    return Page(motions.motion_of_arrays(shown, triangles, edges, radius), **options)


def _differences(values):
    """Returns the rows' differences to the row before, modulo the range of the type."""
    result = values.copy()
    result[1:] -= values[:-1]
    return result


def _halves(words):
    """Returns the low bytes of all words, then the high bytes, which deflate better so."""
    pairs = np.ascontiguousarray(words, "<u2").view(np.uint8).reshape(-1, 2)
    return pairs[:, 0].tobytes() + pairs[:, 1].tobytes()


def placed(shown):
    """Returns the offset of each motion, so that they stand side by side, and the ball around what moves in them."""
    boxes, offsets, at = [], [], 0.0
    for motion in shown:
        moving = ~np.array(motion.still)[motion.body]
        moving = moving if moving.any() else ~moving
        states = [motion.at(i)[moving].astype(float) for i in sorted({0, len(motion) // 2, len(motion) - 1})]
        low, high = (getattr(np.concatenate(states), name)(axis=0) for name in ("min", "max"))
        offsets.append([at - low[0] if len(shown) > 1 else 0.0, 0.0, 0.0])
        at += 1.15 * max(high[0] - low[0], 1e-9)
        boxes += [low + offsets[-1], high + offsets[-1]]
    low, high = np.min(boxes, axis=0), np.max(boxes, axis=0)
    return offsets, ((low + high) / 2).tolist(), float(np.linalg.norm(high - low) / 2) or 1.0
