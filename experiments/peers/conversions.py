"""Converts between the judge's conventions and those of peers. Adapters share these functions; they need NumPy only.

What the judge asks and a peer does not define is answered here, in double, and counted as *own*: the log that
OGC_PEERS_LOG names gets a line of JSON for each call, with the cases that the peer was asked.
"""

import json
import os
import time
from fractions import Fraction

import numpy as np

UNIT = 2.0**-24  # half an ulp of single precision
CORNER_0, CORNER_1, CORNER_2, EDGE_01, EDGE_12, EDGE_20, INTERIOR = range(7)
END_0, END_1, EDGE_INTERIOR = range(3)
POINT_POINT, POINT_EDGE, EDGE_EDGE, POINT_TRIANGLE = range(4)


def log(**row):
    """Appends a line to the file that OGC_PEERS_LOG names, if it names one."""
    if "OGC_PEERS_LOG" in os.environ:
        with open(os.environ["OGC_PEERS_LOG"], "a", encoding="utf-8") as file:
            file.write(json.dumps(row) + "\n")


class Timed:
    """Logs what a block of code that prepares a peer takes: the import, or the compilation of its kernels."""

    def __init__(self, what):
        self.what = what

    def __enter__(self):
        self.start = time.perf_counter()

    def __exit__(self, *_):
        log(prepared=self.what, seconds=time.perf_counter() - self.start)


def doubles(vectors):
    """Returns an array of ogc_vec3, or of rows of three numbers, in double: (…, 3). No value changes."""
    if vectors.dtype.names:
        return np.stack([vectors[axis] for axis in "xyz"], axis=-1).astype(np.float64)
    return np.asarray(vectors, np.float64)


def singles(vectors):
    """Returns the same in single precision."""
    return np.ascontiguousarray(doubles(vectors).astype(np.float32))


def spread(points):
    """Returns Σ|δ| of each case, the sum of the moduli of all coordinates relative to the case's first point."""
    return np.abs(points - points[:, :1]).sum(axis=(1, 2))


def below(distance, points, allowance=2):
    """Returns a lower bound of a peer's distance. Peers have none; rounding to nearest would be too large in every
    second case. The judge accepts a bound that is 24 u max(d, Σ|δ|) too small, by its own smallest choice of Σ|δ|, at
    least a third of this one. So `allowance` u max(d, Σ|δ|) is subtracted, at most 8; only an error above it counts."""
    slack = allowance * UNIT * np.maximum(distance, spread(points))
    return rounded_down(np.maximum(distance - slack, 0))


def edges_answer(features, parallel, parameters, distance, below):
    """Returns the outputs of `closest_points` in the order of the header."""
    first, second = features.T.copy()
    return first, second, parallel.astype(np.uint8), parameters.astype(np.float32), distance.astype(np.float32), below


def at_ends(features, parameters, first, second, distance):
    """Returns features and parameters of two edges by the judge's rule of ties: of equally near features the
    lower-dimensional one. Peers call an end the edge's interior if the parameter of its closest point is exactly 0 or
    1. Of edges that touch, which peers exclude, the answer is ours."""
    interior = features == EDGE_INTERIOR
    features = np.where(interior & (parameters == 0), END_0, features)
    features = np.where(interior & (parameters == 1), END_1, features).astype(np.uint8)
    parameters = parameters.copy()
    near = distance < 1e-6 * spread(np.concatenate([first, second], axis=1))
    for i in np.flatnonzero(near):
        found = touching(first[i], second[i])
        if found:
            features[i] = found
            for side, (own, other) in enumerate(((first[i], second[i]), (second[i], first[i]))):
                end, e = other[found[1 - side] % 2], own[1] - own[0]
                parameters[i, side] = found[side] if found[side] < 2 else ((end - own[0]) @ e) / (e @ e)
    return features, parameters


def rounded_down(values):
    """Returns single-precision numbers that are not above these."""
    rounded = np.asarray(values, np.float64).astype(np.float32)
    return np.where(rounded > values, np.nextafter(rounded, np.float32(-np.inf)), rounded).astype(np.float32)


