"""Meshes of other libraries and of files become arrays of the right kind. Objects with the attributes of the libraries'
meshes stand for these.

Usage: meshes.py BUILD_DIR. Exit status 77: skipped, a Python package is missing.
"""

import tempfile
import unittest
from pathlib import Path
from types import SimpleNamespace

from package import grid, main, prepare

prepare(__doc__)
import numpy as np  # noqa: E402

import ogc_testbed as ogc  # noqa: E402

X, FACES = grid(4)
WIDE = X.astype(np.float64), FACES.astype(np.int64)


class Meshes(unittest.TestCase):
    def expect(self, found):
        x, faces = found
        self.assertEqual((x.dtype, faces.dtype), (np.float32, np.int32))
        self.assertEqual((x.tobytes(), faces.tobytes()), (X.tobytes(), FACES.tobytes()))
        ogc.Mesh(faces, vertex_count=len(x))

    def test_of_other_libraries(self):
        x, faces = WIDE
        counted = np.concatenate([np.full((len(faces), 1), 3), faces], axis=1).ravel()
        for mesh in (SimpleNamespace(vertices=x, faces=faces), SimpleNamespace(vertices=x, triangles=faces),
                     SimpleNamespace(points=x, cells_dict={"triangle": faces, "line": faces[:, :2]}),
                     SimpleNamespace(points=x, faces=counted)):
            with self.subTest(list(vars(mesh))):
                self.expect(ogc.from_mesh(mesh))

    def test_what_is_none_is_refused(self):
        x, faces = WIDE
        with self.assertRaisesRegex(TypeError, "type list"):
            ogc.from_mesh([1])
        with self.assertRaisesRegex(ValueError, "no triangles"):
            ogc.from_mesh(SimpleNamespace(points=x, cells_dict={"line": faces[:, :2]}))
        with self.assertRaisesRegex(ValueError, "triangulate"):
            ogc.from_mesh(SimpleNamespace(points=x, faces=np.array([4, 0, 1, 2, 3, 3, 0, 1])))

    def test_of_files(self):
        x, faces = WIDE
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "mesh.npz"
            for names in (("positions", "triangles"), ("x", "faces")):
                for values in (x, np.stack([x, 2 * x])):
                    np.savez(path, **dict(zip(names, (values, faces))))
                    self.expect(ogc.load(path))
            np.savez(path, x=x, f=faces)
            with self.assertRaisesRegex(ValueError, "it has x, f; give"):
                ogc.load(path)
            with self.assertRaisesRegex(ValueError, "trimesh.load"):
                ogc.load("shirt.obj")


if __name__ == "__main__":
    main()
