"""Sets of near pairs: does a peer list each pair of a vertex and a triangle, and of two edges, nearer than a radius?

    experiments/peers/run newton sets [--states N] [--seed S] [--out FILE]

This is the peers' own definition: all pairs within the distance that share no vertex. IPC Toolkit lists each pair by
the features that are nearest (`NormalCollisions`, the set of IPC): a vertex and a corner, an edge, or the triangle; two
edges, whatever is nearest, if they are nearly parallel (below the threshold of its mollifier). The distance of a pair
is computed in double, and exactly by rational numbers where that does not decide. A pair whose distance differs from
the radius by less than the rounding of the peer's precision is grey: it may be listed or not.
"""

import argparse
import csv
import importlib.metadata
import sys
from fractions import Fraction

import conversions as to
import numpy as np

RADIUS = 0.1
GREY = 32  # units of the last place times max(d, Σ|δ|), as for the judge's smallest distances
LADDER = [0, *(s * 2.0**-k for k in range(4, 27) for s in (-1, 1))]  # distances of `near` are r (1 + rung)
COLUMNS = ["peer", "version", "set", "states", "pairs", "near_pairs", "grey", "missing", "extra", "first_wrong", "seed"]


def soup(rng):
    """Returns 24 triangles of sides of about r to 3 r in a box."""
    centre = rng.uniform(-0.5, 0.5, (24, 1, 3))
    x = centre + rng.uniform(-0.15, 0.15, (24, 3, 3))
    return x.reshape(-1, 3), np.arange(72).reshape(-1, 3)


def sheet(n, x0, y0, z):
    x = np.array([[x0 + 0.08 * i, y0 + 0.08 * j, z] for i in range(n) for j in range(n)])
    k = np.arange(n * n).reshape(n, n)
    a, b, c, d = k[:-1, :-1].ravel(), k[:-1, 1:].ravel(), k[1:, :-1].ravel(), k[1:, 1:].ravel()
    return x, np.concatenate([np.stack([a, b, c], axis=1), np.stack([d, c, b], axis=1)])


def stack(rng):
    """Returns three crumpled sheets over each other, so that vertices have many pairs."""
    parts = [sheet(6, *rng.uniform(-0.02, 0.02, 2), 0.06 * k) for k in range(3)]
    x = np.concatenate([p for p, _ in parts])
    return x + rng.normal(0, 0.02, x.shape), np.concatenate([t + 36 * k for k, (_, t) in enumerate(parts)])


def near(rng):
    """Returns pairs of triangles, turned and moved, whose distance is r (1 + rung): decisions near the radius."""
    x, faces = [], []
    for k in range(12):
        gap = RADIUS * (1 + rng.choice(LADDER))
        lower = np.array([[-1, -1, 0], [1, -1, 0], [0, 1, 0]]) * 0.2
        upper = np.array([[0, 0, gap], [0.1, 0.05, gap + 0.3], [-0.1, 0.1, gap + 0.3]])
        if k % 2:
            lower = np.array([[-0.2, 0, 0], [0.2, 0, 0], [0, 0.1, -0.3]])
            upper = np.array([[0, -0.2, gap], [0, 0.2, gap], [0.1, 0, gap + 0.3]])
        q, r = np.linalg.qr(rng.normal(size=(3, 3)))
        both = np.concatenate([lower, upper]) @ (q * np.sign(np.diag(r))).T + [3 * k - 18, *rng.uniform(-1, 1, 2)]
        faces += [[6 * k, 6 * k + 1, 6 * k + 2], [6 * k + 3, 6 * k + 4, 6 * k + 5]]
        x.append(both)
    return np.concatenate(x), np.array(faces)


STATES = {"soup": soup, "stack": stack, "near": near}


def edges_of(triangles):
    ends = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    return np.unique(np.sort(ends), axis=0)


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def exact_point_edge(p, a, b):
    """Returns the exact squared distance of a point and a segment."""
    p, a, b = (to.exact(x) for x in (p, a, b))
    e, r = [y - x for x, y in zip(a, b)], [y - x for x, y in zip(a, p)]
    s = min(max(dot(r, e) / dot(e, e), 0), 1) if any(e) else 0
    return sum((x - s * y) ** 2 for x, y in zip(r, e))


def exact_edges(a, b):
    """Returns the exact squared distance of two segments: of their lines, if its points lie inside, or of an end."""
    best = min([exact_point_edge(a[k], *b) for k in range(2)] + [exact_point_edge(b[k], *a) for k in range(2)])
    (a0, a1), (b0, b1) = [[to.exact(x) for x in y] for y in (a, b)]
    e, f, r = [[y - x for x, y in zip(u, v)] for u, v in ((a0, a1), (b0, b1), (a0, b0))]
    ee, ff, ef, er, fr = dot(e, e), dot(f, f), dot(e, f), dot(e, r), dot(f, r)
    cross = ee * ff - ef * ef
    if cross == 0:
        return best
    s, t = (er * ff - fr * ef) / cross, (er * ef - fr * ee) / cross
    if not (0 <= s <= 1 and 0 <= t <= 1):
        return best
    return min(best, sum((z - x * s + y * t) ** 2 for x, y, z in zip(e, f, r)))


