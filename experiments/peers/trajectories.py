"""Scenes in Newton Physics' cloth solver (SolverVBD) beside ours: the same mesh, materials, motions, steps, iterations.

    experiments/peers/run newton trajectories cloth_on_sphere twist --scale small --out FILE
    python3 experiments/peers/trajectories.py twist --scale paper --device cuda --variant default exact --time-limit 200

`ogc scenes --write` gives the scene; states of both are audited by `ogc audit --between`: each stored state, and the
straight motion from it to the next. One row a run. OGC_PROGRAM names the program `ogc`, else build/default/ogc. Where
newton and warp lie in a folder instead of an environment, PYTHONPATH names it. README.md says what is converted.

The column prepare_s has the time until the first step of the run: that of the first run of a variant has the time to
compile kernels, which later runs find in a cache.

Variants of Newton: `default`; `exact` has no fast mathematics (enable_fast_math=False); `near` also keeps contacts and
truncation between primitives that lie two rings of triangles apart, which the default leaves out.
"""

import argparse
import csv
import importlib.metadata
import json
import os
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
VARIANTS = {
    "default": {},
    "exact": {"enable_fast_math": False},
    "near": {"particle_topological_contact_filter_threshold": 1},
}
BLOCK = 10  # steps between two rebuilds of Newton's trees, as in its example of a twisted cloth
COLUMNS = ["scene", "scale", "program", "version", "variant", "device", "vertices", "triangles", "iterations", "steps",
           "steps_done", "mean_ms", "worst_ms", "processor_ms", "prepare_s", "largest_demand_vertex",
           "largest_demand_edge", "room_vertex", "room_edge", "every", "states", "states_intersecting",
           "intersections_most", "first_intersecting_step", "motions", "motions_meeting", "meetings_most",
           "first_meeting_step", "largest_coordinate_m", "end"]


def program():
    return os.environ.get("OGC_PROGRAM") or str(HERE.parents[1] / "build/default/ogc")


def read_ply(path):
    """Returns vertices (n, 3) in double and triangles (m, 3) of a PLY as `ogc scenes --write` writes it."""
    data = Path(path).read_bytes()
    header, _, body = data.partition(b"end_header\n")
    words = [line.split() for line in header.decode().splitlines()]
    count = {w[1]: int(w[2]) for w in words if w[0] == "element"}
    kinds = [w[1:] for w in words if w[0] == "property"]
    if kinds != [["double", a] for a in "xyz"] + [["list", "uchar", "int", "vertex_indices"]]:
        raise SystemExit(f"{path}: this PLY has properties {kinds}; expected are those of ogc scenes --write")
    x = np.frombuffer(body, "<f8", 3 * count["vertex"]).reshape(-1, 3)
    faces = np.frombuffer(body, [("n", "u1"), ("v", "<i4", 3)], count["face"], offset=x.nbytes)
    return x, faces["v"]


def read_scene(folder, name):
    """Returns the scene file with the mesh of each body, its first vertex, and all triangles."""
    scene = json.loads((Path(folder) / f"{name}.json").read_text(encoding="utf-8"))
    start, triangles = 0, []
    for body in scene["bodies"]:
        body["x"], body["faces"] = read_ply(Path(folder) / body["mesh"])
        body["first"] = start
        triangles.append(body["faces"] + start)
        start += len(body["x"])
    scene["x"], scene["triangles"] = np.concatenate([b["x"] for b in scene["bodies"]]), np.concatenate(triangles)
    return scene


def turned(x, motion, time_):
    """Returns where a motion has points (n, 3) at this time: turned about its axis, then moved."""
    axis, centre = np.array(motion["axis"]), np.array(motion["centre"])
    t = min(max(time_ - motion["start"], 0), motion["end"] - motion["start"])
    angle, p = motion["angular_velocity"] * t, x - centre
    along = np.outer(p @ axis, axis)
    turned_ = along + np.cos(angle) * (p - along) + np.sin(angle) * np.cross(axis, p)
    return centre + turned_ + np.array(motion["velocity"]) * t


