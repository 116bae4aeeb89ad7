"""Unpacks an archive that came from elsewhere: everything in it is looked at before anything is written, and what would
leave the folder, or fill the disk, is refused by name. Checks of our own, because Python's data filter looks at no
sizes and is not in every Python 3.11.
"""

import shutil
import tarfile
from pathlib import Path, PurePosixPath


class UnpackError(Exception):
    """What in the archive is refused, and why; nothing of it was written."""


def place(name):
    """The parts of a member's path below the folder. Throws UnpackError where it leads elsewhere."""
    path = PurePosixPath(name)
    if path.is_absolute() or ".." in path.parts or not path.parts or "\0" in name or "\\" in name:
        raise UnpackError(f"'{name}' would be written outside the folder")
    return path.parts


def check_link(member, parts):
    """A link must be symbolic and lead to something below the folder."""
    target = PurePosixPath(member.linkname)
    depth = len(parts) - 1
    for part in target.parts:
        depth += -1 if part == ".." else 1
        if depth < 0:
            break
    if not member.issym() or target.is_absolute() or depth < 0:
        raise UnpackError(f"'{member.name}' is a link to '{member.linkname}', outside the folder")


def check(members, largest, total):
    """Throws UnpackError for the first member that is no plain file, folder or link to something inside, is above
    `largest`, or brings all above `total` [bytes]; and where two have one name, or one would be written through a
    link."""
    links, seen, size = set(), set(), 0
    for member in members:
        parts = place(member.name)
        if member.issym() or member.islnk():
            check_link(member, parts)
            links.add(parts)
        elif not (member.isfile() or member.isdir()):
            raise UnpackError(f"'{member.name}' is no file, folder or link")
        if parts in seen and not member.isdir():
            raise UnpackError(f"'{member.name}' is there twice")
        seen.add(parts)
        size += member.size
        if not 0 <= member.size <= largest or size > total:
            raise UnpackError(f"'{member.name}' has {member.size:,} bytes, with what is before it {size:,}: "
                              f"more than is ever packed ({largest:,} a file, {total:,} in all)")
    for parts in seen:
        if any(parts[:n] in links for n in range(1, len(parts))):
            raise UnpackError(f"'{'/'.join(parts)}' would be written through a link")


def extract(archive, out, largest, total):
    """Names of what an open archive holds, written below `out`. Throws UnpackError before anything is written."""
    check(archive, largest, total)  # while it is read: what is absurd is not read to its end
    members, root = archive.getmembers(), Path(out).resolve()
    for member in members:
        path = root.joinpath(*place(member.name))
        if not path.parent.resolve().is_relative_to(root):
            raise UnpackError(f"'{member.name}' would be written through a link that is already in {out}: remove it")
    for member in members:
        write(archive, member, root.joinpath(*place(member.name)))
    return [member.name for member in members]


def write(archive, member, path):
    """One member; neither its owner nor its permissions are taken over, and what a link of that name led to stays."""
    if member.isdir():
        return path.mkdir(parents=True, exist_ok=True)
    path.parent.mkdir(parents=True, exist_ok=True)
    path.unlink(missing_ok=True)
    if member.issym():
        return path.symlink_to(member.linkname)
    with archive.extractfile(member) as source, path.open("wb") as file:
        shutil.copyfileobj(source, file)
    return None


def extract_file(path, out, largest, total):
    """`extract` of the archive in this file. Throws UnpackError, also where it is cut."""
    try:
        with tarfile.open(path) as archive:
            return extract(archive, out, largest, total)
    except (EOFError, tarfile.TarError) as error:
        raise UnpackError("the pieces end in the middle of a file: the last ones are missing or cut") from error
