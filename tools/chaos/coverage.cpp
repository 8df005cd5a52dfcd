#include "castor/tools/chaos/coverage.hpp"

#include "castor/tools/chaos/possible_faults.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

namespace castor::faults {

Coverage::Coverage(const FaultTargets& targets) {
  for (auto& kind : fault_kinds())
    for (auto& fault : kind.for_each_target(targets))
      cells_[target_of(fault)][std::string{kind_of(fault)}];
}

void Coverage::add(std::span<const FaultRecord> faults) {
  for (auto& x : faults) {
    auto& cell = cells_[x.target][x.kind];
    ++(x.state == FaultState::happened ? cell.hits : cell.misses);
  }
}

std::vector<Coverage::Table> Coverage::tables() const {
  std::map<std::vector<std::string>, Table> by_kinds;
  for (auto& [target, row] : cells_) {
    std::vector<std::string> kinds;
    std::vector<Cell> cells;
    for (auto& [kind, cell] : row) {
      kinds.push_back(kind);
      cells.push_back(cell);
    }
    auto& table = by_kinds[kinds];
    table.kinds = std::move(kinds);
    table.rows[target] = std::move(cells);
  }
  std::vector<Table> result;
  for (auto& [kinds, table] : by_kinds)
    result.push_back(std::move(table));
  return result;
}

std::size_t Coverage::possible() const {
  std::size_t result = 0;
  for (auto& [target, row] : cells_)
    result += row.size();
  return result;
}

std::size_t Coverage::hit() const {
  std::size_t result = 0;
  for (auto& [target, row] : cells_)
    result += static_cast<std::size_t>(
      std::ranges::count_if(row, [](auto& x) { return x.second.hits > 0; }));
  return result;
}

Coverage coverage_of(const ChaosRun& run) {
  Coverage result{run.targets};
  result.add(run.faults);
  return result;
}

std::string to_text(const Coverage::Cell& x) {
  auto hits = x.hits > 0 ? std::to_string(x.hits) : std::string{"."};
  return x.misses > 0 ? fmt::format("{} -{}", hits, x.misses) : hits;
}

std::string to_text(const Coverage& x) {
  auto result =
    fmt::format("{} of {} pairs of a fault and a target were hit\n", x.hit(), x.possible());
  for (auto& table : x.tables()) {
    std::size_t width = 0;
    for (auto& [target, cells] : table.rows)
      width = std::max(width, target.size());
    result += fmt::format("\n  {:<{}}", "", width);
    for (auto& kind : table.kinds)
      result += fmt::format("  {:>{}}", kind, std::max<std::size_t>(kind.size(), 7));
    result += '\n';
    for (auto& [target, cells] : table.rows) {
      result += fmt::format("  {:<{}}", target, width);
      for (std::size_t i = 0; i < cells.size(); ++i)
        result += fmt::format("  {:>{}}", to_text(cells[i]),
                              std::max<std::size_t>(table.kinds[i].size(), 7));
      result += '\n';
    }
  }
  return result;
}

} // namespace castor::faults
