"""Which commands and links of pages are taken for mistakes."""

import sys
import tempfile
import unittest
from pathlib import Path

sys.dont_write_bytecode = True

from commands import KnownCommands, check_commands, check_links  # noqa: E402
from page import PageError  # noqa: E402

HELP = {
    (): "Options:\n  --plugin FILE\n  --version\n\nSubcommands:\n  run   run it\n  wm    look\n",
    ("run",): "Options:\n  --trace\n  --set NAME=VALUE\n",
    ("wm",): "Options:\n  --json\n\nSubcommands:\n  ls   list\n  get   show\n",
    ("wm", "ls"): "", ("wm", "get"): "",
}


def check(text):
    known = KnownCommands("castor")
    known.helps = HELP
    check_commands(known, "page.md", text)


class Commands(unittest.TestCase):
    def test_those_that_are_there_are_right(self):
        check("`castor run x.cast --trace --set \"say=a --b\"`")
        check("    castor --plugin build/libx.so run x.cast # --this is a comment")
        check("castor wm ls --json\n`castor wm ls|get` and `castor COMMAND --help`")

    def test_unknown_commands_are_found(self):
        with self.assertRaisesRegex(PageError, "page.md:2: .*no command rnu"):
            check("\n`castor rnu x.cast`")
        with self.assertRaisesRegex(PageError, "`castor wm` has no command list"):
            check("castor wm ls|list")

    def test_unknown_options_are_found(self):
        with self.assertRaisesRegex(PageError, "no option --tarce"):
            check("    castor run x.cast --tarce")


class Links(unittest.TestCase):
    def test_those_that_lead_nowhere_are_found(self):
        with tempfile.TemporaryDirectory() as folder:
            docs = Path(folder) / "docs"
            docs.mkdir()
            (docs / "other.md").write_text("# Some other: page\n")
            page = docs / "page.md"
            check_links(page, "[x](other.md) [y](other.md#some-other-page) [z](https://example.org)")
            with self.assertRaisesRegex(PageError, "page.md:2: .*gone.md"):
                check_links(page, "\n[x](gone.md)")
            with self.assertRaisesRegex(PageError, "no heading.*#elsewhere"):
                check_links(page, "[x](other.md#elsewhere)")


if __name__ == "__main__":
    unittest.main()
