#pragma once

#include "castor/actors/node/system_options.hpp"
#include "castor/wm/filters/change_filter.hpp"

#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

namespace castor::cli {

/// Adds filters to those that a system watches. `on_change` gets the index among `filters`, by any
/// thread.
inline void watch_changes(SystemOptions& options, const std::vector<ChangeFilter>& filters,
                          std::function<void(std::size_t, const ChangeEvent&)> on_change) {
  const auto first = options.watched.size();
  const auto end = first + filters.size();
  options.watched.insert(options.watched.end(), filters.begin(), filters.end());
  options.on_watched = [first, end, on_change = std::move(on_change),
                        others = std::move(options.on_watched)](std::size_t filter,
                                                                const ChangeEvent& event) {
    if (filter >= first && filter < end)
      on_change(filter - first, event);
    else
      others(filter, event);
  };
}

} // namespace castor::cli
