#include "castor/actors/component/action_types.hpp"
#include "castor/actors/system/fault_port.hpp"
#include "castor/tests/actors/component/scripted.hpp"
#include "castor/tests/support/temporary_folder.hpp"

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

/// What becomes of an action whose requester or executor crashes, in each state of the action.
namespace castor::test {

namespace {

using testing::HasSubstr;
using Clock = std::chrono::steady_clock;

struct Lift {
  int number = 0;
};
CASTOR_REFLECT(Lift, number)

/// How often each failure is tried; `scripts/action-kills` tries a hundred times.
int times() {
  auto* given = std::getenv("CASTOR_ACTION_KILLS");
  return given ? std::atoi(given) : 2;
}

/// A requester and a bystander in a, an executor in b.
class FailuresOfActions : public testing::Test {
protected:
  using Self = ManagedScript;

  void SetUp() override { reset(); }
  void TearDown() override { clear_scripts(); }

  static auto& script(const std::string& name) { return ManagedScript::scripts()[name]; }

  void reset() {
    requester_lives = executor_lives = 0;
    offers = true;
    finishes = ignores_cancel = is_locked = false;
    wish = nothing;
    lock_next(std::nullopt);
    executions.clear();
    script("requester").run = [this](Self& self) { request(self, requester_lives++); };
    script("executor").run = [this](Self& self) { execute(self); };
    script("bystander").run = [this](Self& self) { lock(self); };
  }

  /// The first life asks for its actions and does what the test wishes, the second asks for one
  /// more.
  void request(Self& self, int life) {
    std::vector<ActionHandle> handles;
    for (int i = 0; i < (life == 0 ? actions : 1); ++i) {
      // The first is to be the one that occupies the executor.
      while (!handles.empty() && handles.back().status() != ActionStatus::running)
        if (!self.sleep_for(1ms))
          return;
      handles.push_back(self.perform(
        "b", Lift{i},
        {.cause = {Address{"life", fmt::format("{}.{}", life, i)}, ""}, .continues = continues}));
    }
    while (self.sleep_for(1ms)) {
      auto now = wish.exchange(nothing);
      if (now == pause)
        handles.back().pause();
      else if (now == cancel)
        handles.back().cancel();
    }
  }

  /// Works on an action until it is cancelled or finished.
  void execute(Self& self) {
    ++executor_lives;
    while (!offers)
      if (!self.sleep_for(1ms))
        return;
    self.on_action<Lift>(
      [this, &self](ActionInProgress& action, const Lift&) {
        {
          std::lock_guard guard{mutex};
          ++executions[action.address()];
        }
        while (!finishes) {
          if (!action.wait_while_paused() && !ignores_cancel)
            return ActionResult::cancelled();
          self.sleep_for(1ms);
        }
        return ActionResult::succeeded();
      },
      {.can_pause = true});
  }

  /// What the component that locks is to lock; nothing if it is to end.
  void lock_next(std::optional<Address> address) {
    std::lock_guard guard{mutex};
    locks = std::move(address);
  }

  std::optional<Address> wanted_lock() {
    std::lock_guard guard{mutex};
    return locks;
  }

  /// Locks what the test says until there is nothing to lock.
  void lock(Self& self) {
    while (self.sleep_for(1ms)) {
      const auto address = wanted_lock();
      if (address && !is_locked) {
        self.lock_entry(*address, LockLevel::odr);
        is_locked = true;
      } else if (!address && is_locked) {
        self.end_component();
      }
    }
  }

  static ArchitectureDescription description(const std::string& journal = {}) {
    auto policy = " one_for_one RESTARTS 1000 IN 1s DELAY 1ms TO 1ms\n";
    return architecture("SUBARCHITECTURE a\nCPP WM SubarchitectureWorkingMemory --lease 50ms" +
                        journal +
                        "\nCPP TM AlwaysPositiveTaskManager\n"
                        "CPP MG requester Managed\n"
                        "CPP MG bystander Managed --restart temporary\n" +
                        subarchitecture("b") + "CPP MG executor Managed\nSUPERVISE SYSTEM" +
                        policy + "SUPERVISE *" + policy);
  }

  /// The action of that life of the requester and that number, as it stands.
  static std::optional<Action> find(System& system, int life, int number) {
    auto id = fmt::format("{}.{}", life, number);
    for (auto& x : system.entries("a"))
      if (auto action = x->value.as<Action>(); action && action->cause.address.id == id)
        return *action;
    return std::nullopt;
  }

  static bool has_status(System& system, int life, int number, ActionStatus status) {
    auto x = find(system, life, number);
    return x && x->status == status;
  }

  int executed() {
    std::lock_guard guard{mutex};
    return static_cast<int>(executions.size());
  }

  void expect_none_was_executed_twice() {
    std::lock_guard guard{mutex};
    for (auto& [action, count] : executions)
      EXPECT_EQ(count, 1) << to_string(action);
  }

