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

/// Once, so long after the system has started.
struct At {
  Timestamp time{0};

  friend auto operator<=>(const At&, const At&) = default;
};

/// Again and again, first after one period.
struct Every {
  Timestamp period{0};

  friend auto operator<=>(const Every&, const Every&) = default;
};

/// At random moments that know nothing of each other.
struct AtRandom {
  Rate rate;

  friend auto operator<=>(const AtRandom&, const AtRandom&) = default;
};

/// At a change that the filter wants.
struct After {
  ChangeFilter filter;
  /// At the so-manieth.
  std::uint32_t count = 1;
  /// And then again after as many.
  bool repeated = false;

  friend auto operator<=>(const After&, const After&) = default;
};

using Trigger = std::variant<At, Every, AtRandom, After>;

/// One line of a plan: when something is to happen, and what. Of several faults one is drawn each
/// time.
struct Statement {
  Trigger trigger;
  std::vector<Fault> faults;
  /// Where it stands, and how it is written there.
  SourceLocation where;
  std::string line;

  friend bool operator==(const Statement& a, const Statement& b) {
    return a.trigger == b.trigger && a.faults == b.faults;
  }
};

/// What is to happen to a system while it runs. The language is described in docs/fault-plans.md.
struct FaultPlan {
  std::string file;
  std::optional<std::uint64_t> seed;
  std::vector<Statement> statements;

  friend bool operator==(const FaultPlan& a, const FaultPlan& b) {
    return a.seed == b.seed && a.statements == b.statements;
  }
};

/// Of the statements whose faults come after changes, in their order.
std::vector<ChangeFilter> watched_by(const FaultPlan& x);

/// As it stands before what is to happen.
std::string to_string(const Trigger& x);

/// As a line of a plan, without a line break.
std::string to_string(const Statement& x);

/// A plan with the same statements.
std::string to_string(const FaultPlan& x);

} // namespace castor::faults