def handles(scene, steps):
    """Returns the prescribed vertices and their targets after each step, (steps, n, 3) in single precision."""
    first = {body["name"]: body["first"] for body in scene["bodies"]}
    chosen, targets = [], []
    h = scene["settings"]["time_step"]
    for motion in scene["motions"]:
        for part in motion["vertices"]:
            index = np.array(part["indices"]) + first[part["body"]]
            chosen.append(index)
            targets.append([turned(scene["x"][index], motion, (k + 1) * h) for k in range(steps)])
    if not chosen:
        return np.zeros(0, np.int32), np.zeros((steps, 0, 3), np.float32)
    return np.concatenate(chosen).astype(np.int32), np.concatenate(targets, axis=1).astype(np.float32)


def bending_of(x, edges, material):
    """Returns Newton's stiffness and damping of each of its edges (n, 4: two opposite vertices, two ends).

    Newton has k l (θ − θ₀)²/2 with the edge's rest length l, and damping by d l (θ − θᵗ)²/(2 h). Ours is
    c (θ − θ₀)²/2, c = 3 k_b l²/(A₀ + A₁), and k_d c (θ − θᵗ)²/(2 h). So k = c/l and d = k_d c/l."""
    inner = (edges[:, :2] >= 0).all(axis=1)
    o, a, b = x[edges[:, :2]], x[edges[:, 2]], x[edges[:, 3]]
    length = np.linalg.norm(b - a, axis=1)
    areas = [np.linalg.norm(np.cross(b - a, o[:, k] - a), axis=1) / 2 for k in range(2)]
    k = np.where(inner, 3 * material["bending_stiffness"] * length / (areas[0] + areas[1]), 0)
    return np.stack([k, material["bending_damping"] * k], axis=1).astype(np.float32)


def model_of(scene, device):
    """Returns the scene as a model of Newton. A fixed body is cloth of fixed particles, so that cloth meets its
    triangles as it does in our scene."""
    import newton
    import warp as wp

    builder = newton.ModelBuilder(gravity=tuple(scene["gravity"]))
    for body in scene["bodies"]:
        m = body["material"]
        # Damping, Newton: A d ‖C − Cᵗ‖²/(2 h), C = FᵀF = 2 G + I. Ours: A (k_d/h)(λ/2 tr(ΔG)² + μ ‖ΔG‖²). Both resist
        # shear alike with d = k_d μ/2; Newton has no term of the trace.
        builder.add_cloth_mesh(
            pos=wp.vec3(0.0), rot=wp.quat_identity(), scale=1.0, vel=wp.vec3(*body["velocity"]),
            vertices=[wp.vec3(*p) for p in body["x"]], indices=body["faces"].ravel().tolist(), density=m["density"],
            tri_ke=m["lame_mu"], tri_ka=m["lame_lambda"], tri_kd=m["membrane_damping"] * m["lame_mu"] / 2,
            edge_ke=0.0, edge_kd=0.0, particle_radius=scene["settings"]["contact_radius"])
    builder.color(include_bending=True)
    model = builder.finalize(device=device)
    if (model.particle_q.numpy() != scene["x"].astype(np.float32)).any():
        raise SystemExit("Newton starts elsewhere than the scene")
    model.soft_contact_ke = scene["bodies"][0]["material"]["contact_stiffness"]
    model.soft_contact_kd = 0.0
    model.soft_contact_mu = scene["bodies"][0]["material"]["friction"]
    edges = model.edge_indices.numpy()
    model.edge_bending_properties.assign(bending_of(scene["x"], edges, scene["bodies"][0]["material"]))
    flags = model.particle_flags.numpy()
    fixed = [np.arange(len(b["x"])) + b["first"] for b in scene["bodies"] if b["fixed"]]
    index, _ = handles(scene, 1)
    for still in [*fixed, index]:
        flags[still] &= ~int(newton.ParticleFlags.ACTIVE)
    model.particle_flags.assign(flags)
    return model


