"""Computes how hard the contacts of a stored state push, in units of k_c r, from their distances alone, and where IPC's
energy is the softer one at that force.

Distances come from `ogc contacts` on the state's mesh. Contacts between two fixed bodies do not count. The factor of a
contact's energy (the overlap of nearly parallel edges) scales force and curvature alike, and is left out of both.
"""

import json
import subprocess
import tempfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ogc_testbed.runs import RunError
from plots.camera import is_cloth

DECADES, EACH = (-4, 2), 8
EDGES = 10.0 ** (np.arange(DECADES[0] * EACH, DECADES[1] * EACH + 1) / EACH)  # edges of the histogram's bins [k_c r]
HALF = 0.5  # force at which OGC's stages meet, d = r/2 [k_c r]


def ogc_force(distance):
    """Returns −g'(d) of Eq. 18 with Eq. 19 corrected, over k_c r; distance in units of r."""
    return np.where(distance >= 0.5, 1 - distance, 0.25 / distance)


def ipc_force(distance):
    """Returns −g'(d) of g = −k_c (d − r)² ln(d/r), over k_c r."""
    depth = 1 - distance
    return depth * (depth / distance - 2 * np.log(distance))


FORCE = {"ogc": ogc_force, "ipc_log": ipc_force}


@dataclass(frozen=True)
class Forces:
    """Holds the forces of all contacts of a state, in units of OGC's k_c r, and for each the ratio of IPC's curvature
    to OGC's at equal force."""

    force: np.ndarray
    ratio: np.ndarray

    @property
    def share_above_half(self):
        return float(np.mean(self.force > HALF))

    @property
    def share_softer(self):
        """Returns the share of contacts at which IPC's energy has less curvature than OGC's."""
        return float(np.mean(self.ratio < 1))

    @property
    def counts(self):
        """Returns the number of contacts by bin; forces beyond the ends count in the first or last one."""
        return np.histogram(np.clip(self.force, EDGES[0], EDGES[-1]), EDGES)[0]


def ratio_at(force, curve):
    """Returns the curvature ratio at these forces, from `ogc illustrate fig21d`'s curve (forces, ratios); beyond its
    ends that of the nearer end."""
    known, ratio = np.log(curve)
    return np.exp(np.interp(np.log(np.clip(force, curve[0][0], curve[0][-1])), known, ratio))


def write_obj(path, run, positions):
    """Writes the scene's mesh at these positions, with every digit of single precision."""
    with Path(path).open("w") as file:
        file.writelines(f"v {x!s} {y!s} {z!s}\n" for x, y, z in positions)
        for body in run.bodies():
            file.writelines(
                "f {} {} {}\n".format(*(corners + body["first_vertex"] + 1)) for corners in body["triangles"]
            )


def contacts_of(ogc, mesh, radius):
    command = [
        str(ogc),
        "contacts",
        str(mesh),
        "--radius",
        repr(radius),
        "--query-radius",
        repr(radius),
        "--engine",
        "cpu",
        "--no-margins",
        "--json",
    ]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        raise RunError(f"{' '.join(command)}: {done.stderr.strip()}")
    return json.loads(done.stdout)


def distances(ogc, run, frame):
    """Returns the distances, in units of r, of all contacts of a stored frame that can push a vertex which is not
    fixed."""
    radius = run.setting("contact_radius")
    moving = np.zeros(len(frame.positions), bool)
    for body in run.bodies():
        moving[body["first_vertex"] : body["first_vertex"] + body["vertex_count"]] = is_cloth(body)
    with tempfile.TemporaryDirectory() as folder:
        write_obj(Path(folder) / "state.obj", run, frame.positions)
        found = contacts_of(ogc, Path(folder) / "state.obj", radius)
    stencils = [(c["distance"], [c["vertex"], *c["face"]["vertices"]]) for c in found["vertex_facet"]]
    stencils += [(c["distance"], [*c["first"]["vertices"], *c["second"]["vertices"]]) for c in found["edge_edge"]]
    return np.array([distance for distance, vertices in stencils if moving[vertices].any()]) / radius


def forces_of(ogc, run, variant, curve):
    """Returns the forces at the last stored state of a run of `variant` (paper_figures.workflow.commands); `curve`: the
    ratio over force for its κ."""
    force = variant.ratio * FORCE[variant.energy](distances(ogc, run, run.frame(run.frames[-1])))
    return Forces(force, ratio_at(force, curve))


def table(states):
    """Returns rows of the histograms for bins that hold a contact; `states`: {variant: Forces}."""
    for variant, forces in states.items():
        for low, high, count in zip(EDGES, EDGES[1:], forces.counts):
            if count:
                yield {
                    "activation": variant.label,
                    "force_from [k_c r]": f"{low:.4g}",
                    "force_to [k_c r]": f"{high:.4g}",
                    "contacts [1]": int(count),
                }
