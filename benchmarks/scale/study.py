"""What scripts/scale-study measures and simulates, and how it shows it: as text, Markdown, and rows for the page. Pure.

Results are JSON: {"samples": {NODES: {FIGURE: [sample of each round]}}, ...}; figures are those of `performance_castor
mesh`.
"""

import statistics

import cluster
import laws
from docs_table import machine_text, markdown_table
from figures import number
from rows import Line, Point, Row

SIMULATED = (256, 1000)
ON_PAPER = 10_000
# By what the cost of one process grows with the number of nodes: powers of it.
GROWTH = {
    "start_coordinator": (0, 1, 2),
    "start_node": (0, 1, 2),
    "memory_coordinator": (0, 1, 2),
    "memory_node": (0, 1),
    "idle_coordinator": (0, 1),
    "idle_node": (0, 1),
    "hearing_coordinator": (0,),
    "hearing_node": (0,),
}
# Title, unit, and how many of it are one of what is measured.
COSTS = {
    "start_coordinator": ("start, of the coordinator", "s", 1),
    "start_node": ("start, of each node", "s", 1),
    "idle_coordinator": ("nothing happens, the coordinator", "% of a core", 100),
    "idle_node": ("nothing happens, each node", "% of a core", 100),
    "memory_coordinator": ("memory of the coordinator", "MB", 1e-6),
    "memory_node": ("memory of each node", "MB", 1e-6),
    "hearing_coordinator": ("an event to one node, of the coordinator", "us", 1e6),
    "hearing_node": ("an event to one node, of the node", "us", 1e6),
}


def medians(results, figure):
    """{nodes: median}"""
    return {int(n): statistics.median(x[figure]) for n, x in results["samples"].items() if x.get(figure)}


def laws_of(results):
    """{figure: law}; of few nodes, what does not depend on them weighs most, so they are left out for hearing."""
    found = {}
    for figure, powers in GROWTH.items():
        figures = medians(results, figure)
        if powers == (0,):
            most = max(figures)
            figures = {most: figures[most]}
        found[figure] = laws.fit(figures, powers[:len(figures)])
    return found


def costs(found, nodes):
    return cluster.Costs(*(found[x].at(nodes) for x in (
        "start_coordinator", "start_node", "hearing_coordinator", "hearing_node", "idle_coordinator")))


# -- tables


def measured_table(results):
    sizes = sorted(int(x) for x in results["samples"])
    figures = {"start": ("until all run", "s", 1), "p50": ("until all have heard, median", "ms", 1e-3),
               "silent": ("until a node that stopped is out of reach", "s", 1),
               "killed": ("until a node that was killed is out of reach", "s", 1), **COSTS}
    rows = []
    for figure, (title, unit, factor) in figures.items():
        known = medians(results, figure)
        rows.append([f"{title}, {unit}"] + [number(known[n] * factor) if n in known else "" for n in sizes])
    return machine_text(results) + "\n\n" + markdown_table(["", *(f"{n} nodes" for n in sizes)], rows)


def laws_table(results):
    rows = []
    for figure, law in laws_of(results).items():
        title, unit, factor = COSTS[figure]
        terms = [(law.constant, ""), (law.linear, " n"), (law.square, " n^2")]
        text = " + ".join(f"{number(x * factor)}{power}" for x, power in terms if x > 0)
        off = laws.deviation(law, medians(results, figure)) if GROWTH[figure] != (0,) else None
        rows.append([f"{title}, {unit}", text, "" if off is None else f"{100 * off:.0f} %",
                     *(number(law.at(n) * factor) for n in (*SIMULATED, ON_PAPER))])
    head = ["", "for n nodes", "off by at most", *(f"{n:,} nodes" for n in (*SIMULATED, ON_PAPER))]
    return markdown_table(head, rows)


def simulated_rows(results):
    """{(title, unit): {label: value}}: the measured systems with the processors that they share, to be compared; and
    systems of machines of their own."""
    found = laws_of(results)
    shared = results["machine"]["cores"]
    rows = {("until all run", "s"): {}, ("until all have heard", "ms"): {}, ("out of reach after", "s"): {},
            ("taken for out of reach by mistake", "nodes"): {}}
    start, heard, noticed, mistaken = rows.values()
    for n in sorted(int(x) for x in results["samples"]):
        label = f"{n}, {shared} cores"
        start[label] = (cluster.time_to_start(n, costs(found, n), shared), medians(results, "start").get(n))
        heard[label] = (1e3 * cluster.time_to_hear(n, costs(found, n), shared), 1e-3 * medians(results, "p50").get(n, 0))
    for n in (max(int(x) for x in results["samples"]), *SIMULATED, ON_PAPER):
        label = f"{n:,}, a machine each"
        start[label] = (cluster.time_to_start(n, costs(found, n)), None)
        heard[label] = (1e3 * cluster.time_to_hear(n, costs(found, n)), None)
        seconds, mistakes = cluster.time_to_notice(n, costs(found, n))
        noticed[label], mistaken[label] = (seconds, None), (mistakes, None)
    return rows


def simulated_table(results):
    rows = []
    for (title, unit), values in simulated_rows(results).items():
        for label, (simulated, measured) in values.items():
            rows.append([f"{title}, {unit}", label, number(simulated), number(measured) if measured else ""])
    return markdown_table(["", "nodes", "simulated", "measured"], rows)


def tables(results):
    """(mark in the docs, Markdown)."""
    return [("measured", measured_table(results)), ("laws", laws_table(results)),
            ("simulated", simulated_table(results))]


# -- the page


def _meaning(unit):
    return "Memory of one process." if unit == "MB" else "Processor time of one process."


def page_rows(results):
    """Rows of the page, and the results as it wants them."""
    rows, samples = [], {}
    for figure, (title, unit, factor) in COSTS.items():
        points = []
        for n in sorted(int(x) for x in results["samples"]):
            label = f"{n} nodes"
            points.append(Point(label, None, figure))
            found = results["samples"][str(n)].get(figure)
            if found:
                samples.setdefault(figure, {}).setdefault("measured", {})[label] = [x * factor for x in found]
        rows.append(Row(figure, title[0].upper() + title[1:], _meaning(unit), unit,
                        (Line("measured", tuple(points)),), higher_is_better=False))
    for (title, unit), values in simulated_rows(results).items():
        for place in ("cores", "a machine each"):
            # 10,000 nodes are in the table: bars for them would leave no room for the others.
            shown = {k: x for k, x in values.items() if k.endswith(place) and not k.startswith(f"{ON_PAPER:,}")}
            if not shown:
                continue
            name = f"{title}, {place}"
            for label, (simulated, measured) in shown.items():
                samples.setdefault(name, {}).setdefault("simulated", {})[label] = [simulated]
                if measured:
                    samples[name].setdefault("measured", {})[label] = [measured]
            lines = tuple(Line(x, tuple(Point(label, None) for label in shown)) for x in ("simulated", "measured"))
            rows.append(Row(name, title[0].upper() + title[1:], "Simulated with the costs that were measured.", unit,
                            lines, higher_is_better=False))
    return rows, dict(results, rows=samples)
