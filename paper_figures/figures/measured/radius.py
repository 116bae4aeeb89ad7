"""Three contact sets at five radii (§2.2, Fig. 2): a level sheet that its weight presses on a level plate with other
vertices, for a hundred steps. Measures the tangential share of the force, the sheet's roughness, the oscillation of the
force and the number of contacts. Runs, table and picture.

All sets have one activation and one k_c, with which a vertex that a single contact supports rests at 0.9 r.

Tangential share: Σ‖f_t‖ / Σ‖f‖ over the sheet's vertices at the start, 0.95 r above the plate, where f is the sum of a
vertex's contact forces. Forces are computed here from closest points; the method's contacts come from `ogc contacts`.
At the sheet's rim the method pushes neighbours outwards, so that the share is also given for inner vertices.

Roughness: root mean square of the Laplacian of heights (four neighbours) over r at the end. Oscillation: standard
deviation over mean of the force on the sheet in the last twenty steps, from the acceleration of its centre.
"""

import json
import math
import sys
from array import array
from dataclasses import dataclass

import numpy as np

from paper_figures.workflow import layers
from paper_figures.workflow.contact_forces import contacts_of, ogc_force
from paper_figures.workflow.jobs import Job, RunFailure, manifest_of, parser_of_figure
from paper_figures.workflow.runs import provenance, write_table
from plots import style
from ogc_testbed.runs import Run

SIDE, PLATE_SIDE = 12, 20  # vertices
SPACING = 1 / 69  # [m], of fifty_layers
PLATE_SPACING, PLATE_ANGLE = 1.13 * SPACING, 0.3  # no two vertices lie above each other
SHIFT = (0.21 * SPACING, 0.37 * SPACING)
DENSITY, GRAVITY = 0.2, 9.81  # [kg/m²], [m/s²]
TIME_STEP, STEPS, LAST = 1 / 300, 100, 20  # [s]
DEPTH, START = 0.1, 0.95  # depth in r that a vertex would sink with one contact; height at the start in r
RATIOS = (0.1, 0.25, 0.5, 1, 2)  # r over the sheet's spacing
SETS = {"ogc": "OGC's", "pairs": "every pair (IPC's)", "distance": "distance field"}
SEEDS = {"smoke": 1, "small": 10}  # nothing here is chaotic, so few seeds suffice
JITTER = 1e-6  # [m]


def plate():
    """Returns the positions of the plate, turned and shifted."""
    points = np.array(layers.positions(PLATE_SIDE, PLATE_SPACING, 0.0)).reshape(-1, 3)
    c, s = math.cos(PLATE_ANGLE), math.sin(PLATE_ANGLE)
    turned = points @ np.array([[c, 0, -s], [0, 1, 0], [s, 0, c]]) + (SHIFT[0], 0, SHIFT[1])
    return array("d", turned.ravel())


@dataclass(frozen=True)
class Pressed:
    """Holds the scene, written to a file below the folder of the runs (jobs.Job)."""

    ratio: float

    @property
    def radius(self):
        return self.ratio * SPACING

    @property
    def stiffness(self):
        return DENSITY * SPACING**2 * GRAVITY / (DEPTH * self.radius)

    @property
    def path(self):
        return f"scenes/pressed_{self.ratio:g}/pressed.json"

    def write(self, program, root):
        """Writes the scene if it is missing."""
        path = root / self.path
        if path.is_file():
            return
        path.parent.mkdir(parents=True, exist_ok=True)
        layers.write_mesh(path.parent / "sheet.ply", layers.positions(SIDE, SPACING, START * self.radius),
                          layers.triangles(SIDE))
        layers.write_mesh(path.parent / "plate.ply", plate(), layers.triangles(PLATE_SIDE))
        material = {"density": DENSITY, "contact_stiffness": self.stiffness, "friction": 0}
        scene = {"format_version": 2, "name": "pressed", "gravity": [0, -GRAVITY, 0],
                 "settings": {"time_step": TIME_STEP, "steps": STEPS, "iterations": 40, "frame_steps": 1,
                              "contact_radius": self.radius},
                 "bodies": [{"name": "sheet", "mesh": "sheet.ply", "material": material},
                            {"name": "plate", "mesh": "plate.ply", "fixed": True, "material": material}]}
        path.write_text(json.dumps(scene, indent=1))