  /// Brings the last action of the first life into the state.
  void bring_into(System& system, ActionStatus status, int number) {
    auto has = [&](ActionStatus x) {
      return eventually([&] { return has_status(system, 0, number, x); });
    };
    if (status == ActionStatus::accepted) {
      // Its executor waits to read what it is to do.
      ASSERT_TRUE(has(ActionStatus::proposed));
      lock_next(find(system, 0, number)->what.address);
      ASSERT_TRUE(eventually([&] { return is_locked.load(); }));
      offers = true;
    } else if (status == ActionStatus::paused || status == ActionStatus::cancelling) {
      ASSERT_TRUE(has(ActionStatus::running));
      ignores_cancel = status == ActionStatus::cancelling;
      wish = status == ActionStatus::paused ? pause : cancel;
    } else if (status == ActionStatus::over) {
      ASSERT_TRUE(has(ActionStatus::running));
      finishes = true;
    }
    ASSERT_TRUE(has(status));
  }

  /// Crashes the component, and waits until the action is over, or was over and is deleted with its
  /// handle; the time that takes.
  std::chrono::nanoseconds crash(System& system, const std::string& name, int number) {
    auto begin = Clock::now();
    EXPECT_TRUE(system.faults().inject(name, ComponentFault{}));
    auto release = [this] {
      ignores_cancel = false;
      lock_next(std::nullopt);
    };
    // An executor that is to crash could otherwise begin or end its action before that.
    if (name != "executor")
      release();
    EXPECT_TRUE(eventually([&] {
      auto x = find(system, 0, number);
      return !x || x->status == ActionStatus::over;
    }));
    auto result = Clock::now() - begin;
    release();
    return result;
  }

  static void report(const std::string& what, std::vector<std::chrono::nanoseconds> durations) {
    std::ranges::sort(durations);
    auto at = [&](double part) {
      auto last = static_cast<double>(durations.size() - 1);
      return std::chrono::duration<double, std::milli>(
               durations[static_cast<std::size_t>(part * last)])
        .count();
    };
    fmt::print("{}: over after {:.1f} ms (p50), {:.1f} ms (p99), {} runs\n", what, at(0.5),
               at(0.99), durations.size());
  }

  enum Wish { nothing, pause, cancel };

