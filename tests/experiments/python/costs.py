"""What a call from Python costs beyond the same call from C++: at most 50 µs of a search for contacts, 20 µs of a step
of a guard or of a simulation.

Usage: costs.py BUILD_DIR COSTS BACKEND [JSON], COSTS: the program of costs.cpp. Writes the times into JSON. Exit status
77: skipped, the backend is not there.
"""

import json
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

from package import main, prepare, two_layers

_, (COSTS, BACKEND, *JSON) = prepare(__doc__)
import numpy as np  # noqa: E402

import ogc_testbed as ogc  # noqa: E402

if not ogc.backend_info(BACKEND)["usable"]:
    print(f"SKIPPED: {ogc.backend_info(BACKEND)['description']}")
    sys.exit(77)
try:
    import torch
except ImportError:
    torch = None
RADIUS, QUERY = 5e-3, 1e-2
LIMITS = {"find": 50, "step": 20, "advance": 20}  # [µs]
ROUNDS, CALLS = 20, 40  # the two languages take turns, so that both meet the machine's quiet moments


def shortest(call):
    """Returns the shortest time of the calls of a round [µs]."""
    least = float("inf")
    for _ in range(CALLS):
        begun = time.perf_counter_ns()
        call()
        least = min(least, time.perf_counter_ns() - begun)
    return least / 1000


class Costs(unittest.TestCase):
    def setUp(self):
        self.x, self.faces = two_layers(3, 4e-3)  # so few that one thread does all

    def calls(self):
        """Yields what is called, where its arrays lie, and the call from Python."""
        mesh, x, rest = ogc.Mesh(self.faces), self.x.copy(), np.zeros_like(self.x)
        finder = ogc.ContactFinder(mesh, backend=BACKEND)
        guard = ogc.Guard(mesh, x, QUERY, backend=BACKEND)
        yield "find", "host", lambda: finder.find(x, RADIUS, QUERY)
        yield "step", "host", lambda: guard.step(x, rest, out=x)
        if BACKEND == "cuda" and torch and torch.cuda.is_available():
            there, rest_there = torch.from_numpy(x).cuda(), torch.from_numpy(rest).cuda()
            yield "find", "device", lambda: finder.find(there, RADIUS, QUERY)
            yield "step", "device", lambda: guard.step(there, rest_there, out=there)
        scene = ogc.Scene(dt=1 / 300, iterations=1, radius=1e-4, gravity=(0, 0, 0))
        scene.add_cloth(x, self.faces)
        sim = scene.start(backend=BACKEND)
        yield "advance", "host", lambda: sim.advance(1)

    def test_of_calls_from_python(self):
        found = []
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "mesh"
            counts = np.array([len(self.x), len(self.faces)], dtype=np.int32)
            path.write_bytes(counts.tobytes() + self.x.tobytes() + self.faces.tobytes())
            with subprocess.Popen([COSTS, BACKEND, path], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                  text=True) as program:
                for what, place, call in self.calls():
                    ours, theirs = [], []
                    for _ in range(ROUNDS):
                        print(what, place, CALLS, file=program.stdin, flush=True)
                        theirs.append(float(program.stdout.readline()))
                        ours.append(shortest(call))
                    found.append({"call": what, "arrays": place, "python_us": min(ours), "cpp_us": min(theirs),
                                  "cost_us": min(ours) - min(theirs), "limit_us": LIMITS[what]})
                program.stdin.close()
        for row in found:
            print(row)
        if JSON:
            Path(JSON[0]).write_text(json.dumps({"backend": BACKEND, "rows": found}, indent=1) + "\n", encoding="utf-8")
        self.assertGreaterEqual({row["call"] for row in found}, set(LIMITS))
        for row in found:
            self.assertLessEqual(row["cost_us"], row["limit_us"], row)


if __name__ == "__main__":
    main()