@dataclass(frozen=True)
class Case:
    contacts: str
    ratio: float
    seed: int

    @property
    def name(self):
        return f"{self.contacts}_radius_{self.ratio:g}_seed_{self.seed}"

    @property
    def job(self):
        words = ("--solver", "reference_vbd", "--set", f"reference_contact_set={self.contacts}",
                 "--jitter", f"{JITTER:g}",
                 "--seed", self.seed, "--audit", "end")
        return Job(self.name, words, scene=Pressed(self.ratio))


def cases(scale):
    return [Case(contacts, ratio, seed) for seed in range(1, SEEDS[scale] + 1) for ratio in RATIOS for contacts in SETS]


def on_face(p, corners):
    """Returns the weights of the corners at the closest point of a triangle: inside it, or on its nearest side."""
    if len(corners) == 1:
        return np.ones(1)
    if len(corners) == 2:
        along = corners[1] - corners[0]
        share = np.clip((p - corners[0]) @ along / (along @ along), 0, 1)
        return np.array([1 - share, share])
    first, second, away = corners[1] - corners[0], corners[2] - corners[0], p - corners[0]
    gram = np.array([[first @ first, first @ second], [first @ second, second @ second]])
    s, t = np.linalg.solve(gram, np.array([first @ away, second @ away]))
    if s >= 0 and t >= 0 and s + t <= 1:
        return np.array([1 - s - t, s, t])
    best = math.inf, None
    for side in ([0, 1], [1, 2], [2, 0]):
        weights = np.zeros(3)
        weights[side] = on_face(p, corners[side])
        best = min(best, (np.linalg.norm(weights @ corners - p), tuple(weights)))
    return np.array(best[1])


def on_edges(p, q):
    """Returns the weights of the four ends at the closest points of two segments: inside both, or at an end of one of
    them."""
    d, e, apart = p[1] - p[0], q[1] - q[0], q[0] - p[0]
    gram = np.array([[d @ d, -(d @ e)], [-(d @ e), e @ e]])
    if np.linalg.det(gram) > 1e-12 * (d @ d) * (e @ e):
        s, t = np.linalg.solve(gram, np.array([d @ apart, -(e @ apart)]))
        if 0 <= s <= 1 and 0 <= t <= 1:
            return np.array([1 - s, s]), np.array([1 - t, t])
    best = math.inf, None
    for end in range(2):
        alone = tuple(np.eye(2)[end])
        for own, other, is_first in ((p, q, True), (q, p, False)):
            weights = on_face(own[end], other)
            gap = np.linalg.norm(own[end] - weights @ other)
            best = min(best, (gap, (alone, tuple(weights)) if is_first else (tuple(weights), alone)))
    return tuple(map(np.array, best[1]))


def edges_of(triangles):
    return np.unique(np.sort(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1), axis=0)


