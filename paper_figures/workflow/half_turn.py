"""Lists the runs of Fig. 2, half a turn of a cloth, with a contact radius r of one edge and of ten. Needs only Python's
own library.

The paper leaves open how stiff IPC's barrier is, and which neighbours on the sheet OGC leaves out (none by Eq. 12 and
17; the first author's later public code leaves out two rings). So IPC runs with its own stiffness, which adapts, and
with one as stiff as OGC's contact; its contact set also runs in OGC's solver, with OGC's law and k_c; and OGC runs with
all neighbours, and without those on the sheet that are nearer than r at rest.
"""

import json
import subprocess
from dataclasses import dataclass, replace

from paper_figures.workflow.commands import NEO_HOOKEAN, ST_VENANT, TWIST, on, shared
from paper_figures.workflow.jobs import Job

SIDES = {"smoke": 16, "small": 60, "paper": 200}  # vertices along a side
RADIUS = 0.995  # of the scene [edges]
STIFFNESS = 100  # k_c [N/m]
# A barrier of this κ r²/k_c pushes as hard as OGC's contact where faces of one sheet are nearest, at r/√2: there
# κ d/dd(−(d² − r²)² ln(d²/r²)) = 1.687 κ r³, and k_c (r − d) = 0.293 k_c r.
AS_STIFF = 0.1737
RINGS = 2.9  # reach of what is left out at r = one edge: two rings of neighbours [edges]
FEW = 3  # steps in which a cloth is torn; each takes seconds on a CPU
# A run on processors is stopped after so many seconds. LONGEST is for IPC's 1,200 steps, and for those of its set in
# OGC's solver, beside OGC's; SHORTER is for runs of which the first steps tell enough.
LONGEST, SHORTER = {"smoke": 20, "small": 1800}, {"smoke": 20, "small": 400}
# The picture at the paper's size draws runs of `neighbours` and `wide_softer`. Keys are the runs' names in the picture,
# values those that they have there.
AT_PAPER = {"vbd": "neighbours/printed", "vbd_rings": "neighbours/two_rings", "vbd_k1": "neighbours/stiffness_1",
            "vbd_wide": "wide/printed", "vbd_wide_k1": "wide/stiffness_1", "vbd_wide_excluded": "wide/excluded"}
# What could tear OGC's cloth at ten edges, one choice at a time: folder -> setting.
VARIANTS = {"printed": "", "stiffness_10": "contact_stiffness=10", "stiffness_1": "contact_stiffness=1",
            "stiffness_0.1": "contact_stiffness=0.1", "stiffness_0.01": "contact_stiffness=0.01",
            "quadratic": "contact_activation=quadratic", "cubic": "contact_activation=cubic",
            "sweeps_200": "iterations=200", "detection_each_sweep": "detection_every=1",
            "tenth_of_a_step": "time_step=3.3333333e-4", "no_friction": "friction=0", "planes": "bounds=planes",
            "relaxation_0.2": "bounds_relaxation=0.2", "one_guess_round": "guess_rounds=1",
            "query_4r": "detection_radius_cap=4", "isometric_bending": "bending=isometric_quadratic",
            "st_venant": "membrane=st_venant_kirchhoff", "damping_per_vertex": "damping=per_vertex"}


def edge(scale):
    """Returns the rest length of the edges along the sides [m]."""
    return 1 / (SIDES[scale] - 1)


def wide(scale):
    """Returns the options of r = ten edges; the query radius is r, because all else would only take longer."""
    return "--set", f"contact_radius={10 * RADIUS * edge(scale):.6g}", "--set", "detection_radius_cap=1"


def near_pairs(side, reach):
    """Yields the pairs of vertices of a square grid that are at most `reach` edges apart at rest."""
    whole = int(reach)
    offsets = [(i, j) for i in range(whole + 1) for j in range(-whole, whole + 1)
               if (i, j) > (0, 0) and i * i + j * j <= reach * reach]
    for x in range(side):
        for y in range(side):
            for i, j in offsets:
                if x + i < side and 0 <= y + j < side:
                    yield [x * side + y, (x + i) * side + y + j]


@dataclass(frozen=True)
class LeftOut:
    """Holds the scene in which pairs of faces with vertices nearer than `reach` edges at rest are no contacts, written
    to a file below the folder of the runs (jobs.Job)."""

    scale: str
    reach: float

    @property
    def path(self):
        return f"scenes/{self.reach:g}/{TWIST}.json"

    def write(self, program, root):
        """Writes the scene if it is missing."""
        path = root / self.path
        if path.is_file():
            return
        subprocess.run([str(program), "scenes", TWIST, "--scale", self.scale, "--write", str(path.parent), "--force"],
                       check=True, stdout=subprocess.DEVNULL)
        scene = json.loads(path.read_text())
        name = scene["bodies"][0]["name"]
        pairs = list(near_pairs(SIDES[self.scale], self.reach))
        path.write_text(json.dumps({**scene, "excluded_pairs": [{"bodies": [name, name], "vertices": pairs}]}))


