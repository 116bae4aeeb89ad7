"""Lists, as data, the runs of figures and tables that need several. Their scripts draw them; the runner makes them on
machines with nothing but Python.

Every function returns jobs in an order in which they can be done; names are folders below the figure's. Scales are
those of `ogc run`; `backend` is that of VBD in single precision, everything else runs on the CPU.
"""

from dataclasses import dataclass, replace

from paper_figures.workflow import layers, release
from paper_figures.workflow.audited import Audit, BoxAudit
from paper_figures.workflow.first_meeting import FirstMeeting
from paper_figures.workflow.jobs import Job, Share, Step

TWIST, THREE_CLOTHS = "large_radius_twist", "three_cloths_on_sphere"
ONE_ITERATION, ACTIVATIONS = "one_iteration_drop", "activation_drop"
NEO_HOOKEAN = "stable_neo_hookean"  # in all scenes (compare/deviations.md)
ST_VENANT = ("--set", "membrane=st_venant_kirchhoff")  # the other one that the paper leaves open

THREE_CLOTHS_STEP = {"smoke": 24, "small": 40, "paper": 50}
THREE_CLOTHS_OTHERS = {"paper": (25, 41)}  # for these the start stores the states before
# The paper draws 500 and 50.
THREE_CLOTHS_ITERATIONS = {"smoke": {"vbd": 500, "newton": 50}, "small": {"vbd": 1000, "newton": 150},
                           "paper": {"vbd": 1000, "newton": 150}}
REPEATS = 5  # of a step whose time is measured, after a first one that warms up
ANY = ("--set", "detection_fraction=0")
SLOW = ("--set", "friction_velocity=1e-4")
PLANES, PAIRS = ("--set", "bounds=planes"), ("--set", "newton_truncation=pair")  # how Newton's step is truncated
NARROW = ("--set", "bounds_relaxation=0.2")  # gaps close by two fifths at most until the next detection
NEWTON = ("--solver", "newton", "--residual",
          *(word for value in ("newton_tolerance=0", "newton_step_tolerance=1e-9", "newton_friction_solves=50")
                                               for word in ("--set", value)))

ACTIVATION_STEPS = {"smoke": 30, "small": 40, "paper": 40}
ENERGIES = ("ogc", "ipc_log", "quadratic", "cubic", "ogc_as_printed")
PAPER_ENERGIES = ENERGIES[:2]
# The scene's limit of 200 iterations ended step 35 at the paper's size two iterations too early.
TOLERANCE = ("--set", "newton_tolerance=1e-6", "--set", "newton_iterations=2000")
WEAK_TOLERANCE = ("--set", "newton_tolerance=1e-4", "--set", "newton_iterations=500")  # 308 at small
FRAMES = ("--set", "frame_steps=1", "--audit", "end")
ABLATION = ("--solver", "newton", *TOLERANCE, *FRAMES)
BY_VBD = ("--set", "detection_every=10")  # γ_e = 0 is the scene's
# κ: k_c of IPC's energy over k_c of OGC's. In the paper's drawing (Fig. 21d) both are 1.
STIFFNESS_RATIOS = (1, 2, 7, 40)
PRINTED_STIFFNESS = 10  # N/m
# 16 N/m² r, rounded: a contact carries the weight of a cell, whose area is proportional to r²; k_c r must be, too.
WEAK_STIFFNESS = {"smoke": 0.5, "small": 0.2, "paper": 0.08}


def shared(scale, membrane=NEO_HOOKEAN):
    """Returns the options that all runs beside IPC's share."""
    return ("--scale", scale, *(() if membrane == NEO_HOOKEAN else ("--set", f"membrane={membrane}")))


def on(backend):
    return () if backend == "cpu" else ("--backend", backend)


def beside_ipc(scene, scale, backend="cpu", membrane=NEO_HOOKEAN):
    """Returns OGC's run and IPC's of Fig. 20."""
    base = (scene, *shared(scale, membrane), "--audit", "frame")
    return Job("vbd", (*base, *on(backend))), Job("ipc", (*base, "--solver", "ipc"))


