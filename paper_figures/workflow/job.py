"""Runs the command of one step of the workflow with a log; where it fails, shows the command and the log's last lines.
Beside the log it writes how long the command took.

Usage: python3 -m paper_figures.workflow.job LOG OUTPUT COMMAND …; what an interrupted attempt left where OUTPUT goes is
removed first, if it is a run folder. Where OGC_EVENTS names a file, it is told there when the step begins and how it
ends (progress.py), by the log's name.
"""

import json
import os
import shlex
import sys
import time
from pathlib import Path

from paper_figures.workflow.jobs import command_in, last_lines, remove

LINES = 20
EVENTS = "OGC_EVENTS"


def clear(output):
    """A run folder that holds an earlier attempt goes as a whole: `ogc` starts from nothing."""
    if Path(output).name == "run.json":
        remove(Path(output).parent)


def tell(**event):
    """A line for whoever watches; one write, so that steps side by side do not mix theirs."""
    if os.environ.get(EVENTS):
        with open(os.environ[EVENTS], "a", encoding="utf-8") as file:
            file.write(json.dumps(event) + "\n")


def run(log, output, command):
    """Exit status of the command; 1 where it succeeded without making its output."""
    clear(output)
    log = Path(log)
    tell(what="begins", step=log.stem)
    begun = time.monotonic()
    status, _ = command_in(command, log=log)
    if status == 0 and Path(output).is_file():
        seconds = round(time.monotonic() - begun, 2)
        log.with_name(log.name + ".json").write_text(json.dumps({"command": command, "seconds": seconds}))
        tell(what="ends", step=log.stem, seconds=seconds)
        return 0
    why = f"exit status {status}" if status else f"no {output}"
    whole = f"(the whole log: {log.resolve()})"
    words = f"FAILED ({why}): {shlex.join(command)}\n  {last_lines(log, LINES)}\n  {whole}"
    tell(what="fails", step=log.stem, words=words)
    print(words, file=sys.stderr)
    return status or 1


if __name__ == "__main__":
    sys.exit(run(sys.argv[1], sys.argv[2], sys.argv[3:]))
