// Components whose processes are killed while one of them executes an action for the other.
#include "castor/tests/tools/cli/done.hpp"

#include "castor/actors/component/action_types.hpp"
#include "castor/actors/component/registry.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <fstream>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <unistd.h>

namespace castor::test {

namespace {

using namespace std::chrono_literals;

/// Specific entry of the actions.
struct Carry {
  int scene = 0;
  /// Whether it occupies its executor until the scene goes on, so that others have to wait.
  bool occupies = false;
  /// State in which a process is killed.
  ActionStatus state = ActionStatus::running;
};
CASTOR_REFLECT(Carry, scene, occupies, state)

/// A component's process.
struct Life {
  std::string component;
  std::int64_t process = 0;
};
CASTOR_REFLECT(Life, component, process)

/// What the requester is to ask for.
struct Scene {
  int number = 0;
  ActionStatus state = ActionStatus::running;
  /// Asks for an action that occupies the executor first.
  bool after_another = false;
  std::string executor;
};
CASTOR_REFLECT(Scene, number, state, after_another, executor)

/// The action that occupies the executor may end.
struct Free {
  int scene = 0;
};
CASTOR_REFLECT(Free, scene)

class Carrier final : public UnmanagedComponent {
  void start() override {
    add(Life{component_name(), getpid()}, {.ephemeral = true});
    on_action<Carry>([this](ActionInProgress& action, const Carry& x) { return carry(action, x); },
                     {.can_pause = true});
  }

  ActionResult carry(ActionInProgress& action, const Carry& x) {
    // Every beginning, of whatever process, is a line of the diary.
    std::ofstream{diary_.get(), std::ios::app} << to_string(action.address()) << std::endl;
    while (action.wait_while_paused()) {
      auto is_free =
        x.occupies && !read_where_in<Free>("a", field(&Free::scene) == x.scene).empty();
      if (is_free || x.state == ActionStatus::over)
        return ActionResult::succeeded();
      action.sleep_for(2ms);
    }
    if (x.state == ActionStatus::cancelling)
      sleep_for(200ms);
    return ActionResult::cancelled();
  }

  Option<std::string> diary_{this, "diary", "", "file in which every action that begins is noted"};
};
CASTOR_COMPONENT(Carrier, "carries things until it is told not to")

class Sender final : public UnmanagedComponent {
  void start() override {
    on_change(added<Scene>(), [this](const ChangeEvent& event) {
      actions_.clear();
      auto scene = read<Scene>(event.address);
      if (scene->after_another)
        actions_.push_back(perform(scene->executor, Carry{scene->number, true, {}}));
      actions_.push_back(perform(scene->executor, Carry{scene->number, false, scene->state},
                                 {.cause = {event.address, "Scene"}}));
      wish_ = scene->state;
    });
    // Whoever sees this may add scenes.
    add(Life{component_name(), getpid()}, {.ephemeral = true});
  }

  void run() override {
    while (sleep_for(1ms)) {
      auto is_wish = wish_ == ActionStatus::paused || wish_ == ActionStatus::cancelling;
      if (!is_wish || actions_.back().status() != ActionStatus::running)
        continue;
      if (wish_ == ActionStatus::paused)
        actions_.back().pause();
      else
        actions_.back().cancel();
      wish_.reset();
    }
  }

  std::vector<ActionHandle> actions_;
  std::optional<ActionStatus> wish_;
};
CASTOR_COMPONENT(Sender, "asks for things to be carried")

/// Kills requester and executor in each state of an action, and checks what becomes of it.
class Killer final : public UnmanagedComponent {
  using Clock = std::chrono::steady_clock;

  void run() override {
    for (int i = 0; i < times_; ++i)
      for (auto victim : {"carrier", "sender"})
        for (auto state : {ActionStatus::proposed, ActionStatus::accepted, ActionStatus::running,
                           ActionStatus::paused, ActionStatus::cancelling, ActionStatus::over})
          if (!kill_once(victim, state))
            return;
    for (auto& [what, durations] : durations_)
      report(what, durations);
    end_system(7, "all were killed");
  }

