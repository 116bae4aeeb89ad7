"""What viewers show: the frames of one mesh, numbers that colour its vertices, and contacts and planes as segments."""

import zlib
from dataclasses import dataclass, field
from typing import Callable

import numpy as np

from ogc_testbed.runs import RunError

REACH = 4  # distances are searched up to this many contact radii
# Sheets have these colours in front and behind, what does not move has the last; they are those of plots/style.py.
FRONTS, BACKS, STILL = ("#4C86B8", "#7FB0D4", "#2F6393"), ("#E2B458", "#EFD08C", "#C9952F"), "#B9BDC4"
# These are nine colours of viridis. Their lightness grows evenly, so colour-blind readers can order them, too.
SCALE = ("#440154", "#472D7B", "#3B528B", "#2C728E", "#21918C", "#28AE80", "#5EC962", "#ADDC30", "#FDE725")
# what frames hold only if the run measured it: name, option of `ogc run`, meaning, limits
MEASURES = (("cut", "--ledger", "1: the step's last iteration cut the vertex", (0.0, 1.0)),
            ("residual", "--residual", "‖f‖ that the step leaves over its mean ‖f*‖ (Eq. 29); of free vertices", None))
CONTACTS, PLANES = "#D55E00", "#0072B2"  # colours of segments


def rgb(colour):
    """Returns the parts of "#RRGGBB", uint8 (3,)."""
    return np.frombuffer(bytes.fromhex(colour[1:]), np.uint8)


def scaled(values, limits):
    """Returns the colour of each value on SCALE, uint8 (n, 3), grey where it is not finite. `limits`: values of the
    ends."""
    values = np.asarray(values, float)  # the smallest range is no float32
    stops = np.array([rgb(colour) for colour in SCALE], float)
    share = np.clip((values - limits[0]) / max(limits[1] - limits[0], 1e-300), 0, 1) * (len(stops) - 1)
    share = np.where(np.isfinite(share), share, 0)
    below = np.minimum(share.astype(int), len(stops) - 2)
    colours = stops[below] + (share - below)[:, None] * (stops[below + 1] - stops[below])
    colours[~np.isfinite(values)] = rgb(STILL)
    return np.rint(colours).astype(np.uint8)


@dataclass
class Field:
    """A number at each vertex of each frame: `of(i)` is float32 (V,), NaN where there is none. `limits`: least and
    largest value of any frame, if they are known without looking."""

    unit: str
    of: Callable
    meaning: str
    limits: tuple = None


@dataclass
class Motion:
    """Frames of one mesh. `at(i)`: positions of frame i, float32 (V, 3) [m]. `body`: body of each vertex. `still`:
    whether each body only moves as prescribed. `segments`: name -> function of a frame to float32 (n, 2, 3) [m].
    `missing`: name of a field or of segments -> why there is none."""

    name: str
    triangles: np.ndarray
    edges: np.ndarray
    body: np.ndarray
    bodies: list
    still: list
    steps: np.ndarray
    times: np.ndarray
    at: Callable
    fields: dict = field(default_factory=dict)
    segments: dict = field(default_factory=dict)
    missing: dict = field(default_factory=dict)
    radius: float = 0.0  # contact radius, of planes' crosses [m]
    run: object = None  # the Run that the frames are of

    def __len__(self):
        return len(self.steps)

    def colours(self):
        """Returns front and back colour of each body, "#RRGGBB"."""
        moving = np.cumsum(~np.array(self.still)) - 1
        return [(STILL, STILL) if still else (FRONTS[n % 3], BACKS[n % 3]) for still, n in zip(self.still, moving)]

    def field(self, name):
        """Returns the field of this name. Throws RunError that says why there is none."""
        return self._known("colour", name, self.fields)

    def segment(self, name):
        return self._known("kind of segments", name, self.segments)

    def _known(self, what, name, known):
        if name in known:
            return known[name]
        if name in self.missing:
            raise RunError(f"{self.name} has no {name}: {self.missing[name]}")
        raise RunError(f"there is no {what} '{name}'; {self.name} has: {', '.join(known) or 'none'}")

    def limits(self, name, frames=None):
        """Returns the least and the largest finite value of a field over the frames (all without an argument)."""
        if self.field(name).limits:
            return self.field(name).limits
        values = [self.field(name).of(i) for i in (range(len(self)) if frames is None else frames)]
        finite = [part[np.isfinite(part)] for part in values]
        finite = [part for part in finite if part.size]
        return (float(min(p.min() for p in finite)), float(max(p.max() for p in finite))) if finite else (0.0, 1.0)

    def row(self, i, vertex):
        """Returns what is known of a vertex in frame i: (name, text) each."""
        x = self.at(i)[vertex]
        rows = [("vertex", str(vertex)), ("body", self.bodies[self.body[vertex]]),
                ("position", ", ".join(f"{part:.6g}" for part in x) + " m")]
        return rows + [(name, f"{f.of(i)[vertex]:.4g} {f.unit}") for name, f in self.fields.items() if name != "body"]

    def thinned(self, every):
        """Returns the motion with each `every`-th frame, the last one among them."""
        kept = np.arange(len(self))[::-1][::every][::-1]
        pick = lambda of: lambda i: of(int(kept[i]))  # noqa: E731
        return Motion(self.name, self.triangles, self.edges, self.body, self.bodies, self.still, self.steps[kept],
                      self.times[kept], pick(self.at),
                      {name: Field(f.unit, pick(f.of), f.meaning, f.limits) for name, f in self.fields.items()},
                      {name: pick(of) for name, of in self.segments.items()}, self.missing, self.radius, self.run)


