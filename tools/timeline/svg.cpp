#include "castor/tools/timeline/svg.hpp"

#include "castor/base/duration.hpp"
#include "castor/base/markup.hpp"
#include "castor/tools/timeline/text_width.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <set>
#include <string_view>
#include <utility>

namespace castor::timeline {

namespace {

/// Of the rows: for what is in the working memory, and for its ground.
constexpr std::array<std::pair<std::string_view, std::string_view>, 6> row_colours{
  {{"#2f6db3", "#f3f7fb"},
   {"#2a7d55", "#f2f8f5"},
   {"#a3621b", "#fbf7f1"},
   {"#7d4a9e", "#f8f4fa"},
   {"#2b7f8c", "#f1f8f9"},
   {"#a6456b", "#fbf4f7"}}};

constexpr std::string_view styles = R"(
text { fill: #1c2430; }
.heading { font-size: 20px; font-weight: bold; }
.stage { font-size: 17px; font-weight: bold; }
.when, .legend { font-size: 11px; fill: #66707d; }
.name { font-size: 15px; font-weight: bold; }
.type { font-size: 10.5px; font-weight: bold; }
.title { font-size: 11.5px; font-weight: bold; }
.line { font-size: 11px; fill: #3c4654; }
.chip text { font-size: 10.5px; fill: #4a5563; }
.card rect.back { fill: #fff; stroke: #d3dae2; }
.card rect.fate { fill: #c3cbd5; }
.added rect.back { stroke: #b5c9bd; } .added rect.fate { fill: #2f9e66; }
.changed rect.back { stroke: #dccfae; } .changed rect.fate { fill: #dd9a1f; }
.unchanged .line { fill: #8a94a0; }
.unchanged .title { font-weight: normal; fill: #4a5563; }
.gone rect.back { fill: none; stroke-dasharray: 3 3; } .gone rect.fate { fill: #c86464; }
.gone .title { font-weight: normal; fill: #8a6a6a; text-decoration: line-through; }
.chip rect { fill: #e9edf2; stroke: #d3dae2; }
.none { font-size: 11px; fill: #98a1ac; }
.arrow path.way { fill: none; stroke-width: 1.3; stroke-opacity: .75; }
.arrow.old path.way { stroke-opacity: .25; } .arrow.old path.head { fill-opacity: .3; }
.rule { stroke: #dfe4ea; }
)";

std::string_view name_of(Fate x) {
  switch (x) {
    case Fate::added:
      return "added";
    case Fate::changed:
      return "changed";
    case Fate::unchanged:
      return "unchanged";
    case Fate::gone:
      return "gone";
    case Fate::passed:
      return "passed";
  }
  return {};
}

std::string text(std::string_view style, double x, double y, std::string_view content,
                 std::string_view more = {}) {
  return fmt::format("<text class=\"{}\" x=\"{:.1f}\" y=\"{:.1f}\"{}>{}</text>", style, x, y, more,
                     escaped(content));
}

std::string text(std::string_view style, const PlacedText& x, std::string_view more = {}) {
  return text(style, x.x, x.y, x.text, more);
}

std::string rect(std::string_view attributes, const Box& x, double radius) {
  return fmt::format(
    "<rect {} x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" rx=\"{}\"/>", attributes,
    x.x, x.y, x.width, x.height, radius);
}

std::string fill(std::size_t row, bool ground = false) {
  auto& [strong, light] = row_colours[row % row_colours.size()];
  return fmt::format(" fill=\"{0}\" style=\"fill:{0}\"", ground ? light : strong);
}

class Drawer {
public:
  Drawer(const Figure& figure, const Layout& layout) : figure_(figure), layout_(layout) {}

  std::string draw() {
    add(fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" "
                    "height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} {1:.0f}\" role=\"img\" "
                    "aria-label=\"{2}\">",
                    layout_.width, layout_.height, escaped(figure_.title)));
    add(fmt::format("<style>\ntext {{ font-family: {}; }}{}</style>", font_families, styles));
    define_pictures();
    add("<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>");
    add(text("heading", layout_.rows.empty() ? 24 : layout_.rows.front().x, 34, figure_.title));
    draw_rows();
    draw_columns();
    for (auto& x : layout_.labels)
      add(text("type", x.text, fill(x.row)));
    // Below the cards, which they begin and end at.
    for (auto& x : layout_.arrows)
      draw_arrow(x);
    for (std::size_t i = 0; i < layout_.cards.size(); ++i)
      draw_card(i);
    for (std::size_t i = 0; i < layout_.chips.size(); ++i)
      draw_chip(i);
    draw_legend();
    add("</svg>");
    return std::move(out_);
  }

private:
  void add(std::string_view x) {
    out_ += x;
    out_ += '\n';
  }

  /// Each once, however often it is seen.
  void define_pictures() {
    std::set<std::size_t> seen;
    add("<defs>");
    for (auto& card : layout_.cards)
      for (auto& x : card.pictures) {
        if (!seen.insert(x.picture).second)
          continue;
        auto& picture = figure_.pictures[x.picture];
        add(fmt::format("<image id=\"p{}\" width=\"{:.0f}\" height=\"{:.0f}\" href=\"{}\"/>",
                        x.picture, picture.width, picture.height, picture.data));
      }
    for (std::size_t i = 0; i < layout_.cards.size(); ++i) {
      auto& x = layout_.cards[i].box;
      add(fmt::format("<clipPath id=\"c{}\">{}</clipPath>", i, rect("", x, 4)));
    }
    add("</defs>");
  }

  void draw_rows() {
    for (std::size_t i = 0; i < layout_.rows.size(); ++i) {
      auto& x = layout_.rows[i];
      add(rect(fill(i, true), x, 6));
      add(rect(fill(i), {x.x, x.y, 4, x.height}, 2));
      add(text("name", x.x + 14, x.y + 26, fitted(figure_.rows[i], 118, 15, true), fill(i)));
    }
  }

  void draw_columns() {
    for (std::size_t i = 0; i < layout_.columns.size(); ++i) {
      auto& x = layout_.columns[i];
      auto& stage = figure_.columns[i];
      auto left = x.x + 44;
      add(text("stage", left, x.y - 28, fmt::format("t = {}", i)));
      add(text(
        "when", left, x.y - 11,
        stage.end - stage.begin < std::chrono::milliseconds{10}
          ? fmt::format("{:.3f} s", in_seconds(stage.begin))
          : fmt::format("{:.2f} \u2013 {:.2f} s", in_seconds(stage.begin), in_seconds(stage.end))));
      if (i > 0)
        add(fmt::format("<line class=\"rule\" x1=\"{0:.1f}\" y1=\"{1:.1f}\" x2=\"{0:.1f}\" "
                        "y2=\"{2:.1f}\"/>",
                        x.x - 1, x.y - 44, x.bottom()));
    }
  }

  void draw_card(std::size_t number) {
    auto& x = layout_.cards[number];
    add(fmt::format("<g class=\"card {}\" data-v=\"{}\">", name_of(x.entry.fate), x.entry.version));
    add(rect("class=\"back\"", x.box, 4));
    add(rect("class=\"fate\"", {x.box.x, x.box.y, 3.5, x.box.height}, 1.5));
    add(fmt::format("<g clip-path=\"url(#c{})\">", number));
    add(text("title", x.title));
    for (auto& line : x.lines)
      add(text("line", line));
    add("</g>");
    for (auto& picture : x.pictures) {
      auto& source = figure_.pictures[picture.picture];
      add(fmt::format("<use href=\"#p{}\" transform=\"translate({:.1f} {:.1f}) scale({:.4f})\"/>",
                      picture.picture, picture.box.x, picture.box.y,
                      picture.box.width / source.width));
    }
    add("</g>");
  }

  void draw_chip(std::size_t number) {
    auto& x = layout_.chips[number];
    add(fmt::format("<g class=\"chip\" data-i=\"{}\">", number));
    add(rect("", x.box, 9));
    add(text("", x.text));
    add("</g>");
  }

  void draw_arrow(const Arrow& x) {
    auto& from = layout_.cards[x.from];
    auto& to = layout_.cards[x.to];
    constexpr double below_top = 10;
    constexpr double head = 5;
    auto y1 = from.box.y + below_top;
    auto y2 = to.box.y + below_top;
    auto x1 = from.box.x - (x.both_ways ? head : 0);
    auto x2 = to.box.x - head;
    // Three quarters of the way to its control points is how far a curve goes.
    auto turn = std::min(x1, x2) - x.depth / 0.75;
    auto colour = row_colours[from.row % row_colours.size()].first;
    auto tip = [&](double right, double y) {
      return fmt::format(
        "<path class=\"head\" d=\"M{0:.1f} {1:.1f}l-{2} -3.2v6.4z\" fill=\"{3}\"/>", right, y,
        head + 1, colour);
    };
    add(fmt::format("<g class=\"arrow{}\" data-a=\"{}\" data-b=\"{}\">", x.is_old ? " old" : "",
                    x.from, x.to));
    add(fmt::format("<path class=\"way\" d=\"M{:.1f} {:.1f}C{:.1f} {:.1f} {:.1f} {:.1f} {:.1f} "
                    "{:.1f}\" stroke=\"{}\"/>",
                    x1, y1, turn, y1, turn, y2, x2, y2, colour));
    add(tip(to.box.x, y2));
    if (x.both_ways)
      add(tip(from.box.x, y1));
    add("</g>");
  }

  void draw_legend() {
    auto y = layout_.height - 18;
    double x = layout_.rows.empty() ? 24 : layout_.rows.front().x + 134 + 44;
    auto item = [&](Fate fate, std::string_view what) {
      add(fmt::format("<g class=\"card {}\">{}{}</g>", name_of(fate),
                      rect("class=\"back\"", {x, y - 10, 22, 13}, 3),
                      rect("class=\"fate\"", {x, y - 10, 3.5, 13}, 1.5)));
      add(text("legend", x + 28, y, what));
      x += 28 + text_width(what, 11) + 22;
    };
    item(Fate::added, "new");
    item(Fate::changed, "changed");
    item(Fate::unchanged, "as before");
    item(Fate::gone, "gone");
    add(fmt::format("<g class=\"arrow\"><path class=\"way\" d=\"M{0:.1f} {1:.1f}h18\" "
                    "stroke=\"#4a5563\"/><path class=\"head\" d=\"M{2:.1f} {1:.1f}l-6 -3.2v6.4z\" "
                    "fill=\"#4a5563\"/></g>",
                    x, y - 4, x + 22));
    add(text("legend", x + 28, y, "refers to"));
  }

  const Figure& figure_;
  const Layout& layout_;
  std::string out_;
};

} // namespace

std::string to_svg(const Figure& figure, const Layout& layout) {
  return Drawer{figure, layout}.draw();
}

} // namespace castor::timeline
