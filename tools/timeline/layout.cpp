#include "castor/tools/timeline/layout.hpp"

#include "castor/tools/timeline/text_width.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace castor::timeline {

namespace {

constexpr double margin = 24;
constexpr double head_height = 92;
constexpr double foot_height = 40;
constexpr double names_width = 134;
constexpr double gutter = 44;
constexpr double card_width = 252;
constexpr double column_gap = 14;
constexpr double row_gap = 8;
constexpr double row_padding = 10;
constexpr double least_row_height = 36;

constexpr double line_height = 14;
constexpr double label_height = 17;
constexpr double gap = 5;
constexpr double padding = 7;
constexpr double compact_height = 20;
constexpr double chip_height = 18;
constexpr std::size_t most_lines = 4;
/// Of the cards of a group of more than `few_cards`.
constexpr std::size_t lines_of_many = 2;
constexpr std::size_t few_cards = 2;

constexpr double small_side = 42;
constexpr std::size_t most_small = 2;
constexpr double scene_height = 170;

constexpr double shallowest = 9;
constexpr double deepest = gutter - 8;

bool is_large(const EmbeddedPicture& x) {
  return x.width >= large_from;
}

/// As large as fits, and in the middle.
Box fit(const EmbeddedPicture& x, const Box& into) {
  auto scale = std::min(into.width / x.width, into.height / x.height);
  Box result{0, 0, x.width * scale, x.height * scale};
  result.x = into.x + (into.width - result.width) / 2;
  result.y = into.y + (into.height - result.height) / 2;
  return result;
}

class Placer {
public:
  Placer(const Figure& figure, const std::vector<std::vector<Group>>& cells)
    : figure_(figure), cells_(cells) {}

  Layout place() {
    auto columns = figure_.columns.size();
    auto column_width = gutter + card_width + column_gap;
    auto y = head_height;
    result_.width = 2 * margin + names_width +
                    static_cast<double>(std::max<std::size_t>(columns, 1)) * column_width;
    for (std::size_t row = 0; row < figure_.rows.size(); ++row) {
      double height = least_row_height;
      for (std::size_t column = 0; column < columns; ++column) {
        auto x = margin + names_width + static_cast<double>(column) * column_width + gutter;
        auto end = place_cell(row, column, x, y + row_padding);
        height = std::max(height, end - y + row_padding);
      }
      result_.rows.push_back({margin, y, result_.width - 2 * margin, height});
      y += height + row_gap;
    }
    for (std::size_t column = 0; column < columns; ++column)
      result_.columns.push_back({margin + names_width + static_cast<double>(column) * column_width,
                                 head_height, column_width, y - row_gap - head_height});
    result_.height = y + foot_height;
    for (std::size_t column = 0; column < columns; ++column)
      draw_arrows(column);
    return std::move(result_);
  }

private:
  /// Returns where it ends.
  double place_cell(std::size_t row, std::size_t column, double x, double y) {
    std::vector<std::pair<std::string, std::vector<CellEntry>>> counted;
    for (auto& group : cells_[row * figure_.columns.size() + column]) {
      std::vector<CellEntry> passed;
      std::vector<CellEntry> gone;
      std::vector<CellEntry> more;
      for (auto& z : group.hidden)
        (z.fate == Fate::passed ? passed : z.fate == Fate::gone ? gone : more).push_back(z);
      if (!passed.empty())
        counted.emplace_back(fmt::format("{} {} came and went", passed.size(), group.type), passed);
      if (!gone.empty())
        counted.emplace_back(fmt::format("{} {} gone", gone.size(), group.type), gone);
      if (group.shown.empty()) {
        if (!more.empty())
          counted.emplace_back(fmt::format("{} {}", more.size(), group.type), more);
        continue;
      }
      y = place_label(row, group, x, y);
      for (auto& z : group.shown)
        y = place_card(row, column, z, x, y,
                       group.shown.size() > few_cards ? lines_of_many : most_lines);
      if (!more.empty())
        y = place_chips(row, column, {{fmt::format("+ {} more", more.size()), more}}, x, y);
      y += gap;
    }
    return place_chips(row, column, counted, x, y) - gap;
  }

  double place_label(std::size_t row, const Group& group, double x, double y) {
    auto is_there = [](const CellEntry& z) {
      return z.fate != Fate::gone && z.fate != Fate::passed;
    };
    auto count =
      std::ranges::count_if(group.shown, is_there) + std::ranges::count_if(group.hidden, is_there);
    auto text = count > 1 ? fmt::format("{} \u00d7 {}", count, group.type) : group.type;
    result_.labels.push_back({{x, y, card_width, label_height - 3},
                              row,
                              {x, y + label_size, fitted(text, card_width, label_size, true)}});
    return y + label_height;
  }

