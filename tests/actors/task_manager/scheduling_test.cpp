#include "castor/tests/actors/component/scripted.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace castor::test {

namespace {

/// What a system's task managers decided, as "WAITING name: detail".
class TaskLog {
public:
  SystemOptions options() {
    auto result = without_restarts();
    result.on_task = [this](const TaskEvent& x) {
      std::lock_guard guard{mutex_};
      lines_.push_back(std::string{to_string(x.step)} + ' ' + x.task.name +
                       (x.detail.empty() ? "" : ": " + x.detail));
    };
    return result;
  }

  std::vector<std::string> lines() const {
    std::lock_guard guard{mutex_};
    return lines_;
  }

  bool has(const std::string& start) const {
    auto all = lines();
    return std::any_of(all.begin(), all.end(), [&](auto& x) { return x.starts_with(start); });
  }

private:
  mutable std::mutex mutex_;
  std::vector<std::string> lines_;
};

using Lines = std::vector<std::string>;

class Scheduling : public testing::Test {
protected:
  void TearDown() override { clear_scripts(); }

  static ManagedScript::Script& script(const std::string& name) {
    return ManagedScript::scripts()[name];
  }

  /// One subarchitecture of managed components.
  static ArchitectureDescription with(const std::string& manager,
                                      const std::vector<std::string>& components) {
    auto text =
      "SUBARCHITECTURE a localhost\nCPP WM SubarchitectureWorkingMemory\nCPP TM " + manager + '\n';
    for (auto& x : components)
      text += "CPP MG " + x + " Managed\n";
    return architecture(text);
  }

