"""The rule for ratios with other programs: a ratio is comparable if both sides ran on one machine and the version of
each program is named. Without that it is not comparable, whatever its value, and our own ratio stands beside it."""

from dataclasses import dataclass

OURS = "ogc"
UNNAMED = ("", "-", "unknown")


@dataclass(frozen=True)
class Side:
    """Holds one side of a ratio: the program's name, its version or commit, and the device that it ran on."""

    program: str
    version: str
    device: str

    @property
    def machine(self):
        """Returns the hardware, without the versions of drivers that only some programs print."""
        return self.device.partition(", CUDA")[0]


def side_of(row):
    """Returns the side that a table's row is about. A row without a column `program` is of this testbed."""
    return Side(row.get("program") or OURS, row.get("version") or row.get("commit", ""), row.get("device", ""))


def obstacle(sides, against):
    """Returns why a ratio with the program `against` is not comparable, as a sentence; empty if it is comparable."""
    if against not in {side.program for side in sides}:
        return f"No run of {against} on our machine, with its version named, is accepted."
    unnamed = [side.program for side in sides if side.version in UNNAMED]
    if unnamed:
        return f"The version of {' and of '.join(unnamed)} is not named."
    if len({side.machine for side in sides}) > 1:
        return "The sides ran on different machines: " + ", ".join(
            f"{side.program} on {side.machine}" for side in sides) + "."
    return "" if len(sides) > 1 else f"Only {against} ran."
