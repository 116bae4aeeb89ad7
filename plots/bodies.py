"""What of a run is drawn: bodies in their colours, as `render.picture` takes them."""

import numpy as np

from plots import style, yarn
from plots.camera import floors, is_cloth

LAYERS = 3  # shades that neighbouring sheets take in turn


def bodies_of(run, frame):
    """Returns the bodies as `render.picture` takes them, at the frame's positions. Fixed and wholly prescribed bodies
    are grey, except floors, which `floor_of` has; rods are tubes with plies."""
    result, cloth, (flat, _) = [], 0, floors(run)
    for body in run.bodies():
        first, count = body["first_vertex"], body["vertex_count"]
        points, triangles = frame.positions[first:first + count], body["triangles"]
        if "segments" in body:
            result.append(yarn_of(run, body, frame))
        if not len(triangles) or body["name"] in flat:
            continue
        if is_cloth(body):
            closed = body.get("tetrahedron_count", 0) > 0
            front = style.FRONTS[cloth % LAYERS]
            result.append((points, triangles, front, front if closed else style.BACKS[cloth % LAYERS]))
            cloth += 1
        else:
            result.append((points, triangles, style.BODY, style.BODY))
    return result


def floor_of(run):
    """Returns the height of the scene's floor [m]; None without one."""
    return floors(run)[1]


def yarn_of(run, body, frame):
    """Returns a rod as `render.picture` takes it, with a colour for each of its chains."""
    first, count, segments = body["first_vertex"], body["vertex_count"], body["segments"]
    start = run.start_positions[first:first + count].astype(float)
    lengths = np.linalg.norm(start[segments[:, 1]] - start[segments[:, 0]], axis=1)
    diameter = body["material"]["rod"]["diameter"]["value"]
    chains = yarn.chains(segments, count)
    colours = np.empty((len(segments), yarn.PLIES, 3))
    for number, links in enumerate(chains):
        colours[[e for e, _ in links]] = yarn.plies_of(style.YARNS[number % len(style.YARNS)])
    angles = yarn.angles_of(chains, lengths, yarn.PITCH * diameter)
    points = frame.positions[first:first + count]
    orientations = frame.orientations[body["first_segment"]:body["first_segment"] + len(segments)].astype(float)
    if not len(orientations):  # the start of a scene without orientations; frames follow from its rest shape
        orientations = yarn.untwisted(chains, points.astype(float), segments)
    return (*yarn.tubes(points, segments, orientations, angles, diameter, colours), None)
