#include "castor/tools/cli/forbidden_changes.hpp"

#include "castor/tools/cli/watched_changes.hpp"

#include <fmt/core.h>

namespace castor::cli {

void ForbiddenChanges::watch(SystemOptions& options) {
  std::vector<ChangeFilter> filters;
  for (auto& x : never_)
    filters.push_back(x.filter);
  watch_changes(options, filters, [this](std::size_t filter, const ChangeEvent& event) {
    std::lock_guard guard{mutex_};
    auto& x = seen_[filter];
    if (x.count++ == 0)
      x.first = fmt::format("{} of {} by {}", to_string(event.operation), to_string(event.address),
                            event.source);
  });
}

std::vector<std::string> ForbiddenChanges::violations() const {
  std::lock_guard guard{mutex_};
  std::vector<std::string> result;
  for (std::size_t i = 0; i < never_.size(); ++i)
    if (seen_[i].count > 0)
      result.push_back(fmt::format("{}: {}: {} {}, the first: {}", to_string(never_[i].where),
                                   never_[i].line, seen_[i].count,
                                   seen_[i].count == 1 ? "change" : "changes", seen_[i].first));
  return result;
}

} // namespace castor::cli
