"""Which pages readers take for true. The pages of this test type `cmake -E ...` only."""

import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

sys.dont_write_bytecode = True

import reader  # noqa: E402
from page import PageError  # noqa: E402


class Readers(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.source = Path(folder.name)
        patience = mock.patch.object(reader, "SOON", 1)
        patience.start()
        self.addCleanup(patience.stop)

    def follow(self, *lines):
        (self.source / "page.md").write_text("\n".join(lines) + "\n")
        followed = reader.Reader(self.source, "page.md")
        try:
            followed.follow()
        finally:
            self.assertFalse(followed.home.exists())

    def check_false(self, message, *lines):
        with self.assertRaisesRegex(PageError, message):
            self.follow(*lines)

    def test_what_is_printed_has_to_be_what_is_shown(self):
        self.follow("`cmake -E echo one` says:", "```", "one", "```")
        self.check_false("page.md:2: the page shows\n    two\nbut", "`cmake -E echo one` says:", "```", "two", "```")

    def test_dots_are_any_text_within_a_line(self):
        self.follow("`cmake -E echo size 0.61, red` says:", "```", "size ..., red", "```")
        self.check_false("the page shows", "`cmake -E echo size 0.61, red` says:", "```", "size ..., blue", "```")
        self.check_false("the page shows", "```sh", "echo one", "echo two", "```", "```", "one...two", "```")

    def test_commands_have_to_end_as_the_page_says(self):
        self.follow("`cmake -E true` succeeds")
        self.follow("`cmake -E false` fails")
        self.check_false("ended with 1 instead of 0", "`cmake -E false`")
        self.check_false("ended with 0 instead of 1", "`cmake -E true` fails")
        self.check_false("ended with 1 instead of 0", "```sh", "false", "true", "```")

    def test_files_are_written_into_the_folder_that_the_reader_is_in(self):
        self.follow("```sh", "mkdir a", "cd a", "export WORD=two", "```", "`b.txt`:", "```", "one", "```",
                    "```sh", "cat ../a/b.txt", "echo $WORD", "```", "```", "one", "two", "```",
                    "From `b.txt`:", "```", "one", "```")
        self.check_false("b.txt has no such part", "`b.txt`:", "```", "one", "```", "From `b.txt`:", "```", "two", "```")
        self.check_false("has no file c.txt", "From `c.txt`:", "```", "two", "```")

    def test_homes_are_empty(self):
        self.follow("```sh", "test -z \"$(ls -A $HOME | grep -v -e empty -e run -e left)\"", "ls -A", "```")

    def test_the_source_tree_is_left_again(self):
        self.follow("In Castor's source tree:", "", "```sh", "cat page.md", "export PLACE=$PWD", "```", "Elsewhere:", "",
                    "```sh", "test ! -e page.md", "test -e $PLACE/page.md", "```")

    def test_what_comes_late_is_waited_for(self):
        late = "cmake -E cat late"
        self.follow("```sh", "(sleep 0.5; echo one >late) >/dev/null 2>&1 &", "```", f"`{late}` soon says:", "```",
                    "one", "```")
        self.check_false("ended with 1 instead of 0, and without", f"`{late}` soon says:", "```", "one", "```")

    def test_what_goes_on_does_so_until_the_page_ends(self):
        self.follow("`cmake -E sleep 100` goes on until", "`cmake -E true`")
        self.check_false("what goes on meanwhile prints", "`cmake -E sleep 100` goes on", "`cmake -E false`")

    def test_pages_keep_to_their_size(self):
        page = ["<!-- at most 2 lines of C++ and .cast -->", "`a.cpp`:", "```", "one", "two", "```"]
        self.follow(*page)
        self.check_false("3 lines, more than 2", *page, "`b.cast`:", "```", "three", "```")

    def test_the_folder_of_the_page_has_its_files(self):
        (self.source / "page").mkdir()
        file = self.source / "page/a.cpp"
        page = ["`a.cpp`:", "```", "one", "```"]
        file.write_text("one\n")
        self.follow(*page)
        self.check_false("does not quote a.cpp")
        file.write_text("two\n")
        self.check_false("is not as the page shows it", *page)


if __name__ == "__main__":
    unittest.main()
