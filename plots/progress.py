"""Shows how far a long command is, and what is left: a bar on a terminal, a line every ten seconds in a file."""

import sys
import time


class Progress:
    """Call it with the numbers of parts done and of all; `what` is the unit ("frame")."""

    def __init__(self, what, stream=None, clock=time.monotonic):
        self.what, self.stream, self.clock = what, stream or sys.stderr, clock
        self.begun, self.shown, self.drawn = clock(), None, False

    def __call__(self, done, of):
        now, terminal = self.clock(), self.stream.isatty()
        if done < of and self.shown is not None and now - self.shown < (0.1 if terminal else 10):
            return
        if done >= of and self.shown is None and not terminal:
            return  # over before anybody looked
        self.shown = now
        left = (now - self.begun) * (of - done) / max(done, 1)
        text = f"{self.what} {done}/{of}, " + (f"{left:.0f} s left" if left < 60 else f"{left / 60:.0f} min left")
        full = 24 * done // max(of, 1)
        self.stream.write(f"\r[{'#' * full}{'.' * (24 - full)}] {text}\x1b[K" if terminal else text + "\n")
        self.stream.flush()
        self.drawn = terminal

    def end(self):
        if self.drawn:
            self.stream.write("\n")
        self.drawn = False
