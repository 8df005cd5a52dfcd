"""What scripts/filtering-study measures, and how it shows it: as text, Markdown, and rows for the page. Pure.

Results are JSON: {"synthetic": [{...Case, "samples": {FIGURE: [sample of each round]}}], "robots": {NAME: {SCHEME:
figures_of}}, ...}.
"""

import statistics
from dataclasses import asdict, dataclass

import model
from docs_table import machine_text, markdown_table
from rows import Line, Point, Row

# Modules of four components, each of which wants to hear of three others.
MODULE, WANTED = 4, 3
SHARES = (0.0, 1 / 3, 1.0)
SIZES = (12, 24, 48)
PLACES = {0: "one process", 3: "three processes"}
LAYOUTS = {"1": "1 subarchitecture", "m": "one for each module", "n": "one for each component"}
MEASURED_SCHEMES = {model.BROADCAST: 1, model.FILTERED: 0}
# How far a count may be from the model's: changes that were under way, of some thousands.
TOLERANCE = 0.005


@dataclass(frozen=True)
class Case:
    """A synthetic system, and the scheme by which it hears of changes."""

    components: int
    layout: str
    across: float
    scheme: str
    nodes: int = 0

    def groups(self):
        return model.modules(self.components, MODULE)

    def hears(self):
        return model.interests(self.groups(), WANTED, self.across)

    def places(self):
        return model.layouts(self.groups())[self.layout]

    def text(self, changes, pause):
        return model.cast_text(self.places(), self.hears(), self.groups(), changes, pause, self.nodes)

    def expected(self):
        return model.counts(self.places(), self.hears(), self.scheme)


def cases():
    """Those of one size over the shares of interest, in one process and in several; then larger ones."""
    result = [Case(SIZES[0], layout, share, scheme, nodes)
              for nodes in PLACES for share in SHARES for layout in LAYOUTS for scheme in MEASURED_SCHEMES]
    return result + [Case(size, layout, SHARES[1], scheme)
                     for size in SIZES[1:] for layout in LAYOUTS for scheme in MEASURED_SCHEMES]


def samples_of(results, case):
    """{figure: samples} of a case; empty if it was not measured."""
    wanted = asdict(case)
    return next((x["samples"] for x in results["synthetic"] if {k: x[k] for k in wanted} == wanted), {})


def median_of(results, case, figure):
    samples = samples_of(results, case).get(figure)
    return statistics.median(samples) if samples else None


def disagreements(results):
    """Texts about counts that differ from the model's."""
    result = []
    for case in cases():
        if not samples_of(results, case):
            continue
        expected = case.expected()
        wasted = median_of(results, case, "rejected")
        for name, measured, wanted in (("messages", median_of(results, case, "forwarded"), expected.messages),
                                       ("deliveries", median_of(results, case, "deliveries"), expected.deliveries),
                                       ("wasted", wasted, expected.wasted)):
            if abs(measured - wanted) > TOLERANCE * max(wanted, 1):
                result.append(f"{case}: {name} are {measured:.3f}, by the model {wanted:.3f}")
    return result


# -- tables


def _percent(share):
    return f"{100 * share:.0f} %"


def _number(x, digits=1):
    return "" if x is None else f"{x:.{digits}f}"


def model_table():
    """Counts by the model, for all three schemes."""
    rows = []
    for share in SHARES:
        for layout, title in LAYOUTS.items():
            cells = [_percent(share) if layout == "1" else "", title]
            for scheme in model.SCHEMES:
                x = Case(SIZES[0], layout, share, scheme).expected()
                cells.append(f"{x.messages:.1f} / {x.deliveries:.1f} / {x.wasted:.1f}")
            rows.append(cells)
    return markdown_table(["interest across", "subarchitectures", *model.SCHEMES], rows)


def synthetic_table(results, nodes):
    """Costs of each change."""
    head = ["interest across", "subarchitectures", "processor, us", "broadcast"]
    head += ["bytes on links", "broadcast"] if nodes else ["heard after (median), us", "broadcast"]
    other = "bytes" if nodes else "p50"
    rows = []
    for share in SHARES:
        for layout, title in LAYOUTS.items():
            both = [Case(SIZES[0], layout, share, x, nodes) for x in (model.FILTERED, model.BROADCAST)]
            rows.append([_percent(share) if layout == "1" else "", title,
                         *(_number(median_of(results, x, "processor")) for x in both),
                         *(_number(median_of(results, x, other), 0) for x in both)])
    return markdown_table(head, rows)


def size_table(results):
    rows = []
    for size in SIZES:
        for layout, title in LAYOUTS.items():
            both = [Case(size, layout, SHARES[1], x) for x in (model.FILTERED, model.BROADCAST)]
            rows.append([str(size) if layout == "1" else "", title,
                         *(_number(median_of(results, x, "processor")) for x in both),
                         *(_number(median_of(results, x, "p50"), 0) for x in both)])
    return markdown_table(["components", "subarchitectures", "processor, us", "broadcast", "heard after (median), us",
                           "broadcast"], rows)


