#include "castor/tools/cli/forbidden_changes.hpp"

#include <fmt/core.h>

#include <utility>

namespace castor::cli {

void ForbiddenChanges::watch(SystemOptions& options) {
  auto first = options.watched.size();
  for (auto& x : never_)
    options.watched.push_back(x.filter);
  options.on_watched = [this, first, next = std::move(options.on_watched)](
                         std::size_t filter, const ChangeEvent& event) {
    if (filter < first)
      return next(filter, event);
    std::lock_guard guard{mutex_};
    auto& x = seen_[filter - first];
    if (x.count++ == 0)
      x.first = fmt::format("{} of {} by {}", to_string(event.operation), to_string(event.address),
                            event.source);
  };
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
