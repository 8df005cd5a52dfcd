"""What changes cost in the robots' systems: runs them, also rearranged, and asks them for their counters."""

import json
import os
import signal
import socket
import subprocess
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

# Seconds without a change after which a system is at rest, and after which one that is not is given up.
REST = 4.0
PATIENCE = 600.0


class RobotError(RuntimeError):
    """The system did not do what it should."""


@dataclass(frozen=True)
class Robot:
    """A run of a system. `speed_max`: in simulated time, as fast as the machine can. `movable`: its components do the
    same in one subarchitecture; those of the PlayMate know by subarchitectures what is said and what is seen."""

    name: str
    title: str
    arguments: tuple
    speed_max: bool = False
    movable: bool = False


ROBOTS = [
    Robot("figure-3", "PlayMate: it is shown and told of a blue square (the paper's figure 3)",
          ("configs/playmate.cast", "--set", "source=scene:scenes/blue-square.scene", "--set", "recogniser=no",
           "--set", "say=This is a blue square. What is it?")),
    Robot("conversation", "PlayMate: ten questions about a table",
          ("configs/playmate.cast", "--set",
           "say=Where is the ball? What colour is it? Is there a cube behind the triangle? How many things are there? "
           "What is to the left of the cylinder? Is the ball red? Where is the cube? Which things are blue? "
           "What is near the ball? Is the cube bigger than the ball?")),
    Robot("mission", "Explorer: it drives its path through the office, and maps it",
          ("configs/explorer.cast", "--set", "after=stay"), speed_max=True, movable=True),
]


def _component_line(start, component, options):
    words = [f'{name} "{_escape(value)}"' for name, value in options]
    return " ".join([start, component["name"], component["class"], *words])


def _escape(text):
    """A value between quotes, as .cast files have it."""
    return text.replace("\\", "\\\\").replace('"', '\\"')


def in_one_subarchitecture(architecture, options, folder):
    """The .cast text of an architecture (`castor check --json`) whose components are all in the subarchitecture `all`,
    and are told so where they have options that name one. `options`: those of each class, as `castor components --json`
    has them. `folder`: that of the system's file."""
    lines = []
    for x in architecture["standalone"]:
        given = [(y["key"], _value(y, options[x["class"]], folder)) for y in x["options"]]
        lines.append(_component_line("COMPONENT CPP", x, given))
    lines += ["SUBARCHITECTURE all", "CPP WM SubarchitectureWorkingMemory", "CPP TM AlwaysPositiveTaskManager"]
    for place in architecture["subarchitectures"]:
        for x in place["components"]:
            known = options[x["class"]]
            given = [(y["key"], _value(y, known, folder)) for y in x["options"]]
            others = [(f"--{name}", "all") for name, option in known.items()
                      if _names_subarchitecture(option) and option["default"] and f"--{name}" not in dict(given)]
            kind = "MG" if x["kind"] == "managed" else "UM"
            lines.append(_component_line(f"CPP {kind}", x, given + others))
    return "\n".join(lines) + "\n"


def _names_subarchitecture(option):
    return option["kind"] == "name of a subarchitecture"


def _value(given, known, folder):
    name, value = given["key"].removeprefix("--"), given["value"]
    if name == "base":
        return str(folder)
    # An entry elsewhere, such as navigation/seat.
    if name == "lease":
        return "all/" + value.split("/", 1)[1]
    return "all" if value and _names_subarchitecture(known[name]) else value


def rearranged(castor, tree, robot):
    """The text of the robot's system in one subarchitecture."""
    def output(*arguments):
        return subprocess.run([str(castor), *arguments], cwd=tree, capture_output=True, text=True, check=True).stdout

    classes = [json.loads(line) for line in output("components", "--json").splitlines()]
    options = {x["class"]: {y["name"]: y for y in x["options"]} for x in classes}
    architecture = json.loads(output("check", "--json", *robot.arguments))
    return in_one_subarchitecture(architecture, options, Path(tree) / architecture["config_dir"])


class RunningSystem:
    """`castor run`, as a context; it is interrupted at the end."""

    def __init__(self, castor, tree, robot, broadcast, in_one):
        self._folder = tempfile.TemporaryDirectory(prefix="filtering-")
        command = [str(castor), "run"]
        if in_one:
            file = Path(self._folder.name) / "one.cast"
            file.write_text(rearranged(castor, tree, robot))
            command.append(str(file))
        else:
            command += robot.arguments
        command += ["--speed", "max"] if robot.speed_max else []
        command += ["--broadcast"] if broadcast else []
        self.process = subprocess.Popen(command, cwd=tree, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
                                        env=dict(os.environ, XDG_RUNTIME_DIR=self._folder.name))

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGINT)
        try:
            self.process.communicate(timeout=60)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.communicate()
        self._folder.cleanup()

    def ask(self, what):
        """The lines of the answer; none as long as the system does not listen."""
        files = list(Path(self._folder.name).glob("castor/*.sock"))
        if not files:
            return []
        with socket.socket(socket.AF_UNIX) as connection:
            connection.connect(str(files[0]))
            connection.sendall(json.dumps({"do": what}).encode() + b"\n")
            answer = b"".join(iter(lambda: connection.recv(1 << 16), b""))
        return [json.loads(line) for line in answer.decode().splitlines()]

    def status_at_rest(self):
        """The answer to `ps` when nothing has changed for a while."""
        end = time.monotonic() + PATIENCE
        last, since = 0, time.monotonic()
        while time.monotonic() < end:
            if self.process.poll() is not None:
                raise RobotError(f"it ended by itself: {self.process.communicate()[1].strip()[-400:]}")
            time.sleep(0.2)
            status = self.ask("ps")
            events = sum(x["events"] for x in status[0]["working_memories"]) if status else 0
            if events != last:
                last, since = events, time.monotonic()
            elif events and time.monotonic() - since > REST:
                return status[0]
        raise RobotError(f"it is not at rest after {PATIENCE:.0f} s")


def figures_of(status, usages):
    """Figures of a system, from its answers to `ps` and `graph`, in all and not for each change."""
    memories = [x for x in status["working_memories"] if x["subarchitecture"] != "castor"]
    managers = {f"{x['subarchitecture']}_tm" for x in memories}
    components = [x for x in status["components"] if x["subarchitecture"] and x["name"] not in managers]
    written = {}
    for x in usages:
        key = x["component"], x["subarchitecture"], x["type"]
        written[key] = x["adds"] + x["overwrites"] + x["deletes"]
    # At most so many events told components of what they did themselves.
    own = sum(min(x["events"], written[x["component"], x["subarchitecture"], x["type"]]) for x in usages)
    return {
        "subarchitectures": len(memories),
        "components": len(components),
        "changes": sum(x["events"] for x in memories),
        "messages": sum(x["forwarded"] for x in memories),
        "deliveries": sum(x["matched"] for x in memories),
        "own": own,
        "rejected": sum(x["rejected"] for x in components),
        "filters": sum(x["filters"] for x in memories),
        "processor": sum(x["cpu"] for x in status["nodes"]),
    }


def run(castor, tree, robot, broadcast, in_one=False):
    """Figures of one run, with all components in one subarchitecture if `in_one`. Throws RobotError."""
    with RunningSystem(castor, tree, robot, broadcast, in_one) as system:
        status = system.status_at_rest()
        return figures_of(status, system.ask("graph"))
