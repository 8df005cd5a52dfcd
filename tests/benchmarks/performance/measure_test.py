import unittest

from measure import Measurement, MeasurementError, figures_of, runs_of, without_absent
from results import row
from rows import ROWS, Line, Point, run


class NoLoad:
    def share_since(self):
        return 0.25


class Programs:
    """Counts its runs, and gives the number of each as its figure."""

    def __init__(self, failing=None, interrupted_after=None):
        self.load = NoLoad()
        self.runs = []
        self.failing = failing
        self.interrupted_after = interrupted_after

    def run(self, x):
        self.runs.append(x.measurement)
        if x.measurement == self.failing:
            raise MeasurementError("it fails")
        if len(self.runs) == self.interrupted_after:
            raise KeyboardInterrupt
        return {"rate": float(len(self.runs))}


class MeasurementTest(unittest.TestCase):
    def test_rounds_go_over_all_runs(self):
        programs = Programs()
        work = Measurement([row()], programs, 2, 2)
        work.work()
        self.assertEqual(programs.runs, ["one", "two", "one", "two"])
        self.assertEqual(work.samples, {"reads": {"Castor": {"one": [1, 3], "two": [2, 4]}}})

    def test_slow_rows_have_fewer_rounds(self):
        programs = Programs()
        Measurement([row(labels=("fast",)), row(labels=("slow",), name="other", slow=True)], programs, 3, 1).work()
        self.assertEqual(programs.runs, ["fast", "slow", "fast", "fast"])

    def test_a_run_that_several_figures_come_from_is_run_once(self):
        shared = run("castor", "both")
        points = (Point("a", shared, "rate"), Point("b", shared, "rate", 10))
        both = row()
        both = type(both)("both", "", "", "", (Line("Castor", points),))
        work = Measurement([both], Programs(), 1, 1)
        work.work()
        self.assertEqual(work.samples, {"both": {"Castor": {"a": [1], "b": [10]}}})

    def test_what_was_measured_before_an_interruption_is_kept(self):
        work = Measurement([row()], Programs(interrupted_after=3), 2, 2)
        with self.assertRaises(KeyboardInterrupt):
            work.work()
        self.assertEqual(work.samples, {"reads": {"Castor": {"one": [1], "two": [2]}}})

    def test_a_run_that_fails_is_not_tried_again_and_others_go_on(self):
        programs = Programs(failing="one")
        work = Measurement([row()], programs, 2, 2)
        work.work()
        self.assertEqual(programs.runs, ["one", "two", "two"])
        self.assertEqual(list(work.failures.values()), ["it fails"])

    def test_absent_peers_are_left_out(self):
        x = row(lines=("Castor", "Redis"))
        x = type(x)(x.name, "", "", "", (x.lines[0], Line("Redis", x.lines[1].points, "Redis")))
        self.assertEqual([line.name for line in without_absent([x], {"Redis"})[0].lines], ["Castor"])


class OutputTest(unittest.TestCase):
    def test_figures_are_whole_lines(self):
        self.assertEqual(figures_of("figure rate 1.5e6\nno figure x 1\nfigure p50 12\n"), {"rate": 1.5e6, "p50": 12})


class RowsTest(unittest.TestCase):
    def test_names_and_points_are_unambiguous(self):
        self.assertEqual(len({x.name for x in ROWS}), len(ROWS))
        for x in ROWS:
            points = [(line.name, point.label) for line in x.lines for point in line.points]
            self.assertEqual(len(set(points)), len(points), x.name)

    def test_aims_are_about_points_that_exist(self):
        for x in ROWS:
            points = {(line.name, point.label) for line in x.lines for point in line.points}
            points |= {(line.name, "") for line in x.lines}
            for aim in x.aims:
                self.assertIn(aim.point, points)
                self.assertTrue(not aim.other or aim.other in points)

    def test_no_run_is_scheduled_twice_in_a_round(self):
        runs = list(runs_of(ROWS))
        self.assertEqual(len(set(map(str, runs))), len(runs))


if __name__ == "__main__":
    unittest.main()
