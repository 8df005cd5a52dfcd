import unittest

from figures import change, figure_of, number, verdict
from results import at_least, results, row
from rows import Aim


class FigureTest(unittest.TestCase):
    def test_a_figure_is_the_median_and_its_spread_half_the_range(self):
        figure = figure_of([100, 300, 110, 90, 105])
        self.assertEqual((figure.median, figure.low, figure.high, figure.count), (105, 90, 300, 5))
        self.assertAlmostEqual(figure.spread, 1.0)

    def test_nothing_measured_is_no_figure(self):
        self.assertIsNone(figure_of([]))


class ChangeTest(unittest.TestCase):
    def compared(self, old, new):
        return change(figure_of(old), figure_of(new))

    def test_spreads_that_do_not_touch_are_a_change(self):
        x = self.compared([100, 102, 98], [120, 125, 115])
        self.assertTrue(x.beyond_noise)
        self.assertAlmostEqual(x.ratio, 1.2)
        self.assertAlmostEqual(x.low, 115 / 102)
        self.assertAlmostEqual(x.high, 125 / 98)

    def test_spreads_that_touch_are_noise_however_far_the_medians_are(self):
        self.assertFalse(self.compared([100, 130, 98], [120, 125, 115]).beyond_noise)

    def test_three_percent_are_no_change_however_narrow_the_spreads_are(self):
        self.assertFalse(self.compared([100, 100, 100], [102.9, 102.9, 102.9]).beyond_noise)
        self.assertTrue(self.compared([100, 100, 100], [96, 96, 96]).beyond_noise)

    def test_two_rounds_do_not_tell_noise_from_change(self):
        self.assertFalse(self.compared([100, 100], [200, 200, 200]).beyond_noise)

    def test_what_was_not_measured_or_is_zero_has_no_ratio(self):
        self.assertIsNone(self.compared([], [1, 1, 1]))
        self.assertIsNone(self.compared([0, 1, 1], [1, 1, 1]))


class VerdictTest(unittest.TestCase):
    def judged(self, aim, **samples):
        return verdict(aim, row(), results({"reads": samples}))

    def test_at_least(self):
        self.assertTrue(self.judged(at_least(10), Castor={"one": [9, 12, 11]}).met)
        missed = self.judged(at_least(20), Castor={"one": [10]})
        self.assertFalse(missed.met)
        self.assertEqual(missed.outcome, "missed, 0.50 x the aim")

    def test_at_most(self):
        aim = Aim("at most", ("Castor", "one"), 40)
        self.assertAlmostEqual(self.judged(aim, Castor={"one": [80]}).ratio, 0.5)
        self.assertTrue(self.judged(aim, Castor={"one": [40]}).met)

    def test_at_least_that_of_a_peer_is_not_judged_without_the_peer(self):
        aim = Aim("at least that of", ("Castor", "one"), other=("Redis", "one"))
        self.assertAlmostEqual(self.judged(aim, Castor={"one": [30]}, Redis={"one": [20]}).ratio, 1.5)
        self.assertIsNone(self.judged(aim, Castor={"one": [30]}))

    def test_at_most_that_of_another_point(self):
        aim = Aim("at most that of", ("Castor", "first"), 0.1, ("Castor", "later"))
        self.assertTrue(self.judged(aim, Castor={"first": [11], "later": [10]}).met)
        self.assertFalse(self.judged(aim, Castor={"first": [12], "later": [10]}).met)

    def test_does_not_fall_compares_the_least_with_the_first(self):
        aim = Aim("does not fall", ("Castor", ""), 0.05)
        self.assertTrue(self.judged(aim, Castor={"one": [100], "two": [96]}).met)
        self.assertFalse(self.judged(aim, Castor={"one": [100], "two": [94], "three": [200]}).met)
        self.assertIsNone(self.judged(aim, Castor={"one": [100]}))


class NumberTest(unittest.TestCase):
    def test_numbers_have_three_digits(self):
        self.assertEqual([number(x) for x in (4.561e6, 177e3, 999.96, 12.34, 1.234, 0.01234, 0, 2e9)],
                         ["4.56 M", "177 k", "1.00 k", "12.3", "1.23", "0.0123", "0", "2.00 G"])


if __name__ == "__main__":
    unittest.main()
