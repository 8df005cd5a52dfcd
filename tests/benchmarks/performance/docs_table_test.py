import unittest

from docs_table import BEGIN, END, docs_table, with_table
from results import at_least, results, row

MEASURED = {"reads": {"Castor": {"one": [100, 110, 90]}, "Redis": {"one": [70]}}}


class DocsTableTest(unittest.TestCase):
    def test_peers_stand_beside_castor_and_aims_beside_the_title(self):
        text = docs_table([row(lines=("Castor", "Redis"), aims=(at_least(50),))], results(MEASURED))
        self.assertIn("| one | 100 +- 10 % | Redis 70.0 |", text)
        self.assertIn("| **Reads**, reads/s | | one: 50.0 reads/s or more: met, 2.00 x the aim |", text)

    def test_machine_and_load_are_named(self):
        text = docs_table([row()], results(MEASURED))
        self.assertIn("A <fast> one", text)
        self.assertIn("Others used 1 % of the machine before the run", text)

    def test_lines_that_are_no_contenders_have_rows_of_their_own(self):
        text = docs_table([row(lines=("add", "read"))], results({"reads": {"add": {"one": [1]}, "read": {"one": [2]}}}))
        self.assertIn("| one, add | 1.00 |  |\n| one, read | 2.00 |  |", text)

    def test_only_what_is_between_the_marks_is_replaced(self):
        page = f"before\n{BEGIN}\nold\n{END}\nafter\n"
        self.assertEqual(with_table(page, "new"), f"before\n{BEGIN}\n\nnew\n\n{END}\nafter\n")
        with self.assertRaises(ValueError):
            with_table("no marks", "new")


if __name__ == "__main__":
    unittest.main()
