"""Newton Physics' cloth solver (VBD, on the processor) before the judge. README.md says what is converted.

The functions below are private names of newton 1.8.0; another version may lack them:

- newton._src.geometry.kernels: triangle_closest_point
- newton._src.solvers.vbd.particle_vbd_kernels: evaluate_self_contact_force_norm,
  evaluate_vertex_triangle_collision_force_hessian, evaluate_edge_edge_contact, compute_friction,
  orthonormal_basis, mat32,
  evaluate_neo_hookean_membrane_force_hessian, evaluate_dihedral_angle_based_bending_force_hessian

Public is warp.closest_point_edge_edge, which the solver calls with the epsilon below. All run inside kernels of Warp,
which compiles them when this file is loaded; the log has this time apart. They compute in single precision.

OGC_PEERS_OWN=1 asks Newton only where its own definition is the judge's, and answers all else itself: the mismatches
that are left are no matter of definition.
"""

import os

import conversions as to
import newton_steps as steps
import numpy as np
import ogc_testbed as ogc

with to.Timed("import"):
    import warp as wp

    wp.config.quiet = True
    wp.init()
    from newton._src.geometry import kernels as geometry
    from newton._src.geometry.kernels import triangle_closest_point
    from newton._src.solvers.vbd import particle_vbd_kernels as vbd

PARALLEL_EPSILON = 1.0e-5  # particle_edge_parallel_epsilon of SolverVBD
OWN = os.environ.get("OGC_PEERS_OWN") == "1"


@wp.kernel(module="unique")
def closest_face_kernel(
    point: wp.array[wp.vec3], triangle: wp.array2d[wp.vec3], feature: wp.array[int], weights: wp.array[wp.vec3],
    distance: wp.array[float]
):
    i = wp.tid()
    near, bary, kind = triangle_closest_point(triangle[i, 0], triangle[i, 1], triangle[i, 2], point[i])
    feature[i] = kind
    weights[i] = bary
    distance[i] = wp.length(near - point[i])  # as vertex_triangle_collision_detection_kernel has it


@wp.kernel(module="unique")
def closest_points_kernel(first: wp.array2d[wp.vec3], second: wp.array2d[wp.vec3], eps: float, out: wp.array[wp.vec3]):
    i = wp.tid()
    out[i] = wp.closest_point_edge_edge(first[i, 0], first[i, 1], second[i, 0], second[i, 1], eps)


@wp.kernel(module="unique")
def activation_kernel(
    distance: wp.array[float], radius: wp.array[float], stiffness: wp.array[float], slope: wp.array[float],
    curvature: wp.array[float]
):
    i = wp.tid()
    if distance[i] < radius[i]:  # as its callers ask it
        d1, d2 = vbd.evaluate_self_contact_force_norm(distance[i], radius[i], stiffness[i])
        slope[i] = d1
        curvature[i] = d2


@wp.kernel(module="unique")
def membrane_kernel(
    pos: wp.array[wp.vec3], start: wp.array[wp.vec3], tri: wp.array2d[int], pose: wp.array[wp.mat22],
    area: wp.array[float], mu: wp.array[float], lmbd: wp.array[float], force: wp.array[wp.vec3],
    block: wp.array[wp.mat33]
):
    i = wp.tid()
    f, h = vbd.evaluate_neo_hookean_membrane_force_hessian(
        i, 0, pos, start, tri, pose[i], area[i], mu[i], lmbd[i], 0.0, 1.0
    )
    force[i] = f
    block[i] = h


@wp.kernel(module="unique")
def bending_kernel(
    pos: wp.array[wp.vec3], start: wp.array[wp.vec3], edges: wp.array2d[int], order: wp.array[int],
    angle: wp.array[float], length: wp.array[float], stiffness: wp.array[float], damping: wp.array[float],
    force: wp.array[wp.vec3], block: wp.array[wp.mat33]
):
    i = wp.tid()
    f, h = vbd.evaluate_dihedral_angle_based_bending_force_hessian(
        i, order[i], pos, start, edges, angle, length, stiffness[i], damping[i], 1.0
    )
    force[i] = f
    block[i] = h