def nearly_parallel(first, second):
    """Evaluates the rule of closest_points for edges (n, 2, 3): ‖e×e'‖² < 10⁻⁶ ‖e‖² ‖e'‖², and an overlap along the
    first edge in more than a point. No peer has it.

    Returns for each case whether the rule holds, the parameters of its contact points, and their distance.
    """
    e, f = first[:, 1] - first[:, 0], second[:, 1] - second[:, 0]
    ee, ff = (e * e).sum(axis=1), (f * f).sum(axis=1)
    holds = (np.cross(e, f) ** 2).sum(axis=1) < 1e-6 * ee * ff
    with np.errstate(all="ignore"):
        ends = [((second[:, k] - first[:, 0]) * e).sum(axis=1) / ee for k in range(2)]
        low, high = np.maximum(0, np.minimum(*ends)), np.minimum(1, np.maximum(*ends))
        for i in np.flatnonzero(holds & (np.abs(high - low) < 1e-9)):  # in double the overlap's sign is not certain
            holds[i] = overlaps(first[i], second[i])
        holds &= (high > low) | (np.abs(high - low) < 1e-9)
        s = (low + high) / 2
        t = np.clip(((first[:, 0] + s[:, None] * e - second[:, 0]) * f).sum(axis=1) / ff, 0, 1)
        gap = first[:, 0] + s[:, None] * e - second[:, 0] - t[:, None] * f
    return holds, np.stack([s, t], axis=1), np.sqrt((gap * gap).sum(axis=1)), high - low


def exact(point):
    return [Fraction(float(x)) for x in point]


def along(a, b, p):
    """Returns (b − a)·(p − a) exactly."""
    a, b, p = exact(a), exact(b), exact(p)
    return sum((y - x) * (z - x) for x, y, z in zip(a, b, p))


def overlaps(first, second):
    """Returns whether the projection of the second edge on the line of the first overlaps it in more than a point."""
    return all(any(along(first[k], first[1 - k], end) > 0 for end in second) for k in range(2))


def lies_on(point, edge):
    """Returns whether a point lies exactly in the interior of an edge."""
    p, a, b = exact(point), exact(edge[0]), exact(edge[1])
    d, e = [x - y for x, y in zip(p, a)], [x - y for x, y in zip(b, a)]
    if any(d[i] * e[j] != d[j] * e[i] for i, j in ((0, 1), (1, 2), (2, 0))):
        return False
    return along(edge[0], edge[1], point) > 0 and along(edge[1], edge[0], point) > 0


def touching(first, second):
    """Returns the features of two edges that share a point which is an end of one of them, else None. There the judge
    wants the lowest-dimensional features, exactly; peers exclude touching edges."""
    for i in range(2):
        for j in range(2):
            if (first[i] == second[j]).all():
                return i, j
    for i in range(2):
        if lies_on(first[i], second):
            return i, EDGE_INTERIOR
        if lies_on(second[i], first):
            return EDGE_INTERIOR, i
    return None


def truncated(previous, moved, bound):
    """Rounds positions (in double) to single precision, towards `previous` until they are inside the bound: a peer in
    double does not answer for the last bit of a stored position."""
    x = moved.astype(np.float32)
    centre, b = previous.astype(np.float64), bound.astype(np.float64)

    def outside(which):
        d = x[which].astype(np.float64) - centre[which]
        return which[(d * d).sum(axis=1) > b[which] * b[which] * (1 - 2.0**-50)]

    left = outside(np.arange(len(x)))
    for _ in range(4):  # each step is an ulp of all three coordinates; what is farther outside is the peer's error
        x[left] = np.nextafter(x[left], previous[left])
        left = outside(left)
    return x


def hinge(theta, start, gradient, case):
    """Returns force and block of the discrete hinge from angles and the gradient of the own vertex.

    E = c/2 (θ − θ₀)² + k c/2 (θ − θᵗ)², or with per_vertex damping the first term, to which k times its block is added.
    """
    c, k = case["stiffness"].astype(np.float64), case["damping"].astype(np.float64)
    per_vertex = case["damping_form"] == 1
    moment = c * (theta - case["rest_angle"]) + np.where(per_vertex, 0, k * c * (theta - start))
    rows = np.arange(len(case))
    own = case["own"]
    moved = doubles(case["vertex"])[rows, own] - doubles(case["start"])[rows, own]
    block = c[:, None, None] * gradient[:, :, None] * gradient[:, None, :]
    force = -moment[:, None] * gradient
    force -= np.where(per_vertex, k, 0)[:, None] * np.einsum("nij,nj->ni", block, moved)
    return force, packed((1 + k)[:, None, None] * block)


