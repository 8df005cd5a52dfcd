"""The page of a run of scripts/bench: one HTML file that needs nothing else, for light and dark, for phones. Pure."""

from html import escape

from figures import change, figure_at, length_of_round, number
from plot import Bars
from report import change_text, changes, is_better, peers_text, points_of, verdicts

STYLES = """
:root { color-scheme: light dark; --ground: #fff; --text: #1c2430; --soft: #66707d; --line: #d3dae2; --panel: #f6f8fa;
  --s0: #2f6db3; --s1: #9aa5b1; --s2: #c98b4a; --s3: #5f9e8f; --s4: #a07cb0; --good: #1f7a45; --bad: #b3372f; }
@media (prefers-color-scheme: dark) { :root { --ground: #14181e; --text: #e4e9ef; --soft: #97a2af; --line: #333c47;
  --panel: #1c222a; --s0: #6aa5e8; --s1: #76818d; --s2: #d69f63; --s3: #78b9a9; --s4: #b997c8; --good: #62c28c;
  --bad: #ef8a80; } }
body { margin: 0; background: var(--ground); color: var(--text);
  font: 15px/1.5 "Liberation Sans", Arial, Helvetica, sans-serif; }
main { max-width: 640px; margin: 0 auto; padding: 1em; box-sizing: border-box; }
h1 { font-size: 1.5em; margin: .3em 0; } h2 { font-size: 1.1em; margin: 0; }
section { border-top: 1px solid var(--line); padding: 1em 0; }
p { margin: .3em 0; } .soft, dt { color: var(--soft); } a { color: var(--s0); }
dl { display: grid; grid-template-columns: max-content 1fr; gap: 0 1em; margin: .5em 0; } dd { margin: 0;
  overflow-wrap: anywhere; }
.warning { background: var(--panel); border-left: 3px solid var(--bad); padding: .4em .8em; }
.met { color: var(--good); } .missed { color: var(--bad); } .met b, .missed b { font-weight: 600; }
.wide { overflow-x: auto; } table { border-collapse: collapse; font-size: .9em; width: 100%; }
th { text-align: left; font-weight: normal; color: var(--soft); } td, th { padding: .2em .7em .2em 0;
  border-bottom: 1px solid var(--line); vertical-align: top; } td.n, th.n { text-align: right; white-space: nowrap; }
summary { cursor: pointer; color: var(--soft); font-size: .9em; }
svg { display: block; width: 100%; height: auto; margin: .5em 0; font-size: 10.5px; }
svg text { fill: var(--text); } svg .name { text-anchor: end; fill: var(--soft); } svg .heading { font-weight: bold; }
svg .spread { stroke: var(--text); stroke-width: 1.5; opacity: .75; } svg .old { stroke: var(--text); stroke-width: 2; }
svg .aim { stroke: var(--bad); stroke-width: 1.5; stroke-dasharray: 3 2; }
.s0 rect { fill: var(--s0); } .s1 rect { fill: var(--s1); } .s2 rect { fill: var(--s2); } .s3 rect { fill: var(--s3); }
.s4 rect { fill: var(--s4); }
@media print { details { display: none; } section { break-inside: avoid; } }
"""


def _table(head, rows):
    """`rows` of cells that are HTML; those after the first are numbers."""
    kind = lambda i: ' class="n"' if i > 0 else ""
    cells = lambda tag, xs: "".join(f"<{tag}{kind(i)}>{x}</{tag}>" for i, x in enumerate(xs))
    body = "".join(f"<tr>{cells('td', x)}</tr>" for x in rows)
    return f'<div class="wide"><table><tr>{cells("th", head)}</tr>{body}</table></div>'


