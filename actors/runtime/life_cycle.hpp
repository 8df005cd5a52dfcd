#pragma once

#include "castor/actors/runtime/shell_protocol.hpp"

#include <deque>

namespace castor {

/// Life-cycle state of a component: its commanded phases, whether it was told to stop, and whether
/// its working memory is there. Independent of time and messages.
class LifeCycle {
public:
  /// The component was told to enter the phase, once it is done with those before.
  void command(Phase x) { commanded_.push_back(x); }

  /// Enters the phase if it is the next one that was commanded.
  bool try_enter(Phase x);

  /// configure() has returned, or has ended for another reason than a wrong configuration.
  void leave_configure() { configuring_ = false; }
  bool is_configuring() const { return configuring_; }

  /// Whether start() was called.
  bool has_started() const { return started_; }

  void stop() { stopping_ = true; }
  bool is_stopping() const { return stopping_; }

  /// The component's own stop() runs from now on, which may still use working memory.
  void enter_stop_hook() { in_stop_hook_ = true; }

  /// Whether operations throw ComponentStopped.
  bool refuses_operations() const { return stopping_ && !in_stop_hook_; }

  /// The component's own working memory has ended, or is not there yet.
  void set_working_memory_lost(bool x) { working_memory_lost_ = x; }
  bool is_working_memory_lost() const { return working_memory_lost_; }

private:
  std::deque<Phase> commanded_;
  bool configuring_ = false;
  bool started_ = false;
  bool stopping_ = false;
  bool in_stop_hook_ = false;
  bool working_memory_lost_ = false;
};

} // namespace castor
