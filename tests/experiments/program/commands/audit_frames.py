#!/usr/bin/env python3
"""Tests `ogc audit` on frames in formats of other programs, written by NumPy and VTK: it must find the intersecting
frame and nothing in the others.

    tests/experiments/program/commands/audit_frames.py PROGRAM      exit status 77 if NumPy or VTK is missing
"""

import itertools
import json
import signal
import struct
import subprocess
import sys
import tempfile
from pathlib import Path

try:
    import numpy
    from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
    from vtkmodules.vtkCommonCore import vtkPoints
    from vtkmodules.vtkCommonDataModel import VTK_TETRA, vtkCellArray, vtkPolyData, vtkUnstructuredGrid
    from vtkmodules.vtkIOLegacy import vtkPolyDataWriter, vtkUnstructuredGridWriter
    from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter, vtkXMLUnstructuredGridWriter
except ImportError as error:
    print(f"skipped: {error}")
    sys.exit(77)

PROGRAM = sys.argv[1]
sys.path.insert(0, str(Path(__file__).parents[4]))
FRAMES, FIRST_BAD = 12, 10
TRIANGLES = numpy.array([[0, 1, 2], [3, 4, 5]])


def positions():
    """Returns a triangle and another one above it, which comes down by 1 mm a frame and pierces it from frame 10 on."""
    lower = numpy.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], dtype=float)
    upper = numpy.array([[0.2, 0.2, 0.0095], [0.3, 0.2, 0.5], [0.2, 0.3, 0.5]])
    return numpy.array([numpy.vstack([lower, upper - [0, 0, 0.001 * k]]) for k in range(FRAMES)])


def audit(*arguments, status):
    result = subprocess.run([PROGRAM, "audit", *map(str, arguments), "--json"], capture_output=True, text=True)
    assert result.returncode == status, (arguments, result.returncode, result.stderr)
    return json.loads(result.stdout) if result.stdout else result.stderr


def check(verdict, name, distances):
    """Checks that all frames were audited, that the first bad frame is named, and that distances follow from the stored
    numbers."""
    assert len(verdict["states"]) == FRAMES and verdict["complete"]
    assert [state["count"] > 0 for state in verdict["states"]] == [k >= FIRST_BAD for k in range(FRAMES)]
    assert verdict["first_intersecting"].endswith(name), verdict["first_intersecting"]
    for state, distance in zip(verdict["states"][:FIRST_BAD], distances):
        found = state["smallest_distances"]["vertex_triangle"]["distance"]
        assert 0 <= distance - found <= 1e-15 * distance, (state["state"], found, distance)


def save_archives(folder, frames):
    for kind, save in (("stored", numpy.savez), ("deflated", numpy.savez_compressed)):
        for real, whole, (x, faces) in itertools.product("fd", "ilq", (("positions", "triangles"), ("x", "faces"))):
            file = folder / f"{kind}_{real}_{whole}_{x}.npz"
            stored = frames.astype(real)
            save(file, **{faces: TRIANGLES.astype(whole), x: stored, "note": numpy.array(["other arrays are let be"])})
            yield file, stored[:, 3, 2].astype(float)
    big_endian = folder / "big_endian.npz"
    numpy.savez(big_endian, positions=frames.astype(">f4"), triangles=TRIANGLES.astype(">i4"))
    yield big_endian, frames.astype("f")[:, 3, 2].astype(float)


def save_point_cache(file, frames):
    samples = frames.astype("<f4")
    file.write_bytes(struct.pack("<12siiffi", b"POINTCACHE2\0", 1, samples.shape[1], 0.0, 1.0,
                                 len(samples)) + samples.tobytes())


def poly_data(points):
    data, corners, cells = vtkPolyData(), vtkPoints(), vtkCellArray()
    corners.SetData(numpy_to_vtk(points, deep=True))
    cells.SetData(numpy_to_vtkIdTypeArray(numpy.array([0, 3, 6]), deep=True),
                  numpy_to_vtkIdTypeArray(TRIANGLES.ravel(), deep=True))
    data.SetPoints(corners)
    data.SetPolys(cells)
    return data


def save_vtp(file, points, mode, compressor, header, encode, order):
    writer = vtkXMLPolyDataWriter()
    writer.SetFileName(str(file))
    writer.SetInputData(poly_data(points))
    writer.SetDataMode({"ascii": writer.Ascii, "binary": writer.Binary, "appended": writer.Appended}[mode])
    if compressor:
        writer.SetCompressorTypeToZLib()
        writer.SetBlockSize(64)  # several blocks, the last one shorter
    else:
        writer.SetCompressorTypeToNone()
    writer.SetHeaderType(header)
    writer.SetEncodeAppendedData(encode)
    writer.SetByteOrder(order)
    assert writer.Write() == 1