@wp.kernel(module="unique")
def point_triangle_kernel(
    pos: wp.array[wp.vec3], tri: wp.array2d[int], order: wp.array[int], radius: wp.array[float],
    stiffness: wp.array[float], force: wp.array[wp.vec3], block: wp.array[wp.mat33]
):
    i = wp.tid()
    f, h = vbd.evaluate_vertex_triangle_collision_force_hessian(
        4 * i, order[i], i, pos, pos, tri, radius[i], stiffness[i], 0.0, 0.0, 1.0, 1.0
    )
    force[i] = f
    block[i] = h


@wp.kernel(module="unique")
def edge_edge_kernel(
    pos: wp.array[wp.vec3], edges: wp.array2d[int], order: wp.array[int], radius: wp.array[float],
    stiffness: wp.array[float], eps: float, force: wp.array[wp.vec3], block: wp.array[wp.mat33]
):
    i = wp.tid()
    f, h = vbd.evaluate_edge_edge_contact(
        0, order[i], 2 * i, 2 * i + 1, pos, pos, edges, radius[i], stiffness[i], 0.0, 0.0, 1.0, 1.0, eps
    )
    force[i] = f
    block[i] = h


@wp.kernel(module="unique")
def friction_kernel(
    pos: wp.array2d[wp.vec3], start: wp.array2d[wp.vec3], order: wp.array[int], edges: wp.array[int],
    radius: wp.array[float], stiffness: wp.array[float], mu: wp.array[float], limit: wp.array[float], eps: float,
    force: wp.array[wp.vec3], block: wp.array[wp.mat33]
):
    """Friction alone, by the steps of both functions of contacts."""
    i = wp.tid()
    w = wp.vec4(0.0)
    diff = wp.vec3(0.0)
    dx = wp.vec3(0.0)
    distance = float(0.0)
    if edges[i] == 1:
        st = wp.closest_point_edge_edge(pos[i, 0], pos[i, 1], pos[i, 2], pos[i, 3], eps)
        s = st[0]
        t = st[1]
        w = wp.vec4(1.0 - s, s, -1.0 + t, -t)
        c1 = pos[i, 0] + (pos[i, 1] - pos[i, 0]) * s
        c2 = pos[i, 2] + (pos[i, 3] - pos[i, 2]) * t
        c1_start = start[i, 0] + (start[i, 1] - start[i, 0]) * s
        c2_start = start[i, 2] + (start[i, 3] - start[i, 2]) * t
        diff = c1 - c2
        distance = st[2]
        dx = (c1 - c1_start) - (c2 - c2_start)
    else:
        near, bary, kind = triangle_closest_point(pos[i, 1], pos[i, 2], pos[i, 3], pos[i, 0])
        w = wp.vec4(1.0, -bary[0], -bary[1], -bary[2])
        diff = pos[i, 0] - near
        distance = wp.length(diff)
        near_start = bary[0] * start[i, 1] + bary[1] * start[i, 2] + bary[2] * start[i, 3]
        dx = (pos[i, 0] - start[i, 0]) - (near - near_start)
    if distance < radius[i]:
        slope, curvature = vbd.evaluate_self_contact_force_norm(distance, radius[i], stiffness[i])
        e0, e1 = vbd.orthonormal_basis(diff / distance)
        basis = vbd.mat32(e0[0], e1[0], e0[1], e1[1], e0[2], e1[2])
        f, h = vbd.compute_friction(mu[i], -slope, basis, wp.transpose(basis) * dx, limit[i])
        force[i] = w[order[i]] * f
        block[i] = w[order[i]] * w[order[i]] * h


