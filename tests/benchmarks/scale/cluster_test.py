import unittest

import cluster
from cluster import LATENCY, Costs


def costs(**others):
    return Costs(**{"start_coordinator": 0.0, "start_node": 0.0, "hearing_coordinator": 0.0, "hearing_node": 0.0,
                    **others})


class Starts(unittest.TestCase):
    def test_without_work_take_the_way_of_the_messages(self):
        # There and back, for reaching the nodes and for each phase.
        self.assertAlmostEqual(cluster.time_to_start(5, costs()), 2 * LATENCY * (1 + cluster.PHASES))

    def test_work_of_nodes_is_done_at_once_on_machines_of_their_own(self):
        alone = cluster.time_to_start(1, costs(start_node=1.0))
        self.assertAlmostEqual(cluster.time_to_start(50, costs(start_node=1.0)), alone)
        self.assertAlmostEqual(cluster.time_to_start(50, costs(start_node=1.0), shared=2), 25.0)

    def test_work_of_the_coordinator_is_done_one_after_another(self):
        self.assertGreater(cluster.time_to_start(50, costs(start_coordinator=1.0)), 1.0)
        self.assertLess(cluster.time_to_start(50, costs(start_coordinator=1.0)), 1.01)


class Events(unittest.TestCase):
    def test_reach_one_node_after_the_other(self):
        found = cluster.time_to_hear(10, costs(hearing_coordinator=1.0, hearing_node=0.5))
        self.assertAlmostEqual(found, 10 + LATENCY + 0.5)

    def test_share_processors(self):
        self.assertAlmostEqual(cluster.time_to_hear(10, costs(hearing_node=1.0), shared=2), 5.0)


class Losses(unittest.TestCase):
    def test_are_noticed_after_the_silence(self):
        for seed in range(5):
            seconds, mistakes = cluster.time_to_notice(20, costs(), seed)
            self.assertGreater(seconds, cluster.SILENCE - cluster.HEARTBEAT)
            self.assertLess(seconds, cluster.SILENCE + cluster.GLANCE)
            self.assertEqual(mistakes, 0)

    def test_are_noticed_late_by_a_coordinator_that_cannot_keep_up(self):
        seconds, _ = cluster.time_to_notice(20, costs(idle_coordinator=1.5))
        self.assertGreater(seconds, cluster.SILENCE + 1)

    def test_others_are_taken_for_lost_where_heartbeats_are_handled_too_rarely(self):
        _, mistakes = cluster.time_to_notice(20, costs(idle_coordinator=5.0))
        self.assertGreater(mistakes, 0)


if __name__ == "__main__":
    unittest.main()
