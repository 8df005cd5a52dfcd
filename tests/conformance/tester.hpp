#pragma once

#include "castor/actors/component/managed_component.hpp"
#include "castor/tests/conformance/test_struct.hpp"

#include <chrono>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace castor::conformance {

/// The exit statuses of a system that tests itself, as in the original.
constexpr int passed_status = 29;
constexpr int failed_status = 30;

class Tester;

/// One of the tests that a tester offers. An exception that leaves any of its functions fails it.
class Test {
public:
  explicit Test(Tester& tester) : tester_(tester) {}
  Test(const Test&) = delete;
  Test& operator=(const Test&) = delete;
  virtual ~Test() = default;

  /// Everything is connected, and no component runs yet: the place for change filters.
  virtual void start() {}

  /// All components have started.
  virtual void run() {}

  /// What the test still needs in order to end; empty if it never ends of itself.
  virtual std::string awaited() const = 0;

protected:
  void pass();
  void fail(const std::string& why);

  /// Calls `handle` for every event that the filter wants, but never in the middle of another piece
  /// of a test.
  void when(const ChangeFilter& filter, ChangeCallback handle);
  /// The same, for the events that other components cause.
  void when_others(const ChangeFilter& filter, ChangeCallback handle);

  Tester& tester_;
};

/// A component that does one or several of the tests it offers, and ends the system with the
/// verdict: with 30 as soon as a test has failed, with 29 once all have passed.
class Tester : public ManagedComponent {
public:
  // What tests work with.
  using ManagedComponent::add;
  using ManagedComponent::add_async;
  using ManagedComponent::complete_task;
  using ManagedComponent::component_name;
  using ManagedComponent::delete_entry;
  using ManagedComponent::here;
  using ManagedComponent::info;
  using ManagedComponent::is_overwritable;
  using ManagedComponent::is_readable;
  using ManagedComponent::lock;
  using ManagedComponent::new_id;
  using ManagedComponent::now;
  using ManagedComponent::on_change;
  using ManagedComponent::on_push;
  using ManagedComponent::overwrite;
  using ManagedComponent::propose_task;
  using ManagedComponent::pull;
  using ManagedComponent::read;
  using ManagedComponent::read_all_in;
  using ManagedComponent::read_async;
  using ManagedComponent::receiver_count;
  using ManagedComponent::remove_receiver;
  using ManagedComponent::sleep_for;
  using ManagedComponent::try_lock;
  using ManagedComponent::version;

  /// The subarchitecture that the tests write to.
  std::string home() const;
  Address new_address() { return {home(), new_id()}; }

  /// What this tester writes.
  TestStruct made(Operation operation, const Address& address, std::int64_t count) const;

  void pass(const Test& test);
  void fail(const Test& test, const std::string& why);

  /// Has `job` done when nothing else is under way, unless the test is over by then.
  void post(const Test& test, std::function<void()> job);

  /// Waits for change events until the condition holds; false if it does not within the time.
  bool wait_until(const std::function<bool()>& condition, std::chrono::nanoseconds at_most);

  /// Whether nothing happened for so long that would concern a test.
  bool idle_for(std::chrono::nanoseconds duration);

  /// Asks again and again until the condition holds, for what no event tells of. Throws
  /// std::runtime_error if the patience ends before.
  void poll(const std::string& what, const std::function<bool()>& condition);

protected:
  using Factory = std::function<std::unique_ptr<Test>()>;

  /// Only in constructors. `make` is called when options have their values.
  void offer(const std::string& name, Factory make) { offered_[name] = std::move(make); }

private:
  struct Chosen {
    std::string name;
    std::unique_ptr<Test> test;
    bool over = false;
  };

  struct Job {
    Chosen* of;
    std::function<void()> work;
  };

  void configure() override;
  void start() override;
  void run() override;

  std::string choose();
  Chosen& chosen(const Test& test);
  void work_off();
  void attempt(Chosen& x, const std::function<void()>& work);
  void end(int status, const std::string& reason);
  void give_up();
  bool all_over() const;

  std::map<std::string, Factory> offered_;
  std::vector<Chosen> chosen_;
  std::deque<Job> jobs_;
  bool failed_ = false;
  Timestamp patience_ends_ = Timestamp::max();

  Option<std::vector<std::string>> test_{
    this, "test", {}, "which tests to do; may be left out where there is only one"};
  Option<bool> exit_{this, "exit", true, "end the system with the verdict"};
  Option<SubarchitectureName> subarch_{this, "subarch", "",
                                       "the subarchitecture to write to; empty: the own one"};
  Option<std::chrono::milliseconds> patience_{this, "patience", std::chrono::seconds{60},
                                              "a test that is not over by then has failed"};
};

} // namespace castor::conformance
