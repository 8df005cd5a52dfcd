#include "castor/actors/link/dial.hpp"
#include "castor/actors/node/node.hpp"
#include "castor/tests/actors/component/scripted.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace castor::test {

namespace {

using testing::ElementsAre;

/// A system over three actor systems, which are connected as processes are.
class SimulatedTimeOverNodes : public testing::Test {
protected:
  void SetUp() override {
    for (std::string name : {"one", "two"}) {
      NodeOptions node;
      node.name = name;
      node.socket = listen_at({"127.0.0.1", 0});
      options.nodes[name] = {"127.0.0.1", port_of(node.socket)};
      nodes.push_back(std::make_unique<Node>(node));
    }
    options.clock.pace = Pace{};
    options.open_access = true;
  }

  void TearDown() override { clear_scripts(); }

  static std::string text() {
    return "HOST localhost\n" + subarchitecture("a") + "CPP MG x Managed\n" + on("b", "one", "y") +
           on("c", "two", "z");
  }

  /// A subarchitecture with one component on a node.
  static std::string on(const std::string& name, const std::string& host,
                        const std::string& component) {
    return "SUBARCHITECTURE " + name + ' ' + host +
           "\nCPP WM SubarchitectureWorkingMemory\nCPP TM AlwaysPositiveTaskManager\nCPP MG " +
           component + " Managed\n";
  }

  EndReason run_for(std::chrono::nanoseconds at_most) {
    System system{architecture(text()), options};
    EXPECT_TRUE(system.start());
    auto result = system.wait({at_most, std::nullopt});
    system.stop();
    return result;
  }

  auto& script(const std::string& name) { return ManagedScript::scripts()[name]; }

  void note(std::string x) {
    std::lock_guard guard{mutex};
    log.push_back(std::move(x));
  }

  std::vector<std::unique_ptr<Node>> nodes;
  SystemOptions options;
  std::mutex mutex;
  std::vector<std::string> log;
};

TEST_F(SimulatedTimeOverNodes, EventsArriveAtTheTimeAtWhichTheyWereSent) {
  std::atomic<int> heard{0};
  for (auto* name : {"x", "y", "z"}) {
    script(name).start = [&](auto& self) {
      self.on_change(added<Note>().anywhere(), [&](const ChangeEvent& event) {
        EXPECT_EQ(event.time, self.now()) << event.source << " to " << self.component_name();
        ++heard;
      });
    };
    script(name).run = [](auto& self) {
      while (self.sleep_for(10ms))
        self.add(Note{1});
    };
  }
  EXPECT_EQ(run_for(2s), EndReason::time_over);
  // What is added at the very end is heard before the end, too.
  EXPECT_EQ(heard, 3 * 3 * 200);
}

TEST_F(SimulatedTimeOverNodes, AChainOfMessagesTakesNoTime) {
  // Each passes a number on to the next one's working memory.
  auto pass_on = [](auto& self, const std::string& to) {
    self.on_change(added<Note>(), [&self, to](const ChangeEvent& event) {
      auto x = self.template read<Note>(event.address);
      if (x->number > 0)
        self.add(Address{to, "note " + std::to_string(x->number)}, Note{x->number - 1});
    });
  };
  script("x").start = [&](auto& self) {
    pass_on(self, "b");
    self.on_change(added<Note>().anywhere(), [&](const ChangeEvent& event) {
      if (self.template read<Note>(event.address)->number == 0)
        note(std::to_string(self.now().count()));
    });
  };
  script("y").start = [&](auto& self) { pass_on(self, "c"); };
  script("z").start = [&](auto& self) { pass_on(self, "a"); };
  script("x").run = [](auto& self) {
    self.sleep_for(1s);
    self.add(Note{100});
  };
  // Time would go on with this one.
  script("y").run = [](auto& self) {
    while (self.sleep_for(1ms))
      continue;
  };
  run_for(2s);
  EXPECT_THAT(log, ElementsAre("1000000"));
}

TEST_F(SimulatedTimeOverNodes, ALockOfAnotherNodeIsAwaitedForAsLongAsItsHolderSleeps) {
  Address address{"b", "shared"};
  script("y").start = [&](auto& self) { self.add(address, Note{}); };
  script("y").run = [&](auto& self) {
    auto guard = self.lock(address, LockLevel::odr);
    self.sleep_for(60s);
  };
  script("z").run = [&](auto& self) {
    self.sleep_for(1s);
    self.template read<Note>(address);
    note(std::to_string(self.now().count()));
  };
  run_for(2min);
  EXPECT_THAT(log, ElementsAre("60000000"));
}

} // namespace

} // namespace castor::test
