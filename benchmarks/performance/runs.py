"""Runs of programs, one after another, of a study."""

import subprocess
import sys

from machine import Load
from measure import figures_of
from progress import Progress

PATIENCE = 300.0  # seconds that a program may take


class Runs:
    """Runs programs one after another; says how far it is, and how much of the machine others use."""

    def __init__(self, total):
        self.total, self.done, self.loads, self.progress = total, 0, [], Progress(total)

    def run(self, name, work):
        """The result of `work`; None if it failed, which is said."""
        self.progress.show(self.done, name)
        load = Load()
        try:
            return work(load)
        except (RuntimeError, OSError) as error:
            self.progress.end()
            print(f"FAILED: {name}: {error}", file=sys.stderr)
            return None
        finally:
            self.done += 1
            self.loads.append(load.share_since())

    def end(self):
        self.progress.end()

    def load_by_others(self, before):
        """Shares of the machine, as the page of a run has them."""
        loads = sorted(self.loads) or [0.0]
        return {"before": before, "median": loads[len(loads) // 2], "most": loads[-1], "samples": loads}


def figures_of_program(command, load):
    """The figures that a program prints. Throws RuntimeError if it fails."""
    child = subprocess.Popen([str(x) for x in command], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    load.count_as_own(child.pid)
    try:
        output, errors = child.communicate(timeout=PATIENCE)
    except subprocess.TimeoutExpired as error:
        raise RuntimeError(f"{command[0]} has not ended in {PATIENCE:.0f} s") from error
    finally:
        if child.poll() is None:
            child.kill()
            child.wait()
    if child.returncode != 0:
        raise RuntimeError(errors.strip()[-400:])
    return figures_of(output)