def kernels():
    """Returns two kernels: prescribe positions, and keep a state with the largest number of pairs of a primitive."""
    import warp as wp

    @wp.kernel
    def prescribe(index: wp.array[int], targets: wp.array2d[wp.vec3], step: wp.array[int], q: wp.array[wp.vec3],
                  q_next: wp.array[wp.vec3]):
        i = wp.tid()
        p = targets[step[0], i]
        q[index[i]] = p
        q_next[index[i]] = p

    @wp.kernel
    def keep(q: wp.array[wp.vec3], slot: int, ring: wp.array2d[wp.vec3], vertex_count: wp.array[int],
             edge_count: wp.array[int], most: wp.array[int], step: wp.array[int]):
        i = wp.tid()
        if i < q.shape[0]:
            ring[slot, i] = q[i]
            wp.atomic_max(most, 0, vertex_count[i])
        if i < edge_count.shape[0]:
            wp.atomic_max(most, 1, edge_count[i])
        if i == 0:
            step[0] = step[0] + 1

    return prescribe, keep


def copied(array):
    """Returns a copy of an array of Warp. On the processor its numpy() is a view, which later steps overwrite."""
    return array.numpy().copy()


def simulate(options):
    """Runs the scene in Newton and writes states (every `every` steps, the start first) and times."""
    began = time.perf_counter()
    import newton
    import warp as wp

    wp.config.quiet = True
    wp.init()
    scene = read_scene(options.folder, options.scene)
    settings = scene["settings"]
    steps = options.steps or settings["steps"]
    if steps % BLOCK:
        raise SystemExit(f"--steps {steps}: it must be a multiple of {BLOCK}")
    model = model_of(scene, options.device)
    r = settings["contact_radius"]
    solver = newton.solvers.SolverVBD(
        model, iterations=settings["iterations"], friction_epsilon=settings["friction_velocity"],
        particle_enable_self_contact=True, particle_self_contact_margin=r, particle_self_contact_gap=r,
        particle_vertex_contact_buffer_size=options.room, particle_edge_contact_buffer_size=2 * options.room,
        **VARIANTS[options.variant])
    info, device = solver.trimesh_collision_info, model.device
    prescribe, keep = kernels()
    chosen, targets = handles(scene, steps)
    index = wp.array(chosen, dtype=int, device=device)
    targets = wp.array(targets, dtype=wp.vec3, device=device) if len(chosen) else None
    ring = wp.zeros((BLOCK, model.particle_count), dtype=wp.vec3, device=device)
    most, step = wp.zeros(2, dtype=int, device=device), wp.zeros(1, dtype=int, device=device)
    control, h = model.control(), settings["time_step"]
    size = max(model.particle_count, model.edge_count)

    def block(states):
        solver.rebuild_bvh(states[0])
        for slot in range(BLOCK):
            now, then = states[slot % 2], states[1 - slot % 2]
            now.clear_forces()
            if targets is not None:
                wp.launch(prescribe, dim=len(chosen), device=device,
                          inputs=[index, targets, step, now.particle_q, then.particle_q])
            solver.step(now, then, control, None, h)
            wp.launch(keep, dim=size, device=device, inputs=[
                then.particle_q, slot, ring, info.vertex_colliding_triangles_count, info.edge_colliding_edges_count,
                most, step])

    block([model.state(), model.state()])  # compiles
    wp.synchronize_device(device)
    states = [model.state(), model.state()]
    for array in (most, step):
        array.zero_()
    graph = None
    if device.is_cuda:
        with wp.ScopedCapture(device=device) as capture:
            block(states)
        graph = capture.graph
    prepared = time.perf_counter() - began

    stored, walls, processors = [copied(states[0].particle_q)], [], 0.0
    end, began = "all steps", time.perf_counter()
    for first in range(0, steps, BLOCK):
        at, cpu = time.perf_counter(), time.process_time()
        if graph is not None:
            wp.capture_launch(graph)
        else:
            block(states)
        wp.synchronize_device(device)
        walls.append((time.perf_counter() - at) / BLOCK)
        processors += time.process_time() - cpu
        for slot in range(BLOCK):
            if (first + slot + 1) % options.every == 0:
                stored.append(copied(ring[slot]))
        if not np.isfinite(stored[-1]).all():
            end = "not a number"
            stored.pop()
            break
        if time.perf_counter() - began > options.time_limit:
            end = "time limit"
            break
    end = "all steps" if len(walls) * BLOCK == steps and end == "time limit" else end
    np.savez(options.states, positions=np.stack(stored), triangles=scene["triangles"].astype(np.int32))
    demand = most.numpy()
    print(json.dumps({
        "version": f"newton {importlib.metadata.version('newton')}, warp {importlib.metadata.version('warp-lang')}",
        "device": device.name, "steps_done": len(walls) * BLOCK, "mean_ms": 1e3 * float(np.mean(walls)),
        "worst_ms": 1e3 * float(np.max(walls)), "processor_ms": 1e3 * processors / (len(walls) * BLOCK),
        "prepare_s": prepared, "largest_demand_vertex": int(demand[0]), "largest_demand_edge": int(demand[1]),
        "room_vertex": options.room, "room_edge": 2 * options.room, "end": end,
    }))