  double place_card(std::size_t row, std::size_t column, const CellEntry& entry, double x, double y,
                    std::size_t lines) {
    auto& version = figure_.versions[entry.version];
    auto inside = card_width - 2 * padding;
    Card card;
    card.row = row;
    card.column = column;
    card.entry = entry;
    card.box = {x, y, card_width, compact_height};
    auto top = y + padding;
    bool is_told = entry.fate == Fate::added || entry.fate == Fate::changed;
    auto text_width = inside;
    if (!version.pictures.empty() && entry.fate != Fate::gone) {
      if (auto& first = figure_.pictures[version.pictures.front()]; is_large(first)) {
        auto height = std::min(scene_height, first.height * inside / first.width);
        card.pictures.push_back({fit(first, {x + padding, top + line_height + 3, inside, height}),
                                 version.pictures.front()});
        card.box.height = padding + line_height + 3 + height + padding;
        is_told = false;
      } else if (is_told) {
        text_width = place_small_pictures(card, version, x + card_width - padding, top);
      }
    }
    auto& id = figure_.entries[version.entry].address.id;
    card.title = {x + padding + 2, is_told || !card.pictures.empty() ? top + 9 : y + 14,
                  fitted(id, text_width - 2, title_size, true)};
    if (is_told)
      place_lines(card, version, text_width, top + line_height, lines);
    else if (entry.fate == Fate::unchanged)
      place_remark(card, version, inside);
    result_.cards.push_back(std::move(card));
    return result_.cards.back().box.bottom() + gap;
  }

  /// Returns how wide the text beside them may be.
  double place_small_pictures(Card& card, const EntryVersion& version, double right, double top) {
    auto count = std::min(version.pictures.size(), most_small);
    for (std::size_t i = count; i-- > 0;) {
      right -= small_side;
      auto& picture = figure_.pictures[version.pictures[i]];
      card.pictures.push_back(
        {fit(picture, {right, top, small_side, small_side}), version.pictures[i]});
      right -= 4;
    }
    card.box.height = small_side + 2 * padding;
    return right - 4 - card.box.x - padding;
  }

  static std::string told(const EntryVersion& version) {
    std::string result;
    for (auto& x : version.summary)
      result += (result.empty() ? "" : " \u00b7 ") + x;
    return result;
  }

  /// What there is to tell, in what is left of the title's line.
  static void place_remark(Card& card, const EntryVersion& version, double inside) {
    constexpr double least = 60;
    auto left = text_width(card.title.text, title_size) + 10;
    if (inside - left < least || version.summary.empty())
      return;
    card.lines.push_back(
      {card.title.x + left, card.title.y, fitted(told(version), inside - left - 2, line_size)});
  }

  static void place_lines(Card& card, const EntryVersion& version, double width, double y,
                          std::size_t most) {
    auto lines = wrapped(told(version), width - 2, line_size, most);
    for (auto& x : lines) {
      card.lines.push_back({card.title.x, y + 10, std::move(x)});
      y += line_height;
    }
    auto least = lines.empty() ? compact_height : 0;
    card.box.height = std::max({card.box.height, y + padding - 3 - card.box.y, least});
    if (lines.empty() && card.pictures.empty())
      card.title.y = card.box.y + 14;
  }

  double place_chips(std::size_t row, std::size_t column,
                     const std::vector<std::pair<std::string, std::vector<CellEntry>>>& counted,
                     double left, double y) {
    auto x = left;
    for (auto& [text, entries] : counted) {
      auto label = fitted(text, card_width - 2 * padding, chip_size);
      auto width = text_width(label, chip_size) + 2 * padding;
      if (x > left && x + width > left + card_width) {
        x = left;
        y += chip_height + gap - 1;
      }
      result_.chips.push_back(
        {{x, y, width, chip_height}, row, column, {x + padding, y + 12.5, label}, entries});
      x += width + gap;
    }
    return counted.empty() ? y : y + chip_height + gap;
  }

  void draw_arrows(std::size_t column) {
    // Who is where, in this stage.
    std::map<std::size_t, std::size_t> places;
    for (std::size_t i = 0; i < result_.cards.size(); ++i)
      if (result_.cards[i].column == column && result_.cards[i].entry.fate != Fate::gone)
        places[figure_.versions[result_.cards[i].entry.version].entry] = i;
    std::map<std::pair<std::size_t, std::size_t>, Arrow> arrows;
    for (auto& [entry, from] : places)
      for (auto link : figure_.versions[result_.cards[from].entry.version].links) {
        auto i = places.find(link);
        if (i == places.end())
          continue;
        auto to = i->second;
        bool is_old = result_.cards[from].entry.fate == Fate::unchanged;
        if (auto back = arrows.find({to, from}); back != arrows.end()) {
          back->second.both_ways = true;
          back->second.is_old = back->second.is_old && is_old;
        } else {
          arrows[{from, to}] = {from, to, false, is_old, 0};
        }
      }
    std::vector<Arrow> found;
    for (auto& [ends, x] : arrows)
      found.push_back(x);
    auto length = [&](const Arrow& x) {
      return std::abs(result_.cards[x.from].box.y - result_.cards[x.to].box.y);
    };
    std::ranges::stable_sort(found, {}, length);
    auto step =
      (deepest - shallowest) / static_cast<double>(std::max<std::size_t>(found.size(), 6));
    auto depth = shallowest;
    for (auto& x : found) {
      depth += step;
      x.depth = depth;
      result_.arrows.push_back(x);
    }
  }

  const Figure& figure_;
  const std::vector<std::vector<Group>>& cells_;
  Layout result_;
};

} // namespace

Layout lay_out(const Figure& figure, const std::vector<std::vector<Group>>& cells) {
  return Placer{figure, cells}.place();
}

} // namespace castor::timeline
