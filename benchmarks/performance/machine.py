"""The machine that is measured on, and what else it does meanwhile."""

import os
import platform
import resource
import subprocess
import time
from pathlib import Path

# Shares of the machine: what others may take of it before it counts as busy.
QUIET = 0.05


def _first(path, name):
    for line in Path(path).read_text().splitlines():
        if line.startswith(name):
            return line.split(":", 1)[1].strip()
    return "unknown"


def _distribution():
    try:
        return platform.freedesktop_os_release()["PRETTY_NAME"]
    except OSError:
        return "unknown"


def describe(tree):
    """What a reader has to know in order to compare figures. `tree` is the source tree."""
    version = subprocess.run(["git", "-C", str(tree), "describe", "--always", "--dirty"], capture_output=True,
                             text=True, check=False)
    return {
        "processor": _first("/proc/cpuinfo", "model name"),
        "cores": os.cpu_count(),
        "memory": _first("/proc/meminfo", "MemTotal"),
        "virtual": "hypervisor" in _first("/proc/cpuinfo", "flags"),
        "kernel": platform.release(),
        "system": _distribution(),
        "castor": version.stdout.strip() or "unknown",
    }


class Load:
    """How much of the machine others take: other processes, and other machines on the same host (steal)."""

    def __init__(self):
        self._processes = []
        self._start()

    def count_as_own(self, process_id):
        """Of a child that has not been waited for."""
        self._processes.append(process_id)
        self._start()

    def _start(self):
        self._busy, self._total = self._machine()
        self._own = self._own_seconds()
        self._time = time.monotonic()

    def share_since(self):
        """Share of all processors, 0 to 1, that others have taken since this was made or last asked."""
        busy, total = self._machine()
        ticks = os.sysconf("SC_CLK_TCK")
        others = (busy - self._busy) / ticks - (self._own_seconds() - self._own)
        all_seconds = max((total - self._total) / ticks, 1e-9)
        self._start()
        return min(max(others / all_seconds, 0.0), 1.0)

    @staticmethod
    def _machine():
        fields = [int(x) for x in Path("/proc/stat").read_text().splitlines()[0].split()[1:9]]
        # The fourth and the fifth are idle, and waiting for disks.
        return sum(fields) - fields[3] - fields[4], sum(fields)

    def _own_seconds(self):
        result = 0.0
        for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN):
            usage = resource.getrusage(who)
            result += usage.ru_utime + usage.ru_stime
        for process in self._processes:
            try:
                fields = Path(f"/proc/{process}/stat").read_text().rsplit(")", 1)[1].split()
            except OSError:
                continue
            result += (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")
        return result


def load_now(seconds=1.0):
    """Share of the machine that is busy, measured for some time."""
    load = Load()
    time.sleep(seconds)
    return load.share_since()