def dihedral(x):
    """Returns angles of hinges (n, 4, 3) in double, their gradients (n, 4, 3), and the smallest of the lengths of both
    normals and the edge. A collapsed hinge has angle and gradient 0."""
    e, a, b = x[:, 1] - x[:, 0], x[:, 2] - x[:, 0], x[:, 3] - x[:, 0]
    n0, n1 = np.cross(e, a), np.cross(b, e)
    sizes = [np.sqrt((v * v).sum(axis=1)) for v in (n0, n1, e)]
    least = np.minimum.reduce(sizes)
    with np.errstate(all="ignore"):
        m0, m1, length = n0 / sizes[0][:, None], n1 / sizes[1][:, None], sizes[2]
        theta = np.arctan2((np.cross(m0, m1) * e).sum(axis=1) / length, (m0 * m1).sum(axis=1))
        g0, g1 = (-length / sizes[0])[:, None] * m0, (-length / sizes[1])[:, None] * m1
        s, t = [((y * e).sum(axis=1) / length**2)[:, None] for y in (a, b)]
        gradient = np.stack([-(1 - s) * g0 - (1 - t) * g1, -s * g0 - t * g1, g0, g1], axis=1)
    flat = least == 0
    return np.where(flat, 0, theta), np.where(flat[:, None, None], 0, gradient), least


def stable_neo_hookean_force(cases):
    """Returns the stage's force of the stable Neo-Hookean membrane without damping, and J, the ratio of areas."""
    x, g = doubles(cases["corner"]), cases["gradient"].astype(np.float64)
    mu, lam, area = (cases[name].astype(np.float64)[:, None] for name in ("lame_mu", "lame_lambda", "area"))
    f = np.einsum("nki,nkj->nij", np.stack([x[:, 1] - x[:, 0], x[:, 2] - x[:, 0]], axis=1), g)
    b = -g.sum(axis=1)
    cross = np.cross(f[:, :, 0], f[:, :, 1])
    j = np.linalg.norm(cross, axis=1)[:, None]
    t = b[:, :1] * f[:, :, 1] - b[:, 1:] * f[:, :, 0]
    slope = np.cross(t, cross / np.maximum(j, 1e-300))
    return -area * (mu * np.einsum("nij,nj->ni", f, b) + ((lam + mu) * (j - 1) - mu) * slope), j[:, 0]


def stable_neo_hookean_block(cases):
    """Returns the stage's block of the stable Neo-Hookean membrane without damping (compare/stages/membrane.hpp)."""
    x, g = doubles(cases["corner"]), cases["gradient"].astype(np.float64)
    mu, lam, area = (cases[name].astype(np.float64)[:, None, None] for name in ("lame_mu", "lame_lambda", "area"))
    f = np.einsum("nki,nkj->nij", np.stack([x[:, 1] - x[:, 0], x[:, 2] - x[:, 0]], axis=1), g)  # columns f₁, f₂
    b = -g.sum(axis=1)
    cross = np.cross(f[:, :, 0], f[:, :, 1])
    j = np.sqrt((cross * cross).sum(axis=1))
    n = cross / np.maximum(j, 1e-300)[:, None]
    t = b[:, :1] * f[:, :, 1] - b[:, 1:] * f[:, :, 0]
    slope = np.cross(t, n)
    bb, tt = (b * b).sum(axis=1), (t * t).sum(axis=1)
    along = ((lam + mu) * (j[:, None, None] - 1) - mu)[:, 0, 0] * tt / np.maximum(j, 1e-300)
    along = np.maximum(along, -(mu[:, 0, 0] * bb))  # the eigenvalue along n is not below 0
    outer = n[:, :, None] * n[:, None, :]
    return area * (mu * bb[:, None, None] * np.eye(3) + (lam + mu) * slope[:, :, None] * slope[:, None, :]
                   + along[:, None, None] * outer)


def packed(blocks):
    """Returns symmetric matrices as xx, xy, xz, yy, yz, zz."""
    return blocks[:, [0, 0, 0, 1, 1, 2], [0, 1, 2, 1, 2, 2]]


