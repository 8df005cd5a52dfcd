#include "castor/tests/actors/component/scripted.hpp"

#include "castor/actors/component/registry.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <string>
#include <vector>

namespace castor::test {

namespace {

/// Rejects what is called "bad", keeps "later" waiting until something is retracted or completed.
class ChoosyTaskManager final : public TaskManager {
  void task_proposed(const TaskProposal& task) override {
    if (task.name == "later") {
      waiting_ = task.id;
      decide(task.id, TaskDecision::waiting);
    } else {
      decide(task.id, task.name == "bad" ? TaskDecision::rejected : TaskDecision::adopted);
    }
  }

  void task_retracted(const TaskProposal&) override { adopt_waiting(); }

  void task_completed(const TaskProposal&, TaskOutcome outcome) override {
    if (outcome == TaskOutcome::success)
      adopt_waiting();
  }

  void adopt_waiting() { decide(waiting_, TaskDecision::adopted); }

  TaskId waiting_;
};

CASTOR_COMPONENT(ChoosyTaskManager, "for tests")

class Tasks : public testing::Test {
protected:
  void TearDown() override { clear_scripts(); }

  void run_with(const std::string& manager, std::function<void(ManagedScript&)> body) {
    ManagedScript::scripts()["m"].run = [body](auto& self) {
      body(self);
      self.end_system(0, "done");
    };
    System system{
      architecture("SUBARCHITECTURE a localhost\nCPP WM SubarchitectureWorkingMemory\nCPP TM " +
                   manager + "\nCPP MG m Managed\n")};
    EXPECT_EQ(run(system), 0) << system.summary().components.back().failure;
  }
};

TEST_F(Tasks, EveryProposalIsAdoptedInOrderByTheAlwaysPositiveOne) {
  run_with("AlwaysPositiveTaskManager", [](auto& self) {
    std::vector<TaskId> proposed;
    std::vector<TaskId> adopted;
    self.on_adopted = [&](ManagedScript& me, const TaskId& id) {
      adopted.push_back(id);
      me.complete_task(id, TaskOutcome::success);
    };
    for (int i = 0; i < 20; ++i)
      proposed.push_back(self.propose_task("look"));
    while (adopted.size() < proposed.size())
      ASSERT_TRUE(self.sleep_for(1ms));
    EXPECT_EQ(adopted, proposed);
  });
}

TEST_F(Tasks, WorkGivenWithTheProposalIsDoneOnAdoption) {
  run_with("AlwaysPositiveTaskManager", [](auto& self) {
    bool done = false;
    self.propose_task("look", [&] { done = true; });
    EXPECT_FALSE(done) << "only once the component lets the decision in";
    while (!done)
      ASSERT_TRUE(self.sleep_for(1ms));
  });
}

TEST_F(Tasks, ARejectedTaskIsNotDone) {
  run_with("ChoosyTaskManager", [](auto& self) {
    std::vector<TaskId> rejected;
    self.on_rejected = [&](ManagedScript&, const TaskId& id) { rejected.push_back(id); };
    auto id = self.propose_task("bad", [] { ADD_FAILURE(); });
    while (rejected.empty())
      ASSERT_TRUE(self.sleep_for(1ms));
    EXPECT_EQ(rejected, std::vector<TaskId>{id});
  });
}

TEST_F(Tasks, AWaitingTaskIsAdoptedLater) {
  run_with("ChoosyTaskManager", [](auto& self) {
    std::string order;
    self.propose_task("later", [&] { order += "later "; });
    self.propose_task("now", [&] { order += "now "; });
    while (order.size() < 10)
      ASSERT_TRUE(self.sleep_for(1ms));
    EXPECT_EQ(order, "now later ");
  });
}

TEST_F(Tasks, NoDecisionArrivesOnARetractedTask) {
  run_with("ChoosyTaskManager", [](auto& self) {
    bool done = false;
    auto id = self.propose_task("now", [] { ADD_FAILURE() << "was retracted"; });
    self.retract_task(id);
    self.propose_task("now", [&] { done = true; });
    while (!done)
      ASSERT_TRUE(self.sleep_for(1ms));
  });
}

TEST_F(Tasks, WorkThatThrowsIsAFailureOfTheComponent) {
  ManagedScript::scripts()["m"].start = [](auto& self) {
    self.propose_task("now", [] { throw std::runtime_error("lost it"); });
  };
  System system{architecture(subarchitecture("a") + "CPP MG m Managed\n"), without_restarts()};
  ASSERT_TRUE(system.start());
  EXPECT_EQ(system.wait({30s, {}}), EndReason::all_failed);
  system.stop();
  EXPECT_EQ(system.summary().components.back().failure, "failed in task task:m:1: lost it");
}

} // namespace

} // namespace castor::test
