"""IPC Toolkit (`ipctk`, its Python package) before the judge. README.md beside this file says what is converted.

The toolkit computes in double; inputs are single-precision numbers, widened without loss. Each case is a call of the
toolkit, so that times contain its Python binding. OGC_PEERS_CCD=additive chooses its AdditiveCCD.
"""

import os

import conversions as to
import numpy as np
import ogc_testbed as ogc

with to.Timed("import"):
    import ipctk

ipctk.set_logger_level(ipctk.LoggerLevel.off)

TRIANGLE_FEATURES = {
    ipctk.PointTriangleDistanceType.P_T0: to.CORNER_0,
    ipctk.PointTriangleDistanceType.P_T1: to.CORNER_1,
    ipctk.PointTriangleDistanceType.P_T2: to.CORNER_2,
    ipctk.PointTriangleDistanceType.P_E0: to.EDGE_01,
    ipctk.PointTriangleDistanceType.P_E1: to.EDGE_12,
    ipctk.PointTriangleDistanceType.P_E2: to.EDGE_20,
    ipctk.PointTriangleDistanceType.P_T: to.INTERIOR,
}
ENDS = {"0": to.END_0, "1": to.END_1, "": to.EDGE_INTERIOR}
EDGE_FEATURES = {  # EA0_EB: end 0 of the first edge, the interior of the second
    kind: tuple(ENDS[side[2:]] for side in name.split("_"))
    for name, kind in ipctk.EdgeEdgeDistanceType.__members__.items()
    if name != "AUTO"
}


@ogc.kernel("closest_face")
def closest_face(point, triangle):
    p, t = to.doubles(point), to.doubles(triangle)
    feature, weights, distance = np.empty(len(p), np.uint8), np.zeros((len(p), 3)), np.empty(len(p))
    for i, (x, (a, b, c)) in enumerate(zip(p, t)):
        kind = ipctk.point_triangle_distance_type(x, a, b, c)
        feature[i] = f = TRIANGLE_FEATURES[kind]
        distance[i] = ipctk.point_triangle_distance(x, a, b, c, kind)  # squared
        if f == to.INTERIOR:
            u, v = ipctk.point_triangle_closest_point(x, a, b, c)
            weights[i] = 1 - u - v, u, v
        elif f <= to.CORNER_2:
            weights[i, f] = 1
        else:
            k = f - to.EDGE_01
            s = ipctk.point_edge_closest_point(x, t[i, k], t[i, (k + 1) % 3])
            weights[i, k], weights[i, (k + 1) % 3] = 1 - s, s
    distance = np.sqrt(distance)
    to.log(stage="closest_face", cases=len(p), asked=len(p))
    points = np.concatenate([t, p[:, None]], axis=1)
    return feature, np.clip(weights, 0, 1).astype(np.float32), distance.astype(np.float32), to.below(distance, points)


@ogc.kernel("closest_points")
def closest_points(first, second):
    a, b = to.doubles(first), to.doubles(second)
    features, parameters, distance = np.empty((len(a), 2), np.uint8), np.empty((len(a), 2)), np.empty(len(a))
    for i, ((a0, a1), (b0, b1)) in enumerate(zip(a, b)):
        kind = ipctk.edge_edge_distance_type(a0, a1, b0, b1)
        features[i] = f, g = EDGE_FEATURES[kind]
        distance[i] = ipctk.edge_edge_distance(a0, a1, b0, b1, kind)  # squared
        s, t = f, g  # ends 0 and 1 have the parameters 0 and 1
        if f == to.EDGE_INTERIOR and g == to.EDGE_INTERIOR:
            s, t = ipctk.edge_edge_closest_point(a0, a1, b0, b1)
        elif f == to.EDGE_INTERIOR:
            s = ipctk.point_edge_closest_point(b[i, g], a0, a1)
        elif g == to.EDGE_INTERIOR:
            t = ipctk.point_edge_closest_point(a[i, f], b0, b1)
        parameters[i] = s, t
    distance = np.sqrt(distance)
    parallel, middle, gap, _ = to.nearly_parallel(a, b)
    features, parameters = to.at_ends(features, parameters, a, b, distance)
    features[parallel] = to.EDGE_INTERIOR
    parameters = np.where(parallel[:, None], middle, np.clip(parameters, 0, 1))
    to.log(stage="closest_points", cases=len(a), asked=len(a))  # of nearly parallel edges the distance
    below = to.below(distance, np.concatenate([a, b], axis=1))
    return to.edges_answer(features, parallel, parameters, np.where(parallel, gap, distance), below)


BARRIERS = {0: ipctk.TwoStageBarrier(), 3: ipctk.ClampedLogBarrier(), 4: ipctk.CubicBarrier()}


@ogc.kernel("activation")
def activation(distance, contact_radius, stiffness, activation):
    out = np.stack(to.activation(distance, contact_radius, stiffness, activation))
    asked = np.flatnonzero(np.isin(activation, list(BARRIERS)))
    for i in asked:
        g, d, r = BARRIERS[int(activation[i])], float(distance[i]), float(contact_radius[i])
        out[:, i] = g(d, r), g.first_derivative(d, r), g.second_derivative(d, r)
        out[:, i] *= float(stiffness[i])
    to.log(stage="activation", cases=len(distance), asked=len(asked))
    return tuple(out.astype(np.float32))