def three_cloths(scale, backends, start_iterations=None):
    """Returns the runs of Fig. 17: the run up to the step before, each step solved to convergence (γ_e = 0); then that
    step by VBD in single precision, and by VBD and Newton in double. With γ_e = 0 also with a hundredth of ε_v, which
    the paper may have printed in cm/s, and other steps, because the paper does not name the one that it draws; Newton
    also with other bounds than balls, and with the printed γ_e at the other steps. `start_iterations`: of each step
    before, if the scene's own take too long."""
    step, iterations = THREE_CLOTHS_STEP[scale], THREE_CLOTHS_ITERATIONS[scale]
    base = (THREE_CLOTHS, "--scale", scale, "--audit", "end")
    before = ("--set", f"iterations={start_iterations or iterations['vbd']}")
    start = Job("start", (*base, "--backend", backends[-1], "--steps", step - 1, *ANY, *before))
    solve = (*base, "--steps", step, "--iterations", "--profile")
    vbd = ("--set", f"iterations={iterations['vbd']}")
    newton = (*NEWTON, "--set", f"newton_iterations={iterations['newton']}")
    state = ("start", -1)
    variants = (("", ()), ("_any", ANY))
    slow = ("_any_slow", (*ANY, *SLOW))
    with_slow = (*variants, *([] if scale == "smoke" else [slow]))
    timed = ("--repeats", REPEATS)
    single = [Job(f"vbd_{backend}{suffix}", (*solve, *timed, "--backend", backend, *vbd, *more), state)
              for backend in backends for suffix, more in (with_slow if backend == backends[-1] else variants)]
    others = [(other, ("start", Step(other - 1))) for other in THREE_CLOTHS_OTHERS.get(scale, ())]
    again = (*base, "--iterations", "--profile")
    single += [Job(f"vbd_{backends[-1]}_any_at_{other}",
                   (*again, *timed, "--backend", backends[-1], *vbd, *ANY, "--steps", other), begin)
               for other, begin in others]
    bounds = [] if scale == "smoke" else [("_any_planes", (*ANY, *PLANES)), ("_any_pairs", (*ANY, *PAIRS))]
    narrow = [("_any_pairs_narrow", (*ANY, *PAIRS, *NARROW))] if others else []
    at_step = (*with_slow, *bounds, *narrow)
    double = [Job("vbd_double", (*solve, "--solver", "reference_vbd", *vbd), state),
              *(Job(f"newton{suffix}", (*solve, *newton, *more), state) for suffix, more in at_step),
              *(Job(f"newton{suffix}_at_{other}", (*again, *newton, *more, "--steps", other), begin)
                for other, begin in others
                for suffix, more in (("", ()), ("_any", ANY), ("_any_pairs", (*ANY, *PAIRS)), *narrow))]
    return [start, *single], double


@dataclass(frozen=True)
class Variant:
    """Describes a run of Fig. 21: the energy, the ratio κ of its contact stiffness to that of OGC's run beside it,
    whether the latter is the printed k_c or so weak that half of OGC's contacts lie above f = k_c r/2, and whether the
    membrane is the other one that the paper leaves open."""

    energy: str
    ratio: int = 1
    weak: bool = False
    other_membrane: bool = False

    @property
    def label(self):
        ratio = f", κ = {self.ratio}" if self.ratio != 1 else ""
        other = ", St. Venant–Kirchhoff" if self.other_membrane else ""
        return self.energy + ratio + (", weak contact" if self.weak else "") + other

    @property
    def name(self):
        other = "_st_venant" if self.other_membrane else ""
        return (self.energy + (f"_kappa{self.ratio}" if self.ratio != 1 else "") + ("_weak" if self.weak else "")
                + other)

    @property
    def beside(self):
        """Returns OGC's variant beside which this one is held."""
        return replace(self, energy="ogc", ratio=1)

    def stiffness(self, scale):
        """Returns k_c [N/m]."""
        return self.ratio * (WEAK_STIFFNESS[scale] if self.weak else PRINTED_STIFFNESS)

    def options(self, scale):
        return (*(("--set", f"contact_stiffness={self.stiffness(scale):g}") if self.ratio != 1 or self.weak else ()),
                *(ST_VENANT if self.other_membrane else ()),
                "--set", f"contact_activation={self.energy}")


PRINTED = tuple(map(Variant, ENERGIES))
RATIOS = tuple(Variant("ipc_log", ratio) for ratio in STIFFNESS_RATIOS[1:])
WEAK = (Variant("ogc", weak=True), *(Variant("ipc_log", ratio, True) for ratio in STIFFNESS_RATIOS))
OTHER_MEMBRANE = tuple(Variant(energy, other_membrane=True) for energy in PAPER_ENERGIES)
VARIANTS = (*PRINTED, *RATIOS, *WEAK, *OTHER_MEMBRANE)


def compared(variant):
    """Returns whether the variant is one of the paper's two energies, whose last step VBD solves, too."""
    return variant.energy in PAPER_ENERGIES