  int actions = 1;
  bool continues = false;
  std::atomic<int> requester_lives{0};
  std::atomic<int> executor_lives{0};
  std::atomic<bool> offers{true};
  std::atomic<bool> finishes{false};
  std::atomic<bool> ignores_cancel{false};
  std::atomic<bool> is_locked{false};
  std::atomic<Wish> wish{nothing};
  std::optional<Address> locks;
  std::mutex mutex;
  std::map<Address, int> executions;
};

std::string name_of(ActionStatus status) {
  for (auto& [name, x] : reflection_of<ActionStatus>().enumerators)
    if (x == status)
      return std::string{name};
  return {};
}

class InEachState : public FailuresOfActions, public testing::WithParamInterface<ActionStatus> {};

TEST_P(InEachState, AnActionFailsIfItsExecutorCrashes) {
  auto state = GetParam();
  std::vector<std::chrono::nanoseconds> durations;
  for (int i = 0; i < times() && !HasFailure(); ++i) {
    reset();
    // An executor that is at work leaves others proposed.
    actions = state == ActionStatus::proposed ? 2 : 1;
    offers = state != ActionStatus::accepted;
    System system{description()};
    ASSERT_TRUE(system.start());
    if (state == ActionStatus::proposed) {
      ASSERT_TRUE(eventually([&] { return has_status(system, 0, 0, ActionStatus::running); }));
    }
    ASSERT_NO_FATAL_FAILURE(bring_into(system, state, actions - 1));
    durations.push_back(crash(system, "executor", 0));
    auto end = find(system, 0, 0);
    ASSERT_TRUE(end);
    if (state == ActionStatus::over) {
      EXPECT_EQ(end->outcome, ActionOutcome::succeeded);
    } else {
      EXPECT_EQ(end->outcome, ActionOutcome::failed);
      EXPECT_EQ(end->reason, "executor of b ended while it executed it");
      EXPECT_TRUE(end->executor_ended);
    }
    // What it had not accepted, its successor executes, and nothing else.
    finishes = true;
    EXPECT_TRUE(eventually([&] { return executor_lives == 2; }));
    if (state == ActionStatus::proposed) {
      EXPECT_TRUE(eventually([&] { return has_status(system, 0, 1, ActionStatus::over); }));
    }
    system.stop();
    EXPECT_EQ(executed(), state == ActionStatus::accepted ? 0 : actions);
    expect_none_was_executed_twice();
  }
  report("executor crashes while an action is " + name_of(GetParam()), std::move(durations));
}

TEST_P(InEachState, AnActionIsCancelledIfItsRequesterCrashes) {
  auto state = GetParam();
  std::vector<std::chrono::nanoseconds> durations;
  for (int i = 0; i < times() && !HasFailure(); ++i) {
    reset();
    offers = state != ActionStatus::proposed && state != ActionStatus::accepted;
    System system{description()};
    ASSERT_TRUE(system.start());
    ASSERT_NO_FATAL_FAILURE(bring_into(system, state, 0));
    durations.push_back(crash(system, "requester", 0));
    // Nothing of it may be left: a component that crashes by an exception destroys its handles.
    auto end = find(system, 0, 0);
    EXPECT_TRUE(!end || end->outcome == (state == ActionStatus::over ? ActionOutcome::succeeded
                                                                     : ActionOutcome::cancelled))
      << end->reason;
    // The executor is free for others.
    offers = finishes = true;
    EXPECT_TRUE(eventually([&] { return has_status(system, 1, 0, ActionStatus::over); }));
    system.stop();
    // One that is accepted may begin before its end is noticed.
    EXPECT_LE(executed(), 2);
    if (state != ActionStatus::accepted) {
      EXPECT_EQ(executed(), state == ActionStatus::proposed ? 1 : 2);
    }
    expect_none_was_executed_twice();
  }
  report("requester crashes while an action is " + name_of(GetParam()), std::move(durations));
}

TEST_P(InEachState, AnActionThatContinuesOutlivesItsRequester) {
  auto state = GetParam();
  if (state == ActionStatus::cancelling || state == ActionStatus::paused)
    GTEST_SKIP() << "it does what its requester wanted last";
  continues = true;
  reset();
  offers = state != ActionStatus::proposed && state != ActionStatus::accepted;
  System system{description()};
  ASSERT_TRUE(system.start());
  ASSERT_NO_FATAL_FAILURE(bring_into(system, state, 0));
  ASSERT_TRUE(system.faults().inject("requester", ComponentFault{}));
  lock_next(std::nullopt);
  EXPECT_TRUE(eventually([&] { return requester_lives == 2; }));
  offers = finishes = true;
  EXPECT_TRUE(eventually([&] { return has_status(system, 0, 0, ActionStatus::over); }));
  EXPECT_EQ(find(system, 0, 0)->outcome, ActionOutcome::succeeded);
  system.stop();
  expect_none_was_executed_twice();
}

INSTANTIATE_TEST_SUITE_P(FailuresOfActions, InEachState,
                         testing::Values(ActionStatus::proposed, ActionStatus::accepted,
                                         ActionStatus::running, ActionStatus::paused,
                                         ActionStatus::cancelling, ActionStatus::over),
                         [](auto& x) { return name_of(x.param); });

TEST_F(FailuresOfActions, ARequestersWorkingMemoryTakesItsActionsAlong) {
  System system{description()};
  ASSERT_TRUE(system.start());
  ASSERT_TRUE(eventually([&] { return has_status(system, 0, 0, ActionStatus::running); }));
  ASSERT_TRUE(system.faults().inject("a_wm", ComponentFault{}));
  EXPECT_TRUE(eventually([&] { return has_status(system, 1, 0, ActionStatus::running); }))
    << "the executor is free for the next life's";
  system.stop();
  EXPECT_EQ(executor_lives, 1);
  EXPECT_EQ(executed(), 2);
  expect_none_was_executed_twice();
}

TEST_F(FailuresOfActions, AJournalKeepsThemFromBeingExecutedTwice) {
  TemporaryFolder folder;
  continues = true;
  auto journal = " --journal full --journal-dir " + folder.path().string();
  {
    System system{description(journal)};
    ASSERT_TRUE(system.start());
    ASSERT_TRUE(eventually([&] { return has_status(system, 0, 0, ActionStatus::running); }));
    ASSERT_TRUE(system.faults().inject("a_wm", ComponentFault{}));
    ASSERT_TRUE(eventually([&] { return requester_lives == 2; }));
    finishes = true;
    // Its working memory was not there when it was over, or is there again.
    EXPECT_TRUE(eventually([&] { return has_status(system, 0, 0, ActionStatus::over); }));
    EXPECT_EQ(find(system, 0, 0)->outcome, ActionOutcome::succeeded);
    system.stop();
  }
  expect_none_was_executed_twice();
}

TEST_F(FailuresOfActions, ARunThatEndsLeavesNoActionThatTheNextOneExecutesAgain) {
  TemporaryFolder folder;
  continues = true;
  auto journal = " --journal full --journal-dir " + folder.path().string();
  {
    System system{description(journal)};
    ASSERT_TRUE(system.start());
    ASSERT_TRUE(eventually([&] { return has_status(system, 0, 0, ActionStatus::running); }));
    system.stop();
  }
  requester_lives = 1; // asks for another one
  finishes = true;
  System system{description(journal)};
  ASSERT_TRUE(system.start());
  EXPECT_TRUE(eventually([&] { return has_status(system, 1, 0, ActionStatus::over); }));
  EXPECT_TRUE(eventually([&] { return has_status(system, 0, 0, ActionStatus::over); }));
  EXPECT_EQ(find(system, 0, 0)->outcome, ActionOutcome::failed);
  EXPECT_THAT(find(system, 0, 0)->reason, HasSubstr("ended while it executed it"));
  system.stop();
  expect_none_was_executed_twice();
}

} // namespace

} // namespace castor::test
