#include "castor/actors/component/action_types.hpp"
#include "castor/tests/actors/component/scripted.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <functional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace castor::test {

namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

struct Grasp {
  std::string thing;
};
CASTOR_REFLECT(Grasp, thing)

struct Placed {
  int number = 0;
};
CASTOR_REFLECT(Placed, number)

class ActionsOverWorkingMemory : public testing::Test {
protected:
  void TearDown() override { clear_scripts(); }

  static auto& script(const std::string& name) { return ManagedScript::scripts()[name]; }

  static ArchitectureDescription with(const std::vector<std::string>& of_a,
                                      const std::vector<std::string>& of_b) {
    std::string text;
    for (auto* list : {&of_a, &of_b}) {
      text += subarchitecture(list == &of_a ? "a" : "b");
      for (auto& name : *list)
        text += "CPP MG " + name + " Managed\n";
    }
    return architecture(text);
  }

  /// An executor that waits until each action is cancelled.
  static void holds(const std::string& name, ActionOffer offer = {.can_pause = true}) {
    script(name).start = [offer](auto& self) {
      self.template on_action<Grasp>(
        [](ActionInProgress& action, const Grasp&) {
          while (action.wait_while_paused())
            action.sleep_for(1h);
          return ActionResult::cancelled("let go");
        },
        offer);
    };
  }

  template <class Self>
  static void await_status(Self& self, const ActionHandle& action, ActionStatus status) {
    while (action.status() != status)
      ASSERT_TRUE(self.sleep_for(1ms)) << "the system ends";
  }
};

TEST_F(ActionsOverWorkingMemory, AreExecutedAndTellHowTheyEnded) {
  script("arm").start = [](auto& self) {
    self.template on_action<Grasp>([](ActionInProgress&, const Grasp& x) {
      return ActionResult::succeeded({"holds(arm, " + x.thing + ")"}, {"free(arm)"});
    });
  };
  script("planner").run = [](auto& self) {
    for (int i = 0; i < 20; ++i) {
      auto handle = self.perform("b", Grasp{"ball"});
      auto action = handle.wait(10s);
      EXPECT_EQ(action.status, ActionStatus::over);
      EXPECT_EQ(action.outcome, ActionOutcome::succeeded);
      EXPECT_EQ(action.executor, "arm");
      EXPECT_EQ(action.progress, 1);
      EXPECT_THAT(action.became_true, ElementsAre("holds(arm, ball)"));
      EXPECT_THAT(action.became_false, ElementsAre("free(arm)"));
      EXPECT_TRUE(handle.is_over());
    }
    EXPECT_TRUE(self.template read_all<Action>().empty()) << "deleted with the handle";
    EXPECT_TRUE(self.template read_all<Grasp>().empty());
    self.end_system(0, "done");
  };
  System system{with({"planner"}, {"arm"})};
  EXPECT_EQ(run(system), 0);
}

TEST_F(ActionsOverWorkingMemory, WaitForAnActionOfTheirOwn) {
  script("arm").start = [](auto& self) {
    self.template on_action<Grasp>([&self](ActionInProgress& action, const Grasp& x) {
      if (x.thing == "cup")
        return ActionResult::succeeded();
      const auto part = self.perform("a", Grasp{"cup"});
      // Its end is told: nobody has to look again and again.
      EXPECT_TRUE(action.wait_until([&] { return part.is_over(); }));
      EXPECT_EQ(part.state().outcome, ActionOutcome::succeeded);
      EXPECT_TRUE(action.wait_until([] { return false; }, 1ms)) << "for a limited time";
      return ActionResult::succeeded();
    });
  };
  script("hand").start = [](auto& self) {
    self.template on_action<Grasp>(
      [](ActionInProgress&, const Grasp&) { return ActionResult::succeeded(); });
  };
  script("planner").run = [](auto& self) {
    for (int i = 0; i < 20; ++i)
      EXPECT_EQ(self.perform("b", Grasp{"ball"}).wait(10s).outcome, ActionOutcome::succeeded);
    self.end_system(0, "done");
  };
  System system{with({"hand", "planner"}, {"arm"})};
  EXPECT_EQ(run(system), 0);
}

