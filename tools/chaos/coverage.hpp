#pragma once

#include "castor/tools/chaos/chaos_run.hpp"

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace castor::faults {

/// Number of faults by kind and target, in one run or in several.
class Coverage {
public:
  struct Cell {
    /// Faults that happened.
    std::size_t hits = 0;
    /// Faults that did not.
    std::size_t misses = 0;
  };

  /// Targets for which the same kinds are possible.
  struct Table {
    std::vector<std::string> kinds;
    /// By target, one cell for each kind.
    std::map<std::string, std::vector<Cell>> rows;
  };

  Coverage() = default;
  /// Zero for every kind that a system has to survive (`fault_kinds`), at every target.
  explicit Coverage(const FaultTargets& targets);

  void add(std::span<const FaultRecord> faults);

  std::vector<Table> tables() const;
  /// Pairs of a kind and a target.
  std::size_t possible() const;
  std::size_t hit() const;
  bool empty() const { return cells_.empty(); }

private:
  /// By target and kind.
  std::map<std::string, std::map<std::string, Cell, std::less<>>> cells_;
};

/// Of one run.
Coverage coverage_of(const ChaosRun& run);

/// "3 -1": three that happened, and one that did not; a dot if none happened.
std::string to_text(const Coverage::Cell& x);

/// "31 of 96 pairs of a fault and a target were hit", and tables of the numbers.
std::string to_text(const Coverage& x);

} // namespace castor::faults
