"""Keeps a picture that was drawn again from accepted results or from runs made on another machine, with its provenance
and its caption: what `accept` can't, because it keeps a picture together with its runs.

Usage: python3 -m paper_figures.workflow.redrawn PICTURE --machine M --figure F --scale S --redo COMMAND [--of RUN |
--commit C --device D --ended T]. Of a run folder commit, compiler, device and end are read.
"""

import argparse
import hashlib
import json
import sys
from pathlib import Path

from paper_figures.workflow import accept, captions, contents
from paper_figures.workflow.evidence import RESULTS
from paper_figures.workflow.kept import AcceptError, file_of

KEYS = ("commit", "compiler", "device", "ended")


def keep(path, machine, figure, scale, backend, redo, origin, results=RESULTS):
    """Keeps the picture or movie `path` as FIGURE_SCALE (FIGURE alone for scale "-"); returns its name. An earlier one
    of this name goes, whatever its suffix. `origin`: commit, compiler, device and end of the runs behind it."""
    folder = Path(results) / machine
    suffix, data = file_of(path)
    if len(data) > accept.LARGEST_PICTURE:
        raise AcceptError(f"{path} has {len(data) / 2**20:.2g} MiB as kept: draw it smaller")
    stem = figure if scale == "-" else f"{figure}_{scale}"
    alike = (".mp4",) if suffix == ".mp4" else (".png", ".webp", ".svg")
    gone = [f"{stem}{end}" for end in alike if end != suffix and (folder / f"{stem}{end}").is_file()]
    for name in gone:
        (folder / name).unlink()
    name = f"{stem}{suffix}"
    (folder / name).write_bytes(data)
    row = {"file": name, "figure": figure, "scale": scale, "backend": backend, "redo": redo, **origin,
           "sha256": hashlib.sha256(data).hexdigest()[:16]}
    contents.merge(folder / contents.PROVENANCE, contents.COLUMNS, [row], ("file",), {(other,) for other in gone})
    captions.keep(folder, {name: path}, gone)
    return name


def origin_of(run):
    """Returns commit, compiler, device and end of a run that is evidence. Throws AcceptError."""
    manifest = accept.manifest_at(run / "run.json")
    accept.check(run.name, manifest)
    return {key: manifest[key] for key in KEYS}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("picture", type=Path)
    for name in ("machine", "figure", "scale", "redo"):
        parser.add_argument(f"--{name}", required=True)
    parser.add_argument("--backend", default="cuda", choices=("cpu", "cuda", "-"))
    parser.add_argument("--of", type=Path, metavar="RUN", help="run folder behind it")
    for name in KEYS:
        parser.add_argument(f"--{name}", default="")
    options = parser.parse_args()
    try:
        origin = origin_of(options.of) if options.of else {key: getattr(options, key) for key in KEYS}
        place = options.machine, options.figure, options.scale, options.backend
        print(keep(options.picture, *place, options.redo, origin))
    except (AcceptError, OSError, json.JSONDecodeError) as error:
        sys.exit(f"redrawn: {error}")


if __name__ == "__main__":
    main()