def ablation(scale, variant):
    """Returns the job of Fig. 21 with all steps, by Newton, as `ogc ablate` runs them; a run that does not converge is
    a result, too. With weak contact it uses VBD: layers come so near there that Newton takes thousands of iterations
    for a step."""
    steps = (ACTIVATIONS, "--scale", scale, "--steps", ACTIVATION_STEPS[scale])
    solver = (*BY_VBD, "--residual", *FRAMES) if variant.weak else ABLATION
    return Job(f"runs/contact_activation={variant.name}", (*steps, *solver, *variant.options(scale)),
               may_fail=not variant.weak)


def last_step(scale, variant, name, options, may_fail=False):
    """Returns the job of Fig. 21 that repeats the last step from the variant's own state before it."""
    steps = (ACTIVATIONS, "--scale", scale, "--steps", ACTIVATION_STEPS[scale])
    arguments = (*steps, *variant.options(scale), "--iterations", "--audit", "end", *options)
    return Job(f"{name}_{variant.name}", arguments, (f"runs/contact_activation={variant.name}", -2), may_fail=may_fail)


def by_newton(scale, variant):
    tolerance = WEAK_TOLERANCE if variant.weak else TOLERANCE
    return last_step(scale, variant, "newton", ("--solver", "newton", *tolerance, "--condition"), variant.weak)


def by_vbd(scale, variant):
    return last_step(scale, variant, "vbd", ("--solver", "reference_vbd", *BY_VBD))


def by_vbd_on(scale, variant, backend):
    return last_step(scale, variant, f"vbd_{backend}", ("--backend", backend, *BY_VBD))


def activations(scale, backend):
    """Returns the runs of Fig. 21: a chain for each variant."""
    for variant in VARIANTS:
        solved = [by_vbd(scale, variant), by_vbd_on(scale, variant, backend)] if compared(variant) else []
        yield [ablation(scale, variant), by_newton(scale, variant), *solved]


# Table 1: for each row the whole run, its audit, one step from five of its states, and windows on the CPU from the same
# states. Steps between stored, audited states: as many as fit into 1/60 s, one if a step is longer than half of that.
MAT, MAT_PLANES = "mat_twist", "mat_twist_planes"
STRETCH, YARN_TWIST = "yarn_stretch", "yarn_twist"
FRAME_STEPS = {"twist": 5, "cloth_on_sphere": 1, "knot": 5, "fifty_layers": 20, "fifty_layers_1m": 20, "dress": 3,
               "robot_shirt": 10, MAT: 4, STRETCH: 41, YARN_TWIST: 41, THREE_CLOTHS: 1}
TABLE_SCENES = tuple(scene for scene in FRAME_STEPS if scene != THREE_CLOTHS)
WITH_PLANES, WITH_VOLUMES = "_planes", "_volumes"  # ends of a row's name
WITH_FAR, WITH_NEAR = "_far", "_near"  # with balls, and a query radius up to the scene's cap or only r
# With balls, twisted cloth that can't collapse locks unless the query radius is r (ablations.md, membranes).
NEAR_ROWS = ("twist", f"{MAT}{WITH_NEAR}")
NEAR = ("--set", "detection_radius_cap=1")
VOLUMES = ("dress", "robot_shirt")  # scenes whose body is a volume by default


def ends_of_rows(scene):
    """Returns the ends of the names of a scene's rows."""
    volumes = {**dict.fromkeys(VOLUMES, (WITH_VOLUMES, WITH_VOLUMES + WITH_PLANES)), MAT: (WITH_VOLUMES,)}
    return ("", WITH_PLANES, *volumes.get(scene, ()))


ROWS = tuple(scene + end for scene in TABLE_SCENES for end in ends_of_rows(scene))
SHARES = (0, 25, 50, 75, 100)  # of the whole run's steps [%]


def scene_of(row):
    """Returns the scene of a row. Each scene has a row with the paper's bounds, which has its name, and one with
    planes. A driven body, and the solid mat, are surfaces in both, and volumes in further rows."""
    for end in (WITH_PLANES, WITH_VOLUMES, WITH_FAR, WITH_NEAR):
        row = row.removesuffix(end)
    return row


def bounds_of(row):
    """Returns the bounds of a row in words; `r_q = r`: with a query radius of r."""
    return "planes" if row.endswith(WITH_PLANES) else "ball, r_q = r" if row in NEAR_ROWS else "ball"


def body_of(row):
    """Returns how the body of a row takes part in contacts."""
    return "volume" if WITH_VOLUMES in row else "surface"


