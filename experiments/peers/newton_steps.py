"""Newton's contacts step by step, each step in single or in double precision: which rounding makes a mismatch?

The formulas are those of the functions that newton_adapter.py names, for points with triangles and pairs of edges
longer than its threshold, in single precision. OGC_PEERS_STEPS names the steps that are in double, or `none`:

- `weights`: the nearest feature and the weights of the contact points, from products of coordinates,
- `points`: the contact points, their difference, distance and normal,
- `slip`: how far the contact points moved past each other, and its part in the plane,
- `rest`: slope and curvature, friction's law, and products with the weights.

With `moves` the slip is the weighted sum of the vertices' own displacements, in place of Newton's difference of two
positions of a point each.

With the variable set, the adapter answers by these formulas in place of Newton's kernels. A compiler may fuse a product
and a sum, which NumPy does not, so that counts of `none` and of Newton may differ a little. This prints what the judge
counts for each choice of steps, as CSV:

    experiments/peers/run newton steps [--cases N] [--seed S] [--out FILE]
"""

import argparse
import csv
import os
import sys

import numpy as np

STEPS = ("weights", "points", "slip", "rest")
ASKED = os.environ.get("OGC_PEERS_STEPS")
DOUBLE = (ASKED or "").split("+")
CHOICES = {
    "contact_force": ["", "none", "rest", "weights", "points", "weights+points", "weights+points+rest"],
    "friction_force": ["", "none", "points", "weights+slip", "weights+points+slip+rest", "moves", "moves+weights",
                       "moves+points", "moves+weights+points+slip+rest"],
}


def real(step):
    return np.float64 if step in DOUBLE else np.float32


def dot(a, b):
    return a[:, 0] * b[:, 0] + a[:, 1] * b[:, 1] + a[:, 2] * b[:, 2]


def difference(a, b, c, d):
    """Returns a b − c d as Warp does: rounded about once, by fused products."""
    if a.dtype == np.float64:
        return a * b - c * d
    a, b, c, d = (v.astype(np.float64) for v in (a, b, c, d))
    return (a * b - c * d).astype(np.float32)


def on_triangle(x):
    """Returns the weights (n, 3) of the nearest points of triangles x[:, 1:] to points x[:, 0], and their features:
    0 … 2 corners a, b, c, 3 … 5 edges ab, ac, bc, 6 the interior. The first condition that holds decides."""
    p, a, b, c = x[:, 0], x[:, 1], x[:, 2], x[:, 3]
    ab, ac = b - a, c - a
    (d1, d2), (d3, d4), (d5, d6) = ((dot(ab, p - q), dot(ac, p - q)) for q in (a, b, c))
    vc, vb, va = d1 * d4 - d3 * d2, d5 * d2 - d1 * d6, d3 * d6 - d5 * d4
    feature = np.select(
        [(d1 <= 0) & (d2 <= 0), (d3 >= 0) & (d4 <= d3), (d6 >= 0) & (d5 <= d6), (vc <= 0) & (d1 >= 0) & (d3 <= 0),
         (vb <= 0) & (d2 >= 0) & (d6 <= 0), (va <= 0) & (d4 - d3 >= 0) & (d5 - d6 >= 0)],
        [0, 1, 2, 3, 4, 5], 6)
    one, zero = np.ones_like(d1), np.zeros_like(d1)
    with np.errstate(all="ignore"):
        v_ab, v_ac, v_bc = d1 / (d1 - d3), d2 / (d2 - d6), (d4 - d3) / ((d4 - d3) + (d5 - d6))
        scale = one / (va + vb + vc)
        v, w = vb * scale, vc * scale
    weights = [[one, zero, zero], [zero, one, zero], [zero, zero, one], [one - v_ab, v_ab, zero],
               [one - v_ac, zero, v_ac], [zero, one - v_bc, v_bc], [one - v - w, v, w]]
    return np.array(weights)[feature, :, np.arange(len(x))], feature


def on_edges(x):
    """Returns the parameters s, t of the nearest points of edges x[:, :2] and x[:, 2:]."""
    d1, d2, r = x[:, 1] - x[:, 0], x[:, 3] - x[:, 2], x[:, 0] - x[:, 2]
    a, e, f, c, b = dot(d1, d1), dot(d2, d2), dot(d2, r), dot(d1, r), dot(d1, d2)
    with np.errstate(all="ignore"):
        cross = difference(a, e, b, b)
        s = np.where(cross > 0, np.clip(difference(b, f, c, e) / cross, 0, 1), 0).astype(x.dtype)
        t = (b * s + f) / e
        s = np.where(t < 0, np.clip(-c / a, 0, 1), np.where(t > 1, np.clip((b - c) / a, 0, 1), s))
    return s, np.clip(t, 0, 1)


def points_of_edges(x, s, t):
    return x[:, 0] + (x[:, 1] - x[:, 0]) * s[:, None], x[:, 2] + (x[:, 3] - x[:, 2]) * t[:, None]


def point_of_triangle(x, bary, feature):
    a, b, c = x[:, 1], x[:, 2], x[:, 3]
    v, w = bary[:, 1, None], bary[:, 2, None]
    near = [a, b, c, a + v * (b - a), a + w * (c - a), b + w * (c - b), a + v * (b - a) + w * (c - a)]
    return np.array(near)[feature, np.arange(len(x))]


