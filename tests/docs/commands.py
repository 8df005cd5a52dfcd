"""Whether the commands that pages mention are there, with their options, and where their links lead."""

import re
import subprocess

from page import PageError

# `castor ...` in a line, and lines of fences and indented blocks.
INLINE = re.compile(r"`(castor [^`]+)`")
LINE = re.compile(r"^(?: {4})?(castor .+)$")


class KnownCommands:
    """What `castor --help`, and that of its commands, says."""

    def __init__(self, castor):
        self.castor = castor
        self.helps = {}

    def help(self, commands=()):
        if commands not in self.helps:
            result = subprocess.run([self.castor, *commands, "--help"], capture_output=True, text=True,
                                    check=False)
            self.helps[commands] = result.stdout if result.returncode == 0 else ""
        return self.helps[commands]

    def subcommands(self, commands):
        _, _, listed = self.help(commands).partition("ubcommands:\n")
        return re.findall(r"^  ([a-z][-a-z]*)\b", listed, re.MULTILINE)

    def options(self, commands):
        """Those of the command and of the ones around it."""
        return {option for n in range(len(commands) + 1)
                for option in re.findall(r"--[a-z][-a-z]*", self.help(commands[:n]))}

    def problem(self, command):
        """What is wrong with a command line; None if nothing is."""
        # What is quoted is nobody's option.
        words = re.sub(r"\"[^\"]*\"|'[^']*'", "TEXT", command.partition(" #")[0]).split()[1:]
        commands = ()
        before = ""
        for word in words:
            value_of_option = before.startswith("--")
            before = word
            known = self.subcommands(commands)
            if value_of_option or word.startswith("-"):
                continue
            if not known or not re.fullmatch(r"[a-z][-a-z|]*", word):
                break
            # ls|get|watch are three.
            for choice in word.split("|"):
                if choice not in known:
                    return f"`{' '.join(('castor', *commands))}` has no command {choice}"
            commands += (word.split("|")[0],)
        for word in words:
            option = re.match(r"--[a-z][-a-z]*", word)
            if option and option[0] not in self.options(commands) | {"--help"}:
                return f"`{' '.join(('castor', *commands))}` has no option {option[0]}"
        return None


def check_commands(known, page, text):
    """Raises PageError at the first command of the page that is not there."""
    for number, line in enumerate(text.splitlines(), 1):
        typed = LINE.match(line)
        for command in [typed[1]] if typed else INLINE.findall(line):
            if problem := known.problem(command):
                raise PageError(f"{page}:{number}: {command}: {problem}")


def _anchors(path):
    """The names of a page's headings in links."""
    headings = re.findall(r"^#+ +(.*)$", path.read_text(), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", x.lower()).replace(" ", "-") for x in headings}


def check_links(page, text):
    """Raises PageError at the first link of the page to a file or heading that is not there."""
    in_fence = False
    for number, line in enumerate(text.splitlines(), 1):
        if line.startswith("```"):
            in_fence = not in_fence
        if in_fence:
            continue
        for target in re.findall(r"\]\(([^)\s]+)\)", re.sub(r"`[^`]*`", "", line)):
            if re.match(r"[a-z]+:", target):
                continue
            name, _, anchor = target.partition("#")
            path = page.parent / name if name else page
            if not path.exists():
                raise PageError(f"{page}:{number}: there is no {target}")
            if anchor and path.suffix == ".md" and anchor not in _anchors(path):
                raise PageError(f"{page}:{number}: there is no heading for the link {target}")