def exact_triangle(p, t):
    """Returns the exact squared distance of a point and a triangle: that of its plane, if the foot is inside, or of a
    side."""
    best = min(exact_point_edge(p, t[k], t[(k + 1) % 3]) for k in range(3))
    q, (a, b, c) = to.exact(p), [to.exact(x) for x in t]
    e, f, r = [[y - x for x, y in zip(a, z)] for z in (b, c, q)]
    ee, ff, ef, er, fr = dot(e, e), dot(f, f), dot(e, f), dot(e, r), dot(f, r)
    area = ee * ff - ef * ef
    if area == 0:
        return best
    v, w = (er * ff - fr * ef) / area, (fr * ee - er * ef) / area
    if not (v >= 0 and w >= 0 and v + w <= 1):
        return best
    return min(best, sum((z - x * v - y * w) ** 2 for x, y, z in zip(e, f, r)))


class Pairs:
    """All pairs of a state that share no vertex, the distance of each, which are near and which are grey."""

    def __init__(self, x, first, second, unit, weights_of, exact):
        apart = ~(first[:, None, :, None] == second[None, :, None, :]).any(axis=(2, 3))
        self.first, self.second = np.nonzero(apart)
        if len(first) == len(second) and first.shape == second.shape:  # edges: each pair once
            once = self.first < self.second
            self.first, self.second = self.first[once], self.second[once]
        a, b = x[first[self.first]], x[second[self.second]]
        self.weights = weights_of(a, b)
        points = np.concatenate([a, b], axis=1)
        self.distance = np.linalg.norm(np.einsum("nk,nki->ni", self.weights, points), axis=1)
        self.near = self.distance < RADIUS
        # Rounding of the double: each of 4 points errs by some 2⁻⁵³ of its coordinates, times weights below 1 and the
        # conditioning of the solution for them, at most 1e6 for these shapes.
        for i in np.flatnonzero(np.abs(self.distance - RADIUS) < 1e-9 * np.maximum(1, np.abs(points).max())):
            self.near[i] = exact(a[i], b[i]) < Fraction(RADIUS) ** 2
        scale = np.maximum(self.distance, to.spread(points))
        self.grey = np.abs(self.distance - RADIUS) <= GREY * unit * scale

    def __len__(self):
        return len(self.first)


def pairs_of(x, triangles, unit):
    edges = edges_of(triangles)
    vertices = np.arange(len(x))[:, None]

    def of_points(a, b):
        return np.concatenate([np.ones((len(a), 1)), -to.nearest_of_triangle(a[:, 0], b)], axis=1)

    of_triangles = Pairs(x, vertices, triangles, unit, of_points, lambda a, b: exact_triangle(a[0], b))

    def of_edges(a, b):
        s, t = to.nearest_of_edges(a, b).T
        return np.stack([1 - s, s, t - 1, -t], axis=1)

    return edges, of_triangles, Pairs(x, edges, edges, unit, of_edges, exact_edges)


def newton_lists():
    """Newton's detector as SolverVBD calls it, without its filter of neighbours."""
    import warp as wp

    wp.config.quiet = True
    import newton
    from newton._src.geometry.tri_mesh_collision import TriMeshCollisionDetector

    def listed(x, triangles):
        builder = newton.ModelBuilder()
        builder.add_cloth_mesh(pos=wp.vec3(0.0), rot=wp.quat_identity(), scale=1.0, vel=wp.vec3(0.0),
                               vertices=[wp.vec3(*p) for p in x], indices=triangles.ravel().tolist(), density=1.0)
        builder.color()
        model = builder.finalize(device="cpu")
        model.particle_q.assign(x.astype(np.float32))
        detector = TriMeshCollisionDetector(model, init_collision_info=True, vertex_collision_buffer_pre_alloc=512,
                                            edge_collision_buffer_pre_alloc=1024)
        detector.rebuild(model.particle_q)
        detector.vertex_triangle_collision_detection(RADIUS)
        detector.edge_edge_collision_detection(RADIUS)
        rows = [np.asarray(a.numpy()).reshape(-1, 2) for a in (detector.vertex_colliding_triangles,
                                                              detector.edge_colliding_edges)]
        ends = np.sort(model.edge_indices.numpy()[:, 2:], axis=1)
        index = {tuple(e): k for k, e in enumerate(edges_of(triangles).tolist())}
        number = [index[tuple(e)] for e in ends.tolist()]
        edges = {tuple(sorted((number[a], number[b]))) for a, b in rows[1] if b >= 0}
        return {(int(v), int(t)) for v, t in rows[0] if t >= 0}, edges

    def wrong(x, triangles):
        """Yields for each set: its name, how many pairs, near ones, grey ones, and missing and extra ones."""
        _, *exact = pairs_of(x, triangles, to.UNIT)
        for name, pairs, found in zip(("vertex, triangle", "edge, edge"), exact, listed(x, triangles)):
            def some(chosen):
                return set(zip(pairs.first[chosen].tolist(), pairs.second[chosen].tolist()))

            missing = sorted(some(pairs.near & ~pairs.grey) - found)
            allowed = some(pairs.near | pairs.grey)
            yield name, len(pairs), int(pairs.near.sum()), int(pairs.grey.sum()), missing, sorted(found - allowed)

    return wrong


