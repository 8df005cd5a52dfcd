"""What pages are read as."""

import sys
import unittest

sys.dont_write_bytecode = True

from page import CheckOutput, CheckPart, CheckSize, PageError, Type, WriteFile, read_page  # noqa: E402


def steps(*lines):
    return read_page("page.md", "\n".join(lines) + "\n")


class Pages(unittest.TestCase):
    def test_files_are_written_as_they_are_shown(self):
        self.assertEqual(steps("`a/b.cpp`:", "", "```cpp", "int x;", "", "int y;", "```"),
                         [WriteFile(3, "a/b.cpp", "int x;\n\nint y;\n")])

    def test_parts_are_looked_for(self):
        self.assertEqual(steps("From `b.cpp`:", "```cpp", "int x;", "```"), [CheckPart(2, "b.cpp", "int x;\n")])

    def test_code_of_no_file_is_refused(self):
        with self.assertRaisesRegex(PageError, "page.md:1: .*which file"):
            steps("```cpp", "int x;", "```")

    def test_shell_fences_are_typed(self):
        self.assertEqual(steps("Build it:", "", "```sh", "make", "```"), [Type(3, "make\n")])
        self.assertEqual(steps("In Castor's source tree:", "", "```sh", "make", "```"),
                         [Type(3, "make\n", in_source_tree=True)])
        self.assertEqual(steps("In Castor's source tree.", "", "Elsewhere:", "", "```sh", "make", "```"),
                         [Type(5, "make\n")])

    def test_plain_fences_are_what_was_printed(self):
        read = steps("`castor ps` says:", "", "```", "one", "...", "", "two", "```", "and", "```", "three", "```")
        self.assertEqual(read, [Type(1, "castor ps"), CheckOutput(3, ["one", "two"]), CheckOutput(10, ["three"])])

    def test_output_of_nothing_is_refused(self):
        with self.assertRaisesRegex(PageError, "nothing was typed"):
            steps("```", "one", "```")

    def test_commands_come_out_as_the_page_says(self):
        self.assertEqual(steps("`castor run x` fails:"), [Type(1, "castor run x", status=1)])
        self.assertEqual(steps("`castor run x` is refused:"), [Type(1, "castor run x", status=2)])
        self.assertEqual(steps("`castor run x` goes on until"), [Type(1, "castor run x", goes_on=True)])
        self.assertEqual(steps("`castor add x` soon succeeds."), [Type(1, "castor add x", tries=True)])
        self.assertEqual(steps("`castor wm ls` soon says:", "```", "one", "```"),
                         [Type(1, "castor wm ls", tries=True, lines=["one"])])

    def test_commands_within_a_sentence_are_not_typed(self):
        self.assertEqual(steps("Then `castor ps` says something."), [])

    def test_text_is_not_tried(self):
        self.assertEqual(steps("```text", "one", "```", "```mermaid", "two", "```"), [])

    def test_sizes(self):
        self.assertEqual(steps("<!-- at most 99 lines of C++ and .cast -->"), [CheckSize(1, 99)])

    def test_fences_that_do_not_end_are_refused(self):
        with self.assertRaisesRegex(PageError, "page.md:1: the fence does not end"):
            steps("```sh", "make")


if __name__ == "__main__":
    unittest.main()