class Start:
    """Holds both bodies at the start of the runs. A contact is (vertices of one primitive, vertices of the other)."""

    def __init__(self, pressed):
        self.radius = pressed.radius
        sheet = np.array(layers.positions(SIDE, SPACING, START * pressed.radius)).reshape(-1, 3)
        self.x = np.vstack((sheet, np.array(plate()).reshape(-1, 3)))
        self.count = len(sheet)
        self.triangles = np.vstack((face_array(SIDE), face_array(PLATE_SIDE) + self.count))

    def near(self, corners, other):
        """Returns the numbers of the primitives in `other` whose boxes are within r of the box of `corners` and that
        share no vertex with it."""
        low, high = self.x[other].min(axis=1) - self.radius, self.x[other].max(axis=1) + self.radius
        own = self.x[corners]
        near = np.all((own.max(axis=0) >= low) & (own.min(axis=0) <= high), axis=1)
        return np.flatnonzero(near & ~np.isin(other, corners).any(axis=1))

    def pairs(self):
        """Yields pairs of a vertex and a triangle, and pairs of edges, whose boxes are near. At least one of each pair
        belongs to the sheet."""
        edges = edges_of(self.triangles)
        for v in range(len(self.x)):
            for t in self.near([v], self.triangles):
                yield (v,), tuple(self.triangles[t])
        for e, ends in enumerate(edges):
            for f in self.near(ends, edges):
                if e < f:
                    yield tuple(ends), tuple(edges[f])

    def field(self):
        """Yields for each vertex the nearest triangle of the other body."""
        of_plate = self.triangles[:, 0] >= self.count
        for v in range(len(self.x)):
            others = self.triangles[of_plate if v < self.count else ~of_plate]
            near = [((v,), tuple(others[t])) for t in self.near([v], others)]
            yield from sorted(near, key=lambda contact: np.linalg.norm(self.gap(contact)[2]))[:1]

    def method(self, ogc, folder):
        """Yields the contacts that the program finds."""
        with (folder / "start.obj").open("w") as file:
            file.writelines("v {} {} {}\n".format(*point) for point in self.x)
            file.writelines("f {} {} {}\n".format(*(corners + 1)) for corners in self.triangles)
        found = contacts_of(ogc, folder / "start.obj", self.radius)
        yield from (((c["vertex"],), tuple(c["face"]["vertices"])) for c in found["vertex_facet"])
        yield from (tuple(tuple(c[side]["vertices"]) for side in ("first", "second")) for c in found["edge_edge"])

    def gap(self, contact):
        """Returns (weights of both primitives at their closest points, the vector between these points)."""
        p, q = (self.x[list(side)] for side in contact)
        if len(p) > 1 and len(q) > 1:
            weights = on_edges(p, q)
        elif len(p) > 1:
            weights = on_face(q[0], p), np.ones(1)
        else:
            weights = np.ones(1), on_face(p[0], q)
        return *weights, weights[0] @ p - weights[1] @ q

    def forces(self, contacts):
        """Returns the contact forces on the sheet's vertices, in units of k_c r."""
        force = np.zeros_like(self.x)
        for contact in contacts:
            if min(min(side) for side in contact) >= self.count:
                continue
            own, other, gap = self.gap(contact)
            distance = np.linalg.norm(gap)
            if distance >= self.radius:
                continue
            push = ogc_force(distance / self.radius) * gap / distance
            np.add.at(force, list(contact[0]), np.outer(own, push))
            np.add.at(force, list(contact[1]), -np.outer(other, push))
        return force[:self.count]


def tangential_shares(pressed, ogc, folder):
    """Yields the tangential share for each set: over all vertices, and over those farther from the rim than the largest
    r."""
    start = Start(pressed)
    contacts = {"ogc": start.method(ogc, folder), "pairs": start.pairs(), "distance": start.field()}
    rim = math.ceil(max(RATIOS)) + 1
    inner = np.zeros((SIDE, SIDE), bool)
    inner[rim:-rim, rim:-rim] = True
    for name, found in contacts.items():
        force = start.forces(found)
        along, whole = np.linalg.norm(force[:, [0, 2]], axis=1), np.linalg.norm(force, axis=1)
        yield name, (along.sum() / whole.sum(), along[inner.ravel()].sum() / whole[inner.ravel()].sum())


def face_array(side):
    raw = np.frombuffer(layers.triangles(side), dtype=np.dtype([("n", "u1"), ("corners", "<i4", 3)]))
    return raw["corners"].astype(int)


def heights(run):
    """Returns the heights of the sheet in each stored state [m]."""
    return np.array([run.frame(path).positions[:SIDE * SIDE, 1].astype(float) for path in run.frames])


def roughness(height, radius):
    grid = height.reshape(SIDE, SIDE)
    laplacian = (grid[:-2, 1:-1] + grid[2:, 1:-1] + grid[1:-1, :-2] + grid[1:-1, 2:] - 4 * grid[1:-1, 1:-1])
    return math.sqrt(np.mean(laplacian**2)) / radius