TEST_F(ActionsOverWorkingMemory, WaitForAThread) {
  std::function<void()> wake_after_its_end;
  script("arm").start = [&](auto& self) {
    self.template on_action<Grasp>([&](ActionInProgress& action, const Grasp&) {
      std::atomic<bool> is_done{false};
      wake_after_its_end = self.waker();
      const std::jthread worker([&is_done, wake = self.waker()] {
        is_done = true;
        wake();
      });
      EXPECT_TRUE(action.wait_until([&] { return is_done.load(); }));
      EXPECT_TRUE(is_done);
      return ActionResult::succeeded();
    });
  };
  script("planner").run = [](auto& self) {
    for (int i = 0; i < 20; ++i)
      EXPECT_EQ(self.perform("b", Grasp{"ball"}).wait(10s).outcome, ActionOutcome::succeeded);
    self.end_system(0, "done");
  };
  {
    System system{with({"planner"}, {"arm"})};
    EXPECT_EQ(run(system), 0);
  }
  wake_after_its_end();
}

TEST_F(ActionsOverWorkingMemory, StopWaitingWhenTheyAreCancelled) {
  script("arm").start = [](auto& self) {
    self.template on_action<Grasp>([](ActionInProgress& action, const Grasp&) {
      EXPECT_FALSE(action.wait_until([] { return false; }));
      return ActionResult::cancelled("let go");
    });
  };
  script("planner").run = [](auto& self) {
    const auto action = self.perform("b", Grasp{"ball"});
    await_status(self, action, ActionStatus::running);
    EXPECT_TRUE(action.cancel());
    EXPECT_EQ(action.wait(10s).reason, "let go");
    self.end_system(0, "done");
  };
  System system{with({"planner"}, {"arm"})};
  EXPECT_EQ(run(system), 0);
}

TEST_F(ActionsOverWorkingMemory, StandOnWorkingMemoryWhileTheyLast) {
  std::atomic<bool> go_on{false};
  script("arm").start = [&](auto& self) {
    self.template on_action<Grasp>(
      [&](ActionInProgress& action, const Grasp&) {
        action.progress(0.25);
        while (!go_on)
          action.sleep_for(1ms);
        return ActionResult::succeeded();
      },
      {.preconditions = "the arm is free", .can_cancel = false});
  };
  script("planner").run = [&](auto& self) {
    auto goal = self.add(Note{});
    auto action = self.perform("b", Grasp{"cup"}, {.cause = {goal, "Note"}});
    action.wait(10s);
    self.end_system(0, "done");
  };
  script("watcher").run = [&](auto& self) {
    auto is_running = field(&Action::progress) > 0.2;
    while (self.template read_where_in<Action>("a", is_running).empty())
      ASSERT_TRUE(self.sleep_for(1ms));
    auto actions = self.template read_all_in<Action>("a");
    ASSERT_EQ(actions.size(), 1u);
    EXPECT_EQ(actions[0]->status, ActionStatus::running);
    EXPECT_EQ(actions[0]->requester, "planner");
    EXPECT_EQ(actions[0]->subarchitecture, "b");
    EXPECT_EQ(actions[0]->cause.type, "Note");
    EXPECT_TRUE(actions[0]->what.template points_to<Grasp>());
    EXPECT_EQ(self.follow(actions[0]->what.template as<Grasp>())->thing, "cup");
    auto offers = self.template read_all<ActionRegistration>();
    ASSERT_EQ(offers.size(), 1u);
    EXPECT_EQ(offers[0]->component, "arm");
    EXPECT_EQ(offers[0]->type, "Grasp");
    EXPECT_EQ(offers[0]->preconditions, "the arm is free");
    EXPECT_FALSE(offers[0]->can_cancel);
    go_on = true;
  };
  System system{with({"planner"}, {"arm", "watcher"})};
  EXPECT_EQ(run(system), 0);
}

TEST_F(ActionsOverWorkingMemory, FailWithTheTextOfAnExceptionAndTheExecutorGoesOn) {
  script("arm").start = [](auto& self) {
    self.template on_action<Grasp>([](ActionInProgress&, const Grasp& x) {
      if (x.thing.empty())
        throw std::runtime_error("there is nothing to grasp");
      return ActionResult::succeeded();
    });
  };
  script("planner").run = [](auto& self) {
    auto failed = self.perform("b", Grasp{}).wait(10s);
    EXPECT_EQ(failed.outcome, ActionOutcome::failed);
    EXPECT_EQ(failed.reason, "there is nothing to grasp");
    EXPECT_EQ(self.perform("b", Grasp{"x"}).wait(10s).outcome, ActionOutcome::succeeded);
    self.end_system(0, "done");
  };
  System system{with({"planner"}, {"arm"})};
  EXPECT_EQ(run(system), 0);
}