def contact(x, start, edges):
    """Returns of contacts x (n, 4, 3), pairs of edges or of a point and a triangle: the signed weights, normal and
    distance of their points, and the motion of these points past each other since `start`."""
    at = x.astype(real("weights"))
    now, then = x.astype(real("slip")), start.astype(real("slip"))
    if edges:
        s, t = on_edges(at)
        first, second = points_of_edges(x.astype(real("points")), s.astype(real("points")), t.astype(real("points")))
        s, t = s.astype(real("slip")), t.astype(real("slip"))
        ways = [p - q for p, q in zip(points_of_edges(now, s, t), points_of_edges(then, s, t))]
        s, t = s.astype(real("rest")), t.astype(real("rest"))
        w = np.stack([1 - s, s, -1 + t, -t], axis=1)
    else:
        bary, feature = on_triangle(at)
        first = x[:, 0].astype(real("points"))
        second = point_of_triangle(x.astype(real("points")), bary.astype(real("points")), feature)
        weights = bary.astype(real("slip"))
        before = weights[:, :1] * then[:, 1] + weights[:, 1:2] * then[:, 2] + weights[:, 2:] * then[:, 3]
        ways = [now[:, 0] - then[:, 0], point_of_triangle(now, weights, feature) - before]
        w = np.concatenate([np.ones((len(x), 1)), -bary], axis=1).astype(real("rest"))
    gap = first - second
    distance = np.sqrt(dot(gap, gap))
    way = ways[0] - ways[1]
    if "moves" in DOUBLE:
        way = sum(w[:, k, None].astype(way.dtype) * (now[:, k] - then[:, k]) for k in range(4))
    return w, gap / distance[:, None], distance, way


def slopes(distance, radius, stiffness):
    """Returns slope and curvature of Newton's activation, which below 10 µm, or r/4, is a parabola; 0 beyond r, and
    where the distance is NaN, as of a triangle with two corners in one point."""
    d, r, k = (np.asarray(v).astype(real("rest")) for v in (distance, radius, stiffness))
    tau = r / 2
    least = np.minimum(np.array(1e-5, d.dtype), tau / 2)
    k_log = tau * tau * k
    where = [(d > least) & (d < tau), d <= least]
    slope = np.select(where, [-k_log / d, k_log * (d - 2 * least) / (least * least)], -k * (r - d))
    curvature = np.select(where, [k_log / (d * d), k_log / (least * least)], k)
    return np.where(d < r, slope, 0), np.where(d < r, curvature, 0)


def outer(a, b):
    return a[:, :, None] * b[:, None, :]


def contact_force(x, edges, own, radius, stiffness):
    """Returns force (n, 3) and block (n, 3, 3) of vertices `own` of contacts x (n, 4, 3)."""
    w, n, distance, _ = contact(x, x, edges)
    slope, curvature = slopes(distance, radius, stiffness)
    w, n = (np.where((distance < radius)[:, None], v, 0).astype(real("rest")) for v in (w, n))
    w = w[np.arange(len(x)), own]
    return (-slope * w)[:, None] * n, (curvature * w * w)[:, None, None] * outer(n, n)


def basis(n):
    """Returns two unit vectors normal to n and to each other, as Newton chooses them."""
    x, y, z = n.T
    sign = np.where(z < 0, -1, 1).astype(n.dtype)
    a = -1 / (sign + z)
    b = x * y * a
    return np.stack([1 + sign * x * x * a, sign * b, -sign * x], 1), np.stack([b, sign + y * y * a, -y], 1)


def friction_force(x, start, edges, own, radius, stiffness, mu, limit):
    """Returns force and block of friction alone."""
    w, n, distance, way = contact(x, start, edges)
    w, n, way = (np.where((distance < radius)[:, None], v, 0).astype(v.dtype) for v in (w, n, way))
    slope, _ = slopes(distance, radius, stiffness)
    e = [v.astype(real("rest")) for v in basis(n.astype(real("slip")))]
    u = [dot(v, way).astype(real("rest")) for v in basis(n.astype(real("slip")))]
    size = np.sqrt(u[0] * u[0] + u[1] * u[1])
    mu, limit = mu.astype(real("rest")), limit.astype(real("rest"))
    with np.errstate(all="ignore"):
        rate = np.where(size > limit, 1 / size, (-size / limit + 2) / limit)
    scale = np.where(size > 0, mu * -slope * rate, 0) * w[np.arange(len(x)), own]
    plane = outer(e[0], e[0]) + outer(e[1], e[1])
    force = -scale[:, None] * (u[0][:, None] * e[0] + u[1][:, None] * e[1])
    return force, (scale * w[np.arange(len(x)), own])[:, None, None] * plane


def main():
    import table

    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--cases", type=int, default=50_000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--out", help="the table goes into this file, too")
    options = parser.parse_args()
    tables = [sys.stdout] + ([open(options.out, "w", newline="", encoding="utf-8")] if options.out else [])
    names = ["version", "stage", "answers_by", "steps_in_double", "cases", "mismatches", "groups_failing", "seed"]
    writers = [csv.DictWriter(file, names, lineterminator="\n") for file in tables]
    for writer in writers:
        writer.writeheader()
    for stage, choices in CHOICES.items():
        for choice in choices:
            own = {"OGC_PEERS_OWN": "1"} | ({"OGC_PEERS_STEPS": choice} if choice else {})
            question = table.Question("newton", stage, "", environment=own)
            row = table.row_of(question, options.cases, options.seed)
            row |= {"answers_by": "its formulas" if choice else "Newton", "steps_in_double": choice}
            for writer, file in zip(writers, tables):
                writer.writerow({name: row[name] for name in names})
                file.flush()


if __name__ == "__main__":
    main()
