#!/usr/bin/env python3
"""What `castor new` makes builds without warnings, passes its test and runs, with names of all sorts.

    tests/install/castor_new_test.py     in a tree that scripts/run has built
"""

import os
import shutil
import signal
import subprocess
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(__file__).resolve().parent.parent.parent
WARNINGS = "-Wall -Wextra -Wpedantic -Wshadow -Wconversion -Werror"
# Seconds; to build a folder takes some.
LASTS = 300


class New(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = Path(tempfile.mkdtemp(prefix="new-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        home = cls.folder / "home"
        home.mkdir(mode=0o700)
        cls.environment = {**os.environ, "HOME": str(home), "XDG_RUNTIME_DIR": str(home), "CXXFLAGS": WARNINGS,
                           "CMAKE_BUILD_PARALLEL_LEVEL": str(os.cpu_count())}
        cls.environment.pop("LD_LIBRARY_PATH", None)
        cls.run_command("scripts/install", folder=SOURCE)
        cls.environment["PATH"] = f"{home}/castor/bin:{os.environ['PATH']}"

    @classmethod
    def run_command(cls, command, folder=None):
        process = subprocess.Popen(command, shell=True, cwd=folder or cls.folder, env=cls.environment, text=True,
                                   stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                   start_new_session=True)
        try:
            output, _ = process.communicate(timeout=LASTS)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            output, _ = process.communicate()
            raise AssertionError(f"{command} did not end within {LASTS} s:\n{output}") from None
        if process.returncode != 0:
            raise AssertionError(f"{command} ended with {process.returncode}:\n{output}")
        return output

    def make(self, kind, name, *expected):
        output = self.run_command(f"castor new {kind} {name}")
        _, _, commands = output.partition("Next:\n")
        self.assertIn("ctest", commands)
        # Exactly the commands that it prints.
        output = self.run_command("set -e\n" + commands)
        self.assertIn("100% tests passed", output)
        for part in expected:
            self.assertIn(part, output)

    def test_a_component(self):
        self.make("component", "greeter", "GreeterReport")

    def test_a_subarchitecture(self):
        self.make("subarchitecture", "my-kitchen_2", "MyKitchen2Alarm", "TASK COMPLETED")

    def test_a_robot(self):
        self.make("robot", "Rover", "RoverLookRequest", "m in front of an obstacle")

    def test_names_that_are_words_of_castor_and_cpp(self):
        self.make("component", "component", "ComponentReport")


if __name__ == "__main__":
    unittest.main()
