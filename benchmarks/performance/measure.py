"""Runs the programs that measure, in rounds: what disturbs for a while disturbs one sample of each figure, and not
all samples of one."""

import os
import re
import shutil
import signal
import socket
import subprocess
import tempfile
import time
from dataclasses import replace
from pathlib import Path

from machine import Load
from rows import BARE, CASTOR, DDS, REDIS, SQLITE

PATIENCE = 240.0  # seconds that a run may take

# Program, and packages, by peer.
PEERS = {
    REDIS: ("redis", "redis-server libhiredis-dev"),
    DDS: ("dds", "cyclonedds-dev cyclonedds-tools"),
    BARE: ("bare", "libcaf-dev"),
    SQLITE: ("sqlite", "libsqlite3-dev"),
    CASTOR: ("castor", ""),
}


class MeasurementError(Exception):
    """A run that failed; says which and why."""


def figures_of(output):
    """The figures among the lines of a program, {name: value}."""
    return {name: float(value) for name, value in re.findall(r"^figure (\S+) (\S+)$", output, re.MULTILINE)}


def runs_of(rows):
    """Each run of the rows once, in their order, with whether it takes long."""
    result = {}
    for row in rows:
        for line in row.lines:
            for point in line.points:
                result[point.run] = result.get(point.run, False) or row.slow
    return result


def without_absent(rows, absent):
    """The rows without the lines of peers that are not there."""
    return [replace(row, lines=tuple(x for x in row.lines if x.peer not in absent)) for row in rows]


class RedisServer:
    """A redis-server of our own on a free port; ends with `close`."""

    def __init__(self, folder, durable):
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            self.port = free.getsockname()[1]
        self.folder = Path(folder)
        self.folder.mkdir(parents=True, exist_ok=True)
        keeping = ["--appendonly", "yes", "--appendfsync", "always"] if durable else ["--appendonly", "no"]
        self.process = subprocess.Popen(
            ["redis-server", "--port", str(self.port), "--bind", "127.0.0.1", "--save", "", "--dir", str(folder),
             *keeping], stdout=subprocess.DEVNULL, start_new_session=True)
        deadline = time.monotonic() + 10
        while True:
            try:
                socket.create_connection(("127.0.0.1", self.port), 1).close()
                return
            except OSError as error:
                if time.monotonic() > deadline or self.process.poll() is not None:
                    self.close()
                    raise MeasurementError(f"redis-server does not start: {error}") from error
                time.sleep(0.02)

    def close(self):
        self.process.terminate()
        self.process.wait()


class Programs:
    """The programs that measure, and the servers that they need."""

    def __init__(self, build, tree, seconds):
        self.build = Path(build)
        self.tree = Path(tree)
        self.seconds = seconds
        self.load = Load()
        self._servers = {}
        self._child = None
        # On a disk, as what is durable is measured.
        self._folder = Path(tempfile.mkdtemp(prefix="bench-", dir=self.build))

    def close(self):
        self._end_child()
        for server in self._servers.values():
            server.close()
        shutil.rmtree(self._folder, ignore_errors=True)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def path(self, program):
        return self.build / "benchmarks/performance" / f"performance_{program}"

    def absent(self):
        """Peers that cannot be measured, {name: what to do}."""
        result = {}
        for peer, (program, packages) in PEERS.items():
            if not self.path(program).exists() or (peer == REDIS and not shutil.which("redis-server")):
                result[peer] = f"install {packages}, and build again" if packages else "build castor_performance"
        return result

    def run(self, run):
        """The figures of one run."""
        if run.program == "castor run":
            return self._start_vision()
        arguments = dict(run.arguments)
        arguments["seconds"] = max(self.seconds, run.least_seconds)
        if run.program == "redis":
            arguments["port"] = self._redis(bool(arguments.pop("durable", 0))).port
            arguments.setdefault("clients", 1)
        if run.measurement == "durable_writes":
            arguments["folder"] = self._folder
        command = [str(self.path(run.program)), run.measurement] + [f"{k}={v}" for k, v in arguments.items()]
        output = self._output(command, str(run))
        figures = figures_of(output)
        if not figures:
            raise MeasurementError(f"{run} prints no figures; run it by hand: {' '.join(command)}")
        return figures

    def _output(self, command, name):
        self._child = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                       start_new_session=True)
        try:
            output, errors = self._child.communicate(timeout=PATIENCE)
        except subprocess.TimeoutExpired as error:
            raise MeasurementError(f"{name} has not ended in {PATIENCE:.0f} s: {' '.join(command)}") from error
        finally:
            status = self._end_child()
        if status != 0:
            raise MeasurementError(f"{name} failed with status {status}: {errors.strip()[-400:]}")
        return output

    def _end_child(self):
        """Kills what runs, with its own children; returns its status."""
        child, self._child = self._child, None
        if child is None:
            return 0
        if child.poll() is None:
            os.killpg(child.pid, signal.SIGKILL)
        status = child.wait()
        for pipe in (child.stdout, child.stderr):
            if pipe:
                pipe.close()
        return status

    def _redis(self, durable):
        if durable not in self._servers:
            server = RedisServer(self._folder / ("durable" if durable else "volatile"), durable)
            self._servers[durable] = server
            self.load.count_as_own(server.process.pid)
        return self._servers[durable]

    def _start_vision(self):
        """Seconds until the segmentor says that the first picture was processed."""
        command = [str(self.build / "castor"), "run", str(self.tree / "configs/vision.cast"), "--trace", "--for", "30s"]
        begin = time.monotonic()
        self._child = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True,
                                       start_new_session=True)
        try:
            for line in self._child.stdout:
                if re.search(r"\bOVERWRITE\s+SceneChanged\b.*\bsegmentor\b", line):
                    return {"seconds": time.monotonic() - begin}
        finally:
            self._end_child()
        raise MeasurementError(f"vision processed no picture in 30 s: {' '.join(command)}")


class Measurement:
    """Interleaved rounds over rows. What it has so far can be read at any time (`samples`, `loads`, `failures`)."""

    def __init__(self, rows, programs, rounds, slow_rounds):
        self.rows = rows
        self.programs = programs
        self.schedule = [(i, run) for i in range(rounds) for run, slow in runs_of(rows).items()
                         if not slow or i < slow_rounds]
        self.samples = {}
        self.loads = []
        self.failures = {}

    def work(self, progress=lambda done, round_number, run: None):
        for done, (round_number, run) in enumerate(self.schedule):
            progress(done, round_number, run)
            if run in self.failures:
                continue
            self.programs.load.share_since()
            try:
                figures = self.programs.run(run)
            except MeasurementError as error:
                self.failures[run] = str(error)
                continue
            self.loads.append(self.programs.load.share_since())
            self._take(run, figures)

    def _take(self, run, figures):
        for row in self.rows:
            for line in row.lines:
                for point in line.points:
                    if point.run == run and point.figure in figures:
                        labels = self.samples.setdefault(row.name, {}).setdefault(line.name, {})
                        labels.setdefault(point.label, []).append(figures[point.figure] * point.factor)