  TaskLog log;
};

TEST_F(Scheduling, ComponentsTakeTurnsOnABudgetOfOne) {
  constexpr int tasks_each = 50;
  std::atomic<bool> under_way = false;
  std::atomic<int> done = 0;
  for (auto name : {"p", "q"}) {
    script(name).start = [&](auto& self) {
      for (int i = 0; i < tasks_each; ++i) {
        self.propose_task("work", [&] {
          EXPECT_FALSE(under_way.exchange(true));
          std::this_thread::sleep_for(100us);
          under_way = false;
          if (++done == 2 * tasks_each)
            self.end_system(0, "done");
        });
      }
    };
  }
  System system{with("SchedulingTaskManager", {"p", "q"})};
  EXPECT_EQ(run(system), 0);
  EXPECT_EQ(done, 2 * tasks_each);
}

TEST_F(Scheduling, TheMoreImportantTaskComesFirst) {
  script("m").start = [&](auto& self) {
    auto holding = self.propose_task("hold");
    self.on_adopted = [&, holding](ManagedScript& me, const TaskId&) {
      eventually([&] { return log.has("WAITING high"); });
      me.complete_task(holding, TaskOutcome::success);
    };
    self.propose_task(
      "low", [&] { self.end_system(0, "done"); }, TaskOptions{.priority = -1});
    self.propose_task("usual", [] {});
    self.propose_task(
      "high", [] {}, TaskOptions{.priority = 1});
  };
  System system{with("SchedulingTaskManager", {"m"}), log.options()};
  EXPECT_EQ(run(system), 0);
  auto lines = log.lines();
  std::erase_if(lines, [](auto& x) { return !x.starts_with("ADOPTED"); });
  EXPECT_EQ(lines, (Lines{"ADOPTED hold", "ADOPTED high", "ADOPTED usual", "ADOPTED low"}));
}

TEST_F(Scheduling, PredecessorsMayBeOtherComponentsTasks) {
  script("consumer").start = [](auto& self) {
    self.propose_task(
      "consume", [&self] { self.end_system(0, "done"); },
      TaskOptions{.after = {"task:producer:1"}});
  };
  script("producer").start = [](auto& self) { self.propose_task("produce", [] {}); };
  System system{with("SchedulingTaskManager --resource-budget 5", {"consumer", "producer"}),
                log.options()};
  EXPECT_EQ(run(system), 0);
  auto lines = log.lines();
  ASSERT_GE(lines.size(), 4u);
  lines.resize(4);
  EXPECT_EQ(lines, (Lines{"WAITING consume: it waits for task:producer:1 (not proposed so far)",
                          "ADOPTED produce", "COMPLETED produce: success", "ADOPTED consume"}));
}

TEST_F(Scheduling, ARejectionReachesTheComponent) {
  script("m").start = [](auto& self) {
    auto id = self.propose_task(
      "much", [] { ADD_FAILURE(); }, TaskOptions{.cost = 2});
    self.on_rejected = [id](ManagedScript& me, const TaskId& rejected) {
      me.end_system(rejected == id ? 0 : 1, "rejected");
    };
  };
  System system{with("SchedulingTaskManager", {"m"}), log.options()};
  EXPECT_EQ(run(system), 0);
  EXPECT_EQ(log.lines(), Lines{"REJECTED much: it costs 2, more than the whole budget of 1"});
}

TEST_F(Scheduling, WithAFailedComponentItsTasksGo) {
  script("broken").start = [&](auto& self) {
    self.propose_task("hold");
    self.propose_task("more");
    self.on_adopted = [&](ManagedScript&, const TaskId&) {
      eventually([&] { return log.has("WAITING work"); });
      throw std::runtime_error("in the middle of it");
    };
  };
  script("other").start = [](auto& self) {
    self.propose_task("work", [&self] { self.end_system(0, "done"); });
  };
  System system{with("SchedulingTaskManager", {"broken", "other"}), log.options()};
  EXPECT_EQ(run(system), 0);
  auto lines = log.lines();
  ASSERT_GE(lines.size(), 6u);
  lines.resize(6);
  EXPECT_EQ(lines,
            (Lines{"ADOPTED hold", "WAITING more: it costs 1, and 1 of the budget of 1 is taken",
                   "WAITING work: task:broken:2 comes first", "RETRACTED hold: broken failed",
                   "RETRACTED more: broken failed", "ADOPTED work"}));
}

TEST_F(Scheduling, WorkThatThrowsHasFailed) {
  script("broken").start = [&](auto& self) {
    self.propose_task("hold", [&] {
      eventually([&] { return log.has("WAITING work"); });
      throw std::runtime_error("in the middle of it");
    });
  };
  script("other").start = [](auto& self) {
    self.on_rejected = [](ManagedScript& me, const TaskId&) { me.end_system(0, "done"); };
    self.propose_task(
      "work", [] { ADD_FAILURE(); }, TaskOptions{.after = {"task:broken:1"}});
  };
  System system{with("SchedulingTaskManager", {"broken", "other"}), log.options()};
  EXPECT_EQ(run(system), 0);
  EXPECT_EQ(log.lines(), (Lines{"ADOPTED hold", "WAITING work: it waits for task:broken:1",
                                "COMPLETED hold: failure",
                                "REJECTED work: its predecessor task:broken:1 failed"}));
}

TEST_F(Scheduling, WithAStoppedComponentItsTasksGo) {
  // The last one is stopped first.
  script("first").start = [](auto& self) { self.propose_task("hold"); };
  script("first").stop = [&](auto&) {
    EXPECT_TRUE(eventually([&] { return log.has("RETRACTED wait: last stopped"); }));
  };
  script("last").start = [&](auto& self) {
    self.propose_task("wait");
    self.end_system(0, "done");
  };
  System system{with("SchedulingTaskManager", {"first", "last"}), log.options()};
  EXPECT_EQ(run(system), 0);
}

TEST_F(Scheduling, EveryTaskManagerLearnsOfTheEndOfAComponent) {
  script("broken").start = [](auto& self) {
    self.propose_task("hold");
    self.on_adopted = [](ManagedScript&, const TaskId&) { throw std::runtime_error("lost it"); };
  };
  script("other").run = [&](auto& self) {
    EXPECT_TRUE(eventually([&] { return log.has("RETRACTED hold: broken failed"); }));
    self.end_system(0, "done");
  };
  System system{with("AlwaysPositiveTaskManager", {"broken", "other"}), log.options()};
  EXPECT_EQ(run(system), 0);
}

TEST_F(Scheduling, TasksAndChangesAreObservedOnOneThread) {
  std::set<std::thread::id> threads;
  int changes = 0;
  int tasks = 0;
  SystemOptions options;
  options.on_change = [&](const ChangeEvent&) {
    threads.insert(std::this_thread::get_id());
    ++changes;
  };
  options.on_task = [&](const TaskEvent&) {
    threads.insert(std::this_thread::get_id());
    ++tasks;
  };
  script("m").start = [](auto& self) {
    for (int i = 0; i < 20; ++i) {
      self.propose_task("note", [&self, i] {
        self.add(Note{i, ""});
        if (i == 19)
          self.end_system(0, "done");
      });
    }
  };
  System system{with("SchedulingTaskManager", {"m"}), options};
  EXPECT_EQ(run(system), 0);
  EXPECT_EQ(threads.size(), 1u);
  EXPECT_EQ(changes, 20);
  EXPECT_GE(tasks, 20 + 19 + 19) << "adopted, had to wait, completed";
}

TEST_F(Scheduling, ABudgetIsNotNegative) {
  System system{with("SchedulingTaskManager --resource-budget \"-1\"", {"m"})};
  EXPECT_THROW(system.start(), SystemError);
  EXPECT_EQ(system.summary().components.front().failure,
            "failed in configure(): --resource-budget is -1, but a budget is a number from 0");
}

} // namespace

} // namespace castor::test
