// Component classes that the castor executable does not have: a library for --plugin.
#include "castor/actors/registry.hpp"

#include <chrono>
#include <stdexcept>
#include <string>

namespace castor::test {

namespace {

using namespace std::chrono_literals;

struct Tick {
  int number = 0;
};
CASTOR_REFLECT(Tick, number)

class Clock final : public UnmanagedComponent {
  void run() override {
    auto address = add(Tick{});
    for (int i = 1; i <= count_; ++i)
      overwrite(address, Tick{i});
    if (status_ >= 0)
      end_system(status_, "it has ticked " + std::to_string(count_) + " times");
  }

  Option<int> count_{this, "count", 3, "how often it ticks"};
  Option<int> status_{this, "status", -1, "status to end the system with; negative: it goes on"};
};
CASTOR_COMPONENT(Clock, "ticks a few times")

class Pair final : public UnmanagedComponent {
  void run() override {
    write(WriteBatch{}.add(here("left"), Tick{1}).add(here("right"), Tick{2}));
    end_system(0, "both are there");
  }
};
CASTOR_COMPONENT(Pair, "adds two entries in one write")

class Worker final : public ManagedComponent {
  void start() override {
    propose_task("look", [this] { debug("looks"); }, {.priority = 1});
    auto reach = propose_task("reach", [this] { debug("reaches"); });
    propose_task("grasp", [this] { end_system(0, "it has grasped"); }, {.after = {reach}});
    propose_task("carry everything", {.cost = 100});
    propose_task("wait for ever", {.priority = -1, .after = {"task:nobody:1"}});
  }
};
CASTOR_COMPONENT(Worker, "proposes tasks that depend on each other")

class Broken final : public UnmanagedComponent {
  void run() override { throw std::runtime_error("the spring is gone"); }
};
CASTOR_COMPONENT(Broken, "fails at once")

class Endless final : public UnmanagedComponent {
  void run() override {
    info("busy for ever");
    for (volatile bool on = true; on;) {
      // Never asks whether it should stop.
    }
  }
};
CASTOR_COMPONENT(Endless, "never comes back")

/// Adds an entry and overwrites it until it is stopped, whatever becomes of the others.
class Ticker final : public UnmanagedComponent {
  void run() override {
    auto address = here("tick");
    add(address, Tick{});
    for (int i = 1; is_running(); ++i) {
      try {
        overwrite(address, Tick{i});
      } catch (const DeadlineException&) {
        info("no answer to tick {}", i);
        read<Tick>(address);
      }
      sleep_for(10ms);
    }
  }
};
CASTOR_COMPONENT(Ticker, "ticks for ever")

/// Ends the system when it has heard of so many ticks.
class Listener final : public UnmanagedComponent {
  void start() override {
    on_change(overwritten<Tick>().anywhere(), [this](const ChangeEvent& event) {
      if (event.version <= last_)
        throw std::runtime_error("ticks come twice or backwards");
      last_ = event.version;
      if (++heard_ == count_)
        end_system(0, "heard " + std::to_string(heard_) + " ticks");
      if (heard_ == 10)
        info("hears ticks");
    });
  }

  Option<int> count_{this, "count", 20, "how many ticks"};
  int heard_ = 0;
  Version last_ = 0;
};
CASTOR_COMPONENT(Listener, "hears ticks")

} // namespace

} // namespace castor::test