def in_one(scheme):
    """Name of the runs of a robot's system in one subarchitecture."""
    return f"{scheme}, in one"


def _each(name, system):
    return system[name] / system["changes"]


def _measured(runs, name=lambda scheme: scheme):
    """{scheme: (messages, deliveries, wasted)} for each change."""
    return {scheme: tuple(_each(x, runs[name(scheme)]) for x in ("messages", "deliveries", "rejected"))
            for scheme in MEASURED_SCHEMES}


def robot_layouts(runs):
    """(layout, {scheme: (messages, deliveries, wasted)}) for each change of a robot's system. That with its own
    subarchitectures is measured, that with one where the system does the same in it; else they are counted from what
    was wanted."""
    filtered = runs[model.FILTERED]
    n, wanted = filtered["components"], _each("deliveries", filtered)
    # An event about a change of one's own is no message if everybody is alone.
    foreign = wanted - _each("own", filtered)
    if in_one(model.FILTERED) in runs and in_one(model.BROADCAST) in runs:
        one = "1, measured", _measured(runs, in_one)
    else:
        one = "1, counted", {model.BROADCAST: (0.0, n, n - wanted), model.FILTERED: (0.0, wanted, 0.0)}
    return [one, (f"{filtered['subarchitectures']}, measured", _measured(runs)),
            (f"{n}, counted", {model.BROADCAST: (n - 1.0, n, n - wanted), model.FILTERED: (foreign, wanted, 0.0)})]


def _complete(results, robots):
    """(robot, its runs) for those that were measured with both schemes."""
    for robot in robots:
        runs = results["robots"].get(robot.name, {})
        if set(MEASURED_SCHEMES) <= set(runs):
            yield robot, runs


def robot_table(results, robots):
    rows = []
    for robot, runs in _complete(results, robots):
        for i, (layout, schemes) in enumerate(robot_layouts(runs)):
            rows.append([robot.title if i == 0 else "", layout,
                         *(" / ".join(f"{x:.2f}" for x in schemes[scheme]) for scheme in MEASURED_SCHEMES)])
    return markdown_table(["system", "subarchitectures", *MEASURED_SCHEMES], rows)


def robot_cost_table(results, robots):
    rows = []
    for robot, runs in _complete(results, robots):
        for name in (in_one, lambda scheme: scheme):
            if name(model.FILTERED) in runs and name(model.BROADCAST) in runs:
                x = runs[name(model.FILTERED)]
                rows.append([robot.title, str(x["subarchitectures"]), str(x["components"]), str(x["changes"]),
                             *(f"{runs[name(y)]['processor']:.1f} s" for y in (model.FILTERED, model.BROADCAST))])
    return markdown_table(["system", "subarchitectures", "components", "changes", "processor", "broadcast"], rows)


def tables(results, robots):
    """(mark, Markdown) of each table in docs/filtering.md."""
    return [("model", model_table()),
            ("one process", machine_text(results) + "\n\n" + synthetic_table(results, 0)),
            ("three processes", synthetic_table(results, 3)),
            ("sizes", size_table(results)),
            ("robots", robot_table(results, robots)),
            ("costs of robots", robot_cost_table(results, robots))]


# -- the page

FIGURES = {
    "processor": ("Processor time of each change", "us", "Of all processes, from the write to the last callback."),
    "p50": ("Until a component has heard", "us", "Median, from the change to the callback."),
    "bytes": ("Bytes on links", "B", "For each change, heartbeats included."),
    "forwarded": ("Messages between working memories", "for each change", ""),
    "rejected": ("Events that a component has to filter out", "for each change", ""),
}


def page_rows(results):
    """Rows of the page, and the results as it wants them."""
    rows, samples = [], {}
    for nodes, place in PLACES.items():
        for figure, (title, unit, meaning) in FIGURES.items():
            if figure == ("p50" if nodes else "bytes"):
                continue
            name = f"{figure}-{nodes}"
            lines = []
            for scheme in MEASURED_SCHEMES:
                points = []
                for share in SHARES:
                    for layout in LAYOUTS:
                        label = f"{_percent(share)} across, {LAYOUTS[layout]}"
                        points.append(Point(label, None, figure))
                        found = samples_of(results, Case(SIZES[0], layout, share, scheme, nodes)).get(figure)
                        if found:
                            samples.setdefault(name, {}).setdefault(scheme, {})[label] = found
                lines.append(Line(scheme, tuple(points)))
            rows.append(Row(name, f"{title}, {place}", meaning, unit, tuple(lines), higher_is_better=False))
    return rows, dict(results, rows=samples)
