#pragma once

#include "castor/communication/types.hpp"
#include "castor/planning/motivation/table_things.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// Questions about the moves that were made on a table.
namespace castor::planning {

/// Moves that were made; what was taken and put down was moved once.
struct TableHistory {
  std::uint64_t moves = 0;
  /// Those remembered, in their order: the last of them at least.
  std::vector<TableMove> remembered = {};

  friend bool operator==(const TableHistory&, const TableHistory&) = default;
};

/// Whether a step asks about the moves that were made.
bool asks_about_history(std::string_view action);

struct HistoryAnswer {
  std::string words;
  /// Proxies of the things that it names as moved or not.
  std::vector<std::string> things = {};
};

/// Of a step with things, it is about these only.
/// @pre asks_about_history() of its action
HistoryAnswer answer_about_history(const communication::DirectiveStep& step,
                                   std::span<const TableThing> table, const TableHistory& history);

} // namespace castor::planning
