"""Writes `yarn_twist` as scene files: twisted in another way (Twist), or without the motion that turns it (Release), so
that the twisted cloth is let go, or hangs untwisted from the start. The first row, which the motion held, is cast on:
springs join each bight to the next, and each loop is closed at its neck. Without that nothing holds the first row of a
knit, and it runs out under its own weight, twisted or not. Threads can pass through a spring, but not between two
threads that it keeps as near as a loop's neck is, the yarn's thickness. Needs only Python's own library.
"""

import json
import subprocess
from dataclasses import dataclass

SCENE, TURNED, YARN = "yarn_twist", "lower", "yarn"
BIGHT = 0.4 / 33  # [m] between two bights of a row (experiments/scenes/yarn.cpp)
STIFFNESS = 10  # N/m: 33 of them side by side bear the cloth, 0.7 N, and lengthen by 2 mm each
LOOP = 49  # segments of a loop; the first loop begins where the yarn begins (experiments/scenes/yarn.cpp)
NECK, NECK_WIDTH = 7, 2.95e-3  # vertices from a loop's ends to where its legs are nearest, and their distance there [m]
NECK_STIFFNESS = 100  # N/m, of a segment of the yarn: k_s/l
# Damping by vertex resists with k_d times the stiffness of the segments at the vertex, 2 k_s/l, against a mass of ρ l:
# velocities decay at 2 k_s k_d/(ρ l²). Twice the frequency of the slowest swing, 1.2 √(g/L) of a rope as long as the
# cloth, L = 0.8 m once its own weight has stretched it, is 8.4 1/s, which brings it to rest soonest. Solved steps brake
# at this rate; steps of few iterations brake less.
BRAKE_RATE = 8.4  # 1/s
SEGMENT = 1.04e-3  # l [m] (experiments/scenes/yarn.cpp: 51.03 mm a loop of 49)


def bights(vertices):
    """Returns the yarn's end, and the middle vertex of each bight of the first row, in order. A bight is a run of
    consecutive vertices, except short ones between bights, where the next row reaches down to the edge. Half a bight
    ends the yarn; without it the first loop would be open, and its wale could run."""
    runs, run = [], []
    for v in sorted(vertices):
        if run and v != run[-1] + 1:
            runs.append(run)
            run = []
        run.append(v)
    runs.append(run)
    return [0 if run[0] == 0 else run[len(run) // 2] for run in runs
            if run[0] == 0 or 2 * len(run) > max(map(len, runs))]


def spring(a, b, stiffness, rest_length):
    return {"first": {"body": YARN, "index": a}, "second": {"body": YARN, "index": b}, "stiffness": stiffness,
            "rest_length": rest_length, "damping": 0}


def cast_on(motion):
    """Returns springs between the bights that the motion held, and at the necks of their loops."""
    held = bights(v for part in motion["vertices"] for v in part["indices"])
    loops = range(0, LOOP * (len(held) - 1), LOOP)
    return [*(spring(a, b, STIFFNESS, BIGHT) for a, b in zip(held, held[1:])),
            *(spring(a + NECK, a + LOOP - NECK, NECK_STIFFNESS, NECK_WIDTH) for a in loops)]


def brake(rod):
    """Returns the k_d of this material [s] with which, in runs with `damping=per_vertex`, velocities decay at
    BRAKE_RATE."""
    return BRAKE_RATE * rod["density"] * SEGMENT**2 / (2 * rod["stretch"])


def rod_of(scene):
    return next(body for body in scene["bodies"] if body["name"] == YARN)["material"]["rod"]


def stiffen(scene, factor):
    """Stiffens stretch and bend alike."""
    rod = rod_of(scene)
    for name in ("stretch", "bend"):
        rod[name] *= factor


def motion_that_turns(scene):
    return next(motion for motion in scene["motions"] if motion["name"] == TURNED)


class Changed:
    """Holds the scene of a `scale`, changed, as a file at `path` below the folder of the runs (jobs.Job)."""

    def write(self, program, root):
        """Writes the scene if it is missing."""
        path = root / self.path
        if path.is_file():
            return
        subprocess.run([str(program), "scenes", SCENE, "--scale", self.scale, "--write", str(path.parent)], check=True,
                       stdout=subprocess.DEVNULL)
        scene = json.loads(path.read_text())
        self.change(scene)
        path.write_text(json.dumps(scene, indent=1))


@dataclass(frozen=True)
class Twist(Changed):
    """Holds the scene of a scale, `turns` times turned, at `pace` times its speed, with yarn of `stiffness` times its
    own, and then held for so many seconds."""

    scale: str
    turns: float
    pace: float = 1
    stiffness: float = 1
    held: float = 1

    @property
    def seconds(self):
        """Returns the time until it is let go."""
        return 2 * self.turns / self.pace + self.held

    @property
    def path(self):
        return f"scenes/twisted_{self.scale}_{self.turns:g}_{self.pace:g}_{self.stiffness:g}/{SCENE}.json"

    def change(self, scene):
        turned = motion_that_turns(scene)
        turned["angular_velocity"] *= self.pace
        turned["end"] = 2 * self.turns / self.pace
        stiffen(scene, self.stiffness)


@dataclass(frozen=True)
class Release(Changed):
    """Holds the scene of a scale as a file below the folder of the runs (jobs.Job). `braked`: its motion is damped, for
    runs with `damping=per_vertex`; this does not change where it comes to rest. `stiffness` as in Twist."""

    scale: str
    braked: bool = False
    stiffness: float = 1

    @property
    def path(self):
        stiffer = f"_{self.stiffness:g}" if self.stiffness != 1 else ""
        return f"scenes/{'braked' if self.braked else 'released'}_{self.scale}{stiffer}/{SCENE}.json"

    def change(self, scene):
        turned = motion_that_turns(scene)
        scene["springs"] = [*scene.get("springs", []), *cast_on(turned)]
        scene["motions"].remove(turned)
        stiffen(scene, self.stiffness)
        if self.braked:
            rod_of(scene)["damping"] = brake(rod_of(scene))
        scene["name"] = f"{SCENE}_released"
