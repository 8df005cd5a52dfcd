import unittest

import model
from model import BROADCAST, FILTERED, FORWARDED, Counts


class CountsOfChanges(unittest.TestCase):
    """Two subarchitectures, a and b, then c; a is heard by b and by c, and nobody else is heard."""

    hears = {"a": [], "b": ["a"], "c": ["a"]}

    def counts(self, layout, scheme):
        x = model.counts(layout, self.hears, scheme)
        return tuple(round(3 * y) for y in (x.messages, x.deliveries, x.wasted))

    def test_broadcasts_go_to_all(self):
        self.assertEqual(self.counts([["a", "b"], ["c"]], BROADCAST), (3, 9, 7))
        self.assertEqual(self.counts([["a", "b", "c"]], BROADCAST), (0, 9, 7))
        self.assertEqual(self.counts([["a"], ["b"], ["c"]], BROADCAST), (6, 9, 7))

    def test_between_working_memories_only_what_is_wanted_passes(self):
        # a: to both subarchitectures, three components. b: to a and b. c: to c.
        self.assertEqual(self.counts([["a", "b"], ["c"]], FORWARDED), (1, 6, 4))
        self.assertEqual(self.counts([["a", "b", "c"]], FORWARDED), (0, 9, 7))

    def test_within_them_too(self):
        self.assertEqual(self.counts([["a", "b"], ["c"]], FILTERED), (1, 2, 0))
        self.assertEqual(self.counts([["a", "b", "c"]], FILTERED), (0, 2, 0))
        self.assertEqual(self.counts([["a"], ["b"], ["c"]], FILTERED), (2, 2, 0))

    def test_nobody_needs_to_want_anything(self):
        self.assertEqual(model.counts([["a"]], {"a": []}, FILTERED), Counts(0, 0, 0))


class SyntheticSystems(unittest.TestCase):
    def test_interest_is_shared_out_as_asked(self):
        groups = model.modules(12, 4)
        for across, far in ((0.0, 0), (1 / 3, 1), (1.0, 3)):
            hears = model.interests(groups, 3, across)
            for group in groups:
                for component in group:
                    self.assertEqual(len(set(hears[component])), 3)
                    self.assertNotIn(component, hears[component])
                    self.assertEqual(sum(x not in group for x in hears[component]), far)

    def test_each_layout_has_the_same_components(self):
        groups = model.modules(8, 4)
        layouts = model.layouts(groups)
        self.assertEqual([len(x) for x in layouts.values()], [1, 2, 8])
        for layout in layouts.values():
            self.assertEqual(sorted(x for place in layout for x in place), sorted(x for group in groups for x in group))

    def test_components_stay_at_the_node_of_their_module(self):
        groups = [["c0", "c1"], ["c2", "c3"]]
        text = model.cast_text([["c0", "c1", "c2", "c3"]], {x: [] for g in groups for x in g}, groups, 5, "1ms", nodes=2)
        self.assertIn("SUBARCHITECTURE s0 node0\n", text)
        self.assertIn("[node0] CPP UM c1 Talker --changes 5 --pause 1ms\n", text)
        self.assertIn("[node1] CPP UM c2 Talker", text)


if __name__ == "__main__":
    unittest.main()
