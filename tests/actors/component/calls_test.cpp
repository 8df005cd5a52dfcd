#include "castor/actors/component/call_types.hpp"
#include "castor/actors/system/fault_port.hpp"
#include "castor/tests/actors/component/scripted.hpp"
#include "castor/tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace castor::test {

namespace {

using testing::AllOf;
using testing::HasSubstr;

struct Question {
  std::int64_t number = 0;
};
CASTOR_REFLECT(Question, number)

struct Answer {
  std::int64_t number = 0;
  std::string by;
};
CASTOR_REFLECT(Answer, number, by)

class CallsOverWorkingMemory : public testing::Test {
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

  /// A server that doubles numbers.
  static void doubles(const std::string& name) {
    script(name).start = [](auto& self) {
      self.template on_call<Question>([&self](const Question& x) {
        return Answer{2 * x.number, self.component_name()};
      });
    };
  }

  static std::size_t entries(System& system) {
    return system.entries("a").size() + system.entries("b").size();
  }
};

TEST_F(CallsOverWorkingMemory, AreAnswered) {
  doubles("server");
  script("caller").run = [](auto& self) {
    for (int i = 0; i < 100; ++i) {
      auto answer = self.template call<Question, Answer>("b", Question{i});
      EXPECT_EQ(answer.number, 2 * i);
      EXPECT_EQ(answer.by, "server");
    }
    self.end_system(0, "done");
  };
  System system{with({"caller"}, {"server"})};
  EXPECT_EQ(run(system), 0);
}

TEST_F(CallsOverWorkingMemory, StandOnWorkingMemoryWhileTheyLastAndAreClearedAway) {
  std::atomic<bool> go_on{false};
  script("server").start = [&](auto& self) {
    self.template on_call<Question>([&](const Question&) {
      while (!go_on)
        self.sleep_for(1ms);
      return Answer{};
    });
  };
  script("caller").run = [&](auto& self) { self.template call<Question, Answer>("b", Question{}); };
  script("watcher").run = [&](auto& self) {
    while (self.template read_all_in<CallProgress>("b").empty())
      ASSERT_TRUE(self.sleep_for(1ms));
    auto calls = self.template read_all<Call>();
    ASSERT_EQ(calls.size(), 1u);
    EXPECT_EQ(calls[0]->caller, "caller");
    EXPECT_EQ(calls[0]->request_type, "Question");
    EXPECT_EQ(self.template read_all<Question>().size(), 1u);
    auto progress = self.template read_all_in<CallProgress>("b");
    EXPECT_EQ(progress.at(0)->server, "server");
    EXPECT_EQ(progress.at(0)->state, CallState::taken);
    EXPECT_EQ(self.template read_all_in<CallServer>("b").size(), 1u);
    go_on = true;
    while (!self.template read_all<Call>().empty() ||
           !self.template read_all_in<CallProgress>("b").empty() ||
           !self.template read_all_in<Answer>("b").empty())
      ASSERT_TRUE(self.sleep_for(1ms));
    self.end_system(0, "done");
  };
  System system{with({"caller", "watcher"}, {"server"})};
  EXPECT_EQ(run(system), 0);
}

TEST_F(CallsOverWorkingMemory, AServersExceptionArrivesWithItsText) {
  script("server").start = [](auto& self) {
    self.template on_call<Question>([](const Question& x) -> Answer {
      if (x.number == 0)
        throw std::runtime_error("zero is no question");
      return {x.number, ""};
    });
  };
  script("caller").run = [](auto& self) {
    try {
      self.template call<Question, Answer>("b", Question{0});
      ADD_FAILURE();
    } catch (const CallException& e) {
      EXPECT_THAT(e.what(), AllOf(HasSubstr("server of b could not serve the Question of a.caller"),
                                  HasSubstr("zero is no question")));
    }
    EXPECT_EQ((self.template call<Question, Answer>("b", Question{5}).number), 5)
      << "the server goes on";
    self.end_system(0, "done");
  };
  System system{with({"caller"}, {"server"})};
  EXPECT_EQ(run(system), 0);
}

TEST_F(CallsOverWorkingMemory, HaveADeadlineThatSaysWhoWasMissing) {
  script("caller").run = [](auto& self) {
    try {
      self.template call<Question, Answer>("b", Question{}, CallOptions{.timeout = 50ms});
      ADD_FAILURE();
    } catch (const DeadlineException& e) {
      EXPECT_THAT(e.what(),
                  AllOf(HasSubstr("no component of b took it"), HasSubstr("on_call<Question>()")));
    }
    EXPECT_TRUE(self.template read_all<Call>().empty()) << "taken back";
    EXPECT_THROW((self.template call<Question, Answer>("nowhere", Question{})),
                 UnknownSubarchitectureException);
    self.end_system(0, "done");
  };
  System system{with({"caller"}, {"idle"})};
  EXPECT_EQ(run(system), 0);
}

TEST_F(CallsOverWorkingMemory, AServerThatComesLateServesWhoWaits) {
  script("caller").run = [](auto& self) {
    EXPECT_EQ((self.template call<Question, Answer>("b", Question{4}).number), 8);
    self.end_system(0, "done");
  };
  script("late").run = [](auto& self) {
    while (self.template read_all_in<Call>("a").empty())
      ASSERT_TRUE(self.sleep_for(1ms));
    self.template on_call<Question>([](const Question& x) { return Answer{2 * x.number, ""}; });
  };
  System system{with({"caller"}, {"late"})};
  EXPECT_EQ(run(system), 0);
}

TEST_F(CallsOverWorkingMemory, EachIsServedByOneServerOnly) {
  std::atomic<int> served{0};
  for (auto name : {"s1", "s2", "s3"})
    script(name).start = [&](auto& self) {
      self.template on_call<Question>([&](const Question& x) {
        ++served;
        return Answer{x.number, self.component_name()};
      });
    };
  script("caller").run = [&](auto& self) {
    for (int i = 0; i < 50; ++i)
      self.template call<Question, Answer>("b", Question{i});
    EXPECT_EQ(served, 50);
    self.end_system(0, "done");
  };
  System system{with({"caller"}, {"s1", "s2", "s3"})};
  EXPECT_EQ(run(system), 0);
}

TEST_F(CallsOverWorkingMemory, AServerThatDiesIsAClearFailure) {
  script("server").start = [](auto& self) {
    self.template on_call<Question>([](const Question&) -> Answer {
      throw 42; // no std::exception: the component ends
    });
  };
  script("caller").run = [](auto& self) {
    try {
      self.template call<Question, Answer>("b", Question{});
      ADD_FAILURE();
    } catch (const CallException& e) {
      EXPECT_THAT(e.what(), HasSubstr("ended while it worked on it"));
    }
    self.end_system(0, "done");
  };
  System system{with({"caller"}, {"server"})};
  EXPECT_EQ(run(system), 0);
}

TEST_F(CallsOverWorkingMemory, MayBeMadeAgainWhenTheServerDied) {
  std::atomic<int> attempts{0};
  for (auto name : {"s1", "s2"})
    script(name).start = [&](auto& self) {
      self.template on_call<Question>([&](const Question& x) -> Answer {
        if (++attempts == 1)
          throw 42;
        return {x.number, ""};
      });
    };
  script("caller").run = [](auto& self) {
    EXPECT_EQ(
      (self.template call<Question, Answer>("b", Question{3}, CallOptions{.retries = 1}).number),
      3);
    self.end_system(0, "done");
  };
  System system{with({"caller"}, {"s1", "s2"})};
  EXPECT_EQ(run(system), 0);
  EXPECT_EQ(attempts, 2);
}

TEST_F(CallsOverWorkingMemory, AreCancelledWhenTheCallerGoes) {
  std::atomic<bool> taken{false};
  script("caller").run = [&](auto& self) {
    self.template on_change(added<CallProgress>().in("b"), [](auto&) {});
    self.template call<Question, Answer>("b", Question{}, CallOptions{.timeout = 200ms});
  };
  script("server").start = [&](auto& self) {
    self.template on_call<Question>([&](const Question&) {
      taken = true;
      while (!self.call_cancelled())
        self.sleep_for(1ms);
      self.end_system(0, "cancelled");
      return Answer{};
    });
  };
  System system{with({"caller"}, {"server"})};
  EXPECT_EQ(run(system), 0);
  EXPECT_TRUE(taken);
}

/// Calls whose working memory is lost while they are served: no event tells of their end.
class CallsOfALostWorkingMemory : public CallsOverWorkingMemory {
protected:
  static bool is_left(System& system, const std::string& type) {
    auto entries = system.entries("b");
    return std::ranges::any_of(entries, [&](auto& x) { return x->type_name() == type; });
  }

