#pragma once

#include "castor/actors/runtime/crash_report.hpp"
#include "castor/actors/runtime/injected_faults.hpp"
#include "castor/actors/runtime/record.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

namespace castor {

/// Calls the component's own code, and keeps its activity and running time.
class UserCode {
public:
  using Clock = ComponentRecord::Clock;

  UserCode(ComponentRecord& record, InjectedFaults& faults)
    : record_(record), faults_(faults), crash_note_(record.activity) {}

  /// `what` names the call in reports of its failure, and outlives it.
  template <class F>
  void run(const CodeActivity& what, F&& f) {
    ActivityScope scope{record_.activity, what};
    record_.enter_user_code(Clock::now());
    f();
    record_.leave_user_code();
    scope.leave();
  }

  template <class F>
  void run(std::string_view what, F&& f) {
    run(CodeActivity{what}, std::forward<F>(f));
  }

  /// The same for a callback, which faults may have been injected into.
  template <class F>
  void run_callback(const CodeActivity& what, F&& f) {
    run(what, [&] {
      ++callbacks_;
      ++record_.counters.callbacks;
      faults_.in_callback();
      f();
    });
  }

  template <class F>
  void run_callback(std::string_view what, F&& f) {
    run_callback(CodeActivity{what}, std::forward<F>(f));
  }

  /// Number of callbacks so far.
  std::uint64_t callbacks() const { return callbacks_; }

  /// Last activity of the code, such as "configure()".
  std::string activity() const { return to_string(record_.activity.own()); }
  /// What `x` refers to has to outlive the next change.
  void set_activity(const CodeActivity& x) { record_.activity.set(x); }

  CrashNote& crash_note() { return crash_note_; }

  /// While it lives, the component's own code waits for the runtime, which called it or was called
  /// by it.
  class Pause {
  public:
    explicit Pause(UserCode& code) : record_(code.record_) { record_.leave_user_code(); }
    Pause(const Pause&) = delete;
    Pause& operator=(const Pause&) = delete;
    ~Pause() { record_.enter_user_code(Clock::now()); }

    /// Pauses again, after code in between that may have been the component's.
    void renew() { record_.leave_user_code(); }

  private:
    ComponentRecord& record_;
  };

private:
  ComponentRecord& record_;
  InjectedFaults& faults_;
  CrashNote crash_note_;
  std::uint64_t callbacks_ = 0;
};

} // namespace castor
