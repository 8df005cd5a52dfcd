#pragma once

#include "castor/wm/filters/bound_predicate.hpp"
#include "castor/wm/filters/change_filter.hpp"
#include "castor/wm/values/per_type.hpp"

#include <cstdint>
#include <optional>

namespace castor {

/// A filter in an index, with its predicate bound to the types seen so far.
struct RegisteredFilter {
  std::uint64_t key = 0;
  ChangeFilter filter;
  PerType<std::optional<BoundPredicate>> bound;
  /// Number of the last search that found it.
  std::uint64_t seen = 0;

  /// The same as `matches(filter, event, content)`.
  bool matches(const ChangeEvent& event, const Value& content);
};

} // namespace castor