TEST_F(ActionsOverWorkingMemory, AreEachExecutedByOneOfSeveralExecutors) {
  std::atomic<int> executed{0};
  for (auto name : {"e1", "e2", "e3"})
    script(name).start = [&](auto& self) {
      self.template on_action<Grasp>([&](ActionInProgress&, const Grasp&) {
        ++executed;
        return ActionResult::succeeded();
      });
    };
  script("planner").run = [&](auto& self) {
    std::vector<ActionHandle> all;
    for (int i = 0; i < 50; ++i)
      all.push_back(self.perform("b", Grasp{}));
    for (auto& x : all)
      EXPECT_EQ(x.wait(10s).outcome, ActionOutcome::succeeded);
    EXPECT_EQ(executed, 50);
    self.end_system(0, "done");
  };
  System system{with({"planner"}, {"e1", "e2", "e3"})};
  EXPECT_EQ(run(system), 0);
}

TEST_F(ActionsOverWorkingMemory, WaitForTheirTurn) {
  holds("arm");
  script("planner").run = [](auto& self) {
    auto first = self.perform("b", Grasp{"1"});
    await_status(self, first, ActionStatus::running);
    auto second = self.perform("b", Grasp{"2"});
    self.sleep_for(20ms);
    EXPECT_EQ(second.status(), ActionStatus::proposed);
    EXPECT_TRUE(first.cancel());
    await_status(self, second, ActionStatus::running);
    EXPECT_EQ(first.state().outcome, ActionOutcome::cancelled);
    self.end_system(0, "done");
  };
  System system{with({"planner"}, {"arm"})};
  EXPECT_EQ(run(system), 0);
}

TEST_F(ActionsOverWorkingMemory, BeginAlongsideOthersIfTheirOfferSaysSo) {
  holds("arm", {.alongside = true});
  script("planner").run = [](auto& self) {
    auto first = self.perform("b", Grasp{"1"});
    auto second = self.perform("b", Grasp{"2"});
    await_status(self, first, ActionStatus::running);
    await_status(self, second, ActionStatus::running);
    self.end_system(0, "done");
  };
  System system{with({"planner"}, {"arm"})};
  EXPECT_EQ(run(system), 0);
}

TEST_F(ActionsOverWorkingMemory, ArePausedResumedAndCancelled) {
  holds("arm");
  script("planner").run = [](auto& self) {
    auto action = self.perform("b", Grasp{});
    await_status(self, action, ActionStatus::running);
    EXPECT_TRUE(action.pause());
    await_status(self, action, ActionStatus::paused);
    EXPECT_TRUE(action.resume());
    await_status(self, action, ActionStatus::running);
    EXPECT_TRUE(action.pause());
    await_status(self, action, ActionStatus::paused);
    EXPECT_TRUE(action.cancel());
    auto end = action.wait(10s);
    EXPECT_EQ(end.outcome, ActionOutcome::cancelled);
    EXPECT_EQ(end.reason, "let go");
    EXPECT_FALSE(action.cancel()) << "it is over";
    self.end_system(0, "done");
  };
  System system{with({"planner"}, {"arm"})};
  EXPECT_EQ(run(system), 0);
}

TEST_F(ActionsOverWorkingMemory, SayIfTheyCannotBePausedOrCancelled) {
  std::atomic<bool> go_on{false};
  script("arm").start = [&](auto& self) {
    self.template on_action<Grasp>(
      [&](ActionInProgress& action, const Grasp&) {
        while (!go_on) {
          EXPECT_FALSE(action.cancelled());
          action.sleep_for(1ms);
        }
        return ActionResult::succeeded();
      },
      {.can_cancel = false});
  };
  script("planner").run = [&](auto& self) {
    auto action = self.perform("b", Grasp{});
    await_status(self, action, ActionStatus::running);
    EXPECT_FALSE(action.pause());
    EXPECT_FALSE(action.cancel());
    go_on = true;
    EXPECT_EQ(action.wait(10s).outcome, ActionOutcome::succeeded);
    self.end_system(0, "done");
  };
  System system{with({"planner"}, {"arm"})};
  EXPECT_EQ(run(system), 0);
}

