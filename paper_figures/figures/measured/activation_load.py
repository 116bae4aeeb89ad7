"""§5.5.3's two energies held side by side in three ways: at one k_c, at one curvature, at one smallest distance; under
three loads. Runs, tables and picture.

Fig. 21's cloth falls with each energy. VBD in double precision then repeats the last step from the energy's own state
before it, and the iterations to three residuals are counted. IPC's energy is −κ k_c (d − r)² ln(d/r) with κ from 0.1 to
40. The load of a row is the median force of OGC's contacts at the end, in units of k_c r.

Two values of κ follow by interpolation over ln κ between the rows of IPC's energy. At the first, both energies keep the
same smallest distance. At the second, IPC's curvature at the force of the load equals OGC's, which is k_c in the
quadratic stage and f²/(k_c r²/4) in the other. Under a high load the second κ does not exist, and the table gives the
smallest ratio of IPC's curvature to OGC's.
"""

import math
import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from paper_figures.figures.fig21_activation_drop import LEVELS, first_below
from paper_figures.workflow import commands, contact_forces
from paper_figures.workflow.jobs import Job, RunFailure, parser_of_figure
from paper_figures.workflow.runs import iterations, provenance, write_table
from plots import style
from ogc_testbed.runs import Run, RunError

NAME = "activation_load"
STIFFNESSES = (10, 1, 0.2)  # k_c [N/m]: the paper's value, and softer ones, which compress contacts more
RATIOS = (0.1, 0.25, 0.5, 1, 2, 3, 7, 40)  # κ
SEEDS = {"smoke": 1, "small": 1}  # solved to convergence, so one seed suffices
JITTER = 1e-6  # [m]
OTHERS = ("quadratic", "cubic")
WAYS = ("contact stiffness", "curvature at the load", "smallest distance")
TITLE = "At one smallest distance OGC's activation needs about as many iterations as IPC's"
ALT = ("A panel for each load with curves: iterations of the last step over the smallest distance, for IPC's "
       "logarithm at several stiffnesses, and stars for OGC's activation.")


@dataclass(frozen=True)
class Point:
    """Holds an energy, the k_c of OGC's energy beside it, κ and a seed."""

    energy: str
    stiffness: float
    ratio: float
    seed: int

    @property
    def name(self):
        return f"{self.energy}_{self.stiffness:g}_kappa_{self.ratio:g}_seed_{self.seed}"

    def words(self, scale):
        return (commands.ACTIVATIONS, "--scale", scale, "--steps", commands.ACTIVATION_STEPS[scale],
                *commands.BY_VBD, "--set", f"contact_stiffness={self.ratio * self.stiffness:g}",
                "--set", f"contact_activation={self.energy}")

    def fall(self, scale):
        return Job(self.name, (*self.words(scale), *commands.FRAMES, "--jitter", f"{JITTER:g}", "--seed", self.seed))

    def last_step(self, scale):
        return Job(f"{self.name}_last", (*self.words(scale), "--solver", "reference_vbd", "--iterations", "--audit",
                                         "end"), (self.name, -2))


def points(scale):
    for seed in range(1, SEEDS[scale] + 1):
        for stiffness in STIFFNESSES:
            yield from (Point(energy, stiffness, 1, seed) for energy in ("ogc", *OTHERS))
            yield from (Point("ipc_log", stiffness, ratio, seed) for ratio in RATIOS)


def chains(scale):
    """Returns the jobs, a chain for each point."""
    return [(point.fall(scale), point.last_step(scale)) for point in points(scale)]


def measured(point, folder, ogc, scale):
    """Returns {quantity: number} of a point. If the iterations did not suffice, their number is infinity."""
    run, last = Run(folder / point.name), Run(folder / f"{point.name}_last")
    rows = iterations(last, commands.ACTIVATION_STEPS[scale])
    sweeps = {f"iterations to {name} [1]": first_below(rows, level) for name, level in LEVELS.items()}
    found = {name: math.inf if count == "never" else count for name, count in sweeps.items()}
    apart = contact_forces.distances(ogc, run, run.frame(run.frames[-1]))
    found |= {"smallest distance [mm]": 1e3 * run.column("smallest_distance").min(), "contacts [1]": len(apart)}
    if point.energy in contact_forces.FORCE:
        found["load, median force [k_c r]"] = np.median(point.ratio * contact_forces.FORCE[point.energy](apart))
    return found


def in_words(number):
    return "never" if math.isinf(number) else f"{number:.4g}"


def middle(values):
    return {"": np.median(values), " least": min(values), " most": max(values)}


def table(scale, folder, ogc):
    """Returns a row for each energy, load and κ: medians and ranges over the seeds."""
    groups = {}
    for point in points(scale):
        groups.setdefault((point.stiffness, point.energy, point.ratio), []).append(point)
    for (stiffness, energy, ratio), mine in groups.items():
        found = [measured(point, folder, ogc, scale) for point in mine]
        row = {"k_c [N/m]": f"{stiffness:g}", "activation": energy, "kappa [1]": f"{ratio:g}", "seeds [1]": len(mine)}
        for name in (*(f"iterations to {level} [1]" for level in LEVELS), "smallest distance [mm]", "contacts [1]",
                     "load, median force [k_c r]"):
            values = [one[name] for one in found if name in one]
            row |= {f"{name}{end}": in_words(value) for end, value in middle(values).items()} if values else \
                {f"{name}{end}": "" for end in ("", " least", " most")}
        yield row | provenance(Run(folder / f"{mine[0].name}_last"))


def log_force(u):
    """Returns the force of IPC's energy with κ = 1 in units of k_c r; u = d/r."""
    return 2 * (u - 1) * math.log(u) + (u - 1)**2 / u