@ogc.kernel("barrier")
def barrier(squared_distance, activation_distance, thickness):
    xi, d_hat = thickness.astype(np.float64), activation_distance.astype(np.float64)
    g, h = squared_distance.astype(np.float64) - xi * xi, d_hat * (d_hat + 2 * xi)
    of = (ipctk.barrier, ipctk.barrier_first_derivative, ipctk.barrier_second_derivative)
    to.log(stage="barrier", cases=len(g), asked=len(g))
    return tuple(np.array([f(d, r) for d, r in zip(g, h)], np.float32) for f in of)


def narrow_phase():
    if os.environ.get("OGC_PEERS_CCD") == "additive":
        return ipctk.AdditiveCCD()
    return ipctk.TightInclusionCCD()


@ogc.kernel("ccd")
def ccd(cases):
    finder = narrow_phase()
    start, end = to.doubles(cases["from"]), to.doubles(cases["to"])
    time = np.ones(len(cases))
    for i, kind in enumerate(cases["kind"]):
        find = finder.edge_edge_ccd if kind == 1 else finder.point_triangle_ccd
        hit, at = find(*start[i], *end[i])
        if hit:
            time[i] = min(at, 1.0)
    to.log(stage="ccd", cases=len(cases), asked=len(cases))
    return to.rounded_down(time)


@ogc.kernel("truncate")
def truncate(previous, position, bound):
    start, end = to.doubles(previous), to.doubles(position)
    region = ipctk.ogc.TrustRegion(1.0)
    region.trust_region_centers = np.asfortranarray(start)
    region.trust_region_radii = bound.astype(np.float64)
    step = np.asfortranarray(end - start)
    asked = step.copy(order="F")
    region.filter_step(ipctk.CollisionMesh(np.asfortranarray(start)), np.asfortranarray(start), step)
    cut = (step != asked).any(axis=1)
    kept = to.truncated(to.singles(previous), start + step, bound)
    to.log(stage="truncate", cases=len(start), asked=len(start))
    return np.where(cut[:, None], kept, to.singles(position)), cut.astype(np.uint8)


@ogc.kernel("bending")
def bending(cases):
    x, start = to.doubles(cases["vertex"]), to.doubles(cases["start"])
    theta, theta_start, gradient = np.zeros(len(x)), np.zeros(len(x)), np.zeros((len(x), 12))
    flat = [(np.cross(y[:, 1] - y[:, 0], y[:, k] - y[:, 0]) == 0).all(axis=1) for y in (x, start) for k in (2, 3)]
    collapsed, collapsed_start = flat[0] | flat[1], flat[2] | flat[3]
    asked = np.flatnonzero(~collapsed & (cases["model"] == 1))
    for i in asked:
        theta[i] = ipctk.dihedral_angle(*x[i])
        gradient[i] = ipctk.dihedral_angle_gradient(*x[i])
        if not collapsed_start[i]:
            theta_start[i] = ipctk.dihedral_angle(*start[i])
    own = gradient.reshape(-1, 4, 3)[np.arange(len(x)), cases["own"]]
    force, block = to.hinge(theta, theta_start, own, cases)
    to.log(stage="bending", cases=len(x), asked=len(asked))
    return force.astype(np.float32), block.astype(np.float32)


FRICTION = {  # by how many vertices of each side have a weight: the collision, and which vertices it takes in order
    (1, 1): lambda at, potential: ipctk.VertexVertexTangentialCollision(
        ipctk.VertexVertexNormalCollision(0, 1), at, potential),
    (1, 2): lambda at, potential: ipctk.EdgeVertexTangentialCollision(
        ipctk.EdgeVertexNormalCollision(0, 0), at, potential),
    (2, 2): lambda at, potential: ipctk.EdgeEdgeTangentialCollision(
        ipctk.EdgeEdgeNormalCollision(0, 1, 0.0, ipctk.EdgeEdgeDistanceType.EA_EB), at, potential),
    (1, 3): lambda at, potential: ipctk.FaceVertexTangentialCollision(
        ipctk.FaceVertexNormalCollision(0, 0), at, potential),
}


@ogc.kernel("friction_force")
def friction_force(cases):
    """Forces alone: ipctk's second derivative is exact, the stage's block leaves the change of f₁/‖u‖ out. λ and the
    faces that meet are ours; the basis, the slip, f₁ and the force are ipctk's."""
    case = cases["contact"]
    w, _, d, e_k, parallel = to.contact(case)
    slope, _ = to.contact_slopes(case, d, e_k)
    force, block, _ = to.friction_force(cases)
    asked = np.flatnonzero((d > 0) & (slope < 0) & ~parallel & (cases["slip_limit"] > 0))
    x, start = to.doubles(case["vertex"]), to.doubles(cases["start"])
    some_potential = ipctk.BarrierPotential(1.0, 1.0)
    for i in asked:
        first, second = np.flatnonzero(w[i] > 0), np.flatnonzero(w[i] < 0)
        if len(first) > len(second):
            first, second = second, first
        order = [*first, *second]
        if case["own"][i] not in order:
            continue  # its weight is 0
        collision = FRICTION[len(first), len(second)](x[i, order].ravel(), some_potential)
        collision.normal_force_magnitude = -slope[i]
        collision.mu_s = collision.mu_k = mu = float(cases["friction"][i])
        collision.mu_s_effective_lagged = collision.mu_k_effective_lagged = mu  # which alone are read
        potential = ipctk.FrictionPotential(float(cases["slip_limit"][i]))
        slope_of_all = potential.gradient(collision, (x[i, order] - start[i, order]).ravel()).reshape(-1, 3)
        force[i] = -slope_of_all[order.index(case["own"][i])]
    to.log(stage="friction_force", cases=len(cases), asked=len(asked))
    return force.astype(np.float32), block.astype(np.float32)