# A stage alone may be asked for (OGC_PEERS_STAGE): then the kernels of others are not compiled.
KERNELS = {
    "closest_face": [closest_face_kernel], "closest_points": [closest_points_kernel],
    "activation": [activation_kernel], "membrane": [membrane_kernel], "bending": [bending_kernel],
    "contact_force": [point_triangle_kernel, edge_edge_kernel], "friction_force": [friction_kernel],
}
_stage = os.environ.get("OGC_PEERS_STAGE")
for _kernel in KERNELS.get(_stage, sum(KERNELS.values(), [])):
    with to.Timed(f"compilation of {_kernel.key}"):
        wp.load_module(_kernel.module, device="cpu")


def launch(kernel, count, arguments, outputs):
    """Runs a kernel on the processor and returns its outputs, of these types. Arguments are numbers, or pairs of an
    array of NumPy and its type in Warp."""
    inputs = [wp.array(x[0], dtype=x[1], device="cpu") if isinstance(x, tuple) else x for x in arguments]
    results = [wp.zeros(count, dtype=kind, device="cpu") for kind in outputs]
    wp.launch(kernel, dim=count, inputs=[*inputs, *results], device="cpu")
    return [x.numpy() for x in results]


def vectors(array):
    """Returns an array of points for Warp."""
    return to.singles(array), wp.vec3


FEATURES = np.zeros(7, np.uint8)
for _name, _feature in {
    "VERTEX_A": to.CORNER_0, "VERTEX_B": to.CORNER_1, "VERTEX_C": to.CORNER_2, "EDGE_AB": to.EDGE_01,
    "EDGE_BC": to.EDGE_12, "EDGE_AC": to.EDGE_20, "FACE_INTERIOR": to.INTERIOR,
}.items():
    FEATURES[int(getattr(geometry, f"TRI_CONTACT_FEATURE_{_name}"))] = _feature


@ogc.kernel("closest_face")
def closest_face(point, triangle):
    n = len(point)
    kind, weights, distance = launch(
        closest_face_kernel, n, [vectors(point), vectors(triangle)], [int, wp.vec3, float]
    )
    to.log(stage="closest_face", cases=n, asked=n)
    points = np.concatenate([to.doubles(triangle), to.doubles(point)[:, None]], axis=1)
    below = to.below(distance.astype(np.float64), points, allowance=8)
    return FEATURES[kind], np.clip(weights, 0, 1), distance, below


@ogc.kernel("closest_points")
def closest_points(first, second):
    n = len(first)
    (out,) = launch(
        closest_points_kernel, n, [vectors(first), vectors(second), PARALLEL_EPSILON], [wp.vec3]
    )
    a, b = to.doubles(first), to.doubles(second)
    parameters, distance = out[:, :2].astype(np.float64), out[:, 2].astype(np.float64)
    features = np.full((n, 2), to.EDGE_INTERIOR, np.uint8)  # Newton names none: parameters 0 and 1 are the ends
    features, parameters = to.at_ends(features, parameters, a, b, distance)
    parallel, middle, gap, _ = to.nearly_parallel(a, b)
    features[parallel] = to.EDGE_INTERIOR
    parameters = np.where(parallel[:, None], middle, parameters)
    to.log(stage="closest_points", cases=n, asked=n)  # of nearly parallel edges the distance
    below = to.below(distance, np.concatenate([a, b], axis=1), allowance=8)
    return to.edges_answer(features, parallel, parameters, np.where(parallel, gap, distance), below)


@ogc.kernel("activation")
def activation(distance, contact_radius, stiffness, activation):
    out = np.stack(to.activation(distance, contact_radius, stiffness, activation)).astype(np.float32)
    asked = activation == 0
    if OWN:  # below 10 µm, or r/4, Newton continues the logarithm by a parabola
        asked &= distance > np.minimum(np.float32(1e-5), contact_radius / 4)
    arrays = [(np.ascontiguousarray(x[asked]), float) for x in (distance, contact_radius, stiffness)]
    if asked.any():  # Newton has no energy
        out[1, asked], out[2, asked] = launch(activation_kernel, int(asked.sum()), arrays, [float, float])
    to.log(stage="activation", cases=len(distance), asked=int(asked.sum()))
    return tuple(out)


