"""What an archive from elsewhere may not do is refused by name before anything is written; a sound one is unpacked as
it was packed.

Usage: unpacking.py SOURCE_DIR. The standard library is enough.
"""

import io
import subprocess
import sys
import tarfile
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(sys.argv.pop(1)).resolve()
sys.path.insert(0, str(SOURCE))
from paper_figures.workflow import unpacking  # noqa: E402


def member(name, data=b"x", kind=tarfile.REGTYPE, link="", size=None):
    info = tarfile.TarInfo(name)
    info.type, info.linkname, info.size, info.mode = kind, link, len(data) if size is None else size, 0o6777
    return info, data


def sound():
    """Folders, files, a link from a figure to its run."""
    return [member("a", b"", tarfile.DIRTYPE), member("a/run/run.json", b"{}"), member("a/run/frames/f.h5", b"12345"),
            member("fig/run", b"", tarfile.SYMTYPE, "../a/run")]


REFUSED = {"/tmp/x": member("/tmp/x"), "../x": member("../x"), "a/../../x": member("a/../../x"), "b\\x": member("b\\x"),
           "etc": member("etc", b"", tarfile.SYMTYPE, "/etc"), "up": member("up", b"", tarfile.SYMTYPE, "../.."),
           "in/out": member("in/out", b"", tarfile.SYMTYPE, "../a/../../b"),
           "hard": member("hard", b"", tarfile.LNKTYPE, "a/run/run.json"),
           "pipe": member("pipe", b"", tarfile.FIFOTYPE),
           "disk": member("disk", b"", tarfile.BLKTYPE), "fig/run/frames/f.h5": member("fig/run/frames/f.h5"),
           "a/run/run.json": member("a/run/run.json"),
           "large": member("large", b"x" * 101)}


class Unpacking(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = Path(holder.name)
        self.out = self.folder / "above/out"
        self.out.mkdir(parents=True)

    def packed(self, members):
        path = self.folder / "packed.tar.gz"
        with tarfile.open(path, "w:gz") as archive:
            for info, data in members:
                archive.addfile(info, io.BytesIO(data))
        return path

    def unpack(self, members, largest=100, total=1000):
        return unpacking.extract_file(self.packed(members), self.out, largest, total)

    def written(self):
        paths = (path for path in self.folder.rglob("*") if path.name != "packed.tar.gz")
        return sorted(path.relative_to(self.folder).as_posix() for path in paths)

    def test_what_was_packed_comes_back_with_plain_permissions(self):
        self.unpack(sound())
        self.assertEqual((self.out / "fig/run/frames/f.h5").read_bytes(), b"12345")
        self.assertTrue((self.out / "fig/run").is_symlink())
        mode = (self.out / "a/run/run.json").stat().st_mode
        self.assertEqual(mode & 0o7111, 0, "neither executable nor with another's rights")

    def test_what_leads_outside_or_is_absurd_is_refused_by_name_and_nothing_is_written(self):
        for name, bad in REFUSED.items():
            with self.subTest(name), self.assertRaises(unpacking.UnpackError) as caught:
                self.unpack([*sound(), bad])
            self.assertIn(f"'{name}'", str(caught.exception))
            self.assertEqual(self.written(), ["above", "above/out"])

    def test_many_files_that_are_too_large_together_are_refused(self):
        with self.assertRaisesRegex(unpacking.UnpackError, "'f10' has 100 bytes, with what is before it 1,100"):
            self.unpack([member(f"f{n}", b"x" * 100) for n in range(12)])

    def test_a_link_that_was_there_before_is_not_followed(self):
        elsewhere = self.folder / "elsewhere"
        elsewhere.mkdir()
        (self.out / "a").symlink_to(elsewhere)
        words = "'a/run/run.json' would be written through a link that is already in"
        with self.assertRaisesRegex(unpacking.UnpackError, words):
            self.unpack(sound()[1:])
        self.assertEqual(list(elsewhere.iterdir()), [])

    def test_a_file_that_a_link_of_its_name_leads_to_stays_as_it_is(self):
        (self.folder / "mine").write_bytes(b"mine")
        (self.out / "f").symlink_to(self.folder / "mine")
        self.unpack([member("f", b"theirs")])
        self.assertEqual(((self.folder / "mine").read_bytes(), (self.out / "f").read_bytes()), (b"mine", b"theirs"))

    def test_the_command_says_what_it_refuses_and_ends_with_1(self):
        pieces = self.folder / "pieces"
        pieces.mkdir()
        (pieces / "runs_01.tar.gz").write_bytes(self.packed([*sound(), REFUSED["../x"]]).read_bytes())
        command = [sys.executable, "-m", "paper_figures.workflow.runner", "--out", self.out, "--unpack", pieces]
        said = subprocess.run(list(map(str, command)), cwd=SOURCE, capture_output=True, text=True, check=False)
        self.assertEqual(said.returncode, 1)
        words = f"runner: {pieces}: '../x' would be written outside the folder; nothing is unpacked"
        self.assertIn(words, said.stderr)
        self.assertEqual(list(self.out.iterdir()), [])


if __name__ == "__main__":
    unittest.main()