  void lose_the_callers_memory(const std::string& options) {
    std::atomic<int> calls{0}, servers{0};
    std::atomic<bool> is_served{false}, was_cancelled{false}, reply{false};
    script("caller").run = [&](auto& self) {
      if (++calls == 1)
        self.template call<Question, Answer>("b", Question{});
    };
    script("server").start = [&](auto& self) {
      ++servers;
      self.template on_call<Question>([&](const Question&) {
        is_served = true;
        while (!reply) {
          self.is_running();
          was_cancelled = self.call_cancelled();
        }
        return Answer{};
      });
    };
    System system{architecture("SUBARCHITECTURE a\nCPP WM SubarchitectureWorkingMemory" + options +
                               "\nCPP TM AlwaysPositiveTaskManager\nCPP MG caller Managed\n" +
                               subarchitecture("b") + "CPP MG server Managed\n")};
    ASSERT_TRUE(system.start());
    // Taken is not enough: the server reads the request after that, and its handler is not called
    // if the working memory is lost in between.
    ASSERT_TRUE(eventually([&] { return is_served.load(); }));
    ASSERT_TRUE(is_left(system, "CallProgress"));
    ASSERT_TRUE(system.faults().inject("a_wm", ComponentFault{}));
    EXPECT_TRUE(eventually([&] { return calls == 2; })) << "the caller is back";
    EXPECT_TRUE(eventually([&] { return was_cancelled.load(); }));
    reply = true;
    EXPECT_TRUE(
      eventually([&] { return !is_left(system, "CallProgress") && !is_left(system, "Answer"); }));
    EXPECT_EQ(servers, 1) << "the server goes on";
    system.stop();
  }
};

TEST_F(CallsOfALostWorkingMemory, AreCancelledAndClearedAway) {
  lose_the_callers_memory("");
}

TEST_F(CallsOfALostWorkingMemory, AreCancelledAndClearedAwayThoughItHasAJournal) {
  TemporaryFolder folder;
  lose_the_callers_memory(" --journal full --journal-dir " + folder.path().string());
}

TEST_F(CallsOverWorkingMemory, AreClearedAwayByServersThatTakeOnlyTheNewestEvent) {
  std::atomic<bool> noted{false};
  script("caller").run = [&](auto& self) {
    EXPECT_THROW(
      (self.template call<Question, Answer>("b", Question{}, CallOptions{.timeout = 50ms})),
      DeadlineException);
    self.add(Note{});
    noted = true;
  };
  script("server").start = [&](auto& self) {
    self.on_change(added<Note>().in("a"), [](auto&) {});
    self.template on_call<Question>([&](const Question&) {
      while (!noted)
        self.is_running();
      // The note has come before the answer, and has displaced what waited.
      self.exists(self.here("nothing"));
      return Answer{};
    });
  };
  System system{architecture(subarchitecture("a") + "CPP MG caller Managed\n" +
                             subarchitecture("b") + "CPP MG server Managed --queue newest\n")};
  ASSERT_TRUE(system.start());
  EXPECT_TRUE(eventually([&] { return noted.load(); }));
  EXPECT_TRUE(eventually([&] { return system.entries("b").size() == 1; }))
    << "the server's CallServer, and nothing of calls";
  system.stop();
}

TEST_F(CallsOverWorkingMemory, WithinOneSubarchitectureToo) {
  doubles("server");
  script("caller").run = [](auto& self) {
    EXPECT_EQ((self.template call<Question, Answer>("a", Question{4}).number), 8);
    self.end_system(0, "done");
  };
  System system{with({"caller", "server"}, {})};
  EXPECT_EQ(run(system), 0);
}

TEST_F(CallsOverWorkingMemory, TwoWhoCallEachOtherAtOnceAreADeadlock) {
  std::atomic<int> deadlocks{0}, over{0};
  auto begin = std::chrono::steady_clock::now();
  auto script_for = [&](const std::string& other) {
    return [&, other](auto& self) {
      self.template on_call<Question>([](const Question& x) { return Answer{x.number, ""}; });
      try {
        self.template call<Question, Answer>(other, Question{});
      } catch (const DeadlockException& e) {
        ++deadlocks;
        EXPECT_THAT(e.what(), HasSubstr("waits for a reply to its Question, served by"));
      }
      if (++over == 2)
        self.end_system(deadlocks, "done");
    };
  };
  // Both are in their call before either can serve.
  script("ann").run = script_for("b");
  script("bob").run = script_for("a");
  System system{with({"ann"}, {"bob"})};
  auto status = run(system);
  // One of them may have finished its call before the other began.
  EXPECT_LE(status, 1);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, 3s);
}