def integers(array):
    return np.ascontiguousarray(array, np.int32), int


def numbers(array):
    return np.ascontiguousarray(array, np.float32), float


def stencils(array, chosen):
    """Returns the points of chosen cases, one after another, and the indices of each case's points."""
    points = to.singles(array[chosen])
    return (points.reshape(-1, 3), wp.vec3), np.arange(points.shape[0] * points.shape[1]).reshape(points.shape[:2])


@ogc.kernel("membrane")
def membrane(cases):
    own, ratio = to.stable_neo_hookean_force(cases)
    force, block = own.astype(np.float32), to.packed(to.stable_neo_hookean_block(cases)).astype(np.float32)
    asked = (cases["model"] == 2) & (cases["damping"] == 0)
    if OWN:  # below, Newton's J is 1e-10 and its normal shorter than 1
        asked &= ratio > 1e-10
    if asked.any():
        some = cases[asked]
        pos, index = stencils(cases["corner"], asked)
        g = some["gradient"]  # rows ∇N₁, ∇N₂ of a 2 × 2 matrix, as Newton's tri_pose
        arguments = [pos, pos, integers(index), (np.ascontiguousarray(g), wp.mat22), numbers(some["area"])]
        arguments += [numbers(some["lame_mu"]), numbers(some["lame_lambda"])]
        f, h = launch(membrane_kernel, len(some), arguments, [wp.vec3, wp.mat33])
        if OWN:  # Newton drops a stress that presses where the stage clamps the sum; both are positive
            h = to.stable_neo_hookean_block(some)
        force[asked], block[asked] = f, to.packed(h)
    to.log(stage="membrane", cases=len(cases), asked=int(asked.sum()))
    return force, block


@ogc.kernel("bending")
def bending(cases):
    x, start = to.doubles(cases["vertex"]), to.doubles(cases["start"])
    asked = cases["model"] == 1
    theta, gradient, least = to.dihedral(x)
    theta_start, _, least_start = to.dihedral(start)
    own = gradient[np.arange(len(x)), cases["own"]]
    force, block = (a.astype(np.float32) for a in to.hinge(theta, theta_start, own, cases))
    asked &= (cases["damping_form"] == 0) | (cases["damping"] == 0)
    if OWN:  # Newton takes normals, twice an area, and edges below 1e-6 as collapsed
        asked &= (least > 1e-6) & ((least_start > 1e-6) | (cases["damping"] == 0))
        asked &= np.abs(theta - theta_start) < 3.14  # and turns a change of angle by 2π
    if asked.any():
        some = cases[asked]
        pos, index = stencils(cases["vertex"], asked)
        before, _ = stencils(cases["start"], asked)
        order = np.array([2, 3, 0, 1])[some["own"]]  # Newton: o0, o1, x0, x1
        c, k = some["stiffness"], some["damping"]
        arguments = [pos, before, integers(index[:, [2, 3, 0, 1]]), integers(order), numbers(some["rest_angle"])]
        arguments += [numbers(np.ones(len(some))), numbers(c), numbers(k * c)]
        f, h = launch(bending_kernel, len(some), arguments, [wp.vec3, wp.mat33])
        force[asked], block[asked] = f, to.packed(h)
    to.log(stage="bending", cases=len(cases), asked=int(asked.sum()))
    return force, block