def check_arrays(folder):
    frames = positions()
    for file, distances in save_archives(folder, frames):
        check(audit(file, status=1), "frame 10", distances)
    numpy.savez(folder / "clean.npz", positions=frames[:FIRST_BAD], triangles=TRIANGLES)
    assert audit(folder / "clean.npz", status=0)["clean"] is True
    numpy.savez(folder / "one.npz", points=frames[0], faces=TRIANGLES.astype("B"))
    assert len(audit(folder / "one.npz", status=0)["states"]) == 1
    mesh = folder / "mesh.obj"
    mesh.write_text("".join(f"v {x} {y} {z}\n" for x, y, z in frames[0]) + "f 1 2 3\nf 4 5 6\n")
    numpy.save(folder / "alone.npy", frames)
    check(audit(folder / "alone.npy", "--mesh", mesh, status=1), "frame 10", frames[:, 3, 2])
    save_point_cache(folder / "cache.pc2", frames)
    check(audit(folder / "cache.pc2", "--mesh", mesh, status=1), "frame 10", frames.astype("f")[:, 3, 2].astype(float))
    for file in ("alone.npy", "cache.pc2"):
        assert "--mesh" in audit(folder / file, status=2)


def check_layouts(folder):
    """Checks Fortran order, short names, SMPL's names, one array for each frame, and faces in an array: all have the
    same verdict."""
    frames, fortran = positions(), numpy.asfortranarray
    faces, distances = fortran(TRIANGLES), frames[:, 3, 2]
    mesh = folder / "mesh.obj"
    numpy.save(folder / "fortran.npy", fortran(frames))
    numpy.save(folder / "f.npy", faces)
    for ties in (mesh, folder / "f.npy"):
        check(audit(folder / "fortran.npy", "--mesh", ties, status=1), "frame 10", distances)
    check(audit(folder / "fortran.npy", folder / "f.npy", status=1), "frame 10", distances)
    for save in (numpy.savez, numpy.savez_compressed):
        for arrays in ({"vertices": fortran(frames), "faces": faces}, {"V": frames, "F": faces},
                       {"v": fortran(frames), "f": TRIANGLES.astype("uint32"), "betas": numpy.ones(10)}):
            save(folder / "layout.npz", **arrays)
            check(audit(folder / "layout.npz", status=1), "frame 10", distances)
        save(folder / "each.npz", *frames, faces=faces)
        check(audit(folder / "each.npz", status=1), "arr_10.npy", distances)
        save(folder / "two.npz", fortran(frames), faces)
        check(audit(folder / "two.npz", status=1), "frame 10", distances)
    numpy.savez(folder / "smpl.npz", v_template=fortran(frames[0]), f=TRIANGLES.astype("uint32"),
                shapedirs=numpy.zeros((6, 3, 10)))
    assert audit(folder / "smpl.npz", status=0)["clean"] is True
    here = folder / "one_each"
    here.mkdir()
    for k, frame in enumerate(frames):
        numpy.save(here / f"frame_{k}.npy", fortran(frame))
    check(audit(here, "--mesh", mesh, status=1), "frame_10.npy", distances)
    check(audit(*here.glob("*.npy"), folder / "f.npy", status=1), "frame_10.npy", distances)


def printed(folder, name, digits, gap):
    """Returns what an audit prints about two slanted sheets, `gap` apart, whose coordinates are printed in this
    format."""
    count = 6
    corner = numpy.arange(count * count).reshape(count, count)
    a, b, c, d = (part.ravel() + 1 for part in (corner[:-1, :-1], corner[:-1, 1:], corner[1:, 1:], corner[1:, :-1]))
    faces = numpy.concatenate([numpy.stack([a, b, c], axis=1), numpy.stack([a, c, d], axis=1)])
    x, y = (part.ravel() for part in numpy.meshgrid(numpy.linspace(0, 1, count), numpy.linspace(0, 1, count)))
    e, f = numpy.array([0.48, 0.6, 0.64]), numpy.array([-0.8, 0.6, 0.0])
    lower = x[:, None] * e + y[:, None] * f + [1 / 3, 1 / 7, 1 / 9]
    upper = lower * 0.93 + gap * numpy.cross(e, f) + 0.07 * lower.mean(axis=0)
    vertices = "".join("v " + " ".join(digits % value for value in p) + "\n" for p in numpy.vstack([lower, upper]))
    file = folder / name
    both = numpy.vstack([faces, faces + count * count])
    file.write_text(vertices + "".join(f"f {p} {q} {r}\n" for p, q, r in both))
    verdict = json.loads(subprocess.run([PROGRAM, "audit", file, "--json"], capture_output=True, text=True).stdout)
    return verdict["states"][0], verdict.get("in_doubt", ""), verdict["intersections"]


