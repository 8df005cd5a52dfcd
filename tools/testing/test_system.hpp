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

/// An expectation was not met. `what()` says what was expected, what there was instead, and who had
/// gone down and come back by then.
class ExpectationFailed : public std::runtime_error {
public:
  using runtime_error::runtime_error;
};

struct TestSystemOptions {
  /// How long is waited for what is expected, unless that says otherwise.
  std::chrono::milliseconds patience = std::chrono::seconds{10};
  /// Every subarchitecture may write to every other.
  bool open_access = false;
  /// Draws what a fault leaves open, such as `any component`.
  std::uint64_t seed = 1;
  /// What the text is taken for the content of: files that it names are looked for beside it.
  std::string file = "test.cast";
  /// Defined before the text is read, as by `castor run --set`.
  std::map<std::string, std::string> variables = {};
};

/// A running system, to test what becomes of it when something fails:
///
///     TestSystem system{"SUBARCHITECTURE hall ..."};
///     system.inject("crash greeter");
///     system.expect_back("greeter");
///     system.expect_nobody_else_down({"greeter"});
///     system.expect_entry("Greeting in hall where text == \"hello\"");
///
/// Works in any test framework: what is not as expected is thrown, as ExpectationFailed. All of the
/// system runs in this process, isolated components included. Used on one thread.
class TestSystem {
public:
  using Patience = std::optional<std::chrono::milliseconds>;

  /// Starts the system that the text describes, as a .cast file would. Throws std::invalid_argument
  /// if it is no such text, and SystemError if the system cannot be run.
  explicit TestSystem(std::string_view cast, TestSystemOptions options = {});
  TestSystem(const TestSystem&) = delete;
  TestSystem& operator=(const TestSystem&) = delete;
  /// Stops the system.
  ~TestSystem();

  /// Injects a fault now, in the words of fault plans (docs/fault-plans.md):
  /// "crash segmentor", "throw in callback 3 of segmentor", "hang tracker for 3s", "fail journal of
  /// vision". Throws std::invalid_argument if this system has no such target, and
  /// std::runtime_error if nothing of that name is there at the moment.
  void inject(std::string_view fault);

  /// Lets the clocks of all working memories jump: leases and entries end whose time is over then.
  void advance(Timestamp by);

  /// Waits until the condition holds.
  /// @param what what is waited for, for the message
  void wait_until(std::string_view what, const std::function<bool()>& condition,
                  Patience within = {});

  /// A component or a working memory goes down, or has done so already. Returns the last time.
  ComponentDown expect_down(const std::string& component, Patience within = {});

  /// It is back in that life of its, the first being the one that it was started with.
  ComponentUp expect_back(const std::string& component, std::uint64_t incarnation = 2,
                          Patience within = {});

  /// It goes down and is not started again.
  ComponentDown expect_given_up(const std::string& component, Patience within = {});

  /// Nobody else has gone down so far; working memories and task managers count.
  void expect_nobody_else_down(const std::vector<std::string>& known = {});

  /// The system ends, with that status and a reason that contains the text.
  void expect_end(int status, std::string_view reason = {}, Patience within = {});

  /// There is such an entry: a change filter without an operation, such as
  /// `SceneObject in vision from tracker where confidence > 0.8`. Throws std::invalid_argument if
  /// it is none. The most recently written one is returned.
  EntryPtr expect_entry(std::string_view wanted, Patience within = {});

  /// There is no such entry any more, or not yet.
  void expect_no_entry(std::string_view unwanted, Patience within = {});

  /// For what goes beyond that (castor/actors/system/system.hpp).
  System& system();

private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

} // namespace castor
