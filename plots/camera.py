"""Where a scene is seen from: a view for each scene of the paper, fitted to what moves in the frames that are shown."""

import numpy as np

from plots.render import View

VIEWS = {
    "twist": View((0.30, 0.42, 1.0)), "large_radius_twist": View((0.45, 0.75, 1.0)),
    "mat_twist": View((0.42, 0.5, 1.0)),
    "knot": View((0.05, 0.22, 1.0), margin=0.03),
    "fifty_layers": View((0.75, 0.5, 1.0), margin=0.02), "fifty_layers_1m": View((0.75, 0.5, 1.0), margin=0.02),
    "two_hundred_layers": View((0.75, 0.5, 1.0), margin=0.02),
    "dress": View((0.42, 0.06, 1.0)), "robot_shirt": View((0.75, 0.62, 1.0)),
    "cloth_on_sphere": View((0.7, 0.35, 1.0)), "three_cloths_on_sphere": View((0.7, 0.35, 1.0)),
    "one_iteration_drop": View((0.8, 0.45, 1.0)), "activation_drop": View((0.8, 0.42, 1.0)),
    # From above, so that the cloth is pulled from left to right; and from the front, turned about the vertical.
    "yarn_stretch": View((0.0, 1.0, 0.0), up=(1, 0, 0), margin=0.02), "yarn_twist": View((0.25, 0.1, 1.0), margin=0.02),
}
FLAT = 1e-3  # thickness of a floor over its width


def view_of(scene):
    """Returns the scene's view; for a scene of which none is known, from the side and a little from above."""
    return VIEWS.get(scene.removesuffix("_released"), View())


def is_cloth(body):
    """Returns whether a body is simulated, that is neither fixed nor wholly prescribed."""
    return not body["fixed"] and body.get("prescribed_vertices") != body["vertex_count"]


def floors(run):
    """Returns the names of the fixed bodies that lie flat in a horizontal plane, and the height of the highest [m];
    (no name, None) without one."""
    start = run.start_positions
    found = {}
    for body in run.manifest["scene"]["bodies"]:
        points = start[body["first_vertex"]:body["first_vertex"] + body["vertex_count"]]
        low, high = points.min(axis=0), points.max(axis=0)
        if body["fixed"] and high[1] - low[1] <= FLAT * max(high[0] - low[0], high[2] - low[2]):
            found[body["name"]] = float(high[1])
    return set(found), max(found.values(), default=None)


def subject(run, frame, bodies=None):
    """Returns the vertices [n, 3] of the bodies that a picture is about; None: all but floors."""
    if bodies is None:
        flat, _ = floors(run)
        bodies = lambda body: body["name"] not in flat  # noqa: E731
    parts = [frame.positions[body["first_vertex"]:body["first_vertex"] + body["vertex_count"]]
             for body in run.manifest["scene"]["bodies"] if bodies(body)]
    return np.concatenate(parts or [frame.positions]).astype(float)


def fitted(run, frames, size, bodies=None, view=None):
    """Returns (eye, target, up) of the camera that shows these bodies in all of the `frames`, in a picture of this
    size."""
    seen = np.concatenate([subject(run, frame, bodies) for frame in frames])
    return (view or view_of(run.manifest["scene"]["name"])).fit(seen, size)


def near_middle(reach, view=None):
    """Returns a function of (run, frame) that gives a camera for what lies within `reach` [m] of the moving bodies'
    middle."""
    def camera(run, frame):
        points = subject(run, frame)
        return around(points, (points.min(axis=0) + points.max(axis=0)) / 2, reach, run, view)
    return camera


def around(points, centre, reach, run, view=None, size=(1280, 560)):
    """Returns the camera that shows the `points` [n, 3] within `reach` [m] of `centre`."""
    inside = points[np.linalg.norm(points - centre, axis=1) < reach]
    return (view or view_of(run.manifest["scene"]["name"])).fit(inside, size)


def densest(points, reach, rounds=10):
    """Returns the place where most `points` [n, 3] lie within `reach` [m] of one another: the fullest cell of a grid,
    moved to the mean of its neighbourhood until that stays."""
    _, cell, counts = np.unique(np.floor(points / reach), axis=0, return_inverse=True, return_counts=True)
    centre = points[cell.ravel() == np.argmax(counts)].mean(axis=0)
    for _ in range(rounds):
        centre = points[np.linalg.norm(points - centre, axis=1) < reach].mean(axis=0)
    return centre


def of_ends(run, size):
    """Returns (eye, target, up) of a camera that shows a run's bodies at their start and end."""
    return fitted(run, [run.frame(path) for path in (run.frames[0], run.frames[-1])], size)
