import unittest

import laws
from laws import Law


class Fits(unittest.TestCase):
    sizes = (4, 8, 16, 32, 64)

    def fit(self, law, powers):
        return laws.fit({n: law.at(n) for n in self.sizes}, powers)

    def test_find_the_law(self):
        for law in (Law(2.0, 0.5, 0.01), Law(2.0, 0.5), Law(2.0)):
            found = self.fit(law, (0, 1, 2))
            for n in (4, 64, 1000):
                self.assertAlmostEqual(found.at(n) / law.at(n), 1.0, places=6)

    def test_have_no_negative_terms(self):
        figures = {4: 10.0, 8: 9.0, 16: 9.5, 32: 9.0, 64: 8.0}
        found = laws.fit(figures, (0, 1, 2))
        self.assertTrue(all(x >= 0 for x in (found.constant, found.linear, found.square)))
        self.assertAlmostEqual(found.at(1000), found.at(4))
        self.assertGreater(laws.deviation(found, figures), 0.05)

    def test_weigh_shares_not_differences(self):
        found = laws.fit({1: 1.0, 1000: 1100.0}, (1,))
        self.assertAlmostEqual(found.linear, 1.05, delta=0.01)


if __name__ == "__main__":
    unittest.main()
