#include "castor/tools/timeline/page.hpp"

#include "castor/base/markup.hpp"
#include "castor/tools/timeline/svg.hpp"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <string_view>

namespace castor::timeline {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view page_styles = R"(
:root { color-scheme: light; }
body { margin: 0; background: #fff; color: #1c2430;
  font: 14px/1.45 "Liberation Sans", Arial, Helvetica, sans-serif; }
main { overflow-x: auto; }
body.reading main { margin-right: min(460px, 100vw); }
svg { display: block; }
.card, .chip { cursor: pointer; }
.card:hover rect.back, .chip:hover rect { stroke: #4a5563; }
svg.looking .card, svg.looking .arrow { opacity: .25; }
svg.looking .card.lit, svg.looking .arrow.lit { opacity: 1; }
svg.looking .arrow.lit path.way { stroke-width: 2.2; stroke-opacity: 1; }
.card.chosen rect.back { stroke: #1c2430; stroke-width: 2; }
aside { position: fixed; top: 0; right: 0; bottom: 0; width: min(460px, 100vw); overflow: auto;
  box-sizing: border-box; padding: 1em 1.2em; background: #fff; border-left: 1px solid #d3dae2;
  box-shadow: -4px 0 18px #0002; }
aside[hidden] { display: none; }
aside h2 { font-size: 1.1em; margin: 0 2em .2em 0; overflow-wrap: anywhere; }
aside p { margin: .2em 0; color: #66707d; }
aside pre { font: 12px/1.45 "Liberation Mono", ui-monospace, monospace; white-space: pre-wrap;
  overflow-wrap: anywhere; background: #f6f8fa; border-radius: 4px; padding: .8em; }
aside ul { padding-left: 1.2em; } aside li { overflow-wrap: anywhere; }
aside a { color: #2f6db3; cursor: pointer; }
aside button { position: absolute; top: .6em; right: .8em; border: 0; background: none;
  font-size: 1.4em; cursor: pointer; }
@media print { @page { size: landscape; } aside { display: none; }
  body.reading main { margin-right: 0; }
  svg { width: 100%; height: auto; } }
)";

constexpr std::string_view script = R"(
const data = JSON.parse(document.getElementById('data').textContent);
const svg = document.querySelector('svg'), aside = document.querySelector('aside');
const cards = [...svg.querySelectorAll('.card[data-v]')];
const arrows = [...svg.querySelectorAll('.arrow[data-a]')];
const entry = v => data.entries[data.versions[v].entry];
const element = (tag, text, parent) => {
  const x = document.createElement(tag); x.textContent = text; parent.append(x); return x; };
function light(card) {
  const ends = new Set([cards.indexOf(card)]);
  arrows.forEach(x => {
    const [a, b] = [+x.dataset.a, +x.dataset.b], own = cards[a] === card || cards[b] === card;
    x.classList.toggle('lit', own);
    if (own) ends.add(a).add(b); });
  const same = data.versions[card.dataset.v].entry;
  cards.forEach((x, i) => x.classList.toggle('lit',
    ends.has(i) || data.versions[x.dataset.v].entry === same));
  svg.classList.add('looking');
}
function clear(heading) {
  aside.replaceChildren(); aside.hidden = false; document.body.classList.add('reading');
  const close = element('button', '\u00d7', aside);
  close.title = 'close'; close.onclick = leave;
  element('h2', heading, aside);
}
function leave() {
  aside.hidden = true; document.body.classList.remove('reading');
  cards.forEach(x => x.classList.remove('chosen')); }
function link(text, v, parent) {
  element('a', text, element('li', '', parent)).onclick = () => show(v); }
function latest(e, time) {
  let found = -1;
  data.versions.forEach((x, i) => {
    if (x.entry === e && (found < 0 || x.time <= time)) found = i; });
  return found;
}
function show(v) {
  const x = data.versions[v], [where, id, type] = entry(v);
  clear(type + ' ' + where + '/' + id);
  element('p', 'version ' + x.version + ' by ' + x.writer + ' at ' + x.time.toFixed(6) + ' s', aside);
  if (x.links.length) {
    element('p', 'refers to', aside);
    const list = element('ul', '', aside);
    x.links.forEach(e => link(data.entries[e][2] + ' ' + data.entries[e].slice(0, 2).join('/'),
                              latest(e, x.time), list));
  }
  if (x.content) element('pre', JSON.stringify(x.content, null, 2), aside);
  else element('p', 'its content was gone before it could be read', aside);
  cards.forEach(y => y.classList.toggle('chosen', +y.dataset.v === v));
}
function count(chip) {
  const list = data.chips[chip.dataset.i];
  clear(chip.textContent.trim());
  const items = element('ul', '', aside);
  list.forEach(v => link(entry(v)[2] + ' ' + entry(v)[1], v, items));
}
cards.forEach(x => {
  x.onmouseenter = () => light(x);
  x.onmouseleave = () => svg.classList.remove('looking');
  x.onclick = () => show(+x.dataset.v); });
svg.querySelectorAll('.chip').forEach(x => { x.onclick = () => count(x); });
addEventListener('keydown', e => { if (e.key === 'Escape') leave(); });
)";

/// Text for a script element, which nothing in it ends.
std::string for_script(const Json& x) {
  std::string result;
  for (char c : x.dump(-1, ' ', false, Json::error_handler_t::replace))
    result += c == '<' ? std::string{"\\u003c"} : std::string{c};
  return result;
}

Json data_of(const Figure& figure, const Layout& layout) {
  auto entries = Json::array();
  for (auto& x : figure.entries)
    entries.push_back({x.address.subarchitecture, x.address.id, x.type});
  auto versions = Json::array();
  for (auto& x : figure.versions)
    versions.push_back({{"entry", x.entry},
                        {"version", x.version},
                        {"writer", x.writer},
                        {"time", std::chrono::duration<double>(x.time).count()},
                        {"links", x.links},
                        {"content", x.json.empty() ? Json{} : Json::parse(x.json)}});
  auto chips = Json::array();
  for (auto& x : layout.chips) {
    auto list = Json::array();
    for (auto& y : x.entries)
      list.push_back(y.version);
    chips.push_back(std::move(list));
  }
  return {{"entries", entries}, {"versions", versions}, {"chips", chips}};
}

} // namespace

std::string to_page(const Figure& figure, const Layout& layout) {
  return fmt::format("<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
                     "<meta name=\"viewport\" content=\"width=device-width\">\n"
                     "<title>{}</title>\n<style>{}</style></head><body>\n<main>\n{}</main>\n"
                     "<aside hidden></aside>\n"
                     "<script type=\"application/json\" id=\"data\">{}</script>\n"
                     "<script>{}</script>\n</body></html>\n",
                     escaped(figure.title), page_styles, to_svg(figure, layout),
                     for_script(data_of(figure, layout)), script);
}

} // namespace castor::timeline
