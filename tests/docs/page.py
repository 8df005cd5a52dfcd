"""A page of documentation as what a reader does with it, step by step.

What stands before a fence says what is in it:

    `NAME`:                       the whole file, which the reader writes
    From `NAME`:                  a part of a file that the reader has
    (a fence of the language sh)  commands that the reader types, one after the other, and that succeed; in
                                  Castor's source tree if the paragraph before says "source tree"
    (a fence without a language)  lines, or parts of lines, that the last commands printed; `...` is any text

A line that begins with a command in backquotes is typed, too. What follows says what becomes of it:

    `castor ...`                  it succeeds
    `castor ...` fails            its exit status is 1
    `castor ...` is refused       its exit status is 2
    `castor ...` soon says        the next fence is what it prints in the end, if it is typed again and again
    `castor ...` soon succeeds    it does, if it is typed again and again
    `castor ...` goes on          it runs until the reader has come to the end of the page

Fences of other languages than sh, cpp, cmake and none say something without being tried.
`<!-- at most N lines of C++ and .cast -->` is a promise about all files of the page.
"""

import re
from dataclasses import dataclass, field

COMMAND = re.compile(r"`((?:castor|cmake|ctest|scripts/\w+) [^`]+)`(.*)")
OUTCOMES = {"fails": 1, "is refused": 2}


class PageError(Exception):
    """A page that cannot be followed, or does not tell the truth; says where."""


@dataclass
class WriteFile:
    """The reader writes the file as the page shows it."""

    line: int
    name: str
    text: str


@dataclass
class CheckPart:
    """The text is a part of the file."""

    line: int
    name: str
    text: str


@dataclass
class Type:
    """The reader types commands in a shell. `tries` are repeated until they succeed and print `lines`."""

    line: int
    commands: str
    status: int = 0
    in_source_tree: bool = False
    goes_on: bool = False
    tries: bool = False
    lines: list = field(default_factory=list)


@dataclass
class CheckOutput:
    """What was typed last has printed these lines."""

    line: int
    lines: list


@dataclass
class CheckSize:
    """All C++ and .cast files of the page together have no more lines than that."""

    line: int
    most: int


def _typed(line, command, rest):
    rest = rest.strip(" ,.:;")
    for outcome, status in OUTCOMES.items():
        if rest.startswith(outcome):
            return Type(line, command, status=status)
    return Type(line, command, goes_on=rest.startswith("goes on"),
                tries=rest.startswith(("soon says", "soon succeeds")))


def _fence(page, line, language, label, paragraph, text, last):
    """The step of a fence; None if nothing is to be done for it."""
    if whole := re.fullmatch(r"`([^` ]+)`:", label):
        return WriteFile(line, whole[1], text)
    if part := re.fullmatch(r"From `([^` ]+)`:", label):
        return CheckPart(line, part[1], text)
    if language == "sh":
        return Type(line, text, in_source_tree="source tree" in paragraph)
    if language in ("cpp", "cmake"):
        raise PageError(f"{page}:{line}: the page does not say which file this is; write `NAME`: before it")
    if language:
        return None
    lines = [x for x in text.splitlines() if x.strip() and x.strip() != "..."]
    if last is None:
        raise PageError(f"{page}:{line}: nothing was typed that could have printed this; "
                        "if it is no output, give the fence the language text")
    if last.tries:
        last.lines = lines
        return None
    return CheckOutput(line, lines)


def read_page(page, text):
    """The steps of a page.

    page -- its name, for errors
    """
    steps = []
    last = None
    fence = None
    paragraph = []
    paragraph_ended = False
    for number, line in enumerate(text.splitlines(), 1):
        if fence is not None:
            begin, language, body = fence
            if line != "```":
                body.append(line + "\n")
                continue
            fence = None
            label = paragraph[-1] if paragraph else ""
            step = _fence(page, begin, language, label, " ".join(paragraph), "".join(body), last)
            if step is not None:
                steps.append(step)
            if isinstance(step, Type):
                last = step
            paragraph = []
            continue
        if line.startswith("```"):
            fence = (number, line[3:].strip(), [])
            continue
        if not line.strip():
            paragraph_ended = True
            continue
        paragraph = [line] if paragraph_ended else paragraph + [line]
        paragraph_ended = False
        if command := COMMAND.match(line):
            last = _typed(number, command[1], command[2])
            steps.append(last)
        elif size := re.match(r"<!-- at most (\d+) lines of C\+\+ and \.cast -->", line):
            steps.append(CheckSize(number, int(size[1])))
    if fence is not None:
        raise PageError(f"{page}:{fence[0]}: the fence does not end")
    return steps
