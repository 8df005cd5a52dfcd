#pragma once

#include "castor/tools/timeline/contents.hpp"
#include "castor/tools/timeline/stages.hpp"

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace castor::timeline {

/// What became of an entry in a stage.
enum class Fate {
  added,
  changed,
  unchanged,
  /// It was there before.
  gone,
  /// It was neither there before nor is afterwards.
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
  /// A URI with all of it.
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
  /// Into `Figure::pictures`, those that show most first.
  std::vector<std::size_t> pictures;
};

/// An entry in a stage; one that is gone as it was last.
struct CellEntry {
  /// Into `Figure::versions`.
  std::size_t version = 0;
  Fate fate = Fate::unchanged;
};

struct FigureColumn {
  Timestamp begin{0};
  Timestamp end{0};
};

/// Working memories over time, as the paper's Figure 3 shows them: a row for each, a column for
/// each stage.
struct Figure {
  std::string title;
  std::vector<std::string> rows;
  std::vector<FigureColumn> columns;
  std::vector<FigureEntry> entries;
  std::vector<EntryVersion> versions;
  std::vector<EmbeddedPicture> pictures;
  /// Row by row; in a cell the entries in the order in which they first came.
  std::vector<std::vector<CellEntry>> cells;

  const std::vector<CellEntry>& cell(std::size_t row, std::size_t column) const {
    return cells[row * columns.size() + column];
  }
};

/// Makes a picture of at most that size of one that may be larger; nothing if it cannot.
using PictureMaker =
  std::function<std::optional<EmbeddedPicture>(const PictureView&, double width, double height)>;

/// The larger pictures of a page are this size at most, the others `small_picture`.
inline constexpr double large_picture_width = 480;
inline constexpr double large_picture_height = 320;
inline constexpr double small_picture = 128;

/// Those from here on are large: they show more than one thing.
inline constexpr std::uint32_t large_from = 160;

/// @param rows subarchitectures in the order in which they are to be shown; others follow if they
/// have entries
Figure make_figure(std::string title, std::vector<std::string> rows, const Stages& stages,
                   const PictureMaker& picture);

} // namespace castor::timeline