def of_row(row, data):
    """Returns the options of a row. The dress is a stand-in without the data of Codimensional IPC."""
    own = PLANES if row.endswith(WITH_PLANES) else NEAR if row in NEAR_ROWS else ()
    if scene_of(row) in VOLUMES or body_of(row) == "volume":
        own += ("--set", f"body_contact={body_of(row)}")
    return (*(("--set", f"data={data}") if data and scene_of(row) == "dress" else ()), *own)


def whole_runs(row, scale, backend, runs=1, steps=0, audit="afterwards", data="", folder=""):
    """Returns so many runs of the row's scene to its end, or to step `steps`. The audit comes after the run, outside
    its time, or beside it (`audit`: every, frame, end, off). They lie in `folder`, or in that of the row."""
    beside = "off" if audit == "afterwards" else audit
    options = (*(("--steps", steps) if steps else ()), *of_row(row, data),
               "--set", f"frame_steps={FRAME_STEPS[scene_of(row)]}")
    for number in range(1, runs + 1):
        name = f"{folder or row}/whole" + (f"_{number}" if number > 1 else "")
        yield Job(name, (scene_of(row), "--scale", scale, "--backend", backend, "--audit", beside, *options))
        if audit == "afterwards":
            yield Audit(name)


def from_states(row, kind, more_steps, scale, options, data="", shares=SHARES):
    """Returns runs of so many steps from states of the row's whole run, without frames of their own."""
    every = ("--audit", "off", "--set", "frame_steps=1000000", *of_row(row, data), *options)
    for share in shares:
        state = (f"{row}/whole", Share(share, FRAME_STEPS[scene_of(row)]))
        arguments = (scene_of(row), "--scale", scale, *every)
        yield Job(f"{row}/{kind}_{share}", arguments, state, more_steps, pictured=False)


def residuals(row, scale, backend, data=""):
    """Returns runs of one step whose residual is measured. Each iteration has a row with the contacts of the last
    detection; this takes the reference a second at 100,000 vertices, so that the million vertices are not measured."""
    if scene_of(row) == "fifty_layers_1m":
        return []
    options = ("--backend", backend, "--residual", *(() if scene_of(row) == "fifty_layers" else ("--iterations",)))
    return from_states(row, "residual", 1, scale, options, data)


# Time to quality: the whole run of each row; from states with motion, timed steps with few iterations, the scene's and
# many; and one step whose residual the reference measures after each iteration. This takes it half a second of a core
# for knot's 48,000 vertices, so that the knot has twice the scene's iterations and the layers have the scene's. The
# measured step runs on the CPU, because nearly all of its time is the reference's.
QUALITY_SHARES = (25, 50, 75)
QUALITY_ITERATIONS = {"cloth_on_sphere": (10, 40, 160), THREE_CLOTHS: (10, 40, 160), "twist": (3, 10, 40),
                      "knot": (12, 50, 100), "fifty_layers": (10, 20, 40), "dress": (5, 20, 80),
                      "robot_shirt": (3, 10, 40), MAT: (5, 20, 80), STRETCH: (1, 4, 16)}
QUALITY_TIMED_STEPS = 5
QUALITY_BESIDE = {"twist": (WITH_FAR,), MAT: (WITH_NEAR,)}
# From the state in the middle of the run the same step by VBD and, until it has converged, by Newton's method. Both
# are without friction, which the energies of iterations leave out. VBD lists contacts up to 2 r, because Newton's
# method knows those of its result: only sweeps and bounds are compared. For the layers Newton's method takes too long,
# and moving planes, without which bounds keep it from its minimum, do not hold rods.
MINIMUM_SHARES = (50,)
MINIMUM_SECONDS = {"smoke": 20, "small": 60, "paper": 120}  # of Newton's method; then it has no result
MINIMUM_SCENES = tuple(scene for scene in QUALITY_ITERATIONS if scene not in ("fifty_layers", STRETCH))
FRICTIONLESS_STEP = ("--set", "friction=0", "--iterations")
ALL_CONTACTS = ("--set", "contact_margin=1")


def quality_rows(scene):
    """Returns the rows of a scene whose time to quality is measured. Bodies are volumes, as they are by default."""
    body = WITH_VOLUMES if scene in VOLUMES else ""
    return tuple(scene + end for end in (body, *QUALITY_BESIDE.get(scene, ()), body + WITH_PLANES))


def most_iterations(row):
    return ("--set", f"iterations={QUALITY_ITERATIONS[scene_of(row)][-1]}")


