"""Runs the command of one step of the workflow with a log; if it fails, shows the command and the log's last lines.
Beside the log a record keeps the command and, at its end, its duration.

Usage: python3 -m paper_figures.workflow.job LOG OUTPUT COMMAND …; if OUTPUT is the manifest of an interrupted run, the
run continues from its checkpoint, or its folder is removed first.
"""

import json
import shlex
import sys
import time
from pathlib import Path

from paper_figures.workflow.jobs import Limit, can_go_on, command_in, last_lines, remove

LINES = 20


class StepFailure(Exception):
    """Raised if a step failed; the message has its command and the last lines of its log."""

    def __init__(self, status, words):
        super().__init__(words)
        self.status = status


def clear(output):
    """Removes a run folder with an earlier attempt as a whole: `ogc` needs an empty place."""
    if Path(output).name == "run.json":
        remove(Path(output).parent)


def record(log):
    """Returns the command of a step's last attempt, and its duration [s] if it ended; {} if there was none."""
    path = Path(f"{log}.json")
    return json.loads(path.read_text()) if path.is_file() else {}


def run(log, output, command, limit=Limit()):
    """Returns the duration of the command [s]; of an interrupted run that of its last attempt. Throws StepFailure, also
    if the command made no output."""
    log, command = Path(log), list(map(str, command))
    kept, before = log.with_name(log.name + ".json"), record(log)
    kept.parent.mkdir(parents=True, exist_ok=True)
    cut_off = before.get("command") == command and "seconds" not in before and command[1:2] == ["run"]
    goes_on = cut_off and can_go_on(Path(output).parent, command[1:], command[0])
    if not goes_on:
        clear(output)
    kept.write_text(json.dumps({"command": command}))
    begun = time.monotonic()
    status, _ = command_in([command[0], "run", "--resume", Path(output).parent] if goes_on else command, limit, log)
    if status == 0 and Path(output).is_file():
        seconds = round(time.monotonic() - begun, 2)
        kept.write_text(json.dumps({"command": command, "seconds": seconds}))
        return seconds
    why = f"exit status {status}" if status else f"no {output}"
    raise StepFailure(status or 1, f"FAILED ({why}): {shlex.join(command)}\n  {last_lines(log, LINES)}\n"
                                   f"  (the whole log: {log.resolve()})")


if __name__ == "__main__":
    try:
        run(sys.argv[1], sys.argv[2], sys.argv[3:])
    except StepFailure as failure:
        print(failure, file=sys.stderr)
        sys.exit(failure.status)
