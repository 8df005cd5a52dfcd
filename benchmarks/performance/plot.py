"""Bars of a row's figures, as inline SVG whose colours are those of the page. Pure."""

from html import escape

from figures import figure_at, number

# Of the picture; it is as wide as a phone, and scaled up on wider screens.
WIDTH = 360
LEAST_NAME_WIDTH = 112
# Of a letter, about, at the size that the page has for plots.
LETTER_WIDTH = 5.6
VALUE_WIDTH = 58
BAR = 12
STEP = 19
HEADING = 20


class Bars:
    """The bars of a row: one for each figure, by label, and in each label by line."""

    def __init__(self, row, results, old=None):
        self.row, self.results, self.old = row, results, old
        self.shown = [x for x in row.lines if results["rows"].get(row.name, {}).get(x.name)]
        self.aims = {aim.point: aim.value for aim in row.aims if aim.kind in ("at least", "at most")}
        figures = [figure_at(results, row.name, point) for point in self._points()]
        ends = [x.high for x in figures if x] + [self.aims[x] for x in self._points() if x in self.aims]
        self.most = max(ends, default=0) or 1.0
        names = [x.name for x in self.shown] if len(self.shown) > 1 else self._labels()
        self.name_width = max(LEAST_NAME_WIDTH, max(map(len, names), default=0) * LETTER_WIDTH + 6)

    def _points(self):
        return [(line.name, point.label) for line in self.shown for point in line.points]

    def _labels(self):
        """Labels in the order of their first line."""
        return list(dict.fromkeys(label for _, label in self._points()))

    def svg(self):
        parts = []
        y = 4
        several = len(self.shown) > 1
        for label in self._labels():
            if several and len(self._labels()) > 1:
                parts.append(_text(0, y + 13, label, "heading"))
                y += HEADING
            for i, line in enumerate(self.shown):
                figure = figure_at(self.results, self.row.name, (line.name, label))
                if figure is not None:
                    parts.append(self._bar(y, line.name if several else label, (line.name, label), i, figure))
                    y += STEP
        title = f"{self.row.title}, {self.row.unit}"
        return (f'<svg viewBox="0 0 {WIDTH} {y + 2}" role="img" aria-label="{escape(title)}">'
                + "".join(parts) + "</svg>")

    def _x(self, value):
        return self.name_width + value / self.most * (WIDTH - self.name_width - VALUE_WIDTH)

    def _bar(self, y, name, point, i, figure):
        middle = y + BAR / 2
        end = self._x(figure.median)
        tip = (f"{', '.join(point)}: {number(figure.median)} {self.row.unit}, {number(figure.low)} to "
               f"{number(figure.high)} in {figure.count} rounds")
        parts = [f'<g class="s{min(i, 4)}"><title>{escape(tip)}</title>', _text(self.name_width - 6, y + 10, name, "name"),
                 f'<rect x="{self.name_width:g}" y="{y}" width="{max(end - self.name_width, 1):.1f}" height="{BAR}" '
                 'rx="2"/>',
                 f'<path class="spread" d="M{self._x(figure.low):.1f} {middle}H{self._x(figure.high):.1f}"/>']
        old = figure_at(self.old, self.row.name, point) if self.old else None
        if old is not None and old.median <= self.most:
            parts.append(f'<path class="old" d="M{self._x(old.median):.1f} {y - 2}v{BAR + 4}"/>')
        right = max(end, self._x(figure.high))
        if point in self.aims:
            at = self._x(self.aims[point])
            parts.append(f'<path class="aim" d="M{at:.1f} {y - 3}v{BAR + 6}"/>')
            # The value stands beside the bar, and not on the mark.
            right = max(right, at) if at < right + VALUE_WIDTH else right
        parts.append(_text(right + 5, y + 10, number(figure.median), "value") + "</g>")
        return "".join(parts)


def _text(x, y, text, kind):
    return f'<text x="{x:.1f}" y="{y}" class="{kind}">{escape(text)}</text>'