def activation(distance, radius, stiffness, kind):
    """Returns g, g', g'' of the activations of the stage in double: `ogc`, `ogc_as_printed`, `quadratic`, `ipc_log`,
    `cubic`, by number."""
    d, r, k = (np.asarray(a, np.float64) for a in (distance, radius, stiffness))
    tau = r / 2
    k_log = np.where(kind == 1, tau * k * (tau - r) ** 2, tau * k * (r - tau))
    quadratic = (k / 2 * (r - d) ** 2, -k * (r - d), k + 0 * d)
    logarithm = (k_log * np.log(tau / d) + k / 2 * (r - tau) ** 2, -k_log / d, k_log / (d * d))
    ln, s = np.log(d / r), (r - d) / d
    ipc_log = (-k * (d - r) ** 2 * ln, k * (r - d) * (2 * ln - s), k * (-2 * ln + s * (4 + s)))
    cubic = (2 * k / (3 * r) * (r - d) ** 3, -2 * k / r * (r - d) ** 2, 4 * k / r * (r - d))
    out = []
    for q, l, i, c in zip(quadratic, logarithm, ipc_log, cubic):
        value = np.where((kind <= 1) & (d < tau), l, np.where(kind == 3, i, np.where(kind == 4, c, q)))
        out.append(np.where(d < r, value, 0))
    return out


def nearest_of_edges(a, b):
    """Returns the parameters (n, 2) of the closest points of edges (n, 2, 3) in double."""
    e, f, r = a[:, 1] - a[:, 0], b[:, 1] - b[:, 0], b[:, 0] - a[:, 0]
    ee, ff, ef, er, fr = [(u * v).sum(axis=1) for u, v in ((e, e), (f, f), (e, f), (e, r), (f, r))]
    cross = (np.cross(e, f) ** 2).sum(axis=1)
    with np.errstate(all="ignore"):
        tries = [((er * ff - fr * ef) / cross, (er * ef - fr * ee) / cross)]
        for k in range(2):
            end = np.full(len(a), float(k))
            tries.append((end, np.clip(((a[:, k] - b[:, 0]) * f).sum(axis=1) / ff, 0, 1)))
            tries.append((np.clip(((b[:, k] - a[:, 0]) * e).sum(axis=1) / ee, 0, 1), end))
        tries = np.array(tries, np.float64)  # (5, 2, n)
        outside = ~((tries >= 0) & (tries <= 1)).all(axis=1)
        s, t = tries[:, 0, :, None], tries[:, 1, :, None]
        gap = ((a[None, :, 0] + s * e - b[None, :, 0] - t * f) ** 2).sum(axis=2)
    best = np.argmin(np.where(outside, np.inf, gap), axis=0)
    return tries[best, :, np.arange(len(a))]


def nearest_of_triangle(p, t):
    """Returns the weights (n, 3) of the points of triangles (n, 3, 3) nearest to points (n, 3), in double."""
    rows = np.arange(len(p))
    normal = np.cross(t[:, 1] - t[:, 0], t[:, 2] - t[:, 0])
    with np.errstate(all="ignore"):
        inner = np.stack([(np.cross(t[:, (k + 2) % 3] - t[:, (k + 1) % 3], p - t[:, (k + 1) % 3]) * normal).sum(axis=1)
                          / (normal * normal).sum(axis=1) for k in range(3)], axis=1)
        tries = [inner]
        for k in range(3):
            a, e = t[:, k], t[:, (k + 1) % 3] - t[:, k]
            s = np.nan_to_num(np.clip(((p - a) * e).sum(axis=1) / (e * e).sum(axis=1), 0, 1))
            w = np.zeros((len(p), 3))
            w[:, k], w[:, (k + 1) % 3] = 1 - s, s
            tries.append(w)
        tries = np.array(tries)
        gap = ((np.einsum("knj,nji->kni", tries, t) - p) ** 2).sum(axis=2)
        gap = np.where((tries >= 0).all(axis=2), gap, np.inf)
    return tries[np.argmin(gap, axis=0), rows]