def timed(row, scale, backend, steps=0, data=""):
    """Returns the whole run of a row, which Table 1 shares, and the timed steps from its states."""
    scene = scene_of(row)
    begins = tuple(Share(share, FRAME_STEPS[scene]) for share in MINIMUM_SHARES) if scene in MINIMUM_SCENES else ()
    whole, _ = whole_runs(row, scale, backend, steps=steps, data=data)
    yield replace(whole, begins=begins)
    for iterations in QUALITY_ITERATIONS[scene]:
        options = ("--backend", backend, "--set", f"iterations={iterations}")
        yield from from_states(row, f"timed_{iterations}", QUALITY_TIMED_STEPS, scale, options, data, QUALITY_SHARES)


def left(row, scale, data=""):
    """Returns the steps from the same states whose residual is measured after each iteration."""
    options = ("--backend", "cpu", *most_iterations(row), "--iterations")
    return from_states(row, "left", 1, scale, options, data, QUALITY_SHARES)


def minimum(row, scale, data=""):
    """Returns the steps without friction by VBD and by Newton's method."""
    by_vbd = ("--backend", "cpu", *most_iterations(row), *ALL_CONTACTS, *FRICTIONLESS_STEP)
    yield from from_states(row, "minimum_vbd", 1, scale, by_vbd, data, MINIMUM_SHARES)
    for job in from_states(row, "minimum_newton", 1, scale, (*MAT_NEWTON, *FRICTIONLESS_STEP), data, MINIMUM_SHARES):
        yield replace(job, may_fail=True, seconds=MINIMUM_SECONDS[scale])


def to_quality(scene, scale, backend):
    """Returns all jobs about a scene's time to quality."""
    for row in quality_rows(scene):
        yield from timed(row, scale, backend)
        yield from left(row, scale)
        yield from minimum(row, scale) if scene in MINIMUM_SCENES else ()


def cpu_windows(row, steps, scale, data=""):
    return from_states(row, "cpu", steps, scale, ("--backend", "cpu"), data)


# Fig. 19: the mat with both kinds of bounds, with friction and without (like GIPC's measurements); windows on the CPU
# and single steps from states of the run with planes, whose ends do not lag.
MAT_BOUNDS = {"ball": (MAT, ()), "planes": (MAT_PLANES, PLANES)}  # row of Table 1, options
GIPC_STEPS = {"smoke": 216, "small": 576, "paper": 2303}  # at the paper's size not fewer than of GIPC
MAT_WINDOWS = (0, 25, 50, 75)  # of the run's steps [%]: t = 0, 4, 8 and 12 s
MAT_WINDOW_STEPS = {"smoke": 4, "small": 20, "paper": 20}
MAT_ITERATIONS = {"smoke": (20, 80), "small": (20, 40, 80, 160), "paper": (20, 40, 80, 160, 320)}
# IPC makes as many steps as this time allows, and at least two; then Newton's step is abandoned.
WINDOW_SECONDS, IPC_STEPS = {"smoke": 5, "small": 120, "paper": 120}, 2
# Truncation pair by pair, and a detection after one cut vertex, so that nothing but its contacts keeps a step from its
# minimum. Contacts found by a new detection change the residual again, by 10⁻⁴ to 10⁻³ where the mat is tight: no
# tolerance below that is always met (method.md, Fig. 22a).
MAT_NEWTON = ("--solver", "newton", "--set", "newton_tolerance=1e-3", "--set", "newton_iterations=2000", *ANY, *PAIRS)


def mat_whole(scale, backend):
    """Returns the runs of Table 1's two rows, which are used if they exist."""
    for bounds, (row, _) in MAT_BOUNDS.items():
        yield from whole_runs(row, scale, backend, folder=bounds)


MAT_VOLUMES = f"{MAT}{WITH_VOLUMES}"
# Steps between stored, audited states if the mat is a volume: the oracle takes long to find which vertices are inside
# their own body.
MAT_VOLUMES_FRAME_STEPS = {"smoke": 4, "small": 10, "paper": 40}
# At paper until 5.5 s: from 3 s on hundreds of vertices are inside, and the volume takes a second of each step.
MAT_VOLUMES_STEPS = {"paper": 1320}


def mat_as_volume(scale, backend):
    """Returns the mat as a volume, and with both kinds of bounds."""
    steps = ("--steps", MAT_VOLUMES_STEPS[scale]) if scale in MAT_VOLUMES_STEPS else ()
    for row in (MAT_VOLUMES, MAT, MAT_PLANES):
        yield Job(f"{row}/begin", (MAT, "--scale", scale, "--backend", backend, "--audit", "frame", *of_row(row, ""),
                                   *steps, "--set", f"frame_steps={MAT_VOLUMES_FRAME_STEPS[scale]}"))


