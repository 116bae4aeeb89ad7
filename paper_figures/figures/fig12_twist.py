"""Fig. 12: a square cloth twisted at its two ends, with planes. Draws four moments, the last from near, time,
detections and distances."""

from paper_figures.workflow.common import main
from plots.camera import near_middle

TITLE = "Fig. 12. A cloth is twisted eight turns into a tight rope"
ALT = ("Five renderings of a square cloth, blue in front and sand behind. Its left and right edges turn against each "
       "other; the middle becomes a rope that gets longer and thinner with each turn, and the close view shows its "
       "wound layers side by side, none through another.")

if __name__ == "__main__":
    main("twist", (0, 1600, 4800, 9600), TITLE, ALT, near=(near_middle(0.17), "the rope after eight turns, from near"))
