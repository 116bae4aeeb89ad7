"""Truncation over gaps: does a filter of steps keep two sheets apart, from a gap of 1e-12 m to 0.1 m?

    PYTHON gaps.py move FILTER… --out moved.npz     # in an environment that has the filter
    PYTHON gaps.py judge moved.npz … --out FILE     # in one that has ogc_testbed with its audit
    PYTHON gaps.py draw FILE --out picture.png      # in one that has Matplotlib
    PYTHON gaps.py causes passed.npz --out FILE     # in ipctk's, of the pairs that `judge --passed passed.npz` wrote

Filters: `ipctk` (filter_step), `ipctk_planar` (planar_filter_step), `newton`; `ball` and `planes` are ours
(ogc_testbed.Guard). Every filter gets the same pairs, whose coordinates are single-precision numbers, and the same
random displacements, one step each, up to 1000 gaps long. Its result is judged exactly: no triangles may meet at its
end or on the straight way to it. The query radius is 0.2 m for all.
"""

import argparse
import csv
import sys

import numpy as np

QUERY_RADIUS = 0.2
DECADES = range(-12, 0)  # gaps of 10^k to 10^(k+1) m
SHAPES = ("parallel", "point_triangle", "edge_edge", "crowded")
PLACES = ("flat", "turned")
ROUNDING = 1e-14  # [m] above that of a plane's point: a few units of 1.1e-16 of three products of coordinates below 3 m
FAN = 6  # triangles around a crowded vertex


def fan(rng, height, lift):
    """Returns FAN triangles about (0, 0, height), whose rim is `lift` higher by vertex."""
    angles = 2 * np.pi * (np.arange(FAN) + rng.uniform(0.1, 0.9, FAN)) / FAN
    rim = np.stack([np.cos(angles), np.sin(angles), np.zeros(FAN)], axis=1) * rng.uniform(0.5, 1, (FAN, 1))
    rim[:, 2] = height + lift
    return np.concatenate([[[0, 0, height]], rim])


def pair(shape, gap, rng):
    """Returns vertices and triangles of two sheets at this distance, the lower one at or below z = 0."""
    if shape == "crowded":
        flat = rng.random() < 0.5
        lower, upper = fan(rng, 0, 0), fan(rng, gap, 0 if flat else rng.uniform(0, 0.5, FAN))
        sheet = np.array([[0, 1 + k, 1 + (k + 1) % FAN] for k in range(FAN)])
        return np.concatenate([lower, upper]), np.concatenate([sheet, sheet + FAN + 1])
    angles = 2 * np.pi * (np.arange(3) + rng.uniform(0.1, 0.9, 3)) / 3
    lower = np.stack([np.cos(angles), np.sin(angles), np.zeros(3)], axis=1)
    if shape == "parallel":
        angles = rng.uniform(0, 2 * np.pi) + 2 * np.pi * np.arange(3) / 3
        upper = np.stack([np.cos(angles), np.sin(angles), np.full(3, gap)], axis=1)
        upper[:, :2] += rng.uniform(-0.2, 0.2, 2)
    elif shape == "point_triangle":
        upper = rng.uniform(-1, 1, (3, 3))
        upper[:, 2] = gap + rng.uniform(0.05, 0.5, 3)
        upper[0] = *rng.uniform(-0.1, 0.1, 2), gap
    else:
        lower = np.array([[-1, 0, 0], [1, 0, 0], [0, 1, -1]]) * rng.uniform(0.5, 1, (3, 1))
        upper = np.array([[0, -1, 0], [0, 1, 0], [1, 0, 1]]) * rng.uniform(0.5, 1, (3, 1))
        upper[:, 2] += gap
    return np.concatenate([lower, upper]), np.array([[0, 1, 2], [3, 4, 5]])


def turn(rng):
    """Returns a random rotation, or one with a reflection."""
    q, r = np.linalg.qr(rng.normal(size=(3, 3)))
    return q * np.sign(np.diag(r))


def questions(count, seed):
    """Returns `count` pairs of each shape, place and decade: these three, positions, triangles, displacement.

    A flat pair lies about z = 0, where single precision has every gap. A turned one is rotated and moved by up to 1 m,
    then rounded, which changes gaps by up to 1e-7 m; if it then starts with an intersection, it is not judged."""
    found = []
    for key in ((s, p, d) for s in SHAPES for p in PLACES for d in DECADES):
        shape, place, decade = key
        rng = np.random.default_rng([seed, SHAPES.index(shape), PLACES.index(place), -decade])
        for _ in range(count):
            gap = 10 ** rng.uniform(decade, decade + 1)
            x, triangles = pair(shape, gap, rng)
            if place == "turned":
                x = x @ turn(rng).T + rng.uniform(-1, 1, 3)
            length = np.minimum(0.3, gap * 10 ** rng.uniform(0, 3, (len(x), 1)))  # up to 1000 gaps
            way = rng.normal(size=x.shape)
            dx = way / np.linalg.norm(way, axis=1, keepdims=True) * length
            found.append((key, x.astype(np.float32), triangles.astype(np.int32), dx.astype(np.float32)))
    return found


