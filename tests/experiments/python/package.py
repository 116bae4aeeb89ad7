"""Finds the package in a build folder, for the tests beside this file."""

import os
import sys
import threading
import time
import unittest
from pathlib import Path


def prepare(usage):
    """Puts the package of the build folder, the first argument, on the path and returns (build folder, further
    arguments). Exit status 77 if a package that it needs is missing."""
    if len(sys.argv) < 2:
        sys.exit(usage)
    build = Path(sys.argv[1]).resolve()
    rest = [argument for argument in sys.argv[2:] if not argument.startswith("-")]
    sys.argv[1:] = [argument for argument in sys.argv[2:] if argument.startswith("-")]
    folder = str(build / "python")
    sys.path.insert(0, folder)
    os.environ["PYTHONPATH"] = folder  # for the processes that tests start
    try:
        import nanobind_backend  # noqa: F401
        import numpy  # noqa: F401
    except ImportError as missing:
        print(f"SKIPPED: {missing}")
        sys.exit(77)
    return build, rest


def grid(side, length=1.0, height=0.0):
    """Returns positions and triangles of a square of side² vertices in the plane y = height."""
    import numpy as np

    line = np.linspace(0, length, side, dtype=np.float32)
    x = np.array([[a, height, b] for a in line for b in line], dtype=np.float32)
    i = np.arange(side * side, dtype=np.int32).reshape(side, side)
    a, b, c, d = i[:-1, :-1].ravel(), i[:-1, 1:].ravel(), i[1:, :-1].ravel(), i[1:, 1:].ravel()
    return x, np.concatenate([np.stack([a, b, c], axis=1), np.stack([d, c, b], axis=1)])


def two_layers(side, gap, seed=1):
    """Returns positions and triangles of two rough squares above each other."""
    import numpy as np

    random = np.random.default_rng(seed)
    lower, faces = grid(side)
    upper = lower + np.float32([0.31, 0, 0.17]) / side + np.float32([0, gap, 0])
    x = np.concatenate([lower, upper])
    x[:, 1] += random.uniform(0, gap / 4, len(x)).astype(np.float32)
    return x.astype(np.float32), np.concatenate([faces, faces + np.int32(len(lower))])


def counts_during(call, attempts=100):
    """Returns how often another Python thread came round during a call: never if the call keeps the interpreter's lock,
    because here a thread takes the lock only when another one gives it away. The other thread gives it away in each
    round. A busy machine may have no time for it during a call, so there are several attempts."""
    done, rounds = threading.Event(), []

    def count():
        while not done.is_set():
            rounds.append(time.perf_counter())
            time.sleep(0)

    thread, interval, found = threading.Thread(target=count), sys.getswitchinterval(), 0
    sys.setswitchinterval(1000)  # [s]; no thread asks for the lock before
    thread.start()
    try:
        while found == 0 and attempts > 0:
            attempts -= 1
            begin = time.perf_counter()
            call()
            end = time.perf_counter()
            found = sum(begin < moment < end for moment in rounds)
            rounds.clear()
    finally:
        done.set()
        thread.join()
        sys.setswitchinterval(interval)
    return found


main = unittest.main
