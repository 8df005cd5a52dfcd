#pragma once

#include "castor/wm/filters/change_filter.hpp"
#include "castor/wm/filters/filter_index.hpp"
#include "castor/wm/memory/working_memory_protocol.hpp"

#include <map>
#include <optional>
#include <unordered_map>
#include <vector>

namespace castor {

/// What the components of one subarchitecture want of the others: filters that say the same are one
/// interest, so that every other working memory hears of it, and sends an event for it, once.
class RemoteInterests {
public:
  /// Interests are numbered from above `last`.
  explicit RemoteInterests(InterestId last) : last_(last) {}

  /// The interest of a filter that a subscriber has registered.
  InterestId add(const ChangeFilter& filter, FilterIndex::Key subscriber);

  /// The interest, if it was the last of its subscribers; nothing as long as there are others.
  std::optional<InterestId> remove(const ChangeFilter& filter, FilterIndex::Key subscriber);

  /// Appends the subscribers of an interest, none of one that was withdrawn.
  void append_subscribers(InterestId id, std::vector<FilterIndex::Key>& out) const;

  /// Calls `f` with the filter and the number of each.
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
