# Copyright 2026 The Carpus authors
# SPDX-License-Identifier: Apache-2.0
"""What a process holds, second by second, and whether it is flat."""

import os
import pathlib
import statistics
import time


def held_by(pid, folder):
    """Memory in MiB, descriptors, threads of a process; files in a folder."""
    status = pathlib.Path(f"/proc/{pid}/status").read_text()
    fields = dict(line.split(":\t", 1) for line in status.splitlines() if ":\t" in line)
    return {"memory, MiB": int(fields["VmRSS"].split()[0]) / 1024, "descriptors": len(os.listdir(f"/proc/{pid}/fd")),
            "threads": int(fields["Threads"]), "files": sum(not name.startswith("filler") for name in os.listdir(folder))}


class MachineTime:
    """How much others used this machine up: the share of time in which whoever was ready to run had to wait for a core
    (the kernel's pressure stall information). Where the kernel does not tell, the machine has time."""

    PRESSURE = pathlib.Path("/proc/pressure/cpu")

    def __init__(self):
        self.began, self.waited = time.monotonic(), self.waited_us()

    def waited_us(self):
        try:
            return int(self.PRESSURE.read_text().split("\n")[0].rsplit("total=", 1)[1])
        except (OSError, IndexError, ValueError):
            return 0

    def share_waited_for(self):
        return (self.waited_us() - self.waited) / 1e6 / (time.monotonic() - self.began)


class Samples:
    """Figures of one process, by seconds of its life."""

    def __init__(self):
        self.rows = []

    def add(self, second, figures):
        self.rows.append((second, figures))

    def settled(self):
        """Without the first quarter, and 90 s of a short life: the first exercises, caches and stacks come then."""
        seconds = self.rows[-1][0]
        begin = max(seconds / 4, min(90, seconds / 2))
        return [row for row in self.rows if row[0] >= begin]

    def slope_per_second(self, name):
        """Theil and Sen's: the median of the slopes between pairs, which single peaks do not move."""
        rows = self.settled()
        rows = rows[::max(1, len(rows) // 300)]
        slopes = [(b[1][name] - a[1][name]) / (b[0] - a[0]) for i, a in enumerate(rows) for b in rows[i + 1:] if b[0] > a[0]]
        return statistics.median(slopes) if slopes else 0.0

    def row(self, name):
        rows = self.settled()
        values = [figures[name] for _, figures in rows]
        span = rows[-1][0] - rows[0][0]
        return {"least": min(values), "median": statistics.median(values), "most": max(values),
                "rise": self.slope_per_second(name) * span, "seconds": span}
