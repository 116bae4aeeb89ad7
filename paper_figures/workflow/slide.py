"""Writes a scene file with a sheet of cloth that slides down an inclined plane without friction: the plane is level,
and gravity is inclined. Only gravity and the plane's normal force act on the sheet, so that its centre moves along the
plane like a free body. Needs only Python's own library.
"""

import json
import math
from pathlib import Path

from paper_figures.workflow import layers

RADIUS = 3e-3  # [m]
SPACING = 1 / 69  # [m] between the sheet's vertices, as in fifty_layers
ANGLE = math.radians(20)
GRAVITY = 9.81  # [m/s²]
ALONG, ACROSS = GRAVITY * math.sin(ANGLE), GRAVITY * math.cos(ANGLE)  # [m/s²]
TIME_STEP = 1 / 300  # [s]
DENSITY, STIFFNESS = 0.2, 100  # [kg/m²], [N/m]
CELL = 10 * SPACING  # [m] of the plane's cells


def resting_height():
    """Returns the height at which one contact carries a vertex: k_c (r − d) = m g cos."""
    return RADIUS - DENSITY * SPACING**2 * ACROSS / STIFFNESS


def plane(side, steps):
    """Returns (positions, faces) of a plane that extends farther than the sheet slides."""
    way = 0.5 * ALONG * (steps * TIME_STEP)**2 + side * SPACING
    cells = 2 * (int(way / CELL) + 2)
    return layers.positions(cells + 1, CELL, 0.0), layers.triangles(cells + 1)


def write(folder, side, steps, on=None):
    """Writes the scene of side × side vertices; returns its file. `on`: the plane's positions and faces."""
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    layers.write_mesh(folder / "sheet.ply", layers.positions(side, SPACING, resting_height()), layers.triangles(side))
    layers.write_mesh(folder / "plane.ply", *(on or plane(side, steps)))
    material = {"density": DENSITY, "contact_stiffness": STIFFNESS, "friction": 0}
    scene = {"format_version": 2, "name": "slide", "gravity": [ALONG, -ACROSS, 0],
             "settings": {"time_step": TIME_STEP, "steps": steps, "iterations": 20, "contact_radius": RADIUS},
             "bodies": [{"name": "sheet", "mesh": "sheet.ply", "material": material},
                        {"name": "plane", "mesh": "plane.ply", "fixed": True, "material": material}]}
    path = folder / "slide.json"
    path.write_text(json.dumps(scene, indent=1))
    return path