def audited(path, every):
    """Audits states of a file or a run, and the straight motions between them, exactly."""
    done = subprocess.run([program(), "audit", str(path), "--between", "--json", "--limit", "0"], capture_output=True,
                          text=True, check=False)
    if done.returncode > 1:
        raise SystemExit(f"ogc audit {path}: {done.stderr.strip()}")
    report = json.loads(done.stdout)
    counts = [state["count"] for state in report["states"]]
    ways = [way["count"] for way in report["ways"]]

    def first(values, offset):
        return next((every * (k + offset) for k, value in enumerate(values) if value), "")

    return {"states": len(counts), "states_intersecting": sum(map(bool, counts)), "intersections_most": max(counts),
            "first_intersecting_step": first(counts, 0), "motions": len(ways), "motions_meeting": sum(map(bool, ways)),
            "meetings_most": max(ways, default=0), "first_meeting_step": first(ways, 1)}


def row_of_newton(options, scene, name, scale, variant, folder):
    states = Path(folder) / "states.npz"
    command = [sys.executable, __file__, "--simulate", folder, "--scale", scale, "--variant", variant, "--device",
               options.device, "--steps", options.steps, "--every", options.stride, "--time-limit", options.time_limit,
               "--room", options.room, "--states", states, name]
    environment = {**os.environ, "WARP_CACHE_PATH": options.cache}
    done = subprocess.run(list(map(str, command)), env=environment, capture_output=True, text=True, check=False)
    if done.returncode:
        return {"program": "newton", "variant": variant, "end": (done.stderr.strip().splitlines() or ["?"])[-1]}
    found = json.loads(done.stdout.strip().splitlines()[-1])
    positions = np.load(states)["positions"]
    return {"program": "newton", "variant": variant, **found, "largest_coordinate_m": np.abs(positions).max(),
            **audited(states, options.stride)}


