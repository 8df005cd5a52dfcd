#include "castor/actors/runtime/executed_actions.hpp"

#include <algorithm>
#include <utility>

namespace castor {

void ExecutedActions::offer(const std::string& type, bool alongside) {
  offers_[type] = alongside;
}

void ExecutedActions::propose(const Address& action, const std::string& type) {
  auto is_waiting =
    std::any_of(waiting_.begin(), waiting_.end(), [&](auto& x) { return x.action == action; });
  if (is_offered(type) && !is_waiting && !is_under_way(action))
    waiting_.push_back({action, type});
}

void ExecutedActions::prefer(const Address& action) {
  auto x = std::find_if(waiting_.begin(), waiting_.end(),
                        [&](auto& waiting) { return waiting.action == action; });
  if (x == waiting_.end() || !preferred_.insert(action).second)
    return;
  auto first = std::find_if(waiting_.begin(), x,
                            [&](auto& waiting) { return preferred_.count(waiting.action) == 0; });
  std::rotate(first, x, x + 1);
}

std::optional<ExecutedActions::Candidate> ExecutedActions::begin_next() {
  auto next = std::find_if(waiting_.begin(), waiting_.end(),
                           [&](auto& x) { return under_way_.empty() || offers_.at(x.type); });
  if (next == waiting_.end())
    return std::nullopt;
  auto result = std::move(*next);
  waiting_.erase(next);
  preferred_.erase(result.action);
  under_way_[result.action];
  return result;
}

void ExecutedActions::set_specific_entry(const Address& action, Address what) {
  under_way_.at(action).what = std::move(what);
}

bool ExecutedActions::changed(const Address& action) {
  auto i = under_way_.find(action);
  if (i == under_way_.end())
    return false;
  return i->second.is_changed = true;
}

bool ExecutedActions::deleted(const Address& entry) {
  std::erase_if(waiting_, [&](auto& x) { return x.action == entry; });
  preferred_.erase(entry);
  auto result = changed(entry);
  for (auto& [action, x] : under_way_)
    if (x.what == entry)
      result = x.is_changed = x.is_requester_gone = true;
  return result;
}

bool ExecutedActions::memory_lost(const std::string& subarchitecture) {
  std::erase_if(waiting_, [&](auto& x) { return x.action.subarchitecture == subarchitecture; });
  std::erase_if(preferred_, [&](auto& x) { return x.subarchitecture == subarchitecture; });
  auto result = false;
  for (auto& [action, x] : under_way_)
    if (action.subarchitecture == subarchitecture)
      result = x.is_changed = x.is_requester_gone = true;
  return result;
}

bool ExecutedActions::take_changed(const Address& action) {
  auto i = under_way_.find(action);
  return i != under_way_.end() && std::exchange(i->second.is_changed, false);
}

bool ExecutedActions::is_changed(const Address& action) const {
  auto i = under_way_.find(action);
  return i != under_way_.end() && i->second.is_changed;
}

bool ExecutedActions::is_requester_gone(const Address& action) const {
  auto i = under_way_.find(action);
  return i != under_way_.end() && i->second.is_requester_gone;
}

} // namespace castor
