"""The runs of the figures that are made of several, as data: their scripts draw them, device_runs makes them where nothing but Python itself is installed.

Every function returns jobs in an order in which they can be done; names are folders below the figure's. Scales are those of `ogc run`; `backend` is that of VBD in
single precision, all else runs on the CPU.
"""

from paper_figures.timed_runs import Job, Step

TWIST, THREE_CLOTHS, ONE_ITERATION, ACTIVATIONS = "large_radius_twist", "three_cloths_on_sphere", "one_iteration_drop", "activation_drop"
NEO_HOOKEAN = "stable_neo_hookean"  # of IPC's runs and of those beside them (compare/deviations.md)

TWIST_STEPS, TWIST_WINDOWS = 1200, (300, 600, 900, 1180)  # at scales small and paper

THREE_CLOTHS_STEP = {"smoke": 24, "small": 40, "paper": 50}
VBD = ("--set", "iterations=500")
ANY = ("--set", "redetect_fraction=0")
NEWTON = ("--solver", "newton", "--residual", *(word for value in ("newton_tolerance=0", "newton_step_tolerance=1e-9", "newton_iterations=50", "friction_solves=50")
                                               for word in ("--set", value)))

ACTIVATION_STEPS = {"smoke": 30, "small": 40, "paper": 40}
ENERGIES = ("ogc", "ipc_log", "quadratic", "cubic", "ogc_as_printed")
PAPER_ENERGIES = ENERGIES[:2]
# The scene's limit of 200 iterations cut off step 35 at the paper's size two short of its end.
TOLERANCE = ("--set", "newton_tolerance=1e-6", "--set", "newton_iterations=2000")
ABLATION = ("--solver", "newton", *TOLERANCE, "--set", "frame_steps=1", "--audit", "end")


def shared(scale, membrane=NEO_HOOKEAN):
    """Options that all runs beside IPC's share."""
    return ("--scale", scale, *(() if membrane == "st_venant_kirchhoff" else ("--set", f"membrane={membrane}")))


def on(backend):
    return () if backend == "cpu" else ("--backend", backend)


def beside_ipc(scene, scale, backend="cpu", membrane=NEO_HOOKEAN):
    """OGC's run and IPC's of Fig. 2 and 20."""
    base, profile = (scene, *shared(scale, membrane), "--audit", "frame"), ("--profile",) if scene == TWIST else ()
    return Job("vbd", (*base, *on(backend))), Job("ipc", (*base, "--solver", "ipc", *profile))


def ipc_windows(scene, whole, starts, last, scale, membrane=NEO_HOOKEAN, steps=20):
    """IPC on windows of so many steps from states of the run `whole`, which ends at step `last`, where it is too slow for the run itself."""
    return [Job(f"ipc_{start}", (scene, *shared(scale, membrane), "--solver", "ipc", "--profile", "--steps", min(last, start + steps)), (whole, Step(start)))
            for start in starts]


def three_cloths(scale, backends, start_iterations=None):
    """Fig. 17: the run up to the step before, then that step by VBD in single precision; and by VBD and Newton in double. `start_iterations`: of each step before,
    where the scene's own take too long."""
    step = THREE_CLOTHS_STEP[scale]
    base = (THREE_CLOTHS, "--scale", scale, "--audit", "end")
    fewer = ("--set", f"iterations={start_iterations}") if start_iterations else ()
    start = Job("start", (*base, "--backend", backends[-1], "--steps", step - 1, *fewer))
    solve = (*base, "--steps", step, "--iterations", "--profile")
    state = ("start", -1)
    variants = (("", ()), ("_any", ANY))
    single = [Job(f"vbd_{backend}{suffix}", (*solve, "--backend", backend, *VBD, *more), state) for backend in backends for suffix, more in variants]
    newton = [Job(f"newton{suffix}", (*solve, *NEWTON, *more), state) for suffix, more in variants]
    return [start, *single], [Job("vbd_double", (*solve, "--solver", "reference_vbd", *VBD), state), *newton]


def ablation(scale, energy):
    """Fig. 21: all steps by Newton, as `ogc ablate` runs them; a run that does not converge is a result, too."""
    arguments = (ACTIVATIONS, "--scale", scale, "--steps", ACTIVATION_STEPS[scale], *ABLATION, "--set", f"activation={energy}")
    return Job(f"runs/activation={energy}", arguments, may_fail=True)


def last_step(scale, energy, name, options):
    """Fig. 21: the last step again from the energy's own state before it."""
    arguments = (ACTIVATIONS, "--scale", scale, "--steps", ACTIVATION_STEPS[scale], "--set", f"activation={energy}", "--iterations", "--audit", "end", *options)
    return Job(f"{name}_{energy}", arguments, (f"runs/activation={energy}", -2))


def by_newton(scale, energy):
    return last_step(scale, energy, "newton", ("--solver", "newton", *TOLERANCE, "--condition"))


def by_vbd(scale, energy):
    return last_step(scale, energy, "vbd", ("--solver", "reference_vbd", "--set", "redetect_every=10"))


def by_vbd_on(scale, energy, backend):
    return last_step(scale, energy, f"vbd_{backend}", ("--backend", backend, "--set", "redetect_every=10"))


def activations(scale, backend):
    """Fig. 21: a chain an energy."""
    for energy in ENERGIES:
        solved = [by_vbd(scale, energy), by_vbd_on(scale, energy, backend)] if energy in PAPER_ENERGIES else []
        yield [ablation(scale, energy), by_newton(scale, energy), *solved]
