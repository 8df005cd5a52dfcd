#include "castor/wm/store/lifetimes.hpp"

namespace castor {

namespace {

std::optional<Timestamp> expiry(Timestamp time_to_live, Timestamp now) {
  return time_to_live.count() > 0 ? std::optional{now + time_to_live} : std::nullopt;
}

} // namespace

void Lifetimes::add(const std::string& id, Timestamp time_to_live, ClientPtr owner, Timestamp now) {
  auto& lifetime = lifetimes_[id];
  if (owner)
    owned_.insert(id);
  lifetime.owner = std::move(owner);
  set_due(id, lifetime, expiry(time_to_live, now), expiry_source);
}

void Lifetimes::restart(const std::string& id, Timestamp time_to_live, Timestamp now) {
  auto& lifetime = lifetimes_[id];
  if (lifetime.source == expiry_source)
    set_due(id, lifetime, expiry(time_to_live, now), expiry_source);
}

void Lifetimes::set_will(const std::string& id, ClientPtr testator, LastWill will) {
  auto& lifetime = lifetimes_[id];
  bool is_left = will.value.has_value();
  lifetime.testator = is_left ? std::move(testator) : nullptr;
  lifetime.will = std::move(will);
  if (is_left || lifetime.owner)
    owned_.insert(id);
  else
    owned_.erase(id);
}

const LastWill* Lifetimes::due_will(const std::string& id) const {
  auto& lifetime = lifetimes_.at(id);
  return lifetime.testator && lifetime.source == last_will_source ? &lifetime.will : nullptr;
}

void Lifetimes::fulfil(const std::string& id, Timestamp time_to_live, Timestamp now) {
  set_will(id, nullptr, {});
  set_due(id, lifetimes_.at(id), expiry(time_to_live, now), expiry_source);
}

void Lifetimes::erase(const std::string& id) {
  auto i = lifetimes_.find(id);
  if (i == lifetimes_.end())
    return;
  if (i->second.due)
    due_.erase({*i->second.due, id});
  owned_.erase(id);
  lifetimes_.erase(i);
}

ClientPtr Lifetimes::owner(const std::string& id) const {
  auto i = lifetimes_.find(id);
  if (i == lifetimes_.end())
    return nullptr;
  return i->second.owner ? i->second.owner : i->second.testator;
}

void Lifetimes::end_owner(const Client& owner, Timestamp now) {
  for (auto& id : owned_) {
    auto& lifetime = lifetimes_.at(id);
    if (lifetime.owner && *lifetime.owner == owner)
      set_due(id, lifetime, now, owner_ended_source);
    else if (lifetime.testator && *lifetime.testator == owner)
      set_due(id, lifetime, now, last_will_source);
  }
}

void Lifetimes::orphan(const std::string& id, Timestamp now) {
  set_due(id, lifetimes_[id], now, owner_ended_source);
}

void Lifetimes::postpone(const std::string& id, Timestamp until) {
  auto& lifetime = lifetimes_.at(id);
  set_due(id, lifetime, until, lifetime.source);
}

std::optional<Timestamp> Lifetimes::next_due() const {
  return due_.empty() ? std::nullopt : std::optional{due_.begin()->first};
}

std::vector<std::string> Lifetimes::due(Timestamp now) const {
  std::vector<std::string> result;
  for (auto i = due_.begin(); i != due_.end() && i->first <= now; ++i)
    result.push_back(i->second);
  return result;
}

void Lifetimes::set_due(const std::string& id, Lifetime& lifetime, std::optional<Timestamp> due,
                        const char* source) {
  if (lifetime.due)
    due_.erase({*lifetime.due, id});
  lifetime.due = due;
  lifetime.source = source;
  if (due)
    due_.emplace(*due, id);
}

} // namespace castor
