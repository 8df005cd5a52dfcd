#include "castor/planning/motivation/motive_schedule.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

namespace castor::planning {

namespace {

/// How often a motive is begun again whose planner has ended.
constexpr std::int32_t most_interruptions = 5;

/// Whether the two cannot be pursued at a time.
bool exclude_each_other(const Motive& a, const Motive& b) {
  return (!a.about.empty() && a.about == b.about) ||
         std::ranges::any_of(a.resources, [&](const std::string& x) {
           return std::ranges::find(b.resources, x) != b.resources.end();
         });
}

} // namespace

bool MotiveSchedule::is_over(const Motive& x) {
  return x.status == MotiveStatus::completed || x.status == MotiveStatus::rejected ||
         x.status == MotiveStatus::dropped;
}

bool MotiveSchedule::is_pursued(const Motive& x) {
  return x.status == MotiveStatus::active || x.status == MotiveStatus::preempted;
}

void MotiveSchedule::set(const std::string& id, MotiveStatus status, const std::string& why,
                         Timestamp now) {
  auto& motive = motives_.at(id).motive;
  motive.status = status;
  motive.history.push_back({now.count(), status, why});
  changed_.insert(id);
}

void MotiveSchedule::propose(const std::string& id, Motive motive, Timestamp now) {
  if (knows(id))
    return;
  motive.history.clear();
  motives_[id] = {std::move(motive), proposed_++};
  set(id, MotiveStatus::proposed, reason_of(this->motive(id)), now);
  if (is_rejected(id, now))
    return;
  set(id, MotiveStatus::queued, {}, now);
  decide(now);
}

void MotiveSchedule::recall(const std::string& id, Motive motive) {
  if (!knows(id) && is_over(motive) && !motive.history.empty())
    motives_[id] = {std::move(motive), proposed_++};
}

bool MotiveSchedule::is_rejected(const std::string& id, Timestamp now) {
  const auto& own = motive(id);
  std::vector<std::string> less_urgent;
  for (const auto& [other_id, other] : motives_) {
    const auto& x = other.motive;
    if (other_id == id || is_over(x) || !other.withdrawn.empty())
      continue;
    if (x.goal.goal == own.goal.goal) {
      set(id, MotiveStatus::rejected, "I am about to " + x.words + " already", now);
      return true;
    }
    if (own.about.empty() || x.about != own.about)
      continue;
    if (own.priority <= x.priority) {
      set(id, MotiveStatus::rejected,
          "I am about to " + x.words + ", because " + reason_of(x) + " before", now);
      return true;
    }
    less_urgent.push_back(other_id);
  }
  for (const auto& x : less_urgent)
    withdraw(x, "it is more urgent to " + own.words + ", because " + reason_of(own), now);
  return false;
}

void MotiveSchedule::withdraw(const std::string& id, const std::string& why, Timestamp now) {
  const auto found = motives_.find(id);
  if (found == motives_.end() || is_over(found->second.motive))
    return;
  if (is_pursued(found->second.motive)) {
    // Dropped once its action has ended safely.
    if (found->second.motive.status == MotiveStatus::active)
      orders_.push_back({MotiveOrder::Kind::end, id});
    found->second.withdrawn = why;
    set(id, MotiveStatus::preempted, why, now);
  } else {
    set(id, MotiveStatus::dropped, why, now);
    decide(now);
  }
}

void MotiveSchedule::ended(const std::string& id, ActionOutcome outcome, const std::string& reason,
                           Timestamp now) {
  const auto found = motives_.find(id);
  if (found == motives_.end() || !is_pursued(found->second.motive))
    return;
  const auto& entry = found->second;
  if (outcome == ActionOutcome::succeeded)
    set(id, MotiveStatus::completed, reason, now);
  else if (!entry.withdrawn.empty())
    set(id, MotiveStatus::dropped, entry.withdrawn, now);
  else if (entry.motive.status == MotiveStatus::preempted)
    set(id, MotiveStatus::queued, entry.motive.history.back().why, now);
  else
    set(id, MotiveStatus::dropped, reason, now);
  decide(now);
}

void MotiveSchedule::interrupted(const std::string& id, const std::string& reason, Timestamp now) {
  const auto found = motives_.find(id);
  if (found == motives_.end() || !is_pursued(found->second.motive))
    return;
  if (!found->second.withdrawn.empty() || ++found->second.interruptions > most_interruptions)
    return ended(id, ActionOutcome::failed, reason, now);
  set(id, MotiveStatus::queued, reason, now);
  decide(now);
}

void MotiveSchedule::drop_old(Timestamp now) {
  std::vector<std::string> old;
  for (const auto& [id, x] : motives_) {
    const std::chrono::duration<double> waited = now - Timestamp{x.motive.history.front().time};
    const bool has_begun = std::ranges::any_of(x.motive.history, [](const MotiveEvent& event) {
      return event.status == MotiveStatus::active;
    });
    if (x.motive.status == MotiveStatus::queued && !has_begun && x.motive.patience > 0 &&
        waited.count() >= x.motive.patience)
      old.push_back(id);
  }
  for (const auto& id : old)
    withdraw(id, "there was no time for it", now);
}

bool MotiveSchedule::precedes(const Entry& a, const Entry& b) {
  if (a.motive.priority != b.motive.priority)
    return a.motive.priority > b.motive.priority;
  if (a.motive.cost != b.motive.cost)
    return a.motive.cost < b.motive.cost;
  return a.number < b.number;
}

std::vector<MotiveSchedule::Entries::iterator> MotiveSchedule::queue() {
  std::vector<Entries::iterator> result;
  for (auto i = motives_.begin(); i != motives_.end(); ++i)
    if (i->second.motive.status == MotiveStatus::queued)
      result.push_back(i);
  std::ranges::sort(result,
                    [](const auto& a, const auto& b) { return precedes(a->second, b->second); });
  return result;
}

void MotiveSchedule::decide(Timestamp now) {
  // What a more urgent one waits for is not given to others.
  std::set<std::string> reserved;
  for (const auto& candidate : queue()) {
    const auto& [id, entry] = *candidate;
    const auto& own = entry.motive;
    std::vector<std::string> in_use;
    bool can_begin = std::ranges::none_of(
      own.resources, [&](const std::string& x) { return reserved.contains(x); });
    bool is_most_urgent = can_begin;
    for (const auto& [other_id, other] : motives_)
      if (is_pursued(other.motive) && other_id != id && exclude_each_other(own, other.motive)) {
        can_begin = false;
        is_most_urgent &= own.priority > other.motive.priority;
        if (other.motive.status == MotiveStatus::active)
          in_use.push_back(other_id);
      }
    reserved.insert(own.resources.begin(), own.resources.end());
    if (can_begin) {
      set(id, MotiveStatus::active, {}, now);
      orders_.push_back({MotiveOrder::Kind::begin, id});
    } else if (is_most_urgent) {
      for (const auto& x : in_use) {
        set(x, MotiveStatus::preempted,
            "it is more urgent to " + own.words + ", because " + reason_of(own), now);
        orders_.push_back({MotiveOrder::Kind::end, x});
      }
    }
  }
  forget_old();
}

void MotiveSchedule::forget_old() {
  std::vector<std::pair<std::uint64_t, std::string>> over;
  for (const auto& [id, x] : motives_)
    if (is_over(x.motive) && !changed_.contains(id))
      over.emplace_back(x.number, id);
  std::ranges::sort(over);
  for (std::size_t i = 0; i + most_over_ < over.size(); ++i)
    if (motives_.erase(over[i].second) > 0)
      forgotten_.push_back(over[i].second);
}

std::vector<std::string> MotiveSchedule::take_forgotten() {
  return std::exchange(forgotten_, {});
}

std::vector<MotiveOrder> MotiveSchedule::take_orders() {
  return std::exchange(orders_, {});
}

std::set<std::string> MotiveSchedule::take_changed() {
  return std::exchange(changed_, {});
}

} // namespace castor::planning