def mat_without_friction(scale, backend):
    """Returns the runs without friction; a state every 1/15 s is audited."""
    for bounds, (_, options) in MAT_BOUNDS.items():
        name = f"{bounds}/free"
        yield Job(name, (MAT, "--scale", scale, "--backend", backend, "--audit", "off", *options, "--set", "friction=0",
                         "--set", "frame_steps=16", "--steps", GIPC_STEPS[scale]))
        yield Audit(name)


def from_mat(share, name, options, more_steps, scale, **more):
    state = ("planes/whole", Share(share, FRAME_STEPS[MAT]))
    words = (MAT, "--scale", scale, "--audit", "off", "--set", "frame_steps=1", *options)
    return Job(f"window_{share}/{name}", words, state, more_steps, **more)


def mat_windows(scale, seconds=0):
    """Returns VBD on the CPU with both kinds of bounds, then IPC for so many seconds, from each state."""
    steps = MAT_WINDOW_STEPS[scale]
    for share in MAT_WINDOWS:
        yield from (from_mat(share, f"vbd_{bounds}", ("--backend", "cpu", *options), steps, scale, pictured=False)
                    for bounds, (_, options) in MAT_BOUNDS.items())
        yield from_mat(share, "ipc", ("--solver", "ipc"), 50 * steps, scale, least=IPC_STEPS, first=2,  # one step's end
                       seconds=seconds or WINDOW_SECONDS[scale])


def mat_one_step(scale, seconds=0):
    """Returns one step from each state, by VBD with more and more iterations, and by Newton to convergence."""
    for share in MAT_WINDOWS:
        yield from_mat(share, "newton", (*MAT_NEWTON, "--residual"), 1, scale, may_fail=True,
                       seconds=seconds or WINDOW_SECONDS[scale])
        yield from (from_mat(share, f"step_{n}", (*PLANES, "--backend", "cpu", "--residual", "--set",
                                                  f"iterations={n}"), 1, scale)
                    for n in MAT_ITERATIONS[scale])


# Fig. 18's solvers. Newton stops by IPC's velocity tolerance. It detects as soon as one vertex is cut, because a vertex
# held by its ball would never slow down. OGC's force jumps at block boundaries, so that a step may never converge: it
# ends after 100 iterations, like a step of VBD.
NEWTON_AS_IPC = ("newton_tolerance=0", "newton_step_tolerance=1e-3", "detection_fraction=0", "newton_iterations=100")
SOLVERS = {"ipc": ("--solver", "ipc", "--profile"),  # the baseline
           "newton": ("--solver", "newton", "--profile",
                      *(word for value in NEWTON_AS_IPC for word in ("--set", value))),
           "vbd": (), "vbd_cuda": ("--backend", "cuda")}


def solvers(scale, cuda=False, membrane=NEO_HOOKEAN):
    """Returns the same run of Fig. 18 by each solver, with its processor time; one after the other, because each uses
    all cores."""
    base = ("cloth_on_sphere", *shared(scale, membrane), "--audit", "end", "--set", "frame_steps=5")
    return [Job(name, (*base, *options), processor_time=True) for name, options in SOLVERS.items()
            if cuda or name != "vbd_cuda"]


# Growth: time a step over the number of vertices at one contact density, and over threads.
SIDES = {"smoke": (6, 8, 12), "small": (10, 15, 22, 32), "paper": (32, 46, 68, 100, 147, 215, 316)}
LARGEST_SIDE = {"paper": (632,)}  # on a device alone: 4·10⁶ vertices
# Of 200 steps with 2·10⁷ contacts at scale paper.
SIDE_OF_CONTACTS = {"smoke": 12, "small": 32, "paper": 500}
CONTACT_STEPS = {"smoke": 20, "small": 200, "paper": 200}
BOXES = {"smoke": 10, "small": 100, "paper": 1000}
SEED_OF_BOXES = 57
SIDE_OF_THREADS = {"smoke": 8, "small": 22, "paper": 46}
GROWTH_STEPS = 14


def sizes(scale, backend):
    """Returns a run for each size, audited at its end; on a device up to the largest, and with both bounds."""
    cuda = backend == "cuda"
    return [Job(f"{backend}{end}_{layers.vertices(side)}", ("--backend", backend, "--audit", "end", *options),
                scene=layers.Stack(side, GROWTH_STEPS))
            for end, options in (("", ()), (WITH_PLANES, PLANES))[:2 if cuda else 1]
            for side in (*SIDES[scale], *(LARGEST_SIDE.get(scale, ()) if cuda else ()))]


