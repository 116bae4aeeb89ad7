"""Reads trajectory.vtkhdf of a run back with VTK's own reader and compares it, bit for bit, with the frames it was
assembled from.

    python3 read_trajectory.py RUN_FOLDER

Exit status: 0 equal, 1 different, 77 skipped, because VTK (9.4 or newer) or h5py can't be imported.
"""

import argparse
import json
import sys
from pathlib import Path

try:
    import h5py
    import numpy as np
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkCommonCore import vtkVersion
    from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline
    from vtkmodules.vtkIOHDF import vtkHDFReader
    from vtkmodules.vtkIOPLY import vtkPLYReader
except ImportError as error:
    print(f"SKIP: {error}")
    sys.exit(77)
if (vtkVersion.GetVTKMajorVersion(), vtkVersion.GetVTKMinorVersion()) < (9, 4):
    print(f"SKIP: VTK {vtkVersion.GetVTKVersion()} can't read temporal PolyData; 9.4 can")
    sys.exit(77)

failures = []


def expect(what, found, expected):
    """Records a failure unless shape and bits are equal; not-a-number equals itself."""
    found, expected = np.asarray(found), np.asarray(expected)
    if found.shape != expected.shape or not np.array_equal(found, expected, equal_nan=found.dtype.kind == "f"):
        failures.append(f"{what}: found {found.ravel()[:6]} … {found.shape}, expected {expected.ravel()[:6]} … "
                        f"{expected.shape}")


def cells(array):
    return vtk_to_numpy(array.GetConnectivityArray()), vtk_to_numpy(array.GetOffsetsArray())


def body_numbers(bodies):
    return np.concatenate([np.full(body["vertex_count"], number) for number, body in enumerate(bodies)])


def check_step(step, data, path, scene):
    with h5py.File(path) as frame:
        expect(f"{path.name}: points", vtk_to_numpy(data.GetPoints().GetData()), frame["positions"][:])
        for name, dataset in (("velocity", "velocities"), ("bound", "bounds")):
            expect(f"{path.name}: {name}", vtk_to_numpy(data.GetPointData().GetArray(name)), frame[dataset][:])
        expect(f"{path.name}: time", step, frame.attrs["time"])
    expect(f"{path.name}: body", vtk_to_numpy(data.GetPointData().GetArray("body")), body_numbers(scene["bodies"]))
    expect(f"{path.name}: cells", [data.GetNumberOfVerts(), data.GetNumberOfLines(), data.GetNumberOfPolys(),
                                   data.GetNumberOfStrips()],
           [0, scene["loose_edges"], scene["triangles"], 0])


def check_triangles(data, folder, scene):
    """Compares with the meshes of the stored scene, one for each body, which VTK's PLY reader reads."""
    bodies = json.loads((folder / scene["file"]).read_text())["bodies"]
    expected = []
    for place, body in zip(scene["bodies"], bodies):
        reader = vtkPLYReader()
        reader.SetFileName(str((folder / scene["file"]).parent / body["mesh"]))
        reader.Update()
        expected.append(cells(reader.GetOutput().GetPolys())[0] + place["first_vertex"])
    expect("triangles: connectivity", cells(data.GetPolys())[0], np.concatenate(expected))
    expect("triangles: offsets", cells(data.GetPolys())[1], 3 * np.arange(scene["triangles"] + 1))


def check(folder):
    scene = json.loads((folder / "run.json").read_text())["scene"]
    frames = sorted((folder / "frames").glob("frame_*.h5"))
    reader = vtkHDFReader()
    reader.SetFileName(str(folder / "trajectory.vtkhdf"))
    reader.UpdateInformation()
    steps = reader.GetOutputInformation(0).Get(vtkStreamingDemandDrivenPipeline.TIME_STEPS()) or ()
    expect("number of steps", len(steps), len(frames))
    order = list(range(len(steps)))
    for i in order + order[::-2]:  # forwards, then back in jumps: offsets must not depend on what was read before
        reader.UpdateTimeStep(steps[i])
        check_step(steps[i], reader.GetOutputAsDataSet(), frames[i], scene)
    if steps:
        check_triangles(reader.GetOutputAsDataSet(), folder, scene)
    print(f"{folder}: {len(steps)} steps, {scene['vertices']} points, {scene['triangles']} triangles, VTK "
          f"{vtkVersion.GetVTKVersion()}: "
          f"{'equal' if not failures else f'{len(failures)} differences'}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path)
    check(parser.parse_args().folder)
    for failure in failures[:20]:
        print(failure)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
