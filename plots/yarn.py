"""Builds the drawn shape of yarn: tubes around the segments of rods, with two plies on a helix that is fixed in the
material. The helix turns with the segments' orientations, so that twist is visible.
"""

from itertools import chain

import numpy as np

PLIES = 2
PITCH = 5  # length of a turn of a ply in diameters
PIECES_A_TURN = 8  # pieces of a long segment in each turn, so that its helix stays visible
GROOVE = 0.3  # depth of the groove between the plies, in radii
OVERLAP = 0.2  # overlap of neighbouring tubes in radii, so that no gap shows
SIDES, MANY, SIDES_OF_MANY = 24, 20_000, 10  # sides of a tube; fewer if there are more than MANY segments


def chains(segments, count):
    """Returns the segments [n, 2] of `count` vertices as chains of (segment, direction); the direction is 1, or −1 if
    the chain traverses the segment backwards. A chain ends where not exactly two segments meet. A ring begins
    anywhere."""
    at_vertex = [[] for _ in range(count)]
    for e, ends in enumerate(segments.tolist()):
        for vertex in ends:
            at_vertex[vertex].append(e)
    ends, seen, found = segments.tolist(), set(), []

    def walk(vertex, e):
        chain_of = []
        while e is not None and e not in seen:
            seen.add(e)
            along = 1 if ends[e][0] == vertex else -1
            chain_of.append((e, along))
            vertex = ends[e][1] if along == 1 else ends[e][0]
            e = next((f for f in at_vertex[vertex] if f not in seen), None) if len(at_vertex[vertex]) == 2 else None
        return chain_of

    starts = [vertex for vertex in range(count) if at_vertex[vertex] and len(at_vertex[vertex]) != 2]
    for vertex in chain(starts, (vertex for vertex in range(count) if len(at_vertex[vertex]) == 2)):
        found += filter(None, (walk(vertex, e) for e in at_vertex[vertex]))
    return found


def angles_of(chains_of, lengths, pitch):
    """Returns the angles of the first ply's helix at both ends of each segment [n, 2], about the segment's direction.
    `lengths`: [n]."""
    result = np.zeros((len(lengths), 2))
    for links in chains_of:
        numbers, along = (np.array(part) for part in zip(*links))
        ways = np.concatenate([[0], np.cumsum(lengths[numbers])]) / pitch * 2 * np.pi
        first, last = ways[:-1], ways[1:]
        # A helix has the same hand in both directions, so the arc length of a backward segment counts backwards.
        result[numbers] = np.where(along[:, None] > 0, np.stack([first, last], 1), -np.stack([last, first], 1))
    return result


def rotated(quaternions, axis):
    """Returns R(q) applied to one of the three axes: directors [n, 3] of quaternions x, y, z, w [n, 4]."""
    v, w = quaternions[:, :3], quaternions[:, 3:]
    e = np.eye(3)[axis]
    return e + 2 * np.cross(v, np.cross(v, e) + w * e)


def untwisted(chains_of, positions, segments):
    """Returns orientations without twist [n, 4]. Along each chain the smallest rotation turns the frame of a segment
    into the next, like a rod's frames at rest (compare/rods.md, "Rest data"); the first frame starts from the axes."""
    directions = _unit(positions[segments[:, 1]] - positions[segments[:, 0]])
    result = np.empty((len(segments), 4))
    for links in chains_of:
        direction, frame = np.array([0.0, 0.0, 1.0]), np.array([[0.0, 0.0, 0.0, 1.0]])
        for e, _ in links:
            frame = _product(_smallest_rotation(direction, directions[e]), frame)
            result[e], direction = frame[0], directions[e]
    return result


def _smallest_rotation(a, b):
    """Returns the quaternion [1, 4] that rotates the unit vector a to b, by half a turn if they are opposite."""
    w = 1 + a @ b
    axis = np.cross(a, b) if w > 1e-12 else np.cross(a, np.eye(3)[np.argmin(np.abs(a))])
    q = np.append(axis, max(w, 0) if w > 1e-12 else 0)
    return (q / np.linalg.norm(q))[None]


def _product(p, q):
    """Returns the products of quaternions x, y, z, w [n, 4]."""
    v = p[:, 3:] * q[:, :3] + q[:, 3:] * p[:, :3] + np.cross(p[:, :3], q[:, :3])
    return np.hstack([v, p[:, 3:] * q[:, 3:] - np.sum(p[:, :3] * q[:, :3], axis=1, keepdims=True)])


