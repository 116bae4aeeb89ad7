"""USD files of motions, and arrays of USD files. Needs usd-core, which is optional.

Usage: python -m plots.usd RUN|SHEET --out FILE.usdc [--yes]     (ogc export RUN --format usd)
       python -m plots.usd FILE.usd --out FRAMES.npz [--yes]     (ogc audit FILE.usd)
"""

import argparse
import sys
from pathlib import Path

from plots.packages import Missing, begin, need

begin("ogc")
import numpy as np  # noqa: E402

from ogc_testbed.motion import rgb  # noqa: E402
from ogc_testbed.runs import RunError  # noqa: E402
from plots.progress import Progress  # noqa: E402
from plots.sheets import motion_at  # noqa: E402

SUFFIXES = (".usd", ".usda", ".usdc", ".usdz")


def write(motion, out, progress):
    """Writes the motion: metres, y up, a Mesh or BasisCurves for each body with a sample of points for each frame, and
    with speed and bound of its vertices if the motion has them. A second has as many time codes as frames."""
    from pxr import Gf, Sdf, Tf, Usd, UsdGeom, Vt
    stage = Usd.Stage.CreateNew(str(out))
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.y)
    UsdGeom.SetStageMetersPerUnit(stage, 1)
    gaps = np.diff(motion.times)
    rate = 1 / float(np.median(gaps)) if len(gaps) and np.median(gaps) > 0 else 24.0
    codes = [round(float(t) * rate, 6) for t in motion.times]
    stage.SetTimeCodesPerSecond(rate)
    stage.SetFramesPerSecond(rate)
    stage.SetStartTimeCode(codes[0])
    stage.SetEndTimeCode(codes[-1])
    root = UsdGeom.Xform.Define(stage, "/" + Tf.MakeValidIdentifier(motion.name))
    stage.SetDefaultPrim(root.GetPrim())
    origin = motion.run.manifest.get("origin", {}).get("value", [0, 0, 0]) if motion.run else [0, 0, 0]
    if any(origin):
        root.AddTranslateOp().Set(Gf.Vec3d(*origin))
    corners, parts = motion.body[motion.triangles[:, 0]], []
    at_edge = motion.body[motion.edges[:, 0]] if len(motion.edges) else np.empty(0, int)
    for b, (front, _) in enumerate(motion.colours()):
        vertices = np.flatnonzero(motion.body == b)
        path = root.GetPath().AppendChild(Tf.MakeValidIdentifier(f"{motion.bodies[b]}_{b}"))
        if (corners == b).any():
            geometry, points = UsdGeom.Mesh.Define(stage, path), vertices
            faces = motion.triangles[corners == b] - vertices[0]
            geometry.CreateFaceVertexCountsAttr(Vt.IntArray.FromNumpy(np.full(len(faces), 3, np.int32)))
            geometry.CreateFaceVertexIndicesAttr(Vt.IntArray.FromNumpy(np.ascontiguousarray(faces.ravel(), np.int32)))
            geometry.CreateSubdivisionSchemeAttr(UsdGeom.Tokens.none)
            geometry.CreateDoubleSidedAttr(True)
            # A body with segments of its own and triangles has only its triangles here.
        elif (at_edge == b).any():
            geometry, points = UsdGeom.BasisCurves.Define(stage, path), motion.edges[at_edge == b].ravel()
            geometry.CreateTypeAttr(UsdGeom.Tokens.linear)
            geometry.CreateCurveVertexCountsAttr(Vt.IntArray.FromNumpy(np.full(len(points) // 2, 2, np.int32)))
            geometry.CreateWidthsAttr([motion.radius]).SetMetadata("interpolation", UsdGeom.Tokens.constant)
        else:
            continue
        geometry.CreateDisplayColorAttr([Gf.Vec3f(*(rgb(front) / 255).tolist())])
        primvars = UsdGeom.PrimvarsAPI(geometry)
        fields = {name: primvars.CreatePrimvar(name, Sdf.ValueTypeNames.FloatArray, UsdGeom.Tokens.vertex)
                  for name in ("speed", "bound") if name in motion.fields}
        parts.append((geometry.CreatePointsAttr(), geometry.CreateExtentAttr(), fields, points))
    for i, code in enumerate(codes):
        x = motion.at(i)
        for points, extent, fields, vertices in parts:
            own = np.ascontiguousarray(x[vertices], np.float32)
            points.Set(Vt.Vec3fArray.FromNumpy(own), code)
            extent.Set(Vt.Vec3fArray.FromNumpy(np.stack([own.min(axis=0), own.max(axis=0)])), code)
            for name, primvar in fields.items():
                values = np.nan_to_num(motion.fields[name].of(i)[vertices])  # 0 where there is no bound
                primvar.Set(Vt.FloatArray.FromNumpy(np.ascontiguousarray(values, np.float32)), code)
        progress(i + 1, len(codes))
    stage.GetRootLayer().Save()


def read(file):
    """Returns (positions float64 (F, V, 3) [m], triangles int32 (T, 3), remarks) of all visible meshes of a USD file,
    in the stage's order, at each of their time samples. Polygons are cut into fans. Throws RunError for a file without
    meshes, or whose meshes change their faces."""
    from pxr import Usd, UsdGeom
    try:
        stage = Usd.Stage.Open(str(file))
    except Exception as error:  # pxr.Tf.ErrorException, whose text has many lines
        raise RunError(f"{file}: USD can't open it: {str(error).strip().splitlines()[-1].strip()}") from None
    remarks = []
    scale = UsdGeom.GetStageMetersPerUnit(stage) if UsdGeom.StageHasAuthoredMetersPerUnit(stage) else 1.0
    if scale != 1:
        remarks.append(f"its unit is {scale:g} m: positions are converted to metres")
    found = [UsdGeom.Mesh(prim) for prim in stage.Traverse(Usd.TraverseInstanceProxies()) if prim.IsA(UsdGeom.Mesh)]
    meshes = [m for m in found if m.ComputeVisibility(Usd.TimeCode.EarliestTime()) != UsdGeom.Tokens.invisible]
    if not meshes:
        raise RunError(f"{file}: it has no visible mesh")
    if len(meshes) < len(found):
        remarks.append(f"{len(found) - len(meshes)} invisible meshes are left out")
    triangles, first = [], 0
    for mesh in meshes:
        counts_of, indices_of = mesh.GetFaceVertexCountsAttr(), mesh.GetFaceVertexIndicesAttr()
        if max(counts_of.GetNumTimeSamples(), indices_of.GetNumTimeSamples()) > 1:
            raise RunError(f"{file}: {mesh.GetPath()} changes its faces with time; export each state as a file of its "
                           "own")
        counts, indices = (np.array(a.Get(Usd.TimeCode.EarliestTime()) or [], int) for a in (counts_of, indices_of))
        if (counts > 3).any():
            remarks.append(f"{int((counts > 3).sum())} faces of {mesh.GetPath()} have more than three corners and are "
                           "cut into fans")
        starts = np.concatenate([[0], np.cumsum(counts)])[:-1]
        for k in range(1, max(counts.max(initial=0) - 1, 0)):
            at = starts[counts > k + 1]
            triangles.append(np.stack([indices[at], indices[at + k], indices[at + k + 1]], axis=1) + first)
        first += len(mesh.GetPointsAttr().Get(Usd.TimeCode.EarliestTime()) or [])
    times = sorted({time for mesh in meshes for time in _times_of(mesh)}) or [Usd.TimeCode.Default()]
    positions = np.empty((len(times), first, 3))
    for i, time in enumerate(times):
        cache = UsdGeom.XformCache(time)
        parts = []
        for mesh in meshes:
            x = np.array(mesh.GetPointsAttr().Get(time) or np.empty((0, 3)), float).reshape(-1, 3)
            matrix = np.array(cache.GetLocalToWorldTransform(mesh.GetPrim()))
            parts.append(x if (matrix == np.eye(4)).all() else x @ matrix[:3, :3] + matrix[3, :3])
        if sum(map(len, parts)) != first:
            raise RunError(f"{file}: the meshes have another number of vertices at time {time}")
        positions[i] = np.concatenate(parts) * scale
    return positions, np.concatenate([np.empty((0, 3), int), *triangles]).astype(np.int32), remarks


def _times_of(mesh):
    """Returns the times at which the mesh's points or a transformation above it have samples."""
    from pxr import UsdGeom
    times, prim = set(mesh.GetPointsAttr().GetTimeSamples()), mesh.GetPrim()
    while prim and not prim.IsPseudoRoot():
        times |= set(UsdGeom.Xformable(prim).GetTimeSamples() if prim.IsA(UsdGeom.Xformable) else [])
        prim = prim.GetParent()
    return times


def main():
    parser = argparse.ArgumentParser(prog="plots.usd", description=__doc__.splitlines()[0])
    parser.add_argument("source", type=Path, help="a run folder, or a USD file")
    parser.add_argument("--out", type=Path, required=True, help="the USD file, or the .npz, to write")
    parser.add_argument("--yes", action="store_true", help="usd-core is installed without a question")
    options = parser.parse_args()
    try:
        need(["pxr"], options.yes)
        if options.source.suffix.lower() in SUFFIXES:
            positions, triangles, remarks = read(options.source)
            for remark in remarks:
                print(f"ogc: {options.source}: {remark}", file=sys.stderr)
            np.savez(options.out, positions=positions, triangles=triangles)
        else:
            if options.out.suffix.lower() not in SUFFIXES[:3]:
                raise RunError(f"{options.out}: USD is written as .usdc (small), .usda (text) or .usd")
            motion, progress = motion_at(options.source), Progress("frame")
            options.out.parent.mkdir(parents=True, exist_ok=True)
            options.out.unlink(missing_ok=True)  # USD refuses to begin a layer that is there
            write(motion, options.out, progress)
            progress.end()
    except (RunError, Missing, OSError) as problem:
        print(f"ogc: {problem}", file=sys.stderr)
        sys.exit(2)


if __name__ == "__main__":
    main()
