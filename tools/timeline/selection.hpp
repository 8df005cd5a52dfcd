#pragma once

#include "castor/tools/timeline/figure.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace castor::timeline {

struct SelectionOptions {
  /// A group with more entries than this shows only `some`.
  std::size_t whole_group = 6;
  std::size_t some = 4;
  /// Once a cell shows this number of entries, its further groups show only `some`.
  std::size_t whole_cell = 14;
};

/// Entries of one type in a cell: those shown as cards, and those only counted.
struct Group {
  std::string type;
  std::vector<CellEntry> shown;
  std::vector<CellEntry> hidden;
};

/// Selects the entries to show as cards, cell by cell in the order of `Figure::cells`.
///
/// Types within a cell are ordered: first types with large pictures, then types referenced from
/// another working memory, then types referenced from this one, then types with few entries. Other
/// types, mostly internal bookkeeping of components, are only counted. Of many entries of a type,
/// those are shown that were shown in the previous stage, that have changed, and that are linked to
/// entries already shown.
std::vector<std::vector<Group>> select(const Figure& figure, const SelectionOptions& options = {});

} // namespace castor::timeline