def many_contacts(scale, backend):
    """Returns the run with many contacts, and the audit of its last state in boxes."""
    side = SIDE_OF_CONTACTS[scale]
    name, steps = f"contacts_{layers.vertices(side)}", CONTACT_STEPS[scale]
    arguments = ("--backend", backend, "--audit", "end", "--set", f"frame_steps={steps}")
    return [Job(name, arguments, scene=layers.Stack(side, steps)),
            BoxAudit(name, BOXES[scale], SEED_OF_BOXES, backend)]


def threads(scale, cores):
    """Returns the same run with one thread, two, four … up to all cores; nothing but the time may differ."""
    numbers = sorted({*(2**k for k in range(cores.bit_length()) if 2**k <= cores), cores})
    scene = layers.Stack(SIDE_OF_THREADS[scale], GROWTH_STEPS)
    return [Job(f"threads_{n}", ("--threads", n, "--audit", "off"), scene=scene) for n in numbers]


# Where VBD and Newton end in the step after this one: cloths in the middle of their impact and at Fig. 17's step, twist
# after its first turn, before triangles collapse (fast/PERFORMANCE.md): afterwards the energy is not convex between the
# two states.
MINIMISER_STEPS = {"smoke": {"cloth_on_sphere": 22, "three_cloths_on_sphere": 22, "twist": 600},
                   "small": {"cloth_on_sphere": 40, "three_cloths_on_sphere": 39, "twist": 1200},
                   "paper": {"cloth_on_sphere": 50, "three_cloths_on_sphere": 49, "twist": 1200}}


def minimiser(scale, backend):
    """Returns runs to the state, and its next step twice, each time until nothing moves: by VBD and by Newton. They are
    profiled, so that their times are not mistaken for results."""
    for scene, step in MINIMISER_STEPS[scale].items():
        shared_words = (scene, "--scale", scale, "--audit", "end", "--profile", "--set", "frame_steps=" + str(step))
        yield Job(scene, (*shared_words, "--backend", backend, "--steps", step))
        last = (*shared_words[:-1], "frame_steps=1", *ANY, *BY_VBD)
        by_vbd_alone = ("--backend", backend, "--residual", "--set", "iterations=3000")
        for solver, options in (("vbd", by_vbd_alone), ("newton", (*NEWTON, "--set", "newton_iterations=200"))):
            yield Job(f"{scene}_{solver}", (*last, *options), (scene, Step(step)), 1)


# Fig. 15 and 16. The baseline is the same sweep without bounds and with a force that stays finite at every distance:
# the paper's "Newton". The ratio of the yarn's tension to k_c r decides, so that Fig. 15 also has two weaker k_c,
# pulled as far as a mean stretch of 1 needs.
YARN_KINDS = {"ogc": (), "baseline": ("--set", "bounds=off", "--set", "contact_activation=quadratic")}
YARN_STIFFNESS = (222, 22, 2)  # N/m, the scene's first
YARN_STEPS = {STRETCH: {"smoke": 100, "small": 16250, "paper": 16250},
              YARN_TWIST: {"smoke": 100, "small": 7500, "paper": 27500}}
WEAK_YARN_STEPS = {"smoke": 100, "small": 6250, "paper": 6250}  # at rest, then pulled for 2 s
YARN_FRAME_STEPS = {"smoke": 5, "small": 125, "paper": 125}
RELEASE_STEPS = {"smoke": 60, "small": 7500, "paper": 25000}  # at paper 10 s
# Meetings of threads on the way of a step are counted exactly, which takes 0.3 s of a core for 65,000 segments: in
# every step, but at the paper's size only in windows of so many steps from states at these shares of a run [%].
MEETING_STEPS, MEETING_SHARES = {"paper": 50}, (0, 10, 20, 30, 40, 50, 60, 70, 80, 90, 99)
WINDOW_OF = "_window_"  # between the name of a run and the share, or the step after which a window begins


def yarn(scene, kind, scale, backend, name, more=(), steps=0):
    """Returns one run and its windows. Meetings of the baseline are a result, and so is the step at which its numbers
    end."""
    steps, every, may_fail = steps or YARN_STEPS[scene][scale], YARN_FRAME_STEPS[scale], kind == "baseline"
    shared_words = (scene, "--scale", scale, "--backend", backend, *YARN_KINDS[kind], *more)
    asked, in_windows = ("--audit-meetings", f"1:{steps}"), scale in MEETING_STEPS
    words = (*shared_words, "--audit", "off" if kind == "baseline" else "frame",
             *(("--audit-meetings", "off") if in_windows else asked), "--set", f"frame_steps={every}", "--steps", steps)
    yield Job(name, words, may_fail=may_fail)
    if not in_windows:
        return

    def window(place, begin, length):
        return Job(f"{name}{WINDOW_OF}{place}", (*shared_words, "--audit", "off", *asked), (name, begin), length,
                   pictured=False, may_fail=may_fail)

    places = [(share, Share(share, every)) for share in MEETING_SHARES]
    windows = tuple(window(share, begin, MEETING_STEPS[scale]) for share, begin in places)
    yield from windows
    if kind == "baseline":
        yield FirstMeeting(f"{name}{WINDOW_OF}search", windows,
                           lambda step: window(f"after_{step}", Step(step), every), every)