TEST_F(ActionsOverWorkingMemory, ThatNobodyHasAcceptedAreOverAtOnceWhenTheyAreCancelled) {
  script("planner").run = [](auto& self) {
    auto action = self.perform("b", Grasp{});
    try {
      action.wait(20ms);
      ADD_FAILURE();
    } catch (const DeadlineException& e) {
      EXPECT_THAT(e.what(), AllOf(HasSubstr("no component of b has accepted it"),
                                  HasSubstr("on_action<Grasp>()")));
    }
    EXPECT_EQ(action.status(), ActionStatus::proposed) << "it goes on";
    EXPECT_TRUE(action.cancel());
    EXPECT_EQ(action.wait().outcome, ActionOutcome::cancelled);
    EXPECT_THROW((void)self.perform("nowhere", Grasp{}), UnknownSubarchitectureException);
    self.end_system(0, "done");
  };
  System system{with({"planner"}, {"idle"})};
  EXPECT_EQ(run(system), 0);
}

TEST_F(ActionsOverWorkingMemory, WaitForAnExecutorThatComesLate) {
  script("planner").run = [](auto& self) {
    EXPECT_EQ(self.perform("b", Grasp{}).wait(10s).outcome, ActionOutcome::succeeded);
    self.end_system(0, "done");
  };
  script("late").run = [](auto& self) {
    while (self.template read_all_in<Action>("a").empty())
      ASSERT_TRUE(self.sleep_for(1ms));
    self.template on_action<Grasp>(
      [](ActionInProgress&, const Grasp&) { return ActionResult::succeeded(); });
  };
  System system{with({"planner"}, {"late"})};
  EXPECT_EQ(run(system), 0);
}

TEST_F(ActionsOverWorkingMemory, AreCancelledAndDeletedWithTheirHandle) {
  holds("arm");
  script("planner").run = [](auto& self) {
    {
      auto action = self.perform("b", Grasp{});
      await_status(self, action, ActionStatus::running);
    }
    while (!self.template read_all<Action>().empty())
      ASSERT_TRUE(self.sleep_for(1ms));
    EXPECT_TRUE(self.template read_all<Grasp>().empty());
    self.end_system(0, "done");
  };
  System system{with({"planner"}, {"arm"})};
  EXPECT_EQ(run(system), 0);
}

TEST_F(ActionsOverWorkingMemory, OfAnExecutorThatCallsItsRequesterAreADeadlock) {
  script("arm").start = [](auto& self) {
    self.template on_action<Grasp>([&](ActionInProgress&, const Grasp& x) {
      self.template call<Grasp, Placed>("a", x);
      return ActionResult::succeeded();
    });
  };
  script("planner").start = [](auto& self) {
    self.template on_call<Grasp>([](const Grasp&) { return Placed{}; });
  };
  script("planner").run = [](auto& self) {
    // The youngest wait of the cycle is the executor's.
    auto end = self.perform("b", Grasp{}).wait(20s);
    EXPECT_EQ(end.outcome, ActionOutcome::failed);
    EXPECT_THAT(end.reason, AllOf(HasSubstr("wait cycle: "),
                                  HasSubstr("planner of a waits for its action Grasp, served by "
                                            "arm of b")));
    self.end_system(0, "done");
  };
  auto begin = std::chrono::steady_clock::now();
  System system{with({"planner"}, {"arm"})};
  EXPECT_EQ(run(system), 0);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, 5s);
}

TEST_F(ActionsOverWorkingMemory, OfTheOwnSubarchitecture) {
  holds("arm");
  script("planner").run = [](auto& self) {
    auto action = self.perform("a", Grasp{});
    await_status(self, action, ActionStatus::running);
    action.cancel();
    EXPECT_EQ(action.wait(10s).outcome, ActionOutcome::cancelled);
    self.end_system(0, "done");
  };
  System system{with({"planner", "arm"}, {})};
  EXPECT_EQ(run(system), 0);
}

} // namespace

} // namespace castor::test