class _Contacts:
    """Contacts of a motion's frames by ogc_testbed.find_contacts; keeps those of the last frame."""

    def __init__(self, motion, radius, groups, forces=None):
        import ogc_testbed as ogc
        groups = np.asarray(groups, np.int32)[motion.body]
        self.mesh = ogc.Mesh(motion.triangles, edges=motion.edges if len(motion.edges) else None, groups=groups)
        self.finder, self.at, self.radius = ogc.ContactFinder(self.mesh), motion.at, radius
        self.forces = ogc.ContactForces(self.mesh, motion.at(0), radius=radius, **forces) if forces else None
        self.last = None

    def sets(self, i):
        x = np.ascontiguousarray(self.at(i))
        key = (i, zlib.crc32(x.tobytes()))
        if self.last is None or self.last[0] != key:
            self.last = key, x, self.finder.find(x, self.radius, REACH * self.radius)
        return self.last[1:]

    def distance(self, i):
        """The bound is γ_p times the smallest distance of a vertex and of its edges and triangles (Eq. 21)."""
        relaxation = 0.45  # of find_contacts by default
        found = self.sets(i)[1].bound.astype(float) / relaxation
        return np.where(found < REACH * self.radius * (1 - 1e-6), found, np.nan).astype(np.float32)

    def force(self, i):
        x, _ = self.sets(i)
        self.forces.find(x)
        return np.linalg.norm(self.forces.evaluate(x).force, axis=1).astype(np.float32)

    def segments(self, i):
        """Returns the closest points of each contact's two faces."""
        x, sets = self.sets(i)
        found = [np.empty((0, 2, 3))]
        x = x.astype(float)
        for kind in (0, 1, 2):
            v, face = sets.vertex_facet[sets.vertex_facet_kind == kind, :2].T
            corners = face[:, None] if kind == 0 else (self.mesh.edges if kind == 1 else self.mesh.triangles)[face]
            found.append(np.stack([x[v], _nearest(x[corners], x[v])], axis=1))
        for kinds in ((0, 0), (0, 1), (1, 0), (1, 1)):
            p, q = sets.edge_edge[(sets.edge_edge_kind == kinds).all(axis=1), :2].T
            first, second = (x[self.mesh.edges[face] if kind else face[:, None]] for face, kind in zip((p, q), kinds))
            if kinds == (1, 1):
                found.append(_between(first, second))
            elif kinds[1]:
                found.append(np.stack([first[:, 0], _nearest(second, first[:, 0])], axis=1))
            else:
                found.append(np.stack([_nearest(first, second[:, 0]), second[:, 0]], axis=1))
        return np.concatenate(found).astype(np.float32)

    def planes(self, i):
        """Returns a cross in the plane across the middle of each contact: two segments as long as a contact radius."""
        a, b = np.moveaxis(self.segments(i).astype(float), 1, 0)
        normal = _unit(b - a)
        aside = _unit(np.cross(normal, np.eye(3)[np.abs(normal).argmin(axis=1)]))
        half = np.stack([aside, np.cross(normal, aside)]) * self.radius / 2
        middle = (a + b) / 2
        return np.stack([middle - half, middle + half], axis=2).reshape(-1, 2, 3).astype(np.float32)


