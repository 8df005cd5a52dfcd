"""Tables of measured figures in pages of docs/. Pure."""

from figures import figure_at, length_of_round, number
from report import points_of, verdicts
from rows import CASTOR

BEGIN, END = "<!-- begin of figures: scripts/bench --update-docs -->", "<!-- end of figures -->"


def machine_text(results):
    """The machine, the run, and what others did meanwhile."""
    machine, load = results["machine"], results["load"]
    virtual = "virtual, " if machine["virtual"] else ""
    return (f"{machine['processor']} ({virtual}{machine['cores']} cores), {machine['system']}, "
            f"Linux {machine['kernel']}; {results['rounds']} rounds of {length_of_round(results)}, {results['started']}. "
            f"Others used {100 * load['before']:.0f} % of the machine before the run, and "
            f"{100 * load['median']:.0f} % (median; {100 * load['most']:.0f} % at most) during it.")


def _cells(row, results):
    """(figure, Castor's, those of peers) of a row."""
    for label in dict.fromkeys(label for _, label in points_of(row)):
        figures = [(line, figure_at(results, row.name, (line, label))) for line, x in points_of(row) if x == label]
        texts = [(line, f"{number(x.median)} +- {100 * x.spread:.0f} %" if x.count > 1 else number(x.median))
                 for line, x in figures if x]
        if not texts:
            continue
        if not any(line == CASTOR for line, _ in texts):
            yield from ((f"{label}, {line}", text, "") for line, text in texts)
            continue
        peers = ", ".join(f"{line} {text}" for line, text in texts if line != CASTOR)
        yield label, dict(texts)[CASTOR], peers


def docs_table(rows, results):
    """Markdown."""
    lines = [machine_text(results), "", "| | Castor | others |", "|---|---|---|"]
    for row in rows:
        cells = list(_cells(row, results))
        if not cells:
            continue
        aims = "; ".join(f"{x.text}: {x.outcome}" for _, x in verdicts([row], results))
        lines.append(f"| **{row.title}**, {row.unit} | | {aims} |")
        lines += [f"| {figure} | {castor} | {peers} |" for figure, castor, peers in cells]
    return "\n".join(lines)


def with_table(page, table, begin_mark=BEGIN, end_mark=END):
    """The page with the table between its marks. Throws ValueError if the marks are not there."""
    before, begin, rest = page.partition(begin_mark)
    _, end, after = rest.partition(end_mark)
    if not begin or not end:
        raise ValueError(f"there are no lines {begin_mark} and {end_mark}")
    return f"{before}{begin}\n\n{table}\n\n{end}{after}"


def markdown_table(head, rows):
    """`head` and `rows` are lists of cells."""
    return "\n".join(["| " + " | ".join(x) + " |" for x in [head, ["---"] * len(head), *rows]])


def with_tables(page, tables, script):
    """The page with each of the tables, (mark, Markdown), between the marks of that script."""
    for mark, table in tables:
        page = with_table(page, table, f"<!-- begin of {mark}: {script} --update-docs -->", f"<!-- end of {mark} -->")
    return page
