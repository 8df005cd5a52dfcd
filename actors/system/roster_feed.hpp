#pragma once

#include "castor/actors/supervision/roster.hpp"
#include "castor/base/log.hpp"

#include <caf/actor.hpp>

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

namespace castor {

/// The newest roster of a system, and the actors that are sent every new one. Safe to use from any
/// thread.
class RosterFeed {
public:
  SystemRosterPtr newest() const;
  void update(SystemRosterPtr x);
  /// Replaces the roster with an empty one, which is not sent.
  void clear();

  /// Sends the endpoint the roster now, and every new one.
  void set_endpoint(const caf::actor& x);

  /// Sends the observer ObservedSystem now, and with every new roster. `logged` has the levels at
  /// which changes are logged, by subarchitecture.
  void set_observer(const caf::actor& x, std::map<std::string, LogLevel> logged);

private:
  void tell_observer() const;

  mutable std::mutex mutex_;
  SystemRosterPtr newest_ = std::make_shared<const SystemRoster>();
  caf::actor endpoint_;
  caf::actor observer_;
  std::map<std::string, LogLevel> logged_;
};

} // namespace castor