def edges_of(triangles):
    ends = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    return np.unique(np.sort(ends), axis=0)


def ipctk_filter(planar):
    import ipctk

    ipctk.set_logger_level(ipctk.LoggerLevel.off)

    def move(x, triangles, dx):
        start = np.asfortranarray(x.astype(np.float64))
        mesh = ipctk.CollisionMesh(start, np.asfortranarray(edges_of(triangles)), np.asfortranarray(triangles))
        region = ipctk.ogc.TrustRegion(QUERY_RADIUS / 2)  # whose inflation radius is twice that
        region.update(mesh, start, ipctk.NormalCollisions())
        step = np.asfortranarray(dx.astype(np.float64))
        (region.planar_filter_step if planar else region.filter_step)(mesh, start, step)
        return start + step

    return move


def newton_filter():
    """The two kernels by which SolverVBD truncates (private names of newton 1.8.0), with complete lists of pairs."""
    import warp as wp

    wp.config.quiet = True
    from newton._src.solvers.vbd import particle_vbd_kernels as vbd
    from newton._src.geometry.tri_mesh_collision import build_tri_mesh_collision_info

    relaxation = 0.85  # dat_conservative_bound_relaxation of SolverVBD

    def move(x, triangles, dx):
        edges, half = edges_of(triangles), len(x) // 2
        sides = [np.flatnonzero(edges[:, 0] < half), np.flatnonzero(edges[:, 0] >= half)]
        faces = [np.flatnonzero(triangles[:, 0] < half), np.flatnonzero(triangles[:, 0] >= half)]
        most = max(len(edges), len(triangles))
        sizes = {f"{kind}_collision_buffer_pre_alloc": most for kind in ("vertex", "triangle", "edge")}
        info = build_tri_mesh_collision_info(len(x), len(triangles), len(edges), device="cpu", **sizes,
                                             record_triangle_contacting_vertices=False)
        rows = np.zeros((len(x), most, 2), np.int32), np.zeros((len(edges), most, 2), np.int32)
        counts = np.zeros(len(x), np.int32), np.zeros(len(edges), np.int32)
        for v in range(len(x)):
            others = faces[int(v < half)]
            rows[0][v, : len(others), 0], rows[0][v, : len(others), 1], counts[0][v] = v, others, len(others)
        for e in range(len(edges)):
            others = sides[int(edges[e, 0] < half)]
            rows[1][e, : len(others), 0], rows[1][e, : len(others), 1], counts[1][e] = e, others, len(others)
        info.vertex_colliding_triangles.assign(rows[0].ravel())
        info.vertex_colliding_triangles_count.assign(counts[0])
        info.edge_colliding_edges.assign(rows[1].ravel())
        info.edge_colliding_edges_count.assign(counts[1])
        indices = np.concatenate([np.full_like(edges, -1), edges], axis=1)  # opposite vertices are for bending alone
        q, d = wp.array(x, dtype=wp.vec3, device="cpu"), wp.array(dx, dtype=wp.vec3, device="cpu")
        t, end = wp.full(len(x), 1.0, dtype=float, device="cpu"), wp.zeros(len(x), dtype=wp.vec3, device="cpu")
        arrays = [wp.array(a, dtype=int, device="cpu") for a in (triangles, indices)]
        threads = vbd.NUM_THREADS_PER_COLLISION_PRIMITIVE * max(len(x), len(edges))
        wp.launch(vbd.apply_planar_truncation_parallel_by_collision, dim=threads, device="cpu",
                  inputs=[q, d, *arrays, info, relaxation], outputs=[t])
        wp.launch(vbd.apply_truncation_ts, dim=len(x), device="cpu",
                  inputs=[q, d, t, QUERY_RADIUS * relaxation * 0.5], outputs=[d, end])
        return end.numpy().astype(np.float64)

    return move


def our_filter(bounds):
    import ogc_testbed as ogc

    def move(x, triangles, dx):
        guard = ogc.Guard(ogc.Mesh(triangles, vertex_count=len(x)), x, query_radius=QUERY_RADIUS, bounds=bounds)
        return np.array(guard.step(x, dx), np.float64)

    return move


FILTERS = {
    "ipctk": lambda: ipctk_filter(False), "ipctk_planar": lambda: ipctk_filter(True), "newton": newton_filter,
    "ball": lambda: our_filter("ball"), "planes": lambda: our_filter("planes"),
}


