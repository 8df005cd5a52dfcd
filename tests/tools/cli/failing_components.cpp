// Components that take their processes with them, and others that go on without them.
#include "castor/tests/tools/cli/done.hpp"
#include "castor/tests/tools/cli/event_order.hpp"
#include "castor/tests/tools/cli/follow_null.hpp"
#include "castor/tests/tools/cli/tick.hpp"

#include "castor/actors/component/health.hpp"
#include "castor/actors/component/registry.hpp"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <functional>
#include <list>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

namespace castor::test {

namespace {

using namespace std::chrono_literals;

/// How often a component has begun to live, in a working memory that survives it.
struct Lives {
  int number = 0;
};
CASTOR_REFLECT(Lives, number)

void compute_for_ever() {
  for (volatile bool on = true; on;) {
    // Never asks whether it should stop.
  }
}

[[noreturn]] void allocate_for_ever() {
  constexpr std::size_t a_megabyte = 1 << 20;
  std::list<std::string> all;
  for (;;)
    all.emplace_back(a_megabyte, '.');
}

[[noreturn]] void always_throw() {
  throw std::runtime_error("it always does");
}

/// Fails in its first lives, each time in the same way; in the one after those it is done.
class Shaky final : public UnmanagedComponent {
  void run() override {
    auto life = begin_life();
    info("begins life {}", life);
    if (life > failures_)
      add(Done{component_name()});
    else
      ways().at(how_)();
  }

  int begin_life() {
    Address diary{diary_->empty() ? subarchitecture() : diary_.get(), component_name()};
    if (!exists(diary)) {
      add(diary, Lives{1});
      return 1;
    }
    auto life = read<Lives>(diary)->number + 1;
    overwrite(diary, Lives{life});
    return life;
  }

  static const std::map<std::string, std::function<void()>>& ways() {
    static const std::map<std::string, std::function<void()>> result{
      {"null", follow_null},
      {"abort", [] { std::abort(); }},
      {"allocate", allocate_for_ever},
      {"loop", compute_for_ever},
      {"kill", [] { std::raise(SIGKILL); }},
      {"throw", always_throw},
    };
    return result;
  }

  Option<std::string> how_{this, "how", "throw", "null, abort, allocate, loop, kill or throw"};
  Option<int> failures_{this, "failures", 1, "in how many lives it fails"};
  Option<std::string> diary_{this, "diary", "", "subarchitecture that counts its lives; its own"};
};
CASTOR_COMPONENT(Shaky, "fails, in one of several ways")

/// Done when those that it knows have failed and are back, and it has then heard of more ticks:
/// each in its turn, from the first to the last.
class Witness final : public UnmanagedComponent {
  void start() override {
    on_change(added<ComponentUp>().in(health_subarchitecture), [this](const ChangeEvent& event) {
      if (std::count(missed_->begin(), missed_->end(), event.address.id) > 0)
        back_.insert(event.address.id);
    });
    on_change(changed<Tick>().in(where_), [this](const ChangeEvent& event) {
      order_.check(event);
      if (back_.size() == missed_->size() && ++heard_ == enough)
        add(Done{component_name()});
    });
  }

  static constexpr int enough = 20;

  Option<std::vector<std::string>> missed_{this, "missed", {"shaky"}, "who fails"};
  Option<std::string> where_{this, "where", "a", "subarchitecture with a ticker"};
  std::set<std::string> back_;
  int heard_ = 0;
  EventOrder order_;
};
CASTOR_COMPONENT(Witness, "sees others fail and come back")

/// Writes into another working memory whatever becomes of that; done when it works after it did
/// not.
class Visitor final : public UnmanagedComponent {
  void run() override {
    Address there{where_, "visit"};
    bool was_refused = false;
    for (int i = 0; is_running(); ++i) {
      try {
        if (exists(there)) {
          read<Tick>(there);
          overwrite(there, Tick{i});
        } else {
          add(there, Tick{i});
        }
        if (was_refused)
          return done();
      } catch (const WorkingMemoryException& e) {
        info("is not let in: {}", e.what());
        was_refused = true;
      }
      sleep_for(5ms);
    }
  }

  void done() { add(Done{component_name()}); }

  Option<std::string> where_{this, "where", "b", "subarchitecture that it writes to"};
};
CASTOR_COMPONENT(Visitor, "writes into another working memory, also when it is back")

/// Writes numbers down in another working memory until it was refused and then let in again; then
/// ends the system, with status 0 if all that was acknowledged is there.
class Clerk final : public UnmanagedComponent {
  void run() override {
    std::vector<Address> acknowledged;
    bool was_refused = false;
    for (int i = 0, since = 0; since < enough && sleep_for(2ms); ++i) {
      Address at{where_, std::to_string(i)};
      try {
        add(at, Tick{i});
        acknowledged.push_back(at);
        since += was_refused;
      } catch (const WorkingMemoryException& e) {
        info("is not let in: {}", e.what());
        was_refused = true;
      }
    }
    for (auto& x : acknowledged)
      if (!exists(x))
        return end_system(1, to_string(x) + " is lost");
    end_system(0, "all that was acknowledged is there");
  }

  static constexpr int enough = 20;

  Option<std::string> where_{this, "where", "b", "subarchitecture that it writes to"};
};
CASTOR_COMPONENT(Clerk, "misses what was acknowledged and is not there")

} // namespace

} // namespace castor::test
