"""Shows runs, meshes, scenes and frames: `ogc view` calls it.

Usage: python -m plots.view RUN [--beside RUN2] [--png FILE | --mp4 FILE | --html FILE]. Without a file it opens a
window. Exit status: 2 bad input, 3 no display.
"""

import argparse
import json
import os
import sys
import time
from pathlib import Path

from plots.packages import Missing, begin, need

begin("ogc view")
from ogc_testbed.page import Page  # noqa: E402
from ogc_testbed.runs import RunError  # noqa: E402
from plots.progress import Progress  # noqa: E402
from plots.sheets import motion_at, of_run  # noqa: E402

BAD_INPUT, NO_DISPLAY = 2, 3
POLL = 0.2  # time between looks at a run that goes on [s]


class NoDisplay(Exception):
    """Raised if a window can't be opened; the message names what can."""


def expect_display(target):
    if sys.platform.startswith("linux") and not (os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY")):
        raise NoDisplay("there is no display (DISPLAY and WAYLAND_DISPLAY are not set). A picture: "
                        f"ogc view {target} --png view.png; a page for any browser: ogc view {target} --html view.html")


def frame_of(motion, step):
    """Returns the number of the frame nearest to a step; the last one without a step."""
    return len(motion) - 1 if step is None else int(abs(motion.steps - step).argmin())


def shown_segments(options):
    return [name for name in ("contacts", "planes") if getattr(options, name)]


def write_page(shown, options):
    progress = Progress("part")
    page = Page(*shown, colour=options.colour, segments=shown_segments(options), progress=progress,
                frame=frame_of(shown[0], options.step), limit=options.megabytes and int(options.megabytes * 1e6))
    size = page.save(options.html)
    progress.end()
    print(f"{options.html}: {len(shown[0])} frames, {size / 1e6:.2f} MB, positions within {page.error:.2g} m")
    if page.left_out:
        print(f"left out: {', '.join(dict.fromkeys(page.left_out))}, with which the page would be larger than "
              f"{page.limit / 1e6:g} MB; --megabytes allows more, --every takes fewer frames")


def draw(shown, options):
    """Writes the picture and the movie."""
    from plots import stills
    frame = frame_of(shown[0], options.step)
    if options.png:
        stage = stills.Stage(shown, options.colour, shown_segments(options), None if options.mp4 else [frame])
        stills.save_picture(stage, frame, options.png)
        print(options.png)
    if options.mp4:
        stage, progress = stills.Stage(shown, options.colour, shown_segments(options)), Progress("frame")
        rate = options.fps or stills.frames_per_second(shown[0].times)
        stills.save_movie(stage, options.mp4, rate, progress)
        progress.end()
        print(f"{options.mp4}: {len(shown[0])} frames, {rate:.3g} a second")


def has_ended(folder, process):
    """Returns whether the run of this folder goes on no more. `process`: the number of the program that makes it, which
    may have been killed; None if that is not known."""
    try:
        status = json.loads((folder / "run.json").read_text())["status"]
    except FileNotFoundError:  # it has not begun
        status = "running"
    if status != "running" or process is None:
        return status != "running"
    try:
        os.kill(process, 0)
    except ProcessLookupError:
        return True
    return False


def wait_for(options, keep):
    """Returns the motion of a run that has just begun, as soon as it has a frame and a step."""
    try:
        return motion_at(options.target, keep=keep)
    except RunError:
        if not keep:  # no run's sheet
            raise
    folder = Path(next(iter(keep)))
    while True:
        ended = has_ended(folder, options.process)
        try:
            return of_run(folder, 1, keep)
        except RunError:
            if ended:
                raise
        time.sleep(POLL)


def follow(options):
    """Draws the newest frame of a run again and again, until the run ends or the window is closed."""
    keep = {}
    shown = [wait_for(options, keep)]
    folder = shown[0].run.folder

    def newer():
        frames = sorted((folder / "frames").glob("frame_*.h5"))
        if int(frames[-1].stem.removeprefix("frame_")) == shown[0].steps[-1]:
            return None
        shown[0] = of_run(folder, 1, keep)
        return [shown[0]]

    if not options.png:
        from plots.window import Window
        return Window(shown, options.colour, shown_segments(options), newer=newer).run()
    from plots import stills
    while True:
        ended = has_ended(folder, options.process)
        stage = stills.Stage(shown, options.colour, shown_segments(options), [len(shown[0]) - 1])
        partial = Path(options.png).with_suffix(".partial" + Path(options.png).suffix)
        stills.save_picture(stage, len(shown[0]) - 1, partial)
        partial.replace(options.png)
        while not newer():
            if ended:
                return
            time.sleep(POLL)
            ended = has_ended(folder, options.process)


def options_of_view():
    parser = argparse.ArgumentParser(prog="ogc view", description=__doc__.splitlines()[0])
    parser.add_argument("target", help="a run folder, a .npz, or a sheet of ogc view")
    parser.add_argument("--beside", help="a second one, shown beside it")
    parser.add_argument("--name", help="the target's name in messages")
    parser.add_argument("--colour", default="body")
    parser.add_argument("--contacts", action="store_true")
    parser.add_argument("--planes", action="store_true")
    parser.add_argument("--step", type=int)
    parser.add_argument("--every", type=int, default=1)
    parser.add_argument("--fps", type=float)
    parser.add_argument("--megabytes", type=float)
    for name in ("png", "mp4", "html"):
        parser.add_argument(f"--{name}")
    parser.add_argument("--yes", action="store_true")
    parser.add_argument("--follow", action="store_true", help="the newest frame of a run that goes on")
    parser.add_argument("--process", type=int, help="the process that makes this run")
    parser.add_argument("--check", action="store_true", help="only whether all is there that the picture needs")
    return parser.parse_args()


def view(options):
    files = [name for name in ("png", "mp4", "html") if getattr(options, name)]
    if not files:
        expect_display(options.name or options.target)
    modules = ["h5py"] + ["polyscope"] * (not files) + ["pyvista", "PIL"] * bool(options.png or options.mp4)
    need(modules + ["imageio_ffmpeg"] * bool(options.mp4), options.yes)
    if options.check:
        return
    if options.follow:
        return follow(options)
    shown = [motion_at(path, options.every) for path in (options.target, options.beside) if path]
    if options.png or options.mp4:
        draw(shown, options)
    if options.html:
        write_page(shown, options)
    if not files:
        from plots.window import Window
        Window(shown, options.colour, shown_segments(options), frame_of(shown[0], options.step)).run()


def main():
    try:
        view(options_of_view())
    except NoDisplay as problem:
        print(f"ogc view: {problem}", file=sys.stderr)
        sys.exit(NO_DISPLAY)
    except (RunError, Missing, OSError) as problem:
        print(f"ogc view: {problem}", file=sys.stderr)
        sys.exit(BAD_INPUT)
    except KeyboardInterrupt:
        sys.exit(130)


if __name__ == "__main__":
    main()
