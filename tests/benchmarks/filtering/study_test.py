import unittest
from dataclasses import asdict

import model
import robots
import study


def results_of(case, **figures):
    return {"synthetic": [dict(asdict(case), samples={name: [value] for name, value in figures.items()})], "robots": {}}


class Study(unittest.TestCase):
    case = study.Case(12, "m", 0.0, model.BROADCAST)

    def test_counts_are_compared_with_the_model(self):
        right = results_of(self.case, forwarded=2.0, deliveries=12.0, rejected=9.0)
        self.assertEqual(study.disagreements(right), [])
        wrong = results_of(self.case, forwarded=2.0, deliveries=12.0, rejected=9.1)
        self.assertEqual(len(study.disagreements(wrong)), 1)
        self.assertIn("wasted are 9.100, by the model 9.000", study.disagreements(wrong)[0])

    def test_what_was_not_measured_is_left_empty(self):
        table = study.synthetic_table(results_of(self.case, processor=50.0, p50=20.0), 0)
        self.assertIn("| one for each module |  | 50.0 |  | 20 |", table)

    def test_layouts_of_robots_that_do_not_run_are_counted(self):
        common = {"subarchitectures": 2, "components": 10, "changes": 100, "own": 20}
        runs = {model.FILTERED: dict(common, messages=50, deliveries=150, rejected=0),
                model.BROADCAST: dict(common, messages=100, deliveries=1000, rejected=850)}
        one, measured, each = study.robot_layouts(runs)
        self.assertEqual(one, ("1, counted", {model.BROADCAST: (0, 10, 8.5), model.FILTERED: (0, 1.5, 0)}))
        self.assertEqual(measured, ("2, measured", {model.BROADCAST: (1, 10, 8.5), model.FILTERED: (0.5, 1.5, 0)}))
        self.assertEqual(each, ("10, counted", {model.BROADCAST: (9, 10, 8.5), model.FILTERED: (1.3, 1.5, 0)}))

    def test_robots_are_moved_into_one_subarchitecture(self):
        where = {"class": "Driver", "kind": "unmanaged", "name": "driver",
                 "options": [{"key": "--path", "value": 'a "b"'}, {"key": "--pose", "value": "slam"}]}
        robot = {"class": "Robot", "name": "robot", "options": [{"key": "--lease", "value": "navigation/seat"}]}
        options = {"Driver": {"path": {"kind": "text", "default": ""},
                              "pose": {"kind": "name of a subarchitecture", "default": ""},
                              "map": {"kind": "name of a subarchitecture", "default": "mapping"},
                              "own": {"kind": "name of a subarchitecture", "default": ""}},
                   "Robot": {"lease": {"kind": "text", "default": ""}}}
        text = robots.in_one_subarchitecture({"standalone": [robot], "subarchitectures": [{"components": [where]}]},
                                             options, "/configs")
        self.assertEqual(text.splitlines(), [
            'COMPONENT CPP robot Robot --lease "all/seat"', "SUBARCHITECTURE all",
            "CPP WM SubarchitectureWorkingMemory", "CPP TM AlwaysPositiveTaskManager",
            'CPP UM driver Driver --path "a \\"b\\"" --pose "all" --map "all"'])

    def test_counters_of_a_system_are_added_up(self):
        memory = {"forwarded": 3, "matched": 7, "filters": 2}
        status = {"working_memories": [dict(memory, subarchitecture="castor", events=1),
                                       dict(memory, subarchitecture="a", events=5)],
                  "components": [{"name": "a_tm", "subarchitecture": "a", "rejected": 0},
                                 {"name": "x", "subarchitecture": "a", "rejected": 4},
                                 {"name": "camera", "subarchitecture": "", "rejected": 0}],
                  "nodes": [{"cpu": 0.5}, {"cpu": 0.25}]}
        usage = {"component": "x", "subarchitecture": "a", "type": "T", "adds": 1, "overwrites": 1, "deletes": 0}
        self.assertEqual(robots.figures_of(status, [dict(usage, events=6)]),
                         {"subarchitectures": 1, "components": 1, "changes": 5, "messages": 3, "deliveries": 7,
                          "own": 2, "rejected": 4, "filters": 2, "processor": 0.75})


if __name__ == "__main__":
    unittest.main()