def _unit(vectors):
    return vectors / np.maximum(np.linalg.norm(vectors, axis=1, keepdims=True), 1e-300)


def _nearest(corners, points):
    """Returns the point of the affine hull of the corners (n, k, 3) nearest to each point (n, 3). A contact's kind
    names the face that has its closest point inside."""
    origin = corners[:, 0]
    if corners.shape[1] == 1:
        return origin
    sides = corners[:, 1:] - origin[:, None]
    gram, right = sides @ sides.transpose(0, 2, 1), np.einsum("nij,nj->ni", sides, points - origin)
    shares = np.einsum("nij,nj->ni", np.linalg.pinv(gram), right)
    return origin + np.einsum("ni,nij->nj", shares, sides)


def _between(first, second):
    """Returns the closest points of two lines, each by two points (n, 2, 3); of parallel ones some closest points."""
    d, e, r = first[:, 1] - first[:, 0], second[:, 1] - second[:, 0], first[:, 0] - second[:, 0]
    dd, ee, de, dr, er = ((u * v).sum(axis=1) for u, v in ((d, d), (e, e), (d, e), (d, r), (e, r)))
    determinant = dd * ee - de * de
    s = np.where(determinant > 1e-12 * dd * ee, (de * er - ee * dr) / np.where(determinant > 0, determinant, 1), 0.5)
    p = first[:, 0] + np.clip(s, 0, 1)[:, None] * d
    return np.stack([p, _nearest(second, p)], axis=1)


def _add_contacts(motion, radius, groups, forces, why_no_force):
    """Adds what find_contacts tells about each frame, or why it tells nothing. `groups`: a number for each body, -1 if
    it moves by itself; pairs of one group, such as fixed bodies, are no contacts."""
    motion.radius = float(radius)
    names = ("distance", "contact force", "contacts", "planes")
    try:
        contacts = _Contacts(motion, radius, groups, forces)
    except ImportError as error:
        motion.missing.update(dict.fromkeys(names, f"{error}; install the package (experiments/python/README.md)"))
        return
    motion.fields["distance"] = Field("m", contacts.distance, "to the nearest face without a common vertex, of a "
                                      f"vertex and of its edges and triangles; none beyond {REACH} contact radii")
    motion.segments.update({"contacts": contacts.segments, "planes": contacts.planes})
    if forces:
        motion.fields["contact force"] = Field("N", contacts.force, "of contacts, without friction")
    else:
        motion.missing["contact force"] = why_no_force


def motion_of_arrays(frames, triangles, edges=(), radius=None, name="mesh", bodies=None, times=None, names=None):
    """Returns the motion of frames, floats (F, V, 3) or (V, 3) [m], with int triangles (T, 3) and loose edges (E, 2).

    radius: contact radius for distances and contacts [m]; without it a quarter of the median edge. bodies: (name, first
    vertex, number of vertices, whether it is still) each; times: (F,) [s]; names: step numbers (F,).
    """
    frames = np.asarray(frames)
    frames = frames[None] if frames.ndim == 2 else frames
    triangles = np.asarray(triangles, np.int32).reshape(-1, 3)
    edges = np.asarray(edges, np.int32).reshape(-1, 2)
    if frames.ndim != 3 or frames.shape[2] != 3 or 0 in frames.shape[:2]:
        raise RunError(f"{name}: positions of shape (F, V, 3) or (V, 3) are needed, but {frames.shape} came")
    count, largest = frames.shape[1], max((part.max(initial=-1) for part in (triangles, edges)))
    if largest >= count or min(part.min(initial=0) for part in (triangles, edges)) < 0:
        raise RunError(f"{name}: a triangle or edge names vertex {largest}, where there are {count} vertices")
    bodies = bodies or [(name, 0, count, False)]
    body = np.zeros(count, np.int32)
    for number, (_, first, size, _) in enumerate(bodies):
        body[first:first + size] = number
    motion = Motion(name, triangles, edges, body, [b[0] for b in bodies], [bool(b[3]) for b in bodies],
                    np.arange(len(frames)) if names is None else np.asarray(names),
                    np.arange(len(frames), dtype=float) if times is None else np.asarray(times, float),
                    lambda i: np.ascontiguousarray(frames[i], np.float32))
    motion.fields["body"] = Field("", lambda i: body.astype(np.float32), "number of the body")
    if radius is None:
        sides = np.concatenate([triangles[:, pair] for pair in ([0, 1], [1, 2], [2, 0])] + [edges])
        lengths = np.linalg.norm(frames[0][sides[:, 0]] - frames[0][sides[:, 1]], axis=1) if len(sides) else [1]
        radius = float(np.median(lengths)) / 4 or 1e-3
    _add_contacts(motion, radius, np.where(motion.still, 0, -1), None, "a mesh has no stiffness; view a run")
    for what in ("speed", "bound", "cut", "residual"):
        motion.missing[what] = "a mesh has positions alone; view a run"
    return motion


