import re
import unittest
import xml.etree.ElementTree as xml

from page import page
from plot import Bars
from report import changes_text, figures_text
from results import at_least, results, row

MEASURED = {"reads": {"Castor": {"one": [100, 110, 90], "two": [50, 50, 51]}, "Redis": {"one": [70, 71, 72]}}}
ROW = row(lines=("Castor", "Redis"), aims=(at_least(120),))


class PlotTest(unittest.TestCase):
    def setUp(self):
        self.svg = xml.fromstring(Bars(ROW, results(MEASURED)).svg())

    def test_each_figure_has_a_bar_as_long_as_it_is_large(self):
        widths = [float(x.get("width")) for x in self.svg.iter("rect")]
        self.assertEqual(len(widths), 3)
        self.assertAlmostEqual(widths[2] / widths[0], 0.5, places=2)

    def test_the_scale_reaches_to_an_aim_that_is_missed(self):
        aim = next(x for x in self.svg.iter("path") if x.get("class") == "aim")
        bar = next(self.svg.iter("rect"))
        end = float(bar.get("x")) + float(bar.get("width"))
        self.assertGreater(float(re.match(r"M([\d.]+)", aim.get("d")).group(1)), end)

    def test_nothing_leaves_the_picture(self):
        width = float(self.svg.get("viewBox").split()[2])
        for x in self.svg.iter("rect"):
            self.assertLess(float(x.get("x")) + float(x.get("width")), width)


class PageTest(unittest.TestCase):
    def test_the_page_needs_nothing_else(self):
        text = page([ROW], results(MEASURED))
        self.assertNotRegex(text, r"(src|href)=\"(?!#)|url\(|@import|<script")

    def test_text_of_the_machine_is_escaped(self):
        self.assertIn("A &lt;fast&gt; one", page([ROW], results(MEASURED)))

    def test_warnings_and_missed_aims_are_shown(self):
        text = page([ROW], results(MEASURED, warnings=["the machine is not quiet"]))
        self.assertIn("the machine is not quiet", text)
        self.assertIn("Aims: 0 of 1 met", text)
        self.assertIn("0.83 x the aim", text)

    def test_rows_without_figures_are_left_out(self):
        self.assertNotIn('id="reads"', page([ROW], results({})))

    def test_changes_to_an_older_run_are_shown(self):
        old = results({"reads": {"Castor": {"one": [200, 200, 201], "two": [50, 51, 49]}}}, started="2025-12-24")
        text = page([ROW], results(MEASURED), old)
        self.assertIn("1 of 2 figures have changed beyond noise", text)
        self.assertIn("reads: Castor, one: 0.50 x", text)


class ReportTest(unittest.TestCase):
    def test_figures_have_their_spread_and_aims_their_outcome(self):
        text = figures_text([ROW], results(MEASURED))
        self.assertRegex(text, r"Castor, one +100 +\+- 10 %")
        self.assertIn("aim: one: 120 reads/s or more: missed, 0.83 x the aim", text)

    def test_figures_of_peers_are_ratios_to_those_of_the_same_label(self):
        self.assertIn("Castor is 1.41 x Redis (one)\n", figures_text([ROW], results(MEASURED)))

    def test_one_round_has_no_spread(self):
        self.assertRegex(figures_text([ROW], results({"reads": {"Castor": {"one": [7]}}})), r"one +7\.00 +one round")

    def test_less_is_a_change_for_the_better_where_less_is_better(self):
        old = results({"reads": {"Castor": {"one": [200, 200, 201]}}})
        for higher_is_better, word in ((True, "worse"), (False, "better")):
            text = changes_text([row(higher_is_better=higher_is_better)], old, results(MEASURED))
            self.assertRegex(text, r"Castor, one: 0\.50 x \(0\.45 to 0\.55\), " + word)

    def test_too_few_rounds_are_said(self):
        old = results({"reads": {"Castor": {"one": [200]}}})
        self.assertIn("1 of them have too few rounds", changes_text([ROW], old, results(MEASURED)))


if __name__ == "__main__":
    unittest.main()
