"""Figures with their spread: samples of interleaved rounds, aims, and comparisons with an older run. No clocks, no
files, no processes.

Results are JSON: {"rows": {ROW: {LINE: {LABEL: [sample of each round]}}}, ...}.
"""

import statistics
from dataclasses import dataclass

from rows import CASTOR

# Changes below this share are never called changes: code that is laid out otherwise makes as much.
LEAST_CHANGE = 0.03
# Of fewer samples, spread says nothing.
LEAST_SAMPLES = 3


@dataclass(frozen=True)
class Figure:
    """Median, least and greatest of some samples."""

    median: float
    low: float
    high: float
    count: int

    @property
    def spread(self):
        """Half the range, as a share of the median."""
        return (self.high - self.low) / 2 / self.median if self.median else 0.0


def figure_of(samples):
    """None if there are no samples."""
    if not samples:
        return None
    return Figure(statistics.median(samples), min(samples), max(samples), len(samples))


def figure_at(results, row, point):
    """The figure of (line, label) in a row of the results; None if it was not measured."""
    line, label = point
    return figure_of(results["rows"].get(row, {}).get(line, {}).get(label, []))


def length_of_round(results):
    """How much of each figure is measured in a round."""
    return f"{results['changes']} changes by each component" if "changes" in results else f"{results['seconds']:g} s"


@dataclass(frozen=True)
class Verdict:
    """Whether an aim is met. `ratio` is how good the figure is, as a multiple of the aim: 1 and more is met."""

    text: str
    ratio: float

    @property
    def met(self):
        return self.ratio >= 1

    @property
    def outcome(self):
        """As `met, 1.25 x the aim`."""
        return f"{'met' if self.met else 'missed'}, {self.ratio:.2f} x the aim"


def verdict(aim, row, results):
    """None if something was not measured."""
    if aim.kind == "does not fall":
        return _verdict_of_fall(aim, row, results)
    figure = figure_at(results, row.name, aim.point)
    if figure is None:
        return None
    line, label = aim.point
    what = label if line == CASTOR else f"{line}, {label}"
    if aim.kind in ("at least that of", "at most that of"):
        other = figure_at(results, row.name, aim.other)
        if other is None:
            return None
        if aim.kind == "at most that of":
            return Verdict(f"{what}: no longer than {aim.other[1]}", other.median * (1 + aim.value) / figure.median)
        return Verdict(f"{what}: not below {aim.other[0]}", figure.median / other.median)
    wanted = f"{number(aim.value)} {row.unit}"
    if aim.kind == "at most":
        return Verdict(f"{what}: {wanted} or less", aim.value / figure.median)
    return Verdict(f"{what}: {wanted} or more", figure.median / aim.value)


def _verdict_of_fall(aim, row, results):
    figures = [figure_of(x) for x in results["rows"].get(row.name, {}).get(aim.point[0], {}).values()]
    figures = [x.median for x in figures if x is not None]
    if len(figures) < 2:
        return None
    wanted = figures[0] * (1 - aim.value)
    line = aim.point[0]
    what = "" if line == CASTOR else f"{line}: "
    return Verdict(what + "does not fall as more are added", min(figures[1:]) / wanted)


@dataclass(frozen=True)
class Change:
    """New median by old median, and within what that lies if both are anywhere in their spreads."""

    ratio: float
    low: float
    high: float
    # Whether there are samples enough to tell.
    enough: bool

    @property
    def beyond_noise(self):
        far = abs(self.ratio - 1) >= LEAST_CHANGE
        return self.enough and far and not self.low <= 1 <= self.high


def change(old, new):
    """None if either was not measured, or a ratio says nothing."""
    if old is None or new is None or old.low <= 0 or new.low <= 0:
        return None
    return Change(new.median / old.median, new.low / old.high, new.high / old.low,
                  min(old.count, new.count) >= LEAST_SAMPLES)


def number(x):
    """With three significant digits, and k, M or G: 4.56 M, 177 k, 0.123."""
    for size, letter in ((1e9, " G"), (1e6, " M"), (1e3, " k")):
        if abs(x) >= size * 0.9995:
            return _digits(x / size) + letter
    return _digits(x)


def _digits(x):
    if x == 0:
        return "0"
    if abs(x) >= 99.95:
        return f"{x:.0f}"
    if abs(x) >= 9.995:
        return f"{x:.1f}"
    return f"{x:.2f}" if abs(x) >= 0.1 else f"{x:.3g}"
