"""Fig. 10: fifty square cloths fall onto a cylinder, collide, slide to the ground and come to rest. Draws five moments,
time, detections and distances."""

from paper_figures.workflow.common import main

TITLE = "Fig. 10. Fifty cloths fall on a cylinder, slide off and rest in a pile"
ALT = ("Five renderings. Fifty square cloths lie in a stack above a horizontal cylinder; the stack bends over it, "
       "slides to one side, falls to the floor, and at 4 s rests there as a pile of fifty separate, folded layers.")

if __name__ == "__main__":
    main("fifty_layers", (0, 240, 480, 960, 4800), TITLE, ALT)
