#pragma once

#include "castor/wm/filters/change_filter.hpp"
#include "castor/wm/filters/filter_index.hpp"
#include "castor/wm/memory/working_memory_messages.hpp"

#include <map>
#include <optional>
#include <unordered_map>
#include <vector>

namespace castor {

/// Interests of one subarchitecture's components in events of the others. Equal filters share one
/// interest, so that every other working memory registers it, and sends an event for it, once.
class RemoteInterests {
public:
  /// Interests are numbered from `last` + 1.
  explicit RemoteInterests(InterestId last) : last_(last) {}

  /// The interest of a filter that a subscriber has registered.
  InterestId add(const ChangeFilter& filter, FilterIndex::Key subscriber);

  /// Removes a subscriber; returns the interest if it was the last one, else nothing.
  std::optional<InterestId> remove(const ChangeFilter& filter, FilterIndex::Key subscriber);

  /// Appends the subscribers of an interest; none if it was withdrawn.
  void append_subscribers(InterestId id, std::vector<FilterIndex::Key>& out) const;

  /// Calls `f` with the filter and the number of each interest.
  template <class F>
  void for_each(F&& f) const {
    for (auto& [filter, interest] : by_filter_)
      f(filter, interest.id);
  }

private:
  struct Shared {
    InterestId id = 0;
    std::vector<FilterIndex::Key> subscribers;
  };

  std::map<ChangeFilter, Shared> by_filter_;
  std::unordered_map<InterestId, const Shared*> by_id_;
  InterestId last_;
};

} // namespace castor
