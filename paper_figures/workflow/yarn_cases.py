"""Lists the cloths of yarn that are twisted and let go, and how each comes to hang. Needs only Python's own library."""

from dataclasses import dataclass

from paper_figures.workflow import commands, release
from paper_figures.workflow.jobs import Job

TURNS = {"smoke": (0.01, 0.02), "small": (1, 2, 5), "paper": (1, 2, 3, 5)}
HELD = {"smoke": 0.01, "small": 1, "paper": 1}  # time for which the twist is held before the release [s]
LONGER = 3  # factor on the steps that brake a twisted cloth of stiffer yarn
COARSE = ("--set", "time_step=4e-4", "--set", "iterations=4")  # the scene's own settings
STARTS = 10  # of Fig. 16's turns solved well


@dataclass(frozen=True)
class Case:
    """Describes how a cloth comes to hang. `turns`: 0 if it was never twisted. `fine`: twists with the finer steps that
    also brake it. `friction`: whether threads have friction before the cloth is braked. `swings`: whether the cloth
    first swings freely, as long as in Fig. 16. `seed`: of offsets of the start of at most a micrometre; 0: none."""

    turns: float = 0
    pace: float = 1
    stiffness: float = 1
    fine: bool = False
    friction: bool = True
    swings: bool = False
    seed: int = 0

    @property
    def name(self):
        words = [f"turns_{self.turns:g}" if self.turns else "hanging",
                 f"pace_{self.pace:g}" if self.pace != 1 else "",
                 f"stiffness_{self.stiffness:g}" if self.stiffness != 1 else "", "fine" if self.fine else "",
                 "" if self.friction else "frictionless", "swings" if self.swings else "",
                 f"seed_{self.seed}" if self.seed else ""]
        return "_".join(filter(None, words)).replace(".", "p")

    @property
    def twist_settings(self):
        """Returns words of `ogc run`: time step and iterations during the twist."""
        return commands.FINE if self.fine else COARSE

    @property
    def beside(self):
        return Case(stiffness=self.stiffness).name

    def jobs(self, scale, backend):
        """Yields the jobs in their order. The last one ends with the hanging cloth."""
        common = ("--backend", backend, "--audit", "end", "--audit-meetings", "off", "--set")
        kept = (*common, f"frame_steps={commands.REST_FRAME_STEPS[scale]}")
        rubs = () if self.friction else ("--set", "friction=0")
        braked = release.Release(scale, braked=True, stiffness=self.stiffness)
        rest = (*kept, *commands.BRAKED, "--set", "friction=0")
        rest_steps = commands.REST_STEPS[scale] * (LONGER if self.turns and self.stiffness != 1 else 1)
        if not self.turns:
            yield Job(self.name, (*rest, "--steps", rest_steps), scene=braked)
            return
        twist = release.Twist(scale, self.turns, self.pace, self.stiffness, HELD[scale])
        moved = ("--jitter", 1e-6, "--seed", self.seed) if self.seed else ()
        steps = round(twist.seconds / float(self.twist_settings[1].partition("=")[2]))
        before = f"{self.name}_twist"
        yield Job(before, (*common, f"frame_steps={steps}", *rubs, *self.twist_settings, *moved, "--steps", steps),
                  scene=twist)
        if self.swings:
            steps = commands.RELEASE_STEPS[scale]
            last, before = before, f"{self.name}_free"
            yield Job(before, (*common, f"frame_steps={steps}", *rubs), (last, -1), steps,
                      scene=release.Release(scale, stiffness=self.stiffness))
        yield Job(self.name, rest, (before, -1), rest_steps, scene=braked)


def cases(scale):
    """Yields cases that differ in one choice at a time: first few turns and Fig. 16's turns, each solved coarsely and
    well, then the others. Fig. 16's turns solved well have three starts that swing, and STARTS that do not."""
    turns = TURNS[scale]
    most = turns[-1]
    yield from (Case(stiffness=stiffness) for stiffness in (1, 10, 100))
    yield from (Case(t, fine=fine) for fine in (False, True) for t in turns)
    yield from (Case(most, fine=True, swings=True, seed=seed) for seed in (1, 2))
    yield from (Case(most, fine=True, seed=seed) for seed in range(1, STARTS))
    yield from (Case(most, fine=fine, swings=True) for fine in (False, True))
    yield Case(most, pace=0.25)
    yield Case(most, fine=True, friction=False)
    yield from (Case(t, stiffness=stiffness, fine=True) for stiffness in (10, 100) for t in (turns[0], most))


def chains(scale, backend):
    """Returns the jobs of all cases: a chain for each."""
    return tuple(tuple(case.jobs(scale, backend)) for case in cases(scale))