def move(options):
    asked = questions(options.pairs, options.seed)
    moved = {"pairs": options.pairs, "seed": options.seed}
    for name in options.inputs:
        move_one = FILTERS[name]()
        moved[name] = np.concatenate([move_one(x, t, dx) for _, x, t, dx in asked])
    np.savez(options.out, **moved)


def judge(options):
    import ogc_testbed as ogc

    rows, passed = [], {}
    for file in options.inputs:
        moved = np.load(file)
        passed |= {"pairs": moved["pairs"], "seed": moved["seed"]}
        asked = questions(int(moved["pairs"]), int(moved["seed"]))
        splits = np.cumsum([len(x) for _, x, _, _ in asked])[:-1]
        for name in (n for n in moved.files if n in FILTERS):
            cells = {(s, p, d): [0, 0, 0.0] for s in SHAPES for p in PLACES for d in DECADES}
            verdicts = passed[name] = np.full((len(asked), 2), np.nan)  # gap, and 1 where it passes through
            for index, ((key, x, t, dx), end) in enumerate(zip(asked, np.split(moved[name], splits))):
                report = ogc.audit(np.stack([x.astype(np.float64), end]), t, motion=True)
                if report.counts[0]:
                    continue
                gap = float(min(report.distance_vertex_triangle[0], report.distance_edge_edge[0]))  # after rounding
                decade = min(max(int(np.floor(np.log10(gap))), DECADES[0]), DECADES[-1]) if gap > 0 else None
                if decade is None:
                    continue  # they touch
                cell = cells[(*key[:2], decade)]
                cell[0] += 1
                verdicts[index] = gap, bool(report.counts[1]) or bool(np.any(report.meeting_counts))
                cell[1] += int(verdicts[index, 1])
                cell[2] += np.linalg.norm(end - x, axis=1).sum() / np.linalg.norm(dx, axis=1).sum()
            rows += [{"filter": name, "shape": s, "place": p, "gap_from_m": f"1e{d}", "pairs": n, "pass_through": f,
                      "kept_share": f"{k / n:.3g}" if n else "", "seed": int(moved["seed"])}
                     for (s, p, d), (n, f, k) in cells.items()]
    if options.passed:
        np.savez(options.passed, **passed)
    write(rows, options.out)


