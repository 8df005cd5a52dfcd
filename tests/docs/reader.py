"""A reader who does what a page says, in an empty folder and with an empty home."""

import os
import re
import shutil
import signal
import subprocess
import tempfile
import time
from pathlib import Path

from page import CheckOutput, CheckPart, CheckSize, PageError, Type, WriteFile, read_page

# Seconds. Commands of a fence may build something.
COMMAND_LASTS = 900
SOON = 60
# What readers' compilers complain of is wrong with the page.
WARNINGS = "-Wall -Wextra -Wpedantic -Werror"
COUNTED = (".cpp", ".hpp", ".cast")


def _pattern(shown):
    """What a shown line means: `...` in it is any text within the line."""
    return ".*".join(re.escape(x) for x in shown.split("..."))


class Reader:
    """Follows one page.

    source -- Castor's source tree
    """

    def __init__(self, source, page):
        self.source = Path(source).resolve()
        self.page = page
        self.home = Path(tempfile.mkdtemp(prefix="reader-"))
        self.folder = self.home / "empty"
        self.folder.mkdir()
        # Sockets have short names.
        runtime = self.home / "run"
        runtime.mkdir(mode=0o700)
        self.environment = {x: os.environ[x] for x in os.environ
                            if x not in ("LD_LIBRARY_PATH", "CMAKE_PREFIX_PATH", "castor_DIR", "DESTDIR")}
        self.environment.update(HOME=str(self.home), XDG_RUNTIME_DIR=str(runtime), CXXFLAGS=WARNINGS,
                                CMAKE_BUILD_PARALLEL_LEVEL=str(os.cpu_count()))
        self.files = {}
        self.background = []
        self.status = 0
        self.output = ""

    def follow(self):
        """Does all that the page says; raises PageError where it does not tell the truth."""
        actions = {WriteFile: self.write_file, CheckPart: self.check_part, Type: self.type_commands,
                   CheckOutput: self.check_output, CheckSize: self.check_size}
        steps = read_page(self.page, (self.source / self.page).read_text())
        # Sizes are those of the whole page.
        steps.sort(key=lambda step: isinstance(step, CheckSize))
        try:
            for step in steps:
                actions[type(step)](step)
            self.check_folder()
        finally:
            self.leave()

    def fail(self, step, message):
        text = f"{self.page}:{step.line}: {message}"
        for _, log in self.background:
            text += f"\nwhat goes on meanwhile prints:\n{log.read_text(errors='replace')}"
        raise PageError(text)

    def write_file(self, step):
        path = self.folder / step.name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(step.text)
        self.files[step.name] = step.text

    def check_part(self, step):
        path = self.folder / step.name
        if not path.exists():
            self.fail(step, f"the reader has no file {step.name}")
        if step.text not in path.read_text():
            self.fail(step, f"{step.name} has no such part; it is\n{path.read_text()}")

    def type_commands(self, step):
        if step.goes_on:
            self.start(step)
            return
        deadline = time.monotonic() + SOON
        while True:
            self.run(step)
            missing = self.missing(step.lines)
            if self.status == step.status and not missing:
                return
            if not step.tries or time.monotonic() > deadline:
                break
            time.sleep(0.2)
        wanted = "" if self.status == step.status else f" instead of {step.status}"
        without = f", and without\n    {missing}" if missing else ""
        self.fail(step, f"\n{step.commands.rstrip()}\nended with {self.status}{wanted}{without}\n"
                  f"It printed:\n{self.output}")

    def run(self, step):
        """Types the commands. Where they change folder or variables, that stays so afterwards."""
        left = self.home / "left"
        script = f"{step.commands}\n{{ pwd; env -0; }} >'{left}'\n"
        left.unlink(missing_ok=True)
        folder = self.source if step.in_source_tree else self.folder
        process = subprocess.Popen(["sh", "-e", "-c", script], cwd=folder, env=self.environment,
                                   stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                   stderr=subprocess.STDOUT, start_new_session=True)
        try:
            output, _ = process.communicate(timeout=COMMAND_LASTS)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            output, _ = process.communicate()
            self.fail(step, f"\n{step.commands}\ndid not end within {COMMAND_LASTS} s. It printed:\n"
                      f"{output.decode(errors='replace')}")
        self.status = process.returncode
        self.output = output.decode(errors="replace")
        if left.exists():
            place, _, variables = left.read_bytes().partition(b"\n")
            if not step.in_source_tree:
                self.folder = Path(os.fsdecode(place))
            pairs = (x.partition("=") for x in os.fsdecode(variables).split("\0") if x)
            self.environment = {name: value for name, _, value in pairs
                                if name not in ("PWD", "OLDPWD", "SHLVL", "_")}

    def start(self, step):
        log = self.home / f"goes-on-{len(self.background)}.log"
        # It ends of itself should this test be killed.
        command = f"exec timeout -s INT {COMMAND_LASTS} {step.commands}"
        with log.open("w") as output:
            process = subprocess.Popen(["sh", "-c", command], cwd=self.folder, env=self.environment,
                                       stdin=subprocess.DEVNULL, stdout=output, stderr=subprocess.STDOUT,
                                       start_new_session=True)
        self.background.append((process, log))

    def missing(self, lines):
        """The first of the lines that was not printed; None if all were."""
        return next((x for x in lines if not re.search(_pattern(x), self.output)), None)

    def check_output(self, step):
        if missing := self.missing(step.lines):
            self.fail(step, f"the page shows\n    {missing}\nbut this was printed:\n{self.output}")

    def check_size(self, step):
        count = sum(text.count("\n") for name, text in self.files.items() if name.endswith(COUNTED))
        if count > step.most:
            self.fail(step, f"{count} lines, more than {step.most}")

    def check_folder(self):
        """The folder of the page's name has the files of the page, for those who do not want to write them."""
        folder = (self.source / self.page).with_suffix("")
        if not folder.is_dir():
            return
        for path in sorted(x for x in folder.rglob("*") if x.is_file()):
            name = str(path.relative_to(folder))
            if name not in self.files:
                raise PageError(f"{self.page}: the page does not quote {name} of {folder}")
            if self.files[name] != path.read_text():
                raise PageError(f"{self.page}: {path} is not as the page shows it")

    def leave(self):
        for process, _ in self.background:
            if process.poll() is None:
                os.killpg(process.pid, signal.SIGINT)
        for process, _ in self.background:
            try:
                process.wait(timeout=30)
            except subprocess.TimeoutExpired:
                os.killpg(process.pid, signal.SIGKILL)
                process.wait()
        shutil.rmtree(self.home, ignore_errors=True)
