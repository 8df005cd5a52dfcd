#pragma once

#include "castor/tools/timeline/contents.hpp"
#include "castor/tools/timeline/stages.hpp"

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace castor::timeline {

/// Change of an entry in a stage.
enum class Fate {
  added,
  changed,
  unchanged,
  /// Deleted: present before the stage.
  gone,
  /// Added and deleted within the stage.
  passed
};

struct FigureEntry {
  Address address;
  std::string type;
};

/// A picture as it is embedded in pages.
struct EmbeddedPicture {
  double width = 0;
  double height = 0;
  /// Data URI.
  std::string data;
};

/// An entry as it stood in some stages.
struct EntryVersion {
  /// Into `Figure::entries`.
  std::size_t entry = 0;
  Version version = 0;
  std::string writer;
  Timestamp time{0};
  /// Empty if it is not known.
  std::string json;
  std::vector<std::string> summary;
  /// Into `Figure::entries`.
  std::vector<std::size_t> links;
  /// Into `Figure::pictures`, the largest first.
  std::vector<std::size_t> pictures;
};

/// An entry in a stage; a deleted one with its last version.
struct CellEntry {
  /// Into `Figure::versions`.
  std::size_t version = 0;
  Fate fate = Fate::unchanged;
};

struct FigureColumn {
  Timestamp begin{0};
  Timestamp end{0};
};

/// Working memories over time, as in the paper's figure 3: a row for each, a column for each stage.
struct Figure {
  std::string title;
  std::vector<std::string> rows;
  std::vector<FigureColumn> columns;
  std::vector<FigureEntry> entries;
  std::vector<EntryVersion> versions;
  std::vector<EmbeddedPicture> pictures;
  /// Row by row; the entries of a cell in the order of their first addition.
  std::vector<std::vector<CellEntry>> cells;

  const std::vector<CellEntry>& cell(std::size_t row, std::size_t column) const {
    return cells[row * columns.size() + column];
  }
};

/// Scales a picture down to at most this size; nothing if that fails.
using PictureMaker =
  std::function<std::optional<EmbeddedPicture>(const PictureView&, double width, double height)>;

/// Maximum size of large pictures on a page; others are at most `small_picture` wide and high.
inline constexpr double large_picture_width = 480;
inline constexpr double large_picture_height = 320;
inline constexpr double small_picture = 128;

/// Width in pixels from which a picture counts as large: it shows more than one thing.
inline constexpr std::uint32_t large_from = 160;

/// @param rows subarchitectures in the order of the rows; others follow if they have entries
Figure make_figure(std::string title, std::vector<std::string> rows, const Stages& stages,
                   const PictureMaker& picture);

} // namespace castor::timeline