def ogc(scale, backend="cpu", membrane=NEO_HOOKEAN):
    """Returns OGC's runs: r of one edge and of a fifth; with a softer contact; without two rings of neighbours; ten
    edges with all neighbours, with a softer contact, and without the neighbours on the sheet nearer than r; at the
    paper's size some of these, of which those at ten edges need a device."""
    if scale == "paper":
        there = {job.name: job for varied in (neighbours, wide_softer)[:1 if backend == "cpu" else 2]
                 for job in varied(scale, backend)}
        return [replace(there[other], name=name) for name, other in AT_PAPER.items() if other in there]
    base, more = (TWIST, *shared(scale, membrane)), ("--audit", "frame", *on(backend))
    length = edge(scale)
    jobs = [Job("vbd", (*base, *more)),
            Job("vbd_thin", (*base, *more, "--set", f"contact_radius={RADIUS * length / 5:.6g}")),
            *(Job(f"vbd_k{k}", (*base, *more, "--set", f"contact_stiffness={k}")) for k in (10, 1)),
            Job("vbd_rings", more, scene=LeftOut(scale, RINGS))]
    if scale == "smoke":  # ten edges are two thirds of the cloth
        return jobs
    few = ("--steps", FEW) if backend == "cpu" else ()
    return [*jobs, Job("vbd_wide", (*base, *more, *wide(scale), *few)),
            *(Job(f"vbd_wide_k{k:g}", (*base, *more, *wide(scale), *few, "--set", f"contact_stiffness={k:g}"))
              for k in (10, 1, 0.1)),
            Job("vbd_wide_excluded", (*more, *wide(scale)), scene=LeftOut(scale, 11.5),
                seconds=SHORTER[scale] if backend == "cpu" else 0)]


def ipc(scale, membrane=NEO_HOOKEAN):
    """Returns IPC's runs on the CPU at r of one edge: with a stiffness that adapts; as stiff as OGC's contact; and its
    contact set in OGC's solver. At ten edges each of its steps takes minutes, and at the paper's size all take days."""
    base, by = (TWIST, *shared(scale, membrane)), ("--solver", "ipc", "--profile", "--audit", "frame")
    r = RADIUS * edge(scale)
    return [Job("ipc", (*base, *by), seconds=LONGEST[scale] if scale == "small" else 0),
            Job("ipc_stiff", (*base, *by, "--set", f"ipc_stiffness={AS_STIFF * STIFFNESS / r**2:.6g}"),
                seconds=SHORTER[scale]),
            Job("pairs", (*base, "--solver", "reference_vbd", "--set", "reference_contact_set=pairs",
                          "--audit", "off"), seconds=LONGEST[scale])]


def neighbours(scale, backend="cpu"):
    """Returns OGC's whole runs at r = one edge with what decides about the sheet's own neighbours varied: none, one
    ring and two rings left out, r of a fifth of an edge, a softer contact."""
    more = ("--audit", "end", *on(backend), "--set", "frame_steps=200", "--steps", 1200)
    base = (TWIST, *shared(scale), *more)
    varied = {"thin": f"contact_radius={RADIUS * edge(scale) / 5:.6g}", "stiffness_10": "contact_stiffness=10",
              "stiffness_1": "contact_stiffness=1", "st_venant": ST_VENANT[1]}
    return [Job("neighbours/printed", base),
            *(Job(f"neighbours/{name}", more, scene=LeftOut(scale, reach))
              for name, reach in (("one_ring", 1.5), ("two_rings", RINGS))),
            *(Job(f"neighbours/{name}", (*base, "--set", setting)) for name, setting in varied.items())]


def wide_softer(scale, backend="cpu"):
    """Returns OGC's whole runs at r = ten edges, with k_c varied, with the other membrane, and without the neighbours
    on the sheet that are nearer than r."""
    more = ("--audit", "end", *on(backend), "--set", "frame_steps=200", "--steps", 1200, *wide(scale))
    base = (TWIST, *shared(scale), *more)
    varied = {"printed": (), **{f"stiffness_{k:g}": ("--set", f"contact_stiffness={k:g}") for k in (10, 1, 0.1)},
              "st_venant": ST_VENANT}
    return [*(Job(f"wide/{name}", (*base, *options)) for name, options in varied.items()),
            Job("wide/excluded", more, scene=LeftOut(scale, 11.5))]


def variants(scale, backend="cpu"):
    """Returns OGC's first steps at ten edges, with one choice of ours varied in each."""
    few = FEW if backend == "cpu" else 8 * FEW
    base = (TWIST, *shared(scale), "--audit", "off", *on(backend), "--set", f"frame_steps={few // 3}", *wide(scale))
    return [Job(f"variants/{name}", (*base, "--steps", 10 * few if "time_step" in setting else few,
                                     *(("--set", setting) if setting else ())))
            for name, setting in VARIANTS.items()]
