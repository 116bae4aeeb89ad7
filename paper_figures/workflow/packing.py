"""Packs what jobs made into an archive, small enough to be taken to where it is drawn, and unpacks it there. Of a run
there are manifest, rows, audit and some frames. Python's own library is enough.
"""

import itertools
import json
import os
import shutil
import subprocess
import tarfile

from paper_figures.workflow import parts
from paper_figures.workflow.jobs import AUDIT, remove
from paper_figures.workflow.unpacking import extract_file

MIB = 2**20
PACKED = "packed.json"  # beside the runs: file -> when it was changed last [ns], of those that were packed
# What unpacking refuses [bytes]: a frame of ten million vertices has a quarter of the one; the other fills a disk.
LARGEST_FILE, LARGEST_ARCHIVE = 2**30, 2**36


class Archive:
    """The archive of one call: FOLDER/runs_NN.tar.gz with the first number that is free, written anew whenever a part
    is finished, so that nothing is lost where the machine goes away. `piece` and `most` [MiB]: it is cut into pieces of
    the one (….000, ….001), and has at most the other, what does not fit is named and stays for a later call; 0: no
    limit."""

    def __init__(self, folder, out, piece=0, most=0):
        self.folder, self.out, self.piece, self.most = folder, out, piece * MIB, most * MIB
        self.before = packed_before(out)
        self.name = next(name for name in map("runs_{:02d}.tar.gz".format, itertools.count(1))
                         if not list(folder.glob(f"{name}*")))
        self.left_out = []

    def write(self, book):
        """Packs what is new of the parts in `book`, the smallest first, because the last piece is lost most easily;
        returns lines about them."""
        found = {name: self.new_files(part) for name, part in book.items()}
        sizes = {name: sum(path.stat().st_size for path in files) for name, files in found.items()}
        packed, lines, self.left_out = {}, [], []
        self.out.mkdir(parents=True, exist_ok=True)
        whole = self.out / f"packed_{os.getpid()}.tar.gz"
        with tarfile.open(whole, "w:gz", compresslevel=6) as archive:
            for name in sorted((name for name in found if found[name]), key=sizes.get):
                files, size = found[name], f"{name}: {len(found[name])} files, {sizes[name] / MIB:.1f} MiB"
                in_archive = archive.fileobj.fileobj.tell()
                if self.most and in_archive + sizes[name] > self.most:  # as if nothing were compressed
                    self.left_out.append(name)
                    lines.append(f"{size}, did not fit; take the archive away and call again")
                    continue
                lines.append(size)
                for path in files:
                    inside = path.relative_to(self.out).as_posix()
                    if inside not in packed:  # parts share runs
                        archive.add(path, inside)
                        packed[inside] = path.stat().st_mtime_ns
        if packed:
            return [*lines, self.put(whole, packed)]
        whole.unlink()
        return lines

    def new_files(self, part):
        """Those of a part's jobs that no earlier call has packed as they are."""
        root, files = self.out / part.folder, {}
        for job in part.jobs:
            files.update(dict.fromkeys(job.results(root, part.frames, part.last)))
        known = lambda path: self.before.get(path.relative_to(self.out).as_posix())  # noqa: E731
        return [path for path in files if known(path) != path.stat().st_mtime_ns]

    def put(self, whole, packed):
        """The archive, or its pieces, in its folder; returns a line about it."""
        size = whole.stat().st_size
        self.folder.mkdir(parents=True, exist_ok=True)
        for old in self.folder.glob(f"{self.name}*"):
            old.unlink()
        cut(whole, self.folder / self.name, self.piece)
        (self.out / PACKED).write_text(json.dumps({**packed_before(self.out), **packed}))
        return f"{size / MIB:.1f} MiB in {self.folder / self.name}"


def packed_before(out):
    kept = out / PACKED
    return json.loads(kept.read_text()) if kept.is_file() else {}


def cut(whole, target, piece):
    """Moves a file to `target`, or to pieces of so many bytes beside it."""
    if not piece:
        shutil.move(whole, target)
        return
    with whole.open("rb") as file:
        for number in itertools.count():
            data = file.read(piece)
            if not data:
                break
            target.with_name(f"{target.name}.{number:03d}").write_bytes(data)
    whole.unlink()


def archives_in(folder):
    """name -> the file of an archive, or its pieces in their order."""
    found = {}
    for path in sorted(folder.glob("runs_*.tar.gz*")):
        found.setdefault(path.name.partition(".tar.gz")[0], []).append(path)
    return found


def unpack(folder, out, program):
    """Unpacks every archive in `folder`, and assembles what draws meshes (trajectory.vtkhdf) of the frames that came
    along; returns the runs. Throws UnpackError, with nothing of that archive written."""
    names = []
    out.mkdir(parents=True, exist_ok=True)
    for paths in archives_in(folder).values():
        whole = out / "packed.tar.gz"
        with whole.open("wb") as file:
            for path in paths:
                with path.open("rb") as piece:
                    shutil.copyfileobj(piece, file)
        try:
            names += extract_file(whole, out, LARGEST_FILE, LARGEST_ARCHIVE)
        finally:
            whole.unlink()
    runs = sorted({(out / name).parent for name in names if name.endswith(("/run.json", f"/{AUDIT}"))})
    for run in runs:
        assemble(program, run)
    shown = [show(out, run) for run in runs]
    return [*runs, *(path for path in shown if path)]


def assemble(program, run):
    """trajectory.vtkhdf of a run's frames: `ogc export` makes it on its way."""
    if not any((run / "frames").glob("*")) or (run / "trajectory.vtkhdf").is_file():
        return
    scratch = run / "exported"
    command = [str(program), "export", str(run), "--format", "obj", "--out", str(scratch)]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    shutil.rmtree(scratch)


def show(out, run):
    """Copies the whole run of a row to where the workflow of its scene's figure looks; returns that folder, if any."""
    table, row, name = run.relative_to(out).parts if len(run.relative_to(out).parts) == 3 else ("", "", "")
    figure = parts.ROWS.get(row, ("",))[0]
    if not table.startswith("table1-") or name != "whole" or not figure:
        return None
    target = out / table.replace("table1", figure, 1) / parts.SHOWN.get(row, "run")
    remove(target)
    shutil.copytree(run, target)
    return target
