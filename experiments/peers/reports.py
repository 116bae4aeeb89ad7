"""Runs the lines of the reports about a peer's projects and compares what they print with the page.

    experiments/peers/run ipctk reports [PAGE…]     # or newton, whose pages include Warp's
"""

import argparse
import contextlib
import io
import re
import runpy
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent / "reports"
PROJECTS = {"ipctk": ("ipctk",), "newton": ("newton", "warp")}
BLOCK = re.compile(r"```(python|text)\n(.*?)```", re.DOTALL)


def printed(code):
    """Returns what the lines print. They run from a file, since Warp reads the source of kernels."""
    out = io.StringIO()
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "lines.py"
        file.write_text(code, encoding="utf-8")
        with contextlib.redirect_stdout(out):
            runpy.run_path(str(file), run_name="__main__")
    return out.getvalue()


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("peer", choices=sorted(PROJECTS))
    parser.add_argument("pages", nargs="*", help="names without .md; default: all of the peer's")
    options = parser.parse_args()
    if options.peer == "newton":
        import warp

        warp.config.log_level = warp.LOG_ERROR  # otherwise it prints what it compiles
    names = options.pages or sorted(p.stem for p in HERE.glob("*.md") if p.stem.split("_")[0] in PROJECTS[options.peer])
    failed = 0
    for name in names:
        blocks = BLOCK.findall((HERE / f"{name}.md").read_text(encoding="utf-8"))
        if [kind for kind, _ in blocks] != ["python", "text"]:
            raise SystemExit(f"{name}.md: it needs lines of Python and, after them, the text that they print")
        (_, code), (_, expected) = blocks
        found = printed(code)
        failed += found != expected
        print(f"{name}: " + ("as the page says" if found == expected else f"printed\n{found}and not\n{expected}"))
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