TEST_F(CallsOverWorkingMemory, AServerThatCallsItsCallerBackIsADeadlock) {
  auto begin = std::chrono::steady_clock::now();
  script("server").start = [](auto& self) {
    self.template on_call<Question>(
      [&](const Question&) { return self.template call<Question, Answer>("a", Question{}); });
  };
  script("caller").start = [](auto& self) {
    self.template on_call<Question>([](const Question&) { return Answer{}; });
  };
  script("caller").run = [](auto& self) {
    // The youngest wait of the cycle is the server's; its failure is the caller's.
    try {
      self.template call<Question, Answer>("b", Question{});
      ADD_FAILURE();
    } catch (const CallException& e) {
      EXPECT_THAT(e.what(), AllOf(HasSubstr("wait cycle: "),
                                  HasSubstr("server of b waits for a reply to its Question, "
                                            "served by caller of a")));
    }
    self.end_system(0, "done");
  };
  System system{with({"caller"}, {"server"})};
  EXPECT_EQ(run(system), 0);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, 3s);
}

TEST_F(CallsOverWorkingMemory, ACallAndALockCanBeACycle) {
  const Address x{"a", "x"};
  script("caller").run = [&](auto& self) {
    self.add(x, Note{});
    auto guard = self.lock(x, LockLevel::odr);
    EXPECT_THROW((self.template call<Question, Answer>("b", Question{})), CallException);
    self.end_system(0, "done");
  };
  script("server").start = [&](auto& self) {
    self.template on_call<Question>([&](const Question&) {
      return Answer{self.template read<Note>(x)->number, ""};
    });
  };
  System system{with({"caller"}, {"server"})};
  EXPECT_EQ(run(system), 0);
}

} // namespace

} // namespace castor::test