def row_of_ours(options, scene, name, scale, bounds, folder):
    run = Path(folder) / "run"
    backend = "cuda" if options.device == "cuda" else "cpu"
    command = [program(), "run", name, "--scale", scale, "--backend", backend, "--audit", "off", "--json", "--out", run,
               "--set", f"bounds={bounds}", "--set", f"frame_steps={options.stride}"]
    command += ["--steps", options.steps] if options.steps else []
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    try:
        done = subprocess.run(list(map(str, command)), capture_output=True, text=True, timeout=options.time_limit,
                              check=False)
    except subprocess.TimeoutExpired:
        return {"program": "ogc", "variant": bounds, "end": "time limit"}
    if done.returncode:
        return {"program": "ogc", "variant": bounds, "end": done.stderr.strip().splitlines()[-1]}
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    spent = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime  # with the start and all writing
    manifest = json.loads((run / "run.json").read_text(encoding="utf-8"))
    with open(run / "steps.csv", encoding="utf-8") as file:
        walls = np.array([float(row["wall [ms]"]) for row in csv.DictReader(file)])
    means = walls[: len(walls) // BLOCK * BLOCK].reshape(-1, BLOCK).mean(axis=1)
    return {"program": "ogc", "variant": bounds, "version": f"ogc {manifest['commit']}", "device": manifest["device"],
            "steps_done": len(walls), "mean_ms": walls.mean(), "worst_ms": means.max(),
            "processor_ms": 1e3 * spent / len(walls), "prepare_s": manifest["start_seconds"], "end": "all steps",
            **audited(run, options.stride)}


def rows(options):
    for name in options.scenes:
        for scale in options.scale:
            with tempfile.TemporaryDirectory(prefix="ogc-peers-") as folder:
                subprocess.run([program(), "scenes", name, "--scale", scale, "--write", folder], check=True,
                               stdout=subprocess.DEVNULL)
                scene = read_scene(folder, name)
                steps = options.steps or scene["settings"]["steps"]
                options.stride = options.every or (1 if steps <= 2400 else 10)
                asked = [(row_of_ours, bounds) for bounds in options.bounds]
                asked += [(row_of_newton, variant) for variant in options.variant]
                for make, which in asked:
                    with tempfile.TemporaryDirectory(prefix="ogc-peers-") as own:
                        for file in Path(folder).iterdir():
                            (Path(own) / file.name).write_bytes(file.read_bytes())
                        row = make(options, scene, name, scale, which, own)
                    base = {"scene": name, "scale": scale, "vertices": len(scene["x"]), "every": options.stride,
                            "triangles": len(scene["triangles"]), "iterations": scene["settings"]["iterations"],
                            "steps": steps}
                    yield {key: f"{v:.4g}" if isinstance(v, float) else v for key, v in {**base, **row}.items()}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("scenes", nargs="+", help="cloth_on_sphere, twist, or another built-in scene of cloth alone")
    parser.add_argument("--scale", nargs="+", default=["small"], choices=["smoke", "small", "paper"])
    parser.add_argument("--device", default="cpu", choices=["cpu", "cuda"])
    parser.add_argument("--variant", nargs="*", default=["default", "near"], choices=sorted(VARIANTS))
    parser.add_argument("--bounds", nargs="*", default=["ball", "planes"], help="runs of ours")
    parser.add_argument("--steps", type=int, default=0, help="in place of the scene's; a multiple of 10")
    parser.add_argument("--every", type=int, default=0, help="states are stored and audited after so many steps "
                        "(default: each, but 10 of runs of more than 2,400 steps)")
    parser.add_argument("--time-limit", type=float, default=3600, help="[s] of a run; what it has then is audited")
    parser.add_argument("--room", type=int, default=256, help="pairs that Newton keeps of a vertex; twice as many of "
                        "an edge; pairs beyond are dropped")
    parser.add_argument("--cache", help="compiled kernels stay in this folder (default: one that is removed)")
    parser.add_argument("--out", help="the table goes into this file, too")
    parser.add_argument("--simulate", dest="folder", help=argparse.SUPPRESS)
    parser.add_argument("--states", help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.folder:
        options.scene, options.variant = options.scenes[0], options.variant[0]
        return simulate(options)
    tables = [sys.stdout] + ([open(options.out, "w", newline="", encoding="utf-8")] if options.out else [])
    writers = [csv.DictWriter(table, COLUMNS, lineterminator="\n", restval="") for table in tables]
    for writer in writers:
        writer.writeheader()
    with tempfile.TemporaryDirectory(prefix="ogc-warp-") as cache:  # empty, so the first run of a variant compiles
        options.cache = options.cache or cache
        for row in rows(options):
            for writer, table in zip(writers, tables):
                writer.writerow(row)
                table.flush()


if __name__ == "__main__":
    main()
