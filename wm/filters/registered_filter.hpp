#pragma once

#include "castor/wm/filters/bound_predicate.hpp"
#include "castor/wm/filters/change_filter.hpp"
#include "castor/wm/values/per_type.hpp"

#include <cstdint>
#include <optional>

namespace castor {

/// A filter in an index, with what was worked out for the types that it met.
struct RegisteredFilter {
  std::uint64_t key = 0;
  ChangeFilter filter;
  PerType<std::optional<BoundPredicate>> bound;
  /// The last search that came across it.
  std::uint64_t seen = 0;

  /// The same as `matches(filter, event, content)`.
  bool matches(const ChangeEvent& event, const Value& content);
};

} // namespace castor
