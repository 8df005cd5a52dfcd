#pragma once

#include "castor/base/source_location.hpp"
#include "castor/tools/chaos/fault.hpp"
#include "castor/wm/filters/change_filter.hpp"

#include <compare>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace castor::faults {

/// Once, at this time after the start of the system.
struct At {
  Timestamp time{0};

  friend auto operator<=>(const At&, const At&) = default;
};

/// Periodically, first after one period.
struct Every {
  Timestamp period{0};

  friend auto operator<=>(const Every&, const Every&) = default;
};

/// At random, independent moments.
struct AtRandom {
  Rate rate;

  friend auto operator<=>(const AtRandom&, const AtRandom&) = default;
};

/// At a change that matches the filter.
struct After {
  ChangeFilter filter;
  /// Number of matching changes to wait for.
  std::uint32_t count = 1;
  /// Repeats after every `count` further changes.
  bool repeated = false;

  friend auto operator<=>(const After&, const After&) = default;
};

using Trigger = std::variant<At, Every, AtRandom, After>;

/// One line of a plan: a trigger and its fault. If there are several faults, one is drawn each
/// time.
struct Statement {
  Trigger trigger;
  std::vector<Fault> faults;
  /// Location and text in the file.
  SourceLocation where;
  std::string line;

  friend bool operator==(const Statement& a, const Statement& b) {
    return a.trigger == b.trigger && a.faults == b.faults;
  }
};

/// Faults to inject into a running system. The language is described in docs/fault-plans.md.
struct FaultPlan {
  std::string file;
  std::optional<std::uint64_t> seed;
  std::vector<Statement> statements;

  friend bool operator==(const FaultPlan& a, const FaultPlan& b) {
    return a.seed == b.seed && a.statements == b.statements;
  }
};

/// Filters of the statements triggered by changes, in their order.
std::vector<ChangeFilter> watched_by(const FaultPlan& x);

/// In the syntax of plans.
std::string to_string(const Trigger& x);

/// As a line of a plan, without a line break.
std::string to_string(const Statement& x);

/// A plan with the same statements.
std::string to_string(const FaultPlan& x);

} // namespace castor::faults
