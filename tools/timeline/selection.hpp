#pragma once

#include "castor/tools/timeline/figure.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace castor::timeline {

struct SelectionOptions {
  /// A group with more entries than these shows only some.
  std::size_t whole_group = 6;
  std::size_t some = 4;
  /// Once a cell shows so many, the groups that follow show only some.
  std::size_t whole_cell = 14;
};

/// Entries of one type in a cell: those to be seen at once, and those that are counted.
struct Group {
  std::string type;
  std::vector<CellEntry> shown;
  std::vector<CellEntry> hidden;
};

/// Which entries of the cells are seen at once, cell by cell as `Figure::cells` has them.
///
/// In a cell, types with large pictures come first, then those that something refers to in another
/// working memory, then those that something refers to in this one, then those that are few; of
/// other types, which are most often the books that components keep, nothing is seen but their
/// number. Of many entries those are seen that were seen in the stage before, that have changed,
/// and that are linked to what is seen already.
std::vector<std::vector<Group>> select(const Figure& figure, const SelectionOptions& options = {});

} // namespace castor::timeline
