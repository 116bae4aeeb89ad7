"""Packs what jobs made into an archive that is small enough to be moved to the machine that draws it, and unpacks it
there. Of a run it has manifest, rows, audit and some frames. Needs only Python's own library.
"""

import itertools
import json
import os
import shutil
import subprocess
import tarfile
from pathlib import PurePosixPath

from paper_figures.workflow import parts
from paper_figures.workflow.jobs import AUDIT, remove

MIB = 2**20
PACKED = "packed.json"  # beside the runs: packed file -> its last change [ns]


class UnpackError(Exception):
    """Raised for what an archive may not contain, with the reason; nothing of the archive was written."""


class Archive:
    """Writes the archive of one call: FOLDER/runs_NN.tar.gz with the first free number. It is rewritten whenever a part
    is finished, so that nothing is lost if the machine is taken away."""

    def __init__(self, folder, out):
        self.folder, self.out, self.before = folder, out, packed_before(out)
        names = map("runs_{:02d}.tar.gz".format, itertools.count(1))
        self.path = next(folder / name for name in names if not (folder / name).exists())

    def write(self, book):
        """Packs what is new of the parts in `book`; returns lines about them."""
        packed, lines, seen = {}, [], set()
        for name, part in book.items():
            files = [path for path in self.new_files(part) if path.resolve() not in seen]
            seen.update(path.resolve() for path in files)
            if files:
                lines.append(f"{name}: {len(files)} files, {sum(path.stat().st_size for path in files) / MIB:.1f} MiB")
            packed.update((path.resolve().relative_to(self.out.resolve()).as_posix(), path) for path in files)
        if not packed:
            return lines
        self.folder.mkdir(parents=True, exist_ok=True)
        partial = self.folder / f"packed_{os.getpid()}"
        with tarfile.open(partial, "w:gz", compresslevel=6) as archive:
            for inside, path in packed.items():
                archive.add(path, inside)
        partial.replace(self.path)
        changed = {inside: path.stat().st_mtime_ns for inside, path in packed.items()}
        (self.out / PACKED).write_text(json.dumps({**packed_before(self.out), **changed}))
        return [*lines, f"{self.path.stat().st_size / MIB:.1f} MiB in {self.path}"]

    def new_files(self, part):
        """Returns the files of a part's jobs that no earlier call packed in their current form. A link to a row's run
        (Part.shown_as) is packed as that run, from which unpacking makes it again."""
        root, files, out = self.out / part.folder, {}, self.out.resolve()
        for job in part.jobs:
            files.update(dict.fromkeys(job.results(root, part.frames, part.last)))
        known = lambda path: self.before.get(path.resolve().relative_to(out).as_posix())  # noqa: E731
        return [path for path in files if known(path) != path.stat().st_mtime_ns]


def packed_before(out):
    kept = out / PACKED
    return json.loads(kept.read_text()) if kept.is_file() else {}


def extract(path, out):
    """Writes the members of an archive below `out` and returns their names. Throws UnpackError, before anything is
    written, if a member is not a plain file or would be written elsewhere, or if the archive is truncated. Python's own
    data filter is not in Debian 12's."""
    try:
        with tarfile.open(path) as archive:
            members = archive.getmembers()
            for member in members:
                inside = PurePosixPath(member.name)
                folder = out.joinpath(inside).parent.resolve()
                if (not member.isfile() or inside.is_absolute() or ".." in inside.parts
                        or not folder.is_relative_to(out.resolve())):
                    raise UnpackError(f"'{member.name}' is no plain file, or would be written outside the folder")
            for member in members:
                target = out / member.name
                target.parent.mkdir(parents=True, exist_ok=True)
                target.unlink(missing_ok=True)
                with archive.extractfile(member) as source, target.open("wb") as file:
                    shutil.copyfileobj(source, file)
            return [member.name for member in members]
    except (EOFError, tarfile.TarError) as error:
        raise UnpackError(f"{path.name} is cut or damaged ({error})") from error


def unpack(folder, out, program):
    """Unpacks every archive in `folder`, and assembles the file that meshes are drawn from (trajectory.vtkhdf) from the
    unpacked frames; returns the runs. Throws UnpackError, with nothing of that archive written."""
    out.mkdir(parents=True, exist_ok=True)
    names = [name for path in sorted(folder.glob("runs_*.tar.gz")) for name in extract(path, out)]
    runs = sorted({(out / name).parent for name in names if name.endswith(("/run.json", f"/{AUDIT}"))})
    for run in runs:
        assemble(program, run)
    shown = [show(out, run) for run in runs]
    return [*runs, *(path for path in shown if path)]


def assemble(program, run):
    """Assembles trajectory.vtkhdf from a run's frames; `ogc export` makes it as a by-product. Of frames without a
    scene, with which jobs begin, it makes nothing."""
    if not any((run / "frames").glob("*")) or not (run / "scene").is_dir() or (run / "trajectory.vtkhdf").is_file():
        return
    scratch = run / "exported"
    command = [str(program), "export", str(run), "--format", "obj", "--out", str(scratch)]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    shutil.rmtree(scratch)


def show(out, run):
    """Copies the whole run of a row to the folder where the workflow of its scene's figure looks for it; returns that
    folder, if any."""
    table, row, name = run.relative_to(out).parts if len(run.relative_to(out).parts) == 3 else ("", "", "")
    figure = parts.ROWS.get(row, ("",))[0]
    if not table.startswith("table1-") or name != "whole" or not figure:
        return None
    target = out / table.replace("table1", figure, 1) / parts.SHOWN.get(row, "run")
    remove(target)
    shutil.copytree(run, target)
    return target
