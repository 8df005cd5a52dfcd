"""What scripts/bench prints: the figures of each row, aims, and what has changed. Pure text."""

from figures import change, figure_at, number, verdict
from rows import CASTOR


def points_of(row):
    """All (line, label) of a row."""
    return [(line.name, point.label) for line in row.lines for point in line.points]


def verdicts(rows, results):
    """(row, verdict) of all aims that can be judged."""
    found = [(row, verdict(aim, row, results)) for row in rows for aim in row.aims]
    return [(row, x) for row, x in found if x is not None]


def changes(rows, old, new):
    """(row, point, change) of all figures that both results have."""
    result = []
    for row in rows:
        for point in points_of(row):
            x = change(figure_at(old, row.name, point), figure_at(new, row.name, point))
            if x is not None:
                result.append((row, point, x))
    return result


def against_peers(row, results):
    """(peer, label, ratio) of Castor's figures to those of others in the same run."""
    castor = {label: figure_at(results, row.name, (line, label)) for line, label in points_of(row) if line == CASTOR}
    for line, label in points_of(row):
        other = figure_at(results, row.name, (line, label))
        if line != CASTOR and castor.get(label) and other and other.median:
            yield line, label, castor[label].median / other.median


def peers_text(row, results):
    """As `Castor is 1.2 x bare CAF (100 B)`; empty if there are none."""
    ratios = [f"{ratio:.2f} x {peer} ({label})" for peer, label, ratio in against_peers(row, results)]
    return "Castor is " + ", ".join(ratios) if ratios else ""


def is_better(row, x):
    return (x.ratio > 1) == row.higher_is_better


def _figure_lines(row, results):
    width = max(len(f"{line}, {label}") for line, label in points_of(row))
    for line, label in points_of(row):
        figure = figure_at(results, row.name, (line, label))
        if figure is not None:
            name = f"{line}, {label}"
            spread = f"+- {100 * figure.spread:.0f} %" if figure.count > 1 else "one round"
            yield f"  {name:<{width}}  {number(figure.median):>8}   {spread}"


def figures_text(rows, results):
    lines = []
    for row in rows:
        if row.name not in results["rows"]:
            continue
        lines += ["", f"{row.title} [{row.unit}]", *_figure_lines(row, results)]
        lines += ["  " + peers_text(row, results)] if peers_text(row, results) else []
        lines += [f"  aim: {x.text}: {x.outcome}" for _, x in verdicts([row], results)]
    return "\n".join(lines[1:])


def change_text(row, point, x):
    line, label = point
    word = "better" if is_better(row, x) else "worse"
    return f"{row.name}: {line}, {label}: {x.ratio:.2f} x ({x.low:.2f} to {x.high:.2f}), {word}"


def changes_text(rows, old, new):
    compared = changes(rows, old, new)
    beyond = [x for x in compared if x[2].beyond_noise]
    vague = sum(1 for _, _, x in compared if not x.enough)
    lines = [f"{len(compared)} figures compared with {old.get('started', 'an older run')}, "
             f"{len(beyond)} changed beyond noise:"]
    lines += ["  " + change_text(*x) for x in beyond]
    if vague:
        lines.append(f"  {vague} of them have too few rounds to tell noise from change; run without --quick.")
    if old.get("machine", {}).get("processor") != new.get("machine", {}).get("processor"):
        lines.append("  The machines differ: this compares them, too.")
    return "\n".join(lines)