def check_digits(folder):
    """Checks that a file whose last digit exceeds its smallest distance causes a warning, and a file with 17 digits
    does not."""
    state, words, found = printed(folder, "all.obj", "%.17g", 1e-12)
    assert found == 0 and "printed" not in state and not words
    state, words, found = printed(folder, "nine.obj", "%.9g", 1e-12)
    assert found > 5 and state["printed"]["digits"] == 9 and state["printed"]["unit"] == 1e-8, state["printed"]
    assert state["printed"]["doubtful_intersections"] == found and "17 digits" in words, words
    state, words, found = printed(folder, "six.obj", "%.6f", 1e-6)
    assert state["printed"]["decimals"] == 6 and state["printed"]["unit"] == 1e-6, state
    state, words, found = printed(folder, "enough.obj", "%.9g", 1e-4)
    assert found == 0 and "printed" not in state and not words
    state, words, found = printed(folder, "pierced.obj", "%.9g", -0.0)
    assert found > 0 and state["printed"]["doubtful_intersections"] > 0
    # An intersection deeper than the rounding is not doubtful.
    (folder / "deep.obj").write_text("".join(f"v {x:.9f} {y:.9f} {z:.9f}\n" for x, y, z in positions()[11] / 1.1) +
                                     "f 1 2 3\nf 4 5 6\n")
    verdict = audit(folder / "deep.obj", status=1)
    assert "printed" not in verdict["states"][0] and "in_doubt" not in verdict


def check_vtp(folder):
    frames = positions()
    for number, options in enumerate(itertools.product(("ascii", "binary", "appended"), (False, True), (32, 64), (0, 1),
                                                       (0, 1))):
        here = folder / f"vtp_{number}"
        here.mkdir()
        for k, points in enumerate(frames if number == 0 else frames[[0, FRAMES - 1]]):
            save_vtp(here / f"frame_{k}.vtp", points, *options)
        verdict = audit(here, status=1)
        if number == 0:
            check(verdict, "frame_10.vtp", frames[:, 3, 2])
        assert [state["count"] > 0 for state in verdict["states"]][-1], options
        assert verdict["states"][0]["smallest_distances"]["vertex_triangle"]["distance"] == frames[0, 3, 2], options


def two_tetrahedra(points):
    """Returns a VTK grid of two tetrahedra: the first four and the last four of eight points."""
    data, corners = vtkUnstructuredGrid(), vtkPoints()
    corners.SetData(numpy_to_vtk(points, deep=True))
    data.SetPoints(corners)
    for first in (0, 4):
        data.InsertNextCell(VTK_TETRA, 4, list(range(first, first + 4)))
    return data


def check_vtk(folder):
    """Checks the older format in text and bytes, with cells as versions before 5 and from 5 on write them, and grids in
    XML."""
    frames = positions()
    corner = numpy.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], dtype=float)
    solids = numpy.vstack([corner, corner + [0, 0, 2]])

    def save(writer, data, name):
        writer.SetFileName(str(folder / name))
        writer.SetInputData(data)
        assert writer.Write() == 1
        return folder / name

    for version, binary in itertools.product((42, 51), (False, True)):
        for bad, points in ((False, frames[0]), (True, frames[-1])):
            writer = vtkPolyDataWriter()
            writer.SetFileVersion(version)
            (writer.SetFileTypeToBinary if binary else writer.SetFileTypeToASCII)()
            verdict = audit(save(writer, poly_data(points), "surface.vtk"), status=int(bad))
            if not bad:
                found = verdict["states"][0]["smallest_distances"]["vertex_triangle"]["distance"]
                assert abs(found - frames[0, 3, 2]) < 1e-9, found  # VTK writes text with about ten digits
        writer = vtkUnstructuredGridWriter()
        writer.SetFileVersion(version)
        (writer.SetFileTypeToBinary if binary else writer.SetFileTypeToASCII)()
        solid = save(writer, two_tetrahedra(solids), "solid.vtk")
        found = audit(solid, status=0)["states"][0]["smallest_distances"]["vertex_triangle"]["distance"]
        assert abs(found - 3 ** -0.5) < 1e-15, found
        audit(save(writer, two_tetrahedra(solids - numpy.repeat([[0, 0, 0], [0, 0, 1.5]], 4, axis=0)), "solid.vtk"),
              status=1)
    for mode in ("Ascii", "Binary", "Appended"):
        writer = vtkXMLUnstructuredGridWriter()
        getattr(writer, f"SetDataModeTo{mode}")()
        audit(save(writer, two_tetrahedra(solids), "solid.vtu"), status=0)


