#pragma once

#include "castor/actors/component/health.hpp"
#include "castor/wm/entries/entry.hpp"
#include "castor/wm/values/timestamp.hpp"

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace castor {

class System;

/// An expectation was not met. `what()` says what was expected, what was found instead, and which
/// components had gone down and come back by then.
class ExpectationFailed : public std::runtime_error {
public:
  using runtime_error::runtime_error;
};

struct TestSystemOptions {
  /// Default time limit of expectations.
  std::chrono::milliseconds patience = std::chrono::seconds{10};
  /// Every subarchitecture may write to every other.
  bool open_access = false;
  /// Fault plan (docs/fault-plans.md) of statements that are triggered by changes, for moments that
  /// a test would miss: `after added FindPlan in planning: crash planner`. What tests inject at a
  /// time of their own is no part of it.
  std::string faults = {};
  /// Seed for random choices of faults, such as `any component`.
  std::uint64_t seed = 1;
  /// File name assumed for the text: relative file names in it are resolved against its folder.
  std::string file = "test.cast";
  /// Variables of the text, as defined by `castor run --set`.
  std::map<std::string, std::string> variables = {};
  /// The system has simulated time (docs/time.md). It goes on as fast as all components are done,
  /// and only while the test waits for something, so that `patience` is simulated time too.
  bool simulated_time = false;
};

/// A running system, to test its recovery from failures:
///
///     TestSystem system{"SUBARCHITECTURE hall ..."};
///     system.inject("crash greeter");
///     system.expect_back("greeter");
///     system.expect_nobody_else_down({"greeter"});
///     system.expect_entry("Greeting in hall where text == \"hello\"");
///
/// Works in any test framework: a failed expectation throws ExpectationFailed. The whole system
/// runs in this process, isolated components included. Not thread-safe: use it on one thread.
class TestSystem {
public:
  using Patience = std::optional<std::chrono::milliseconds>;

  /// Starts the system that the text describes, as a .cast file would. Throws std::invalid_argument
  /// if it is no such text or `faults` no such plan, and SystemError if the system cannot be run.
  explicit TestSystem(std::string_view cast, TestSystemOptions options = {});
  TestSystem(const TestSystem&) = delete;
  TestSystem& operator=(const TestSystem&) = delete;
  /// Stops the system.
  ~TestSystem();

  /// Injects a fault now, in the language of fault plans (docs/fault-plans.md): "crash segmentor",
  /// "throw in callback 3 of segmentor", "hang tracker for 3s", "fail journal of vision". Throws
  /// std::invalid_argument if this system has no such target, and std::runtime_error if the target
  /// is not running at the moment.
  void inject(std::string_view fault);

  /// Lets time pass at once. With real time it passes for all working memories only: leases and
  /// entries whose time is over then expire. With simulated time it passes for everybody.
  /// Throws ExpectationFailed if simulated time stands, because a component does not wait.
  void advance(Timestamp by);

  /// Waits until the condition holds.
  /// @param what description of the condition, for the message
  void wait_until(std::string_view what, const std::function<bool()>& condition,
                  Patience within = {});

  /// Waits until a component or a working memory has gone down, unless it already has. Returns its
  /// most recent failure.
  ComponentDown expect_down(const std::string& component, Patience within = {});

  /// Waits until it is up in this incarnation; the one after the start of the system is 1.
  ComponentUp expect_back(const std::string& component, std::uint64_t incarnation = 2,
                          Patience within = {});

  /// Waits until it has gone down and is not restarted.
  ComponentDown expect_given_up(const std::string& component, Patience within = {});

  /// Checks that no component has gone down so far except the known ones; working memories and task
  /// managers count.
  void expect_nobody_else_down(const std::vector<std::string>& known = {});

  /// Waits until the system has ended with this status and a reason that contains the text.
  void expect_end(int status, std::string_view reason = {}, Patience within = {});

  /// Waits for an entry that matches a change filter without an operation, such as `SceneObject in
  /// vision from tracker where confidence > 0.8`, and returns the one written last. Throws
  /// std::invalid_argument if the text is not such a filter.
  EntryPtr expect_entry(std::string_view wanted, Patience within = {});

  /// Waits until no entry matches the filter.
  void expect_no_entry(std::string_view unwanted, Patience within = {});

  /// For all further access (castor/actors/system/system.hpp).
  System& system();

private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

} // namespace castor