def _machine(results):
    machine, load = results["machine"], results["load"]
    facts = [
        ("processor", f"{machine['processor']}, {machine['cores']} cores{', virtual' if machine['virtual'] else ''}"),
        ("memory", machine["memory"]),
        ("system", f"{machine['system']}, Linux {machine['kernel']}"),
        ("Castor", machine["castor"]),
        ("run", f"{results['started']}, {results['rounds']} interleaved rounds of {length_of_round(results)}"),
        ("load by others", f"{100 * load['before']:.0f} % of the machine before the run, then "
                           f"{100 * load['median']:.0f} % (median), {100 * load['most']:.0f} % at most"),
    ]
    items = "".join(f"<dt>{escape(name)}</dt><dd>{escape(text)}</dd>" for name, text in facts)
    return f"<dl>{items}</dl>"


def _warnings(results):
    return "".join(f'<p class="warning">{escape(x)}</p>' for x in results["warnings"])


def _summary(rows, results):
    judged = verdicts(rows, results)
    if not judged:
        return ""
    met = sum(1 for _, x in judged if x.met)
    table = _table(("aim", "", "of the aim"),
                   [(f'<a href="#{row.name}">{escape(row.title)}</a><br><span class="soft">{escape(x.text)}</span>',
                     _outcome(x), f"{x.ratio:.2f} x") for row, x in judged])
    return f"<section><h2>Aims: {met} of {len(judged)} met</h2>{table}</section>"


def _outcome(x):
    word = "met" if x.met else "missed"
    return f'<span class="{word}"><b>{word}</b></span>'


def _changes(rows, results, old):
    compared = changes(rows, old, results)
    beyond = [x for x in compared if x[2].beyond_noise]
    items = "".join(f'<li class="{"met" if is_better(x[0], x[2]) else "missed"}">{escape(change_text(*x))}</li>'
                    for x in beyond)
    return (f"<section><h2>Changes since {escape(str(old.get('started', 'an older run')))}</h2>"
            f"<p>{len(beyond)} of {len(compared)} figures have changed beyond noise: their spreads do not touch.</p>"
            f"<ul>{items}</ul></section>")


def _row(row, results, old):
    figures = []
    for point in points_of(row):
        figure = figure_at(results, row.name, point)
        if figure is None:
            continue
        cells = [escape(", ".join(point)), number(figure.median), number(figure.low), number(figure.high),
                 str(figure.count)]
        if old:
            x = change(figure_at(old, row.name, point), figure)
            cells.append(f"{x.ratio:.2f} x" + ("" if x.beyond_noise else " (noise)") if x else "")
        figures.append(cells)
    head = ["figure", "median", "least", "most", "rounds"] + (["to old"] if old else [])
    judged = "".join(f"<p>{_outcome(x)} <span class=\"soft\">{escape(x.text)}; {x.ratio:.2f} x the aim</span></p>"
                     for _, x in verdicts([row], results))
    if peers_text(row, results):
        judged += f'<p class="soft">{escape(peers_text(row, results))}.</p>'
    return (f'<section id="{row.name}"><h2>{escape(row.title)} <span class="soft">{escape(row.unit)}</span></h2>'
            f'<p class="soft">{escape(row.meaning)} {"More" if row.higher_is_better else "Less"} is better.</p>'
            f"{judged}{Bars(row, results, old).svg()}"
            f"<details><summary>figures</summary>{_table(head, figures)}</details></section>")


def page(rows, results, old=None, title="What Castor costs"):
    """HTML of the results, compared with older ones if there are any."""
    measured = [row for row in rows if results["rows"].get(row.name)]
    legend = "Bars are medians, the thin lines reach from the least to the most that a round gave"
    legend += "; dashed: the aim" if any(row.aims for row in measured) else ""
    legend += "; upright lines: the older run." if old else "."
    return "\n".join([
        '<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8">',
        '<meta name="viewport" content="width=device-width, initial-scale=1">',
        f"<title>{escape(title)}</title>\n<style>{STYLES}</style></head><body><main>",
        f"<h1>{escape(title)}</h1>", _machine(results), _warnings(results),
        _changes(rows, results, old) if old else "", _summary(rows, results), f'<p class="soft">{legend}</p>',
        *(_row(row, results, old) for row in measured), "</main></body></html>\n"])