def askable(case, d, e_k, parallel):
    """Returns which contacts Newton defines as the stage does: of a point and a triangle or of two edges, with the
    paper's activation, without a mollifier, and of a vertex that is updated alone."""
    asked = np.isin(case["sides"], [to.EDGE_EDGE, to.POINT_TRIANGLE]) & (case["activation"] == 0) & to.alone(case)
    asked &= (e_k == 1) & ~parallel & (d > 0)
    if OWN:  # beyond r Newton has no block, and below 10 µm or r/4 it continues the logarithm by a parabola
        r = case["contact_radius"]
        asked &= (d < r * (1 - 1e-6)) & (d > np.minimum(1e-5, r / 4) * (1 + 1e-6))
        x = to.doubles(case["vertex"])  # edges with a squared length below the epsilon are points
        least = ((x[:, [1, 3]] - x[:, [0, 2]]) ** 2).sum(axis=2).min(axis=1)
        asked &= (case["sides"] != to.EDGE_EDGE) | (least > PARALLEL_EPSILON * (1 + 1e-6))
    return asked


@ogc.kernel("contact_force")
def contact_force(cases):
    _, _, d, e_k, parallel = to.contact(cases)
    asked = askable(cases, d, e_k, parallel)
    force, block = (a.astype(np.float32) for a in to.contact_force(cases))
    for sides, kernel in ((to.POINT_TRIANGLE, point_triangle_kernel), (to.EDGE_EDGE, edge_edge_kernel)):
        chosen = asked & (cases["sides"] == sides)
        if not chosen.any():
            continue
        some = cases[chosen]
        pos, index = stencils(cases["vertex"], chosen)
        if sides == to.EDGE_EDGE:  # columns: two opposite vertices, two ends; a row an edge
            mesh, order = np.full((2 * len(some), 4), -1), some["own"]
            mesh[:, 2:] = index.reshape(-1, 2)
        else:
            mesh, order = index[:, 1:], np.array([3, 0, 1, 2])[some["own"]]  # Newton: three corners, then the vertex
        arguments = [pos, integers(mesh), integers(order), numbers(some["contact_radius"]), numbers(some["stiffness"])]
        arguments += [PARALLEL_EPSILON] if sides == to.EDGE_EDGE else []
        if steps.ASKED:
            x = to.singles(some["vertex"])
            f, h = steps.contact_force(x, sides == to.EDGE_EDGE, some["own"], some["contact_radius"], some["stiffness"])
        else:
            f, h = launch(kernel, len(some), arguments, [wp.vec3, wp.mat33])
        force[chosen], block[chosen] = f, to.packed(h)
    to.log(stage="contact_force", cases=len(cases), asked=int(asked.sum()))
    return force, block


@ogc.kernel("friction_force")
def friction_force(cases):
    case = cases["contact"]
    _, _, d, e_k, parallel = to.contact(case)
    asked = askable(case, d, e_k, parallel)
    force, block, slip = to.friction_force(cases)
    if OWN:  # Newton's friction has no block where nothing slips
        asked &= np.linalg.norm(slip, axis=1) > 0
    force, block = force.astype(np.float32), block.astype(np.float32)
    for sides in (to.POINT_TRIANGLE, to.EDGE_EDGE):
        chosen = asked & (case["sides"] == sides)
        if not chosen.any():
            continue
        some, part = cases[chosen], case[chosen]
        if steps.ASKED:
            x, start = to.singles(part["vertex"]), to.singles(some["start"])
            f, h = steps.friction_force(x, start, sides == to.EDGE_EDGE, part["own"], part["contact_radius"],
                                        part["stiffness"], some["friction"], some["slip_limit"])
        else:
            arguments = [vectors(part["vertex"]), vectors(some["start"]), integers(part["own"])]
            arguments += [integers(part["sides"] == to.EDGE_EDGE), numbers(part["contact_radius"])]
            arguments += [numbers(part["stiffness"]), numbers(some["friction"]), numbers(some["slip_limit"])]
            f, h = launch(friction_kernel, len(some), [*arguments, PARALLEL_EPSILON], [wp.vec3, wp.mat33])
        force[chosen], block[chosen] = f, to.packed(h)
    to.log(stage="friction_force", cases=len(cases), asked=int(asked.sum()))
    return force, block