  bool kill_once(const std::string& victim, ActionStatus state) {
    auto in_time = [this, end = Clock::now() + 20s](auto condition) {
      while (!condition()) {
        if (!sleep_for(1ms))
          return false;
        if (Clock::now() > end)
          return fail("20 s were not enough");
      }
      return true;
    };
    what_ = victim + " killed while " + std::string{name_of(state)};
    if (!in_time([&] { return life("a", "sender") && life("b", "carrier"); }))
      return false;
    auto number = ++scene_;
    bool occupied =
      state == ActionStatus::accepted || (state == ActionStatus::proposed && victim == "carrier");
    // Nobody executes actions in a.
    auto where = state == ActionStatus::proposed && victim == "sender" ? "a" : "b";
    scene_at_ = add(Scene{number, state, occupied, where});
    if (occupied &&
        !in_time([&] { return action() && other() && other()->status == ActionStatus::running; }))
      return false;
    std::optional<LockGuard> lock;
    if (state == ActionStatus::accepted) {
      lock = this->lock(action()->what.address, LockLevel::odr);
      add(Free{number}, {.time_to_live = 5s});
    }
    if (!in_time([&] { return action() && action()->status == state; }))
      return false;
    auto process = *life(victim == "sender" ? "a" : "b", victim);
    auto begin = Clock::now();
    ::kill(static_cast<pid_t>(process), SIGKILL);
    lock.reset();
    bool goes_on = state == ActionStatus::proposed && victim == "carrier";
    if (goes_on) {
      // Its successor executes what it had not accepted.
      if (!in_time([&] { return other() && other()->status == ActionStatus::over; }))
        return false;
      note(victim, state, begin);
      if (!in_time([&] { return action()->status == ActionStatus::running; }))
        return false;
      if (other()->outcome != ActionOutcome::failed)
        return fail("it did not fail: " + other()->reason);
    } else {
      if (!in_time([&] { return action() && action()->status == ActionStatus::over; }))
        return false;
      note(victim, state, begin);
      auto expected = state == ActionStatus::over ? ActionOutcome::succeeded
                      : victim == "carrier"       ? ActionOutcome::failed
                                                  : ActionOutcome::cancelled;
      if (action()->outcome != expected)
        return fail("the outcome is wrong: " + action()->reason);
    }
    return in_time([&] {
             auto now = life(victim == "sender" ? "a" : "b", victim);
             return now && *now != process;
           }) &&
           none_began_twice();
  }

  static std::string_view name_of(ActionStatus x) {
    return reflection_of<ActionStatus>().enumerators[static_cast<std::size_t>(x)].first;
  }

  /// The process of a component, if it lives.
  std::optional<std::int64_t> life(const std::string& where, const std::string& component) {
    for (auto& x : read_where_in<Life>(where, field(&Life::component) == component))
      return x->process;
    return std::nullopt;
  }

  /// The action that the scene is about.
  std::optional<Action> action() {
    for (auto& x : read_all<Action>())
      if (x->cause.address == scene_at_)
        return *x;
    return std::nullopt;
  }

  /// The action that occupies the executor: the only other one that is not older.
  std::optional<Action> other() {
    for (auto& x : read_all<Action>())
      if (!x->cause && x->status != ActionStatus::proposed && !old_.contains(x.address))
        return *x;
    return std::nullopt;
  }

  void note(const std::string& victim, ActionStatus state, Clock::time_point begin) {
    durations_[victim + " while " + std::string{name_of(state)}].push_back(Clock::now() - begin);
  }

  bool none_began_twice() {
    // What is left would be looked through again and again.
    for (auto& x : read_all<Action>())
      if (old_.insert(x.address).second && x->status == ActionStatus::over)
        delete_entry(x.address);
    std::map<std::string, int> begun;
    std::ifstream diary{diary_.get()};
    for (std::string line; std::getline(diary, line);)
      if (++begun[line] > 1)
        return fail("began twice: " + line);
    return true;
  }

  bool fail(const std::string& why) {
    end_system(1, what_ + ": " + why);
    return false;
  }

  void report(const std::string& what, std::vector<std::chrono::nanoseconds> x) {
    std::sort(x.begin(), x.end());
    auto at = [&](double part) {
      return std::chrono::duration<double, std::milli>(
               x[static_cast<std::size_t>(part * static_cast<double>(x.size() - 1))])
        .count();
    };
    info("{}: over after {:.1f} ms (p50), {:.1f} ms (p99), {} times", what, at(0.5), at(0.99),
         x.size());
  }

  Option<int> times_{this, "times", 1, "how often each is killed in each state"};
  Option<std::string> diary_{this, "diary", "", "file in which actions that begin are noted"};
  int scene_ = 0;
  Address scene_at_;
  std::string what_;
  std::set<Address> old_;
  std::map<std::string, std::vector<std::chrono::nanoseconds>> durations_;
};
CASTOR_COMPONENT(Killer, "kills processes while one executes an action for the other")

} // namespace

} // namespace castor::test
