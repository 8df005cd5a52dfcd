#pragma once

#include "castor/tools/timeline/figure.hpp"
#include "castor/tools/timeline/selection.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace castor::timeline {

/// Pixels; y downwards.
struct Box {
  double x = 0;
  double y = 0;
  double width = 0;
  double height = 0;

  double right() const { return x + width; }
  double bottom() const { return y + height; }
};

struct PlacedText {
  double x = 0;
  /// Baseline.
  double y = 0;
  std::string text;
};

struct PlacedPicture {
  Box box;
  /// Into `Figure::pictures`.
  std::size_t picture = 0;
};

/// An entry in a stage.
struct Card {
  Box box;
  std::size_t row = 0;
  std::size_t column = 0;
  CellEntry entry;
  PlacedText title;
  std::vector<PlacedText> lines;
  std::vector<PlacedPicture> pictures;
};

/// Hidden entries of one type, shown as their number.
struct Chip {
  Box box;
  std::size_t row = 0;
  std::size_t column = 0;
  PlacedText text;
  std::vector<CellEntry> entries;
};

/// Name of a type above its cards.
struct GroupLabel {
  Box box;
  std::size_t row = 0;
  PlacedText text;
};

/// Arrow from a card to one that it refers to, through the gutter on the left of both.
struct Arrow {
  /// Into `Layout::cards`.
  std::size_t from = 0;
  std::size_t to = 0;
  /// The cards refer to each other.
  bool both_ways = false;
  /// The reference and both entries are unchanged.
  bool is_old = false;
  /// Horizontal extent into the gutter.
  double depth = 0;
};

struct Layout {
  double width = 0;
  double height = 0;
  /// Positions of the rows and columns of cells.
  std::vector<Box> rows;
  std::vector<Box> columns;
  std::vector<Card> cards;
  std::vector<Chip> chips;
  std::vector<GroupLabel> labels;
  std::vector<Arrow> arrows;
};

// Font sizes.
inline constexpr double title_size = 11.5;
inline constexpr double line_size = 11;
inline constexpr double label_size = 10.5;
inline constexpr double chip_size = 10.5;

Layout lay_out(const Figure& figure, const std::vector<std::vector<Group>>& cells);

} // namespace castor::timeline