def yarn_stretched(scale, backend):
    """Returns the runs of Fig. 15: a chain for each run."""
    for stiffness in YARN_STIFFNESS:
        scenes_own = stiffness == YARN_STIFFNESS[0]
        more = () if scenes_own else ("--set", f"contact_stiffness={stiffness}")
        for kind in YARN_KINDS:
            yield tuple(yarn(STRETCH, kind, scale, backend, f"{kind}_{stiffness}", more,
                             0 if scenes_own else WEAK_YARN_STEPS[scale]))


def yarn_twisted(scale, backend):
    """Returns the runs of Fig. 16: a chain for each run that is twisted and let go, and one for the cloth that hangs
    untwisted."""
    let_go = ("--backend", backend, "--audit-meetings", "off", "--set", f"frame_steps={YARN_FRAME_STEPS[scale]}")
    scene, steps = release.Release(scale), RELEASE_STEPS[scale]
    for kind, options in YARN_KINDS.items():
        audit = ("--audit", "frame" if kind == "ogc" else "off")
        released = Job(f"{kind}_released", (*let_go, *audit, *options), (kind, -1), steps, scene=scene,
                       may_fail=kind == "baseline")
        twisted, *asked = yarn(YARN_TWIST, kind, scale, backend, kind)
        yield twisted, released, *asked
    yield (Job("hanging", (*let_go, "--audit", "frame", "--steps", steps), scene=scene),)


# Whether the twisted cloth returns: let go as in Fig. 16, then braked until it hangs still, beside the cloth that hangs
# untwisted. With the scene's 4 iterations it never does, braked or not: so few sweeps do not follow friction, whose
# block is a thousand times m/h², and move in circles of a centimetre (results/tried/yarn_rest_iterations.csv).
# Friction holds threads in place, so that there are many states at rest; the next runs, of both cloths, have none, and
# the energy alone decides. Eight iterations of an eighth of the time step are as many sweeps a second as 64 iterations
# of the whole one, and follow better: in a step an eighth as long the stiffness of a segment is half of m/h², in place
# of 30 times.
REST_STEPS = {"smoke": 480, "small": 90000, "paper": 90000}
REST_FRAME_STEPS = {"smoke": 240, "small": 5000, "paper": 5000}
RELEASE_FRAME_STEPS = {"smoke": 30, "small": 1250, "paper": 1250}  # until they are braked
FINE = ("--set", "time_step=5e-5", "--set", "iterations=8")
BRAKED = ("--set", "damping=per_vertex", *FINE)
FRICTIONLESS = "_frictionless"
AT_REST = {"released": "hanging", f"released{FRICTIONLESS}": f"hanging{FRICTIONLESS}"}  # beside which it is held


def yarn_at_rest(scale, backend):
    """Returns Fig. 16's cloths at rest: a chain for each cloth."""
    common = ("--backend", backend, "--audit", "frame", "--audit-meetings", "off", "--set")
    loose = (*common, f"frame_steps={RELEASE_FRAME_STEPS[scale]}")
    held = (*common, f"frame_steps={REST_FRAME_STEPS[scale]}", *BRAKED)
    braked, steps = release.Release(scale, braked=True), REST_STEPS[scale]
    twisted = Job("twisted", (YARN_TWIST, "--scale", scale, *loose, "--steps", YARN_STEPS[YARN_TWIST][scale]),
                  pictured=False)
    let_go = Job("let_go", loose, (twisted.name, -1), RELEASE_STEPS[scale], scene=release.Release(scale),
                 pictured=False)

    def without_friction(of):
        return Job(f"{of}{FRICTIONLESS}", (*held, "--set", "friction=0"), (of, -1), steps, scene=braked)

    released = Job("released", held, (let_go.name, -1), steps, scene=braked)
    hanging = Job("hanging", (*held, "--steps", steps), scene=braked)
    yield twisted, let_go, released, without_friction(released.name)
    yield hanging, without_friction(hanging.name)
