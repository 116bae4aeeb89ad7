"""Packs what jobs made into an archive that is small enough to be moved to the machine that draws it, and unpacks it
there. Of a run it has manifest, rows, audit and some frames. Needs only Python's own library.
"""

import contextlib
import itertools
import json
import os
import shutil
import subprocess
import tarfile
from pathlib import PurePosixPath

from paper_figures.workflow import parts
from paper_figures.workflow.jobs import AUDIT, FINISHED, KEPT, remove

MIB = 2**20
PACKED = "packed.json"  # beside the runs: packed file -> its last change [ns]
STAMP, TIMES = "program.txt", "times.json"  # beside the runs of everything.py, which packs them with each archive
# An archive that has reached this size is closed. Its last file can be large: a frame of yarn has 10 MiB, a scene that
# leaves out many pairs 22.
PIECE = 5 * MIB


class UnpackError(Exception):
    """Raised for what an archive may not contain, with the reason; nothing of the archive was written."""


class Archive:
    """Writes the archives of one call: FOLDER/runs_NN.tar.gz from the first free number on. The last one is rewritten
    whenever a part is finished, so that nothing is lost if the machine is taken away; one that is full is closed. Of a
    run it has at most so many `frames`, besides those with which jobs begin. `beside`: files of the runs' folder that
    each archive has."""

    def __init__(self, folder, out, frames=None, beside=()):
        self.folder, self.out, self.before = folder, out, packed_before(out)
        self.frames, self.beside, self.path = frames, beside, self.next_path()

    def next_path(self):
        names = map("runs_{:02d}.tar.gz".format, itertools.count(1))
        return next(self.folder / name for name in names if not (self.folder / name).exists())

    def write(self, book):
        """Packs what is new of the parts in `book`; returns lines about them."""
        packed, lines, seen = {}, [], set()
        for name, part in book.items():
            files = [path for path in self.new_files(part) if path.resolve() not in seen]
            seen.update(path.resolve() for path in files)
            if files:
                lines.append(f"{name}: {len(files)} files, {sum(path.stat().st_size for path in files) / MIB:.1f} MiB")
            packed.update((self.inside(path), path) for path in files)
        while packed:
            changed, full = self.piece(packed)
            (self.out / PACKED).write_text(json.dumps({**packed_before(self.out), **changed}))
            packed = {inside: path for inside, path in packed.items() if inside not in changed}
            lines.append(f"{self.path.stat().st_size / MIB:.1f} MiB in {self.path}")
            if full:
                self.before.update(changed)
                self.path = self.next_path()
        return lines

    def piece(self, packed):
        """Packs files until the archive is full; returns (file -> its last change, whether it is full)."""
        self.folder.mkdir(parents=True, exist_ok=True)
        partial, changed, full = self.folder / f"packed_{os.getpid()}", {}, False
        with partial.open("wb") as file, tarfile.open(fileobj=file, mode="w:gz", compresslevel=6) as archive:
            for name in self.beside:
                archive.add(self.out / name, name)
            for inside, path in packed.items():
                archive.add(path, inside)
                changed[inside] = path.stat().st_mtime_ns
                if full := file.tell() >= PIECE:
                    break
        partial.replace(self.path)
        return changed, full

    def inside(self, path):
        return path.resolve().relative_to(self.out.resolve()).as_posix()

    def new_files(self, part):
        """Returns the files of a part's jobs that no closed archive has in their current form. A link to a row's run
        (Part.shown_as) is packed as that run, from which unpacking makes it again."""
        root, files = self.out / part.folder, {}
        frames = part.frames if self.frames is None else min(part.frames, self.frames)
        for job in part.jobs:
            files.update(dict.fromkeys(job.results(root, frames, part.last)))
        known = lambda path: self.before.get(self.inside(path))  # noqa: E731
        return [path for path in files if known(path) != path.stat().st_mtime_ns]


def note(out, names):
    """Notes that an archive has these files, so that they are not packed again."""
    there = {name: (out / name).stat().st_mtime_ns for name in names}
    (out / PACKED).write_text(json.dumps({**packed_before(out), **there}))


def packed_before(out):
    kept = out / PACKED
    return json.loads(kept.read_text()) if kept.is_file() else {}


@contextlib.contextmanager
def opened(path):
    """Opens an archive. Throws UnpackError if it is cut or damaged, also while it is read."""
    try:
        with tarfile.open(path) as archive:
            yield archive
    except (EOFError, tarfile.TarError) as error:
        raise UnpackError(f"{path.name} is cut or damaged ({error})") from error


def members(path):
    """Returns the names of an archive's members. Throws UnpackError as `opened` does."""
    with opened(path) as archive:
        return archive.getnames()


def read(path, name):
    """Returns the text of a member of an archive; empty if there is none. Throws UnpackError as `opened` does."""
    with opened(path) as archive:
        try:
            with archive.extractfile(name) as file:
                return file.read().decode()
        except KeyError:
            return ""


def take_times(archives, out):
    """Takes over how long the parts of the archives took, unless it is known below `out`; returns it all."""
    ended = lambda found, name: found.get(name, {}).get("end") in (FINISHED, KEPT)  # noqa: E731
    times = {}
    for path in archives:
        packed = json.loads(read(path, TIMES) or "{}")
        times |= {name: each for name, each in packed.items() if not ended(times, name)}
    known = json.loads((out / TIMES).read_text()) if (out / TIMES).is_file() else {}
    times |= {name: each for name, each in known.items() if not ended(times, name)}
    if times:
        (out / TIMES).write_text(json.dumps(times, indent=1) + "\n")
    return times


def extract(path, out, left_out=()):
    """Writes the members of an archive below `out`, but those whose names begin as in `left_out`, and returns their
    names. Throws UnpackError, before anything is written, if a member is not a plain file or would be written
    elsewhere, or if the archive is truncated. Python's own data filter is not in Debian 12's."""
    with opened(path) as archive:
        wanted = [member for member in archive.getmembers() if not member.name.startswith(tuple(left_out))]
        for member in wanted:
            inside = PurePosixPath(member.name)
            folder = out.joinpath(inside).parent.resolve()
            if (not member.isfile() or inside.is_absolute() or ".." in inside.parts
                    or not folder.is_relative_to(out.resolve())):
                raise UnpackError(f"'{member.name}' is no plain file, or would be written outside the folder")
        for member in wanted:
            target = out / member.name
            target.parent.mkdir(parents=True, exist_ok=True)
            target.unlink(missing_ok=True)
            with archive.extractfile(member) as source, target.open("wb") as file:
                shutil.copyfileobj(source, file)
        return [member.name for member in wanted]


def unpack(folder, out, program):
    """Unpacks every archive in `folder`, and assembles the file that meshes are drawn from (trajectory.vtkhdf) from the
    unpacked frames; returns the runs. Throws UnpackError, with nothing of that archive written."""
    out.mkdir(parents=True, exist_ok=True)
    archives = sorted(folder.glob("runs_*.tar.gz"))
    for said in filter(None, (read(path, STAMP) for path in archives)):
        if not (out / STAMP).exists():
            (out / STAMP).write_text(said)  # before the runs, which are of this program
    take_times(archives, out)
    names = [name for path in archives for name in extract(path, out, (STAMP, TIMES))]
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