def log_curvature(u):
    """Returns the second derivative of that energy in units of k_c."""
    return -2 * math.log(u) - 4 * (u - 1) / u + (u - 1)**2 / u**2


def distance_at(force):
    """Returns d/r at which IPC's energy with κ = 1 pushes with `force` k_c r. The force decreases with the distance."""
    near, far = 1e-12, 1.0
    for _ in range(200):
        halfway = (near + far) / 2
        near, far = (halfway, far) if log_force(halfway) > force else (near, halfway)
    return (near + far) / 2


def stiffer(force, ratio):
    """Returns the ratio of IPC's curvature to OGC's where both push with `force` k_c r."""
    own = 1 if force <= 0.5 else 4 * force**2
    return ratio * log_curvature(distance_at(force / ratio)) / own


def crossing(values, wanted):
    """Returns the largest ln κ at which `values`, linear between the ln κ of RATIOS, equal `wanted`; None if there is
    none."""
    logs = np.log(RATIOS)
    for left in reversed(range(len(RATIOS) - 1)):
        a, b = values[left] - wanted, values[left + 1] - wanted
        if a * b <= 0 and a != b:
            return logs[left] + (logs[left + 1] - logs[left]) * a / (a - b)
    return None


def number(row, name):
    return math.inf if row[name] == "never" else float(row[name])


def equal(rows):
    """Returns a row for each load and way of comparison: κ, and the ratio of IPC's iterations to OGC's."""
    for stiffness in (f"{one:g}" for one in STIFFNESSES):
        mine = [row for row in rows if row["k_c [N/m]"] == stiffness]
        ours = next(row for row in mine if row["activation"] == "ogc")
        logs = [row for row in mine if row["activation"] == "ipc_log"]
        load, apart = (float(ours[name]) for name in ("load, median force [k_c r]", "smallest distance [mm]"))
        curvatures = [stiffer(load, ratio) for ratio in RATIOS]
        distances = [math.log(float(row["smallest distance [mm]"])) for row in logs]
        places = dict(zip(WAYS, (0.0, crossing(curvatures, 1), crossing(distances, math.log(apart)))))
        for way, place in places.items():
            row = {"k_c [N/m]": stiffness, "load, median force [k_c r]": f"{load:.3g}", "equal": way,
                   "kappa [1]": "" if place is None else f"{math.exp(place):.3g}",
                   "least curvature of the logarithm over OGC's [1]": f"{min(curvatures):.3g}"}
            for level in LEVELS:
                name = f"iterations to {level} [1]"
                counts = [number(one, name) for one in logs]
                ratio = math.nan if place is None else np.interp(place, np.log(RATIOS), counts) / number(ours, name)
                is_told = 0 < ratio < math.inf  # both energies reach that residual
                row[f"logarithm's over OGC's iterations to {level} [1]"] = f"{ratio:.3g}" if is_told else ""
            yield row | {key: ours[key] for key in ("device", "commit")}


def draw(rows, out):
    plt = style.use()
    below = ("lines: IPC's logarithm, numbers: κ, its stiffness over OGC's; stars: OGC's activation; iterations of VBD "
             "in double until the residual of the last step is at most the number beside the line")
    figure, (panels,) = style.page([(3.1, [(1 / len(STIFFNESSES), "plot")] * len(STIFFNESSES))], TITLE, below)
    for axes, stiffness in zip(panels, STIFFNESSES):
        mine = [row for row in rows if row["k_c [N/m]"] == f"{stiffness:g}"]
        for place, level in enumerate(LEVELS):
            name = f"iterations to {level} [1]"
            logs = [row for row in mine if row["activation"] == "ipc_log" and row[name] != "never"]
            apart, counts = ([float(row[key]) for row in logs] for key in ("smallest distance [mm]", name))
            axes.plot(apart, counts, "o-", color=style.COLOURS[place], markersize=3, label=f"{level}")
            ours = next(row for row in mine if row["activation"] == "ogc")
            if ours[name] != "never":
                axes.plot([float(ours["smallest distance [mm]"])], [float(ours[name])], "*", markersize=11,
                          color=style.COLOURS[place])
            if place == 0:
                for row, x, y in zip(logs, apart, counts):
                    axes.annotate(row["kappa [1]"], (x, y), fontsize=6.5, textcoords="offset points", xytext=(2, 4))
        load = next(row for row in mine if row["activation"] == "ogc")["load, median force [k_c r]"]
        axes.set(xscale="log", yscale="log", xlabel="smallest distance [mm]", ylabel="iterations of the last step",
                 title=f"k_c = {stiffness:g} N/m, load {float(load):.2g} k_c r")
        for axis in (axes.xaxis, axes.yaxis):
            axis.set_major_locator(plt.matplotlib.ticker.LogLocator(subs=(1, 2, 5)))
            axis.set_major_formatter(lambda value, _: f"{value:g}")
            axis.set_minor_formatter(plt.matplotlib.ticker.NullFormatter())
        style.label_ends(axes)
    style.save(figure, out, TITLE, ALT, f"{NAME}; " + ", ".join(sorted({row["commit"] for row in rows})))


def main():
    options = parser_of_figure(__doc__.splitlines()[0], SEEDS, "smoke", has_backend=False).parse_args()
    try:
        for chain in chains(options.scale):
            for job in chain:
                job.make(options.ogc, options.folder, shown=True)
        rows = list(table(options.scale, options.folder, options.ogc))
    except (RunFailure, RunError) as error:
        sys.exit(f"{NAME}: {error}")
    write_table(options.folder / f"{NAME}.csv", rows)
    write_table(options.folder / f"{NAME}_equal.csv", list(equal(rows)))
    draw(rows, options.folder / f"{NAME}.png")


if __name__ == "__main__":
    main()
