import unittest

import study
from page import page

MACHINE = {"processor": "P", "virtual": False, "cores": 2, "system": "S", "kernel": "K", "memory": "M", "castor": "1"}


def results():
    """Of systems whose costs are known."""
    samples = {}
    for n in (4, 8, 16):
        samples[str(n)] = {
            "start": [0.1], "p50": [500.0], "silent": [1.0], "killed": [0.1], "start_coordinator": [0.01 * n],
            "start_node": [0.02], "idle_coordinator": [0.001 * n], "idle_node": [0.002], "memory_coordinator": [4e6],
            "memory_node": [3e6], "hearing_coordinator": [20e-6], "hearing_node": [100e-6]}
    return {"samples": samples, "machine": MACHINE, "load": {"before": 0, "median": 0, "most": 0}, "rounds": 1,
            "seconds": 1.0, "started": "today", "warnings": []}


def setUpModule():
    # Simulated faster.
    study.ON_PAPER = 2000


class Tables(unittest.TestCase):
    def test_show_what_was_measured(self):
        self.assertIn("| start, of the coordinator, s | 0.04 | 0.08 | 0.16 |", study.measured_table(results()))

    def test_show_what_follows_for_more_nodes(self):
        row = next(x for x in study.laws_table(results()).splitlines() if x.startswith("| start, of the coordinator"))
        self.assertEqual([x.strip() for x in row.split("|")][2:7], ["0.01 n", "0 %", "2.56", "10.0", "20.0"])

    def test_show_the_simulated_beside_the_measured(self):
        text = study.simulated_table(results())
        self.assertIn("| until all have heard, ms | 16, 2 cores | 0.96 | 0.50 |", text)
        self.assertIn("| taken for out of reach by mistake, nodes | 1,000, a machine each | ", text)


class Page(unittest.TestCase):
    def test_has_a_plot_for_each_figure(self):
        rows, shown = study.page_rows(results())
        html = page(rows, shown, title="T")
        self.assertEqual(html.count("<svg"), len(rows))


if __name__ == "__main__":
    unittest.main()