def check_interrupted(folder):
    """Checks that an interrupt ends the audit long before the last frame, with a report of what was found before."""
    count, side = 400, 80
    x, y = numpy.meshgrid(numpy.arange(side) * 0.01, numpy.arange(side) * 0.01)
    sheet = numpy.stack([x.ravel(), y.ravel(), 0.01 * numpy.sin(9 * x.ravel())], axis=1)
    corner = numpy.arange(side * side).reshape(side, side)
    a, b, c, d = (part.ravel() for part in (corner[:-1, :-1], corner[:-1, 1:], corner[1:, 1:], corner[1:, :-1]))
    faces = numpy.concatenate([numpy.stack([a, b, c], axis=1), numpy.stack([a, c, d], axis=1)])
    numpy.savez(folder / "long.npz", x=numpy.repeat(sheet[None].astype("f"), count, axis=0), faces=faces)
    process = subprocess.Popen([PROGRAM, "audit", str(folder / "long.npz"), "--json"], stdout=subprocess.PIPE,
                               stderr=subprocess.PIPE, text=True)
    process.stderr.readline()  # the first frames are done
    process.send_signal(signal.SIGINT)
    said = json.loads(process.communicate()[0])
    assert process.returncode == 130 and not said["complete"], process.returncode
    assert 0 < len(said["states"]) < count, len(said["states"])


def check_refused(folder):
    """Checks that damage is named by file, frame and byte, and that everything read before it is reported."""
    frames = positions()
    numpy.savez(folder / "names.npz", cloth=frames, triangles=TRIANGLES)
    message = audit(folder / "names.npz", status=2)
    assert "positions" in message and "cloth" in message
    numpy.savez(folder / "outside.npz", x=frames, faces=TRIANGLES + 1)
    assert "vertex 6 does not exist" in audit(folder / "outside.npz", status=2)
    numpy.savez(folder / "body.npz", poses=frames[0], trans=frames[0], faces=TRIANGLES)
    assert "let it compute the vertices" in audit(folder / "body.npz", status=2)
    numpy.savez(folder / "objects.npz", x=numpy.array([{}], dtype=object), faces=TRIANGLES)
    assert "float32" in audit(folder / "objects.npz", status=2)
    frames[7, 4, 1] = numpy.nan
    numpy.savez(folder / "nan.npz", x=frames, faces=TRIANGLES)
    verdict = audit(folder / "nan.npz", status=2)
    assert len(verdict["states"]) == 7 and "frame 7: vertex 4" in verdict["stopped"] and not verdict["complete"]
    bytes_of = (folder / "stored_f_i_x.npz").read_bytes()
    spoiled = bytearray(bytes_of)
    place = bytes_of.index(b"NUMPY", bytes_of.index(b"x.npy")) + 200
    spoiled[place] ^= 1
    (folder / "spoiled.npz").write_bytes(spoiled)
    assert "checksum" in json.dumps(audit(folder / "spoiled.npz", status=1))
    mesh, cache = folder / "mesh.obj", (folder / "cache.pc2").read_bytes()
    (folder / "cut.pc2").write_bytes(cache[:-40])
    verdict = audit(folder / "cut.pc2", "--mesh", mesh, status=1)
    assert len(verdict["states"]) == FRAMES - 1 and "frame 11: the file ends at byte" in verdict["stopped"]


def check_drawn(folder):
    """Checks that the intersections of one frame are drawn from the file of `--show`: two pictures side by side, each
    of several colours."""
    from plots import offenders, render
    if not render.available()[0]:
        return
    x = positions()[FIRST_BAD].tolist()
    mesh = folder / "drawn.obj"
    mesh.write_text("".join("v {} {} {}\n".format(*point) for point in x) + "f 1 2 3\nf 4 5 6\n")
    audit(mesh, "--show", folder / "show", status=1)
    offenders.draw(folder / "show/drawn.vtp", mesh, folder / "drawn.png")
    import pyvista
    picture = pyvista.read(folder / "drawn.png")
    assert picture.dimensions[:2] == (1280, 480), picture.dimensions
    halves = numpy.asarray(picture.point_data["PNGImage"]).reshape(480, 1280, -1)
    assert halves[:, :640].std() > 0 and halves[:, 640:].std() > 0


with tempfile.TemporaryDirectory() as scratch:
    check_arrays(Path(scratch))
    check_layouts(Path(scratch))
    check_digits(Path(scratch))
    check_vtp(Path(scratch))
    check_vtk(Path(scratch))
    check_drawn(Path(scratch))
    check_interrupted(Path(scratch))
    check_refused(Path(scratch))
