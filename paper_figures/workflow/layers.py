"""Writes scenes of any size at one contact density as scene files: LAYERS square sheets of `fifty_layers` (its spacing,
radius and materials), pressed together between a fixed ground and a fixed lid. The number of vertices determines the
size of the sheets.

The density is the same for all sizes: two sheets differ in size by rows and columns of the same cells added at the rim.
Each layer's shift in the plane is drawn with the layer's number alone, so that an inner vertex meets the same
neighbours at the same distances whatever the size, in the first step and, because a step's forces are local, in later
ones. Only the rim has fewer contacts: 4 / side of the vertices. The measured density stands in growth.py's table.

Sheets lie 0.9 r apart, so that all touch their neighbours from the first step on; ground and lid keep them there. With
the scene's own time step of 1/1200 s a stack like that cuts one vertex in a hundred in every iteration (k_c exceeds
m/h², fast/PERFORMANCE.md) and detects 41 times a step; with 1/5000 s it detects once and keeps its contacts, which is
sufficient for the growth over the number of vertices. Needs only Python's own library.
"""

import json
import random
import struct
import subprocess
from array import array
from dataclasses import dataclass
from pathlib import Path

LAYERS = 10
SPACING = 1 / 69  # [m], of fifty_layers: 70 vertices on 1 m
RADIUS = 3e-3  # [m], its contact radius
GAP = 0.9 * RADIUS
SHIFT = 3e-3  # [m], its standard deviation of a layer's shift in x and in z
TIME_STEP = 1 / 5000  # [s]
GROUND_CELLS = 10  # cells of the cloth in one of the ground's: triangles a hundred times as large
MARGIN = 0.05  # [m] that the ground reaches beyond the sheets


def vertices(side):
    """Returns the number of vertices of all sheets."""
    return LAYERS * side * side


def positions(side, spacing, height, shift=(0, 0)):
    """Returns x, y, z of a square grid of side × side vertices about the origin, row by row."""
    at = [(i - (side - 1) / 2) * spacing for i in range(side)]
    result = array("d")
    for x in at:
        for z in at:
            result.extend((x + shift[0], height, z + shift[1]))
    return result


def face(a, b, c):
    """Returns a face in binary PLY."""
    return struct.pack("<Biii", 3, a, b, c)


def triangles(side):
    """Returns two triangles a cell, with alternating diagonals, as the faces of a binary PLY file."""
    result = []
    for i in range(side - 1):
        for j in range(side - 1):
            a, b, c, d = (i * side + j, i * side + j + 1, (i + 1) * side + j + 1, (i + 1) * side + j)
            first, second = ((a, b, c), (a, c, d)) if (i + j) % 2 == 0 else ((a, b, d), (b, c, d))
            result.append(face(*first) + face(*second))
    return b"".join(result)


def write_mesh(path, points, faces):
    head = (f"ply\nformat binary_little_endian 1.0\nelement vertex {len(points) // 3}\nproperty double x\nproperty "
            "double y\nproperty double z\n"
            f"element face {len(faces) // 13}\nproperty list uchar int vertex_indices\nend_header\n")
    path.write_bytes(head.encode() + points.tobytes() + faces)


def shift_of(layer):
    """Returns x, z [m] from the layer's number alone: normal deviates, as sums of twelve uniforms."""
    uniform = random.Random(layer).random
    return [SHIFT * (sum(uniform() for _ in range(12)) - 6) for _ in range(2)]


def template(program, folder):
    """Returns the scene file of fifty_layers, as the program writes it."""
    subprocess.run([str(program), "scenes", "fifty_layers", "--scale", "smoke", "--write", str(folder)], check=True,
                   stdout=subprocess.DEVNULL)
    return json.loads((folder / "fifty_layers.json").read_text())


def write(program, folder, side, steps):
    """Writes the scene of `side` vertices a side and layer into `folder`; returns the scene file."""
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    scene = template(program, folder / "template")
    layer, ground = scene["bodies"][0], scene["bodies"][-1]
    plates = [("ground", 0.0), ("lid", GAP * (LAYERS + 1))]
    scene["name"] = f"layers_{vertices(side)}"
    scene["settings"] |= {"steps": steps, "contact_radius": RADIUS, "time_step": TIME_STEP}
    scene["bodies"] = [{**layer, "name": f"layer_{k}", "mesh": f"layer_{k}.ply"} for k in range(1, LAYERS + 1)]
    scene["bodies"] += [{**ground, "name": name, "mesh": f"{name}.ply"} for name, _ in plates]
    faces = triangles(side)
    for k in range(1, LAYERS + 1):
        write_mesh(folder / f"layer_{k}.ply", positions(side, SPACING, GAP * k, shift_of(k)), faces)
    cell = GROUND_CELLS * SPACING
    cells = int(((side - 1) * SPACING + 2 * MARGIN) / cell) + 1
    for name, height in plates:
        write_mesh(folder / f"{name}.ply", positions(cells + 1, cell, height), triangles(cells + 1))
    path = folder / "scene.json"
    path.write_text(json.dumps(scene, indent=1))
    return path


@dataclass(frozen=True)
class Stack:
    """Holds the scene of so many steps, written to a file below the folder of the runs (jobs.Job)."""

    side: int
    steps: int

    @property
    def path(self):
        return f"scenes/{self.side}_{self.steps}/scene.json"

    def write(self, program, root):
        """Writes the scene if it is missing."""
        path = root / self.path
        if not path.is_file():
            write(program, path.parent, self.side, self.steps)