def contact(case):
    """Returns of contacts the signed weights (n, 4), the normal (n, 3) and distance of their points, e_k, and whether
    their edges are nearly parallel, in double (compare/stages/contact_force.hpp)."""
    x, sides, n = doubles(case["vertex"]), case["sides"], len(case)
    w, parallel, e_k = np.zeros((n, 4)), np.zeros(n, bool), np.ones(n)
    w[:, 0] = 1
    w[sides == POINT_POINT, 1] = -1
    i = np.flatnonzero(sides == POINT_EDGE)
    e = x[i, 2] - x[i, 1]
    with np.errstate(all="ignore"):
        s = np.nan_to_num(np.clip(((x[i, 0] - x[i, 1]) * e).sum(axis=1) / (e * e).sum(axis=1), 0, 1))
    w[i, 1], w[i, 2] = s - 1, -s
    i = np.flatnonzero(sides == POINT_TRIANGLE)
    w[i, 1:] = -nearest_of_triangle(x[i, 0], x[i, 1:])
    i = np.flatnonzero(sides == EDGE_EDGE)
    before = doubles(case["previous"])[i]
    parallel[i], middle, _, _ = nearly_parallel(x[i, :2], x[i, 2:])
    s, t = np.where(parallel[i, None], middle, nearest_of_edges(x[i, :2], x[i, 2:])).T
    w[i] = np.stack([1 - s, s, t - 1, -t], axis=1)
    rest = case["rest_squared"].astype(np.float64)[i]
    limit = 1e-3 * rest[:, 0] * rest[:, 1]
    c = (np.cross(before[:, 1] - before[:, 0], before[:, 3] - before[:, 2]) ** 2).sum(axis=1)
    with np.errstate(all="ignore"):
        e_k[i] = np.where(c < limit, c / limit * (2 - c / limit), 1)
        were, _, _, share = nearly_parallel(before[:, :2], before[:, 2:])
        lengths = np.linalg.norm(before[:, [1, 3]] - before[:, [0, 2]], axis=2)
        share = share * lengths[:, 0] / lengths.min(axis=1)
    loose = (rest == 0).all(axis=1) & were
    e_k[i] = np.where(loose, share, e_k[i])
    gap = np.einsum("nk,nki->ni", w, x)
    d = np.linalg.norm(gap, axis=1)
    return w, np.where(d[:, None] > 0, gap / np.maximum(d, 1e-300)[:, None], 0), d, e_k, parallel


def contact_slopes(case, d, e_k):
    """Returns e_k g' and e_k g'' at the distances, which are clamped to 2⁻²³ r … r; beyond r the slope is 0."""
    r, k, kind = case["contact_radius"].astype(np.float64), case["stiffness"].astype(np.float64), case["activation"]
    _, slope, curvature = activation(np.maximum(d, 2.0**-23 * r), r, k, kind)
    curvature = np.where(d >= r, np.where(kind <= 2, k, 0), curvature)
    return np.where(d > 0, e_k * slope, 0), np.where(d > 0, e_k * curvature, 0)


def own_weights(case, w):
    """Returns the weight of each case's own vertex, and |w| Σ |w_u| over the vertices updated together with it."""
    rows, own = np.arange(len(case)), case["own"]
    bits = case["together"].astype(np.int64) | (1 << own.astype(np.int64))
    moved = np.where((bits[:, None] >> np.arange(4)) & 1, np.abs(w), 0).sum(axis=1)
    return w[rows, own], np.abs(w[rows, own]) * moved


def contact_force(case):
    """Returns force and block of the stage, packed."""
    w, n, d, e_k, _ = contact(case)
    slope, curvature = contact_slopes(case, d, e_k)
    own, square = own_weights(case, w)
    return -(slope * own)[:, None] * n, packed((curvature * square)[:, None, None] * n[:, :, None] * n[:, None, :])


def friction_force(case):
    """Returns force and block of the stage, packed, and the slip (n, 3)."""
    w, n, d, e_k, _ = contact(case["contact"])
    slope, _ = contact_slopes(case["contact"], d, e_k)
    own, square = own_weights(case["contact"], w)
    moved = np.einsum("nk,nki->ni", w, doubles(case["contact"]["vertex"]) - doubles(case["start"]))
    slip = moved - (moved * n).sum(axis=1)[:, None] * n
    y, limit = np.linalg.norm(slip, axis=1), case["slip_limit"].astype(np.float64)
    with np.errstate(all="ignore"):
        rate = np.where(y < limit, (2 - y / limit) / limit, 1 / y)
    size = np.where(slope < 0, -case["friction"] * slope, 0) * rate
    plane = np.eye(3) - n[:, :, None] * n[:, None, :]
    return -(size * own)[:, None] * slip, packed((size * square)[:, None, None] * plane), slip


def alone(case):
    """Returns of contacts whether no other vertex is updated together with the case's own one."""
    return (case["together"] & ~(1 << case["own"].astype(np.uint8)) & 15) == 0