def motion_of_run(run, every=1):
    """Returns the motion of a run's stored frames, each `every`-th of them. Throws RunError if there is none yet."""
    if not run.frames:
        raise RunError(f"{run.folder} has no finished frame yet (status: {run.status})")
    bodies = run.bodies()
    body = np.concatenate([np.full(b["vertex_count"], number, np.int32) for number, b in enumerate(bodies)])
    first = run.frame(run.frames[0])
    last = {}

    def frame(i):
        if last.get("i") != i:
            last.update(i=i, frame=run.frame(run.frames[i]))
        return last["frame"]

    still = [bool(b["fixed"] or b.get("prescribed_vertices") == b["vertex_count"]) for b in bodies]
    steps = np.array([int(path.stem.removeprefix("frame_")) for path in run.frames])
    triangles, edges = (np.ascontiguousarray(part, np.int32) for part in run.topology)
    motion = Motion(run.folder.name, triangles, edges, body, [b["name"] for b in bodies], still, steps,
                    steps * run.setting("time_step"), lambda i: frame(i).positions, run=run)
    motion.fields.update({
        "body": Field("", lambda i: body.astype(np.float32), "number of the body"),
        "speed": Field("m/s", lambda i: np.linalg.norm(frame(i).velocities, axis=1).astype(np.float32),
                       "at the frame's end"),
        "bound": Field("m", lambda i: _bounds_of(frame(i), motion), "b_v of the last detection (Eq. 21)")})
    # the start has no measures, nor has a state that a continued run took from its checkpoint
    only_start = run.status == "running" and len(run.frames) == 1
    recent = [run.frame(path) for path in run.frames[-2:]]
    for what, option, meaning, limits in MEASURES:
        if only_start or any(getattr(state, what).size for state in recent):
            motion.fields[what] = Field("", lambda i, what=what: _measure(frame(i), what), meaning, limits)
        else:
            motion.missing[what] = f"its frames hold none; ogc run {option} measures it for new runs"
    _add_contacts_of_run(motion, run, bodies, len(first.positions))
    return motion if every == 1 else motion.thinned(every)


def _measure(frame, what):
    """Returns a measure, NaN where there is none, as in the start."""
    values = getattr(frame, what)
    return values if values.size else np.full(len(frame.positions), np.nan, np.float32)


def _bounds_of(frame, motion):
    """Returns the bounds, NaN where there is none: before the first detection, and of what does not move by itself."""
    still = np.array(motion.still)[motion.body]
    return np.where((frame.bounds > 0) & ~still, frame.bounds, np.nan).astype(np.float32)


def _add_contacts_of_run(motion, run, bodies, count):
    if any(b.get("body_contact") == "volume" for b in bodies):
        motion.missing.update(dict.fromkeys(("distance", "contact force", "contacts", "planes"),
                                            "bodies that others may enter have no such contacts"))
        return
    if len(motion.body) != count:
        raise RunError(f"{run.folder}: frames have {count} vertices, the run's bodies {len(motion.body)}")
    stiffness, frictions = ({b["material"][key]["value"] for b in bodies} for key in ("contact_stiffness", "friction"))
    forces = None
    if len(stiffness) == 1 and not motion.edges.size:
        forces = {"contact_stiffness": stiffness.pop(), "friction": max(frictions),
                  "friction_velocity": run.setting("friction_velocity"),
                  "activation": run.setting("contact_activation")}
    groups = [0 if b["fixed"] else number + 1 if still else -1
              for number, (b, still) in enumerate(zip(bodies, motion.still))]
    _add_contacts(motion, run.setting("contact_radius"), groups, forces,
                  "the package's forces take one stiffness for all contacts, and no curves")
