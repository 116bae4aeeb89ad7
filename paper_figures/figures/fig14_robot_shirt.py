"""Fig. 14: two grippers lift a T-shirt by its shoulders, shake it and fold it. Draws four moments, time, the grippers'
lag or the contacts, and distances."""

from paper_figures.workflow.common import main

TITLE = "Fig. 14. Two grippers lift, shake and fold a T-shirt"
ALT = ("Four renderings of a blue T-shirt on a table. Two grey grippers pinch its shoulders, lift it until it hangs, "
       "and lay it down folded on itself.")

if __name__ == "__main__":
    main("robot_shirt", (0, 1200, 2220, 3600), TITLE, ALT, driven=True)
