#include "castor/tests/conformance/tester.hpp"

#include "castor/actors/component/registry.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace castor::conformance {

namespace {

/// Adopts every task. Each component has to complete its tasks in the order of their proposal.
class TestTaskManager final : public TaskManager {
  void task_proposed(const TaskProposal& task) override {
    open_[task.component].push_back(task.id);
    decide(task.id, TaskDecision::adopted);
  }

  void task_retracted(const TaskProposal& task) override {
    std::erase(open_[task.component], task.id);
  }

  void task_completed(const TaskProposal& task, TaskOutcome) override {
    auto& open = open_[task.component];
    if (open.front() != task.id)
      end(failed_status, task.component + " has completed " + task.id + " before " + open.front());
    std::erase(open, task.id);
    if (++completed_ == count_)
      end(passed_status, "all tasks were completed in order");
  }

  void end(int status, const std::string& reason) {
    if (exit_)
      end_system(status, reason);
  }

  std::map<std::string, std::vector<TaskId>> open_;
  std::int64_t completed_ = 0;

  Option<bool> exit_{this, "exit", true, "end the system with the verdict"};
  Option<std::int64_t> count_{
    this, "count", 0, "after how many completed tasks the test has passed; 0: it never ends"};
};
CASTOR_COMPONENT(TestTaskManager, "adopts every task, and tests that they are completed in order")

class Propose final : public Test {
public:
  Propose(Tester& tester, std::int64_t tasks) : Test(tester), tasks_(tasks) {}

  void run() override {
    for (std::int64_t i = 0; i < tasks_; ++i)
      proposed_.push_back(tester_.propose_task("task " + std::to_string(i)));
  }

  void decided(const TaskId& id, bool adopted) {
    auto& expected = proposed_.at(decisions_);
    if (!adopted)
      return fail(id + " was rejected");
    if (id != expected)
      return fail(id + " was adopted before " + expected);
    tester_.complete_task(id, TaskOutcome::success);
    if (++decisions_ == proposed_.size())
      pass();
  }

  std::string awaited() const override {
    return "decisions on " + std::to_string(proposed_.size() - decisions_) + " of " +
           std::to_string(tasks_) + " tasks";
  }

private:
  std::int64_t tasks_;
  std::vector<TaskId> proposed_;
  std::size_t decisions_ = 0;
};

class Proposer final : public Tester {
public:
  Proposer() {
    offer("propose", [this] {
      auto test = std::make_unique<Propose>(*this, count_);
      test_ = test.get();
      return test;
    });
  }

private:
  void task_adopted(const TaskId& id) override { test_->decided(id, true); }
  void task_rejected(const TaskId& id) override { test_->decided(id, false); }

  Propose* test_ = nullptr;

  Option<std::int64_t> count_{this, "count", 10, "how many tasks it proposes"};
};
CASTOR_COMPONENT(Proposer, "proposes tasks, and tests that they are decided on in order")

} // namespace

} // namespace castor::conformance
