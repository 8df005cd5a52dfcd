#include "castor/actors/system/roster_feed.hpp"

#include "castor/actors/system/observer.hpp"

#include <caf/send.hpp>

#include <utility>

namespace castor {

SystemRosterPtr RosterFeed::newest() const {
  std::lock_guard guard{mutex_};
  return newest_;
}

void RosterFeed::update(SystemRosterPtr x) {
  std::lock_guard guard{mutex_};
  newest_ = std::move(x);
  if (endpoint_)
    caf::anon_send(endpoint_, newest_);
  tell_observer();
}

void RosterFeed::clear() {
  std::lock_guard guard{mutex_};
  newest_ = std::make_shared<const SystemRoster>();
}

void RosterFeed::set_endpoint(const caf::actor& x) {
  std::lock_guard guard{mutex_};
  endpoint_ = x;
  caf::anon_send(endpoint_, newest_);
}

void RosterFeed::set_observer(const caf::actor& x, std::map<std::string, LogLevel> logged) {
  std::lock_guard guard{mutex_};
  observer_ = x;
  logged_ = std::move(logged);
  tell_observer();
}

void RosterFeed::tell_observer() const {
  if (observer_)
    caf::anon_send(observer_, ObservedSystem{newest_->working_memories, logged_});
}

} // namespace castor
