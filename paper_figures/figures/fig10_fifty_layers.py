"""Fig. 10: fifty square cloths, at smaller scales fewer, fall onto a cylinder, collide, slide to the ground and come to
rest. Draws moments, time, detections and distances."""

from paper_figures.workflow.common import claims_of, draw_a_run
from plots.scene_figure import draw

STEPS = (0, 240, 480, 960, 4800)
TITLE = "Fig. 10. Fifty cloths fall on a cylinder, slide off and rest in a pile"
FEWER = "Fig. 10. A stack of cloths falls on a cylinder and slides off"
ALT = ("Five renderings. Fifty square cloths lie in a stack above a horizontal cylinder; the stack bends over it, "
       "slides to one side, falls to the floor, and at 4 s rests there as a pile of fifty separate, folded layers.")
FEWER_ALT = ("Renderings. Square cloths lie in a stack above a horizontal cylinder; the stack bends over it, slides to "
             "one side and falls to the floor as a pile of separate, folded layers.")


def moments(last):
    """Returns the steps that are shown of a run with so many: those that it reaches, and its end."""
    return [*(step for step in STEPS[:-1] if step < last), min(last, STEPS[-1])]


def figure(run, out, by_stage):
    whole = run.manifest.get("scale") == "paper"
    draw(run, moments(int(run.column("step")[-1])), claims_of(run), out, TITLE if whole else FEWER,
         ALT if whole else FEWER_ALT, by_stage)


if __name__ == "__main__":
    draw_a_run("fifty_layers", figure, profiled=True)