def features(weights, first, second, pairs):
    """Yields for each pair the vertices with a weight on either side, or None if a weight is doubtful."""
    for i in range(len(pairs)):
        w = np.abs(weights[i])
        doubtful = ((w > 0) & (w < 1e-9)).any()
        k = first.shape[1]
        a, b = first[pairs.first[i]], second[pairs.second[i]]
        yield None if doubtful else (tuple(sorted(a[w[:k] > 0].tolist())), tuple(sorted(b[w[k:] > 0].tolist())))


def ipctk_lists():
    import ipctk

    ipctk.set_logger_level(ipctk.LoggerLevel.off)

    def listed(x, triangles):
        start = np.asfortranarray(x)
        mesh = ipctk.CollisionMesh(start, np.asfortranarray(edges_of(triangles)), np.asfortranarray(triangles))
        collisions = ipctk.NormalCollisions()
        collisions.build(mesh, start, RADIUS)
        edges, found = mesh.edges, set()
        for c in collisions.vv_collisions:
            found.add(frozenset([(c.vertex0_id,), (c.vertex1_id,)]))
        for c in collisions.ev_collisions:
            found.add(frozenset([(c.vertex_id,), tuple(sorted(edges[c.edge_id].tolist()))]))
        for c in collisions.ee_collisions:
            found.add(frozenset(tuple(sorted(edges[e].tolist())) for e in (c.edge0_id, c.edge1_id)))
        for c in collisions.fv_collisions:
            found.add(frozenset([(c.vertex_id,), tuple(sorted(triangles[c.face_id].tolist()))]))
        return found

    def wrong(x, triangles):
        edges, of_triangles, of_edges = pairs_of(x, triangles, 2.0**-53)
        wanted, doubtful = set(), set()
        for pairs, first, second in ((of_triangles, np.arange(len(x))[:, None], triangles), (of_edges, edges, edges)):
            for i, sides in enumerate(features(pairs.weights, first, second, pairs)):
                if not pairs.near[i] and not pairs.grey[i]:
                    continue
                a, b = first[pairs.first[i]], second[pairs.second[i]]
                if len(a) == 2:
                    e, f = x[a[1]] - x[a[0]], x[b[1]] - x[b[0]]
                    ratio = (np.cross(e, f) ** 2).sum() / ((e @ e) * (f @ f)) / 1e-3
                    if ratio < 1:  # below the threshold of the mollifier
                        sides = tuple(a.tolist()), tuple(b.tolist())
                    if abs(ratio - 1) < 1e-9:
                        sides = None
                if sides is None or pairs.grey[i]:  # all that this pair may be listed as
                    subsets = [[c for r in range(1, 4) for c in _subsets(s, r)] for s in (a.tolist(), b.tolist())]
                    doubtful |= {frozenset([p, q]) for p in subsets[0] for q in subsets[1]}
                else:
                    wanted.add(frozenset(sides))
        found = listed(x, triangles)
        near = int(of_triangles.near.sum() + of_edges.near.sum())
        missing = [k for k in wanted - doubtful if k not in found]
        yield ("nearest features", len(of_triangles) + len(of_edges), near, len(doubtful), missing,
               list(found - wanted - doubtful))

    return wrong


def _subsets(items, size):
    from itertools import combinations

    return [tuple(sorted(c)) for c in combinations(items, size)]


PEERS = {"newton": (newton_lists, ["newton", "warp-lang"]), "ipctk": (ipctk_lists, ["ipctk"])}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("peer", choices=sorted(PEERS))
    parser.add_argument("--states", type=int, default=100, help="of each kind")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--out")
    options = parser.parse_args()
    make, distributions = PEERS[options.peer]
    wrong, rows = make(), {}
    for kind, state in STATES.items():
        for index in range(options.states):
            x, triangles = state(np.random.default_rng([options.seed, len(kind), index]))
            x = x.astype(np.float32).astype(np.float64)
            for name, pairs, is_near, grey, missing, extra in wrong(x, triangles.astype(np.int32)):
                row = rows.setdefault((kind, name), dict.fromkeys(COLUMNS, 0) | {"set": f"{kind}: {name}",
                                                                                 "first_wrong": ""})
                for key, value in (("states", 1), ("pairs", pairs), ("near_pairs", is_near), ("grey", grey),
                                   ("missing", len(missing)), ("extra", len(extra))):
                    row[key] += value
                if (missing or extra) and not row["first_wrong"]:
                    row["first_wrong"] = f"state {index}: {(missing or extra)[0]}"
    version = ", ".join(f"{name} {importlib.metadata.version(name)}" for name in distributions)
    with open(options.out, "w", newline="", encoding="utf-8") if options.out else sys.stdout as file:
        writer = csv.DictWriter(file, COLUMNS, lineterminator="\n")
        writer.writeheader()
        for row in rows.values():
            writer.writerow({**row, "peer": options.peer, "version": version, "seed": options.seed})


if __name__ == "__main__":
    main()