def vertex_share():
    """Returns the share of the sheet's mass at each of its vertices."""
    share = np.zeros(SIDE * SIDE)
    np.add.at(share, face_array(SIDE).ravel(), 1)
    return share / share.sum()


def oscillation(height):
    """Returns standard deviation over mean of the force on the sheet, from the accelerations of its centre."""
    centre = height @ vertex_share()
    force = 1 + (centre[2:] - 2 * centre[1:-1] + centre[:-2]) / TIME_STEP**2 / GRAVITY
    return float(np.std(force[-LAST:]) / np.mean(force[-LAST:]))


def metrics(run, case):
    height, pressed = heights(run), Pressed(case.ratio)
    contacts = np.mean(run.column("vertex_facet_contacts")[-LAST:] + run.column("edge_edge_contacts")[-LAST:])
    return {"roughness [r]": roughness(height[-1], pressed.radius), "oscillation [1]": oscillation(height),
            "contacts a vertex [1]": contacts / SIDE**2, "height at the end [r]":
            float(height[-1] @ vertex_share()) / pressed.radius}


def finished(folder, scale):
    return {case: Run(folder / case.name) for case in cases(scale)
            if manifest_of(folder / case.name).get("status") == "finished"}


def table(runs, ogc, folder):
    """Returns a row for each set and radius, with median and range over the seeds."""
    for ratio in RATIOS:
        shares = dict(tangential_shares(Pressed(ratio), ogc, folder))
        for contacts in SETS:
            mine = {case: run for case, run in runs.items() if (case.contacts, case.ratio) == (contacts, ratio)}
            if not mine:
                continue
            found = [metrics(run, case) for case, run in mine.items()]
            row = {"r over edge [1]": f"{ratio:g}", "contacts": SETS[contacts], "runs": len(mine),
                   "tangential share at the start [1]": f"{shares[contacts][0]:.4g}",
                   "away from the rim [1]": f"{shares[contacts][1]:.4g}"}
            for name in found[0]:
                values = [one[name] for one in found]
                row |= {name: f"{np.median(values):.4g}", f"{name} least": f"{min(values):.4g}",
                        f"{name} most": f"{max(values):.4g}"}
            yield row | provenance(next(iter(mine.values())))


def draw(rows, out):
    plt = style.use()
    names = ("away from the rim [1]", "roughness [r]", "oscillation [1]", "contacts a vertex [1]")
    figure, grid = plt.subplots(1, len(names), figsize=(14, 3.5))
    for axes, name in zip(grid, names):
        for number, label in enumerate(SETS.values()):
            mine = [row for row in rows if row["contacts"] == label]
            ratio, value = ([float(row[key]) for row in mine] for key in ("r over edge [1]", name))
            axes.plot(ratio, value, "o^s"[number] + "-", color=style.COLOURS[number], label=label, alpha=0.8)
            if f"{name} least" in rows[0]:
                axes.fill_between(ratio, *([float(row[f"{name} {end}"]) for row in mine] for end in ("least", "most")),
                                  color=style.COLOURS[number], alpha=0.2, linewidth=0)
        title = "tangential share away from the rim [1]" if name == names[0] else name
        axes.set(xscale="log", xlabel="r over edge length", title=title)
        axes.set_yscale("symlog", linthresh=1e-4) if name != names[-1] else axes.set_yscale("log")
        axes.legend(fontsize=6)
    style.save(figure, out)


def main():
    options = parser_of_figure(__doc__.splitlines()[0], SEEDS, "smoke", has_backend=False).parse_args()
    try:
        for case in cases(options.scale):
            case.job.make(options.ogc, options.folder, shown=True)
    except RunFailure as error:
        sys.exit(f"radius: {error}")
    rows = list(table(finished(options.folder, options.scale), options.ogc, options.folder))
    write_table(options.folder / "radius.csv", rows)
    draw(rows, options.folder / "radius.png")


if __name__ == "__main__":
    main()