def _unit(vectors):
    length = np.linalg.norm(vectors, axis=1, keepdims=True)
    return vectors / np.where(length > 0, length, 1)


def _mitres(segments, directions, count):
    """Returns the normals of the planes in which tubes end [n, 2, 3]: the mean of both directions where two segments
    meet, elsewhere the segment's own direction."""
    normals = np.repeat(directions[:, None], 2, axis=1)
    meeting = np.bincount(segments.ravel(), minlength=count)
    ordered = np.argsort(segments.ravel(), kind="stable")
    first = np.concatenate([[0], np.cumsum(meeting)])[:-1][meeting == 2]
    a, b = ordered[first], ordered[first + 1]  # segment · 2 + end
    away = lambda at: directions[at // 2] * np.where(at % 2 == 0, 1, -1)[:, None]  # noqa: E731
    middle = away(a) - away(b)
    flat = normals.reshape(-1, 3)
    usable = np.linalg.norm(middle, axis=1) >= 1  # for a turn of more than 120° a mitre would be long
    for at in (a, b):
        own = np.where(at % 2 == 0, 1, -1)[:, None]
        toward = _unit(middle) * np.where(np.sum(middle * away(at), axis=1) < 0, -1, 1)[:, None] * own
        flat[at[usable]] = toward[usable]
    return normals


def tubes(positions, segments, orientations, angles, diameter, colours):
    """Returns (points, triangles, RGB of each point) of the tubes. `angles` [n, 2]: angles of the helix at both ends
    (angles_of). `colours` [n, PLIES, 3]: colours of each segment's plies."""
    radius, count = diameter / 2, len(segments)
    ends = positions[segments].astype(float)
    directions = _unit(ends[:, 1] - ends[:, 0])
    first = rotated(orientations, 0)
    first = _unit(first - np.sum(first * directions, axis=1, keepdims=True) * directions)
    second = np.cross(directions, first)
    sides = SIDES if count <= MANY else SIDES_OF_MANY
    pieces = int(np.clip(np.ceil(np.max(np.ptp(angles, axis=1), initial=0) / (2 * np.pi) * PIECES_A_TURN), 1, 64))
    share = np.linspace(0, 1, pieces + 1)[:, None]
    around = 2 * np.pi * np.arange(sides) / sides
    helix = angles[:, :1] + share.T * np.ptp(angles, axis=1)[:, None]
    wave = np.cos(PLIES * (around - helix[:, :, None]))  # 1 on a ply's back, -1 between plies
    reach = radius * (1 - GROOVE * (1 - wave) / 2)
    spoke = np.cos(around)[:, None] * first[:, None] + np.sin(around)[:, None] * second[:, None]
    centres = ends[:, None, 0] + share * (ends[:, 1] - ends[:, 0])[:, None]
    points = centres[:, :, None] + reach[..., None] * spoke[:, None]
    for end, normals in zip((0, -1), np.moveaxis(_mitres(segments, directions, len(positions)), 1, 0)):
        rim = points[:, end] - centres[:, end, None]
        ahead = np.sum(rim * normals[:, None], axis=2) / np.sum(directions * normals, axis=1)[:, None]
        points[:, end] -= (ahead + (OVERLAP if end == 0 else -OVERLAP) * radius)[..., None] * directions[:, None]
    ply = np.floor((around - helix[:, :, None]) / (2 * np.pi) * PLIES + 0.5).astype(int) % PLIES
    rgb = np.take_along_axis(colours[:, None, None], ply[..., None, None], axis=3)[..., 0, :]
    return points.reshape(-1, 3), _triangles(count, pieces, sides), rgb.reshape(-1, 3).astype(np.uint8)


def _triangles(count, pieces, sides):
    """Returns the triangles of `count` tubes with this number of pieces, whose rings of points are consecutive."""
    ring, side = np.meshgrid(np.arange(pieces), np.arange(sides), indexing="ij")
    a, b = ring * sides + side, ring * sides + (side + 1) % sides
    one = np.stack([a, b, a + sides, b, b + sides, a + sides], axis=-1).reshape(-1, 3)
    return (np.arange(count)[:, None, None] * (pieces + 1) * sides + one).reshape(-1, 3)


def plies_of(colour):
    """Returns the RGB of a yarn's two plies [2, 3]: the given colour and a lighter one of the same hue."""
    dark = np.array([int(colour[i:i + 2], 16) for i in (1, 3, 5)])
    return np.stack([dark, 255 - (255 - dark) * 0.3])
