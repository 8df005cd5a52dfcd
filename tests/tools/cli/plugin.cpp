// Component classes that the castor executable does not have: a library for --plugin.
#include "castor/tests/tools/cli/tick.hpp"

#include "castor/actors/component/registry.hpp"

#include <cstdio>
#include <stdexcept>
#include <string>

namespace castor::test {

namespace {

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

class Printer final : public UnmanagedComponent {
  void run() override {
    std::puts("printed by a component");
    std::fflush(stdout);
    end_system(0, "it has printed");
  }
};
CASTOR_COMPONENT(Printer, "prints to standard output")

class Broken final : public UnmanagedComponent {
  void run() override { throw std::runtime_error("the spring is gone"); }
};
CASTOR_COMPONENT(Broken, "fails at once")

/// Logs what would drive a terminal, or pass for a message of the system.
class Forger final : public UnmanagedComponent {
  void start() override {
    warning("seen\x1b[2J\n12:00:00.000 error   [castor] all is lost");
    end_system(0, "done");
  }
};
CASTOR_COMPONENT(Forger, "logs lines of others")

class Endless final : public UnmanagedComponent {
  void run() override {
    info("busy for ever");
    for (volatile bool on = true; on;) {
      // Never asks whether it should stop.
    }
  }
};
CASTOR_COMPONENT(Endless, "never comes back")

} // namespace

} // namespace castor::test
