"""Samples the memory that runs use on a device from outside, because the driver's own share (context, code of the
kernels) counts, too."""

import json
import os
import subprocess
import threading

from paper_figures.workflow.jobs import PLACE


class DeviceMemory:
    """Samples the memory in use on the place's device, or that CUDA counts first [MiB], once a second while its block
    runs, and keeps the first and the largest number in a file; does nothing without nvidia-smi. One process samples all
    the time, because its start takes locks of the driver, which would show in a step."""

    COMMAND = ("nvidia-smi", "--query-gpu=memory.used", "--format=csv,noheader,nounits", "--loop=1")

    def __init__(self, path, wanted, command=None):
        device = PLACE.get().device or os.environ.get("CUDA_VISIBLE_DEVICES", "0").split(",")[0]
        self.path, self.command = path, (command or (*self.COMMAND, f"--id={device}")) if wanted else None
        self.samples, self.process, self.first = [], None, threading.Event()

    def __enter__(self):
        try:
            self.process = subprocess.Popen(self.command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                                            text=True) if self.command else None
        except OSError:
            return
        if self.process:
            self.reader = threading.Thread(target=self.read)
            self.reader.start()
            self.first.wait(10)  # memory in use before anything begins

    def read(self):
        for line in self.process.stdout:
            if line.strip().isdigit():
                self.samples.append(int(line))
                self.first.set()
        self.first.set()

    def __exit__(self, *_):
        if not self.process:
            return
        self.process.terminate()
        self.reader.join()
        self.process.wait()
        self.process.stdout.close()
        if self.samples:
            self.path.parent.mkdir(parents=True, exist_ok=True)
            # of a run that continues
            earlier = json.loads(self.path.read_text())["largest [MiB]"] if self.path.is_file() else 0
            self.path.write_text(json.dumps({"before [MiB]": self.samples[0],
                                             "largest [MiB]": max(earlier, *self.samples),
                                             "samples": len(self.samples)}) + "\n")


def taken(path):
    """Returns the most memory in use beyond the memory in use before [MiB]; "" if it was not sampled, or only once,
    before the run used any."""
    sampled = json.loads(path.read_text()) if path.is_file() else None
    return sampled["largest [MiB]"] - sampled["before [MiB]"] if sampled and sampled["samples"] > 1 else ""