def write(rows, path):
    with open(path, "w", newline="", encoding="utf-8") if path else sys.stdout as file:
        writer = csv.DictWriter(file, rows[0], lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def planes_of_ipctk(x, triangles, dx):
    """Yields for each near pair of primitives, by the rule of ipctk's planar filter: whether it is left out (nearer
    than 1e-10 m), whether the plane's normal, as rounded, separates the two sides exactly, whether a vertex crosses the
    plane before 1e-10 of its step, and whether one begins beyond the plane where the motions place it."""
    import ipctk
    from conversions import exact

    start = np.asfortranarray(x.astype(np.float64))
    mesh = ipctk.CollisionMesh(start, np.asfortranarray(edges_of(triangles)), np.asfortranarray(triangles))
    region = ipctk.ogc.TrustRegion(QUERY_RADIUS / 2)
    region.update(mesh, start, ipctk.NormalCollisions())
    for k in range(len(region.candidates)):
        pair = region.candidates[k]
        ids = [v for v in pair.vertex_ids(mesh.edges, mesh.faces) if v >= 0]
        at = start[ids]
        gap, weights = pair.compute_distance_vector_with_coefficients(at.ravel())
        weights = np.array(weights)[: len(ids)]
        distance = np.linalg.norm(gap)
        if distance < 1e-10:
            yield True, True, False, False
            continue
        n = exact(gap / distance)
        heights = [sum(a * b for a, b in zip(n, exact(p))) for p in at]
        first = len(ids) // 2 if len(pair.vertex_ids(mesh.edges, mesh.faces)) == 4 and is_edges(pair) else 1
        apart = min(heights[:first]) > max(heights[first:]) or max(heights[:first]) < min(heights[first:])
        speed = dx[ids].astype(np.float64) @ (gap / distance)
        toward = np.maximum(0, -speed[weights > 0]).max(initial=0), np.maximum(0, speed[weights < 0]).max(initial=0)
        share = toward[1] / sum(toward) if sum(toward) > 0 else 0.5
        point = -(weights[weights < 0] @ at[weights < 0]) + share * gap
        with np.errstate(all="ignore"):
            crossing = -((at - point) @ (gap / distance)) / speed
        level = sum(a * b for a, b in zip(n, exact(point)))
        beyond = max(level - min(heights[:first]), max(heights[first:]) - level) > ROUNDING
        yield False, apart, bool(((crossing > 0) & (crossing < 1e-10)).any()), beyond


def is_edges(pair):
    return type(pair).__name__.startswith("EdgeEdge")


def causes(options):
    """Writes how many pairs have, among their primitives, one that is left out, a plane that does not separate, a
    crossing that is left out, and a vertex that begins beyond its plane: of those that pass through ipctk's planar
    filter, and of the others."""
    passed = np.load(options.inputs[0])
    asked = questions(int(passed["pairs"]), int(passed["seed"]))
    cells = {(d, through): [0] * 7 for d in DECADES for through in (True, False)}
    for (_, x, t, dx), (gap, through) in zip(asked, passed["ipctk_planar"]):
        if np.isnan(gap):
            continue
        decade = min(max(int(np.floor(np.log10(gap))), DECADES[0]), DECADES[-1])
        if decade > -6 and not through:
            continue  # none of these passes, so none of them is examined
        found = np.array(list(planes_of_ipctk(x, t, dx)))
        left_out, tilted, early, beyond = found[:, 0].any(), (~found[:, 1]).any(), found[:, 2].any(), found[:, 3].any()
        first_three = left_out or tilted or early
        cell = cells[decade, bool(through)]
        for k, counts in enumerate((True, left_out, tilted, early, beyond, not first_three and beyond,
                                    not first_three and not beyond)):
            cell[k] += bool(counts)
    names = ["pairs", "left_out", "plane_does_not_separate", "crossing_left_out", "begins_beyond_plane",
             "this_alone", "none_of_these"]
    write([{"filter": "ipctk_planar", "gap_from_m": f"1e{d}", "pass_through": int(through), **dict(zip(names, cell)),
            "seed": int(passed["seed"])} for (d, through), cell in cells.items() if cell[0]], options.out)


NAMES = {"ipctk": "IPC Toolkit's spheres", "ipctk_planar": "IPC Toolkit's planes", "newton": "Newton's rule",
         "ball": "our balls", "planes": "our planes"}
WHERE = {"flat": "Pairs about z = 0", "turned": "The same, turned and moved by up to 1 m"}
ALT = ("Two plots of the share of pairs of triangles that pass through one another in one step, over the gap between "
       "them, for pairs about z = 0 and for pairs turned and moved by up to 1 m. {said}.")


def shares(rows, name, place):
    """Returns the share of a filter's pairs that pass through [%] in each decade; not-a-number without pairs."""
    found = []
    for decade in DECADES:
        cell = [r for r in rows if (r["filter"], r["place"], r["gap_from_m"]) == (name, place, f"1e{decade}")]
        pairs, passed = (sum(int(r[key]) for r in cell) for key in ("pairs", "pass_through"))
        found.append(100 * passed / pairs if pairs else np.nan)
    return np.array(found)


def draw(options):
    """Draws the share of pairs that pass through, by decade; Python's path needs the root of the source tree."""
    from plots import style

    style.use()
    with open(options.inputs[0], encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    there = [name for name in NAMES if any(row["filter"] == name for row in rows)]
    leaks = [name for name in there if any(np.nanmax(shares(rows, name, place)) > 0 for place in PLACES)]
    tight = [NAMES[name] for name in there if name not in leaks]
    said = (f"{' and '.join(NAMES[name] for name in leaks) or 'No filter'} let near pairs pass through"
            + (f", {' and '.join(tight)} none" if leaks and tight else ""))
    below = (f"{sum(int(row['pairs']) for row in rows) // len(there):,} random pairs a filter, one step each of up to "
             "1000 gaps; the way of each is judged exactly")
    figure, (panels,) = style.page([(2.9, [(0.5, "plot")] * 2)], said, below)
    colours = (style.BASELINE, style.COLOURS[1])
    for axes, place in zip(panels, PLACES):
        middles = [10.0 ** (decade + 0.5) for decade in DECADES]
        for name, colour, marker in zip(leaks, colours, "os"):
            axes.semilogx(middles, shares(rows, name, place), color=colour, marker=marker, markersize=4,
                          label=NAMES[name])
        if tight:
            axes.semilogx(middles, 0 * np.array(middles), color=style.OURS, linewidth=2, label=" and ".join(tight))
        axes.set(title=WHERE[place], xlabel="gap [m]", ylabel="pairs that pass through [%]", ylim=(-2, None))
    panels[1].legend(loc="upper right")
    style.save(figure, options.out, said, ALT.format(said=said), "peers_gaps.csv")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("do", choices=["move", "judge", "draw", "causes"])
    parser.add_argument("inputs", nargs="+", help="filters to move by, files to judge, or a table to draw")
    parser.add_argument("--pairs", type=int, default=300, help="of each shape and decade")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--out")
    parser.add_argument("--passed", help="judge: gaps and verdicts of all pairs go into this file, for causes")
    options = parser.parse_args()
    {"move": move, "judge": judge, "draw": draw, "causes": causes}[options.do](options)


if __name__ == "__main__":
    main()
