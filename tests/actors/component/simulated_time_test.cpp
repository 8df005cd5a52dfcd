#include "castor/base/log.hpp"
#include "castor/tests/actors/component/scripted.hpp"
#include "castor/tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace castor::test {

namespace {

using testing::ElementsAre;

/// With actors that run at the same time, and one at a time.
class SimulatedTime : public testing::TestWithParam<bool> {
protected:
  void TearDown() override { clear_scripts(); }

  static std::string components(const std::string& names) {
    auto result = "HOST localhost\n" + subarchitecture("a");
    for (auto name : names)
      result += std::string{"CPP MG "} + name + " Managed\n";
    return result;
  }

  std::function<void(ManagedScript&)>& run_of(const std::string& name) {
    return ManagedScript::scripts()[name].run;
  }
  std::function<void(ManagedScript&)>& start_of(const std::string& name) {
    return ManagedScript::scripts()[name].start;
  }

  SystemOptions options() {
    SystemOptions result;
    result.clock.pace = Pace{};
    result.clock.reproducible = GetParam();
    return result;
  }

  /// Runs the system for a simulated time; returns why it ended.
  EndReason run_for(const std::string& text, std::optional<std::chrono::nanoseconds> at_most,
                    std::optional<std::chrono::nanoseconds> quiet = std::nullopt) {
    return run_for(text, options(), at_most, quiet);
  }

  EndReason run_for(const std::string& text, SystemOptions with,
                    std::optional<std::chrono::nanoseconds> at_most,
                    std::optional<std::chrono::nanoseconds> quiet = std::nullopt) {
    System system{architecture(text), std::move(with)};
    EXPECT_TRUE(system.start());
    auto result = system.wait({at_most, quiet});
    system.stop();
    return result;
  }

  void note(std::string x) {
    std::lock_guard guard{mutex_};
    log.push_back(std::move(x));
  }

  static std::string text(Timestamp x) { return std::to_string(x.count() / 1000) + " ms"; }

  std::vector<std::string> log;

private:
  std::mutex mutex_;
};

INSTANTIATE_TEST_SUITE_P(Orders, SimulatedTime, testing::Bool(),
                         [](auto& x) { return x.param ? "one_at_a_time" : "parallel"; });

TEST_P(SimulatedTime, SleepersSleepForAsLongAsTheySayInHardlyAnyRealTime) {
  std::atomic<int> rounds{0};
  for (auto name : {"x", "y", "z"})
    run_of(name) = [&](auto& self) {
      for (int i = 1; self.sleep_for(10s); ++i) {
        EXPECT_EQ(self.now(), Timestamp{i * 10s});
        ++rounds;
      }
    };
  auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(run_for(components("xyz"), 1h), EndReason::time_over);
  EXPECT_EQ(rounds, 3 * 360);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, 5min);
}

TEST_P(SimulatedTime, EventsAndComputationTakeNone) {
  run_of("w") = [&](auto& self) {
    self.sleep_for(1s);
    self.add(Note{1});
  };
  start_of("r") = [&](auto& self) {
    self.on_change(added<Note>(), [&](const ChangeEvent& event) {
      std::this_thread::sleep_for(30ms);
      note(text(event.time) + ", " + text(self.now()));
    });
  };
  run_of("o") = [&](auto& self) {
    while (self.sleep_for(1ms)) {
      // Time would go on with this one.
    }
  };
  run_for(components("wro"), 2s);
  EXPECT_THAT(log, ElementsAre("1000 ms, 1000 ms"));
}

TEST_P(SimulatedTime, ALockIsAwaitedForAsLongAsItsHolderSleeps) {
  Address address{"a", "x"};
  start_of("h") = [&](auto& self) { self.add(address, Note{}); };
  run_of("h") = [&](auto& self) {
    auto guard = self.lock(address, LockLevel::odr);
    self.sleep_for(60s);
  };
  run_of("w") = [&](auto& self) {
    self.sleep_for(1s);
    self.template read<Note>(address);
    note(text(self.now()));
  };
  run_for(components("hw"), 2min);
  EXPECT_THAT(log, ElementsAre("60000 ms"));
}

TEST_P(SimulatedTime, AnEffectorThatLearnsWhoHoldsTheLeaseDuringATimerMissesNoTimer) {
  StandaloneScript::scripts()["meter"].start = [](auto& self) {
    self.template provide<Other>([] { return Other{}; });
  };
  int rounds = 0;
  StandaloneScript::scripts()["wheel"].start = [&](auto& self) {
    self.template on_command<Note>([](const Note&) {}, [] {},
                                   CommandTerms{10s, Address{"a", "drive"}});
    self.every(20ms, [&] {
      // The working memory's answer about the lease arrives during one of these.
      for (int i = 0; i < 50; ++i)
        self.template pull<Other>("meter");
      ++rounds;
    });
  };
  run_of("d") = [](auto& self) {
    self.add(self.here("drive"), Note{});
    auto lease = self.lock(self.here("drive"), LockLevel::o);
    self.command("wheel", Note{});
    self.sleep_for(10s);
  };
  run_for("HOST localhost\nCOMPONENT CPP wheel Standalone\nCOMPONENT CPP meter Standalone\n" +
            subarchitecture("a") + "CPP MG d Managed\n",
          2s);
  EXPECT_GE(rounds, 99);
}

TEST_P(SimulatedTime, TimesToLiveEndInIt) {
  run_of("x") = [&](auto& self) {
    self.on_change(deleted<Note>(), [&](const ChangeEvent& e) { note(text(e.time)); });
    self.sleep_for(500ms);
    EntryLife life;
    life.time_to_live = 5s;
    self.add(Note{}, life);
  };
  run_for(components("x"), 10s);
  EXPECT_THAT(log, ElementsAre("5500 ms"));
}

TEST_P(SimulatedTime, StandsForComponentsThatOnlyAnswerEachOtherAndTheyAreNamed) {
  Address ball{"a", "ball"};
  auto answer = [&](const std::string& name, const std::string& other) {
    start_of(name) = [&, other](auto& self) {
      self.on_change(changes_of(ball), [&, other](const ChangeEvent& event) {
        if (event.source != other)
          return;
        self.template read<Note>(ball);
        self.overwrite(ball, Note{1});
      });
    };
  };
  answer("x", "y");
  answer("y", "x");
  run_of("x") = [&](auto& self) { self.add(ball, Note{}); };
  System system{architecture(components("xy")), options()};
  ASSERT_TRUE(system.start());
  flush_log();
  testing::internal::CaptureStderr();
  EXPECT_EQ(system.wait({.at_most = 1h, .quiet = {}, .at_most_real = 5s}), EndReason::time_over);
  flush_log();
  EXPECT_THAT(testing::internal::GetCapturedStderr(),
              testing::ContainsRegex("simulated time stands at 0.000 s, while these work without a "
                                     "pause: a.x, a.y;"));
  EXPECT_EQ(system.now(), Timestamp{0});
  system.stop();
}

TEST_P(SimulatedTime, TimersDoNotDrift) {
  std::atomic<int> calls{0};
  start_of("x") = [&](auto& self) {
    self.every(10ms, [&] {
      ++calls;
      EXPECT_EQ(self.now().count() % 10'000, 0);
      self.sleep_for(3ms);
    });
  };
  run_for(components("x"), 10s);
  EXPECT_GE(calls, 999);
  EXPECT_LE(calls, 1001);
}

TEST_P(SimulatedTime, ADeadlockIsFoundBeforeTimeGoesOn) {
  Address first{"a", "first"};
  Address second{"a", "second"};
  start_of("x") = [&](auto& self) {
    self.add(first, Note{});
    self.add(second, Note{});
  };
  auto lock_both = [&](auto& self, const Address& one, const Address& other) {
    auto guard = self.lock(one, LockLevel::o);
    self.sleep_for(1s);
    try {
      auto another = self.lock(other, LockLevel::o);
    } catch (const DeadlockException&) {
      note("deadlock at " + text(self.now()));
    }
  };
  run_of("x") = [&](auto& self) { lock_both(self, first, second); };
  run_of("y") = [&](auto& self) { lock_both(self, second, first); };
  run_of("o") = [&](auto& self) {
    while (self.sleep_for(10ms)) {
      // Time would go on with this one.
    }
  };
  run_for(components("xyo"), 5s);
  EXPECT_THAT(log, ElementsAre("deadlock at 1000 ms"));
}

TEST_P(SimulatedTime, StandsWhileAThreadOfAComponentWorks) {
  std::optional<std::thread> worker;
  std::atomic<bool> done{false};
  run_of("x") = [&](auto& self) {
    self.sleep_for(1s);
    worker.emplace([&done, hold = self.hold_time()] {
      std::this_thread::sleep_for(50ms);
      done = true;
    });
    self.sleep_for(1ms);
    EXPECT_TRUE(done);
  };
  run_for(components("x"), 2s);
  ASSERT_TRUE(worker);
  worker->join();
}

TEST_P(SimulatedTime, ARunEndsWhenItHasBeenQuiet) {
  run_of("x") = [&](auto& self) {
    self.sleep_for(300ms);
    auto address = self.add(Note{});
    self.sleep_for(300ms);
    self.overwrite(address, Note{2});
    while (self.sleep_for(7ms))
      note(text(self.now()));
  };
  EXPECT_EQ(run_for(components("x"), std::nullopt, 500ms), EndReason::quiet);
  // The last change is at 600 ms, so the run ends at 1100 ms, between two times to wake.
  ASSERT_FALSE(log.empty());
  EXPECT_EQ(log.back(), "1097 ms");
}

TEST_P(SimulatedTime, CommandsHoldForIt) {
  StandaloneScript::scripts()["wheel"].start = [&](auto& self) {
    CommandTerms terms;
    terms.valid_for = 100ms;
    self.template on_command<Note>([&](const Note&) { note("turns at " + text(self.now())); },
                                   [&] { note("stands still at " + text(self.now())); }, terms);
  };
  run_of("x") = [&](auto& self) {
    self.sleep_for(1s);
    self.command("wheel", Note{1});
    // A slow computation is no reason to stand still.
    std::this_thread::sleep_for(200ms);
    self.sleep_for(50ms);
    self.command("wheel", Note{2});
    self.sleep_for(1s);
  };
  run_for(components("x") + "COMPONENT CPP wheel Standalone\n", 5s);
  EXPECT_THAT(log, ElementsAre("turns at 1000 ms", "turns at 1050 ms", "stands still at 1150 ms"));
}

TEST_P(SimulatedTime, StandsWhileAComponentIsBeingStartedAgain) {
  run_of("x") = [&](auto& self) {
    note("runs at " + text(self.now()));
    self.sleep_for(1s);
    if (self.now() < 2s)
      throw std::runtime_error("on purpose");
  };
  run_of("o") = [&](auto& self) {
    while (self.sleep_for(1ms)) {
      // Time would go on with this one.
    }
  };
  run_for(components("xo") + "SUPERVISE a one_for_one DELAY 200ms TO 2s\n", 3s);
  EXPECT_THAT(log, ElementsAre("runs at 0 ms", "runs at 1000 ms"));
}

TEST_P(SimulatedTime, StandsWhileAJournalIsWritten) {
  const TemporaryFolder folder;
  run_of("x") = [&](auto& self) {
    for (int i = 1; i <= 20; ++i) {
      self.sleep_for(1s);
      self.add(Note{i});
      EXPECT_EQ(self.now(), Timestamp{i * 1s});
    }
    note("done");
  };
  run_of("o") = [&](auto& self) {
    while (self.sleep_for(1ms)) {
      // Time would go on with this one.
    }
  };
  auto text = "HOST localhost\nSUBARCHITECTURE a localhost\nCPP WM SubarchitectureWorkingMemory "
              "--journal full --journal-dir " +
              folder.path().string() +
              "\nCPP TM AlwaysPositiveTaskManager\nCPP MG x Managed\nCPP MG o Managed\n";
  run_for(text, 30s);
  EXPECT_THAT(log, ElementsAre("done"));
}

TEST_P(SimulatedTime, AComponentEndsTheSystemAtItsTime) {
  std::atomic<std::int64_t> last{0};
  run_of("x") = [&](auto& self) {
    self.sleep_for(1s);
    self.end_system(7, "enough");
  };
  run_of("o") = [&](auto& self) {
    while (self.sleep_for(1ms))
      last = self.now().count();
  };
  System system{architecture(components("xo")), options()};
  ASSERT_TRUE(system.start());
  EXPECT_EQ(system.wait({1h, std::nullopt}), EndReason::ended_by_component);
  EXPECT_EQ(system.ended()->first, 7);
  system.stop();
  EXPECT_LE(last, 1'000'000);
}

TEST_P(SimulatedTime, GoesOnOnlyWhileItIsWaitedFor) {
  std::atomic<std::int64_t> last{0};
  run_of("x") = [&](auto& self) {
    while (self.sleep_for(1ms))
      last = self.now().count();
  };
  System system{architecture(components("x")), options()};
  ASSERT_TRUE(system.start());
  EXPECT_EQ(last, 0);
  for (int i = 1; i <= 3; ++i) {
    system.wait({100ms, std::nullopt});
    EXPECT_EQ(last, i * 100'000);
  }
  system.stop();
}

/// Events of a system in which many components react to each other.
std::vector<std::string> events_of_a_tangle(SystemOptions options) {
  std::mutex mutex;
  std::vector<std::string> events;
  options.on_change = [&](const ChangeEvent& event) {
    std::lock_guard guard{mutex};
    events.push_back(std::to_string(event.time.count()) + ' ' + to_string(event) + " v" +
                     std::to_string(event.version));
  };
  auto& scripts = ManagedScript::scripts();
  std::string names = "abcdef";
  for (std::size_t i = 0; i < names.size(); ++i) {
    std::string name{names[i]};
    scripts[name].start = [i](auto& self) {
      self.on_change(added<Note>(), [&self, i](const ChangeEvent& event) {
        auto note = self.template read<Note>(event.address);
        if (note->number > 0 && static_cast<std::size_t>(note->number) % 6 == i)
          self.add(Note{note->number * 5 / 6, "from " + event.address.id});
        // All of them want to.
        try {
          auto guard = self.lock(event.address, LockLevel::o);
          auto seen = self.template read<Note>(event.address);
          self.overwrite(event.address, Note{seen->number, seen->text + '.'});
        } catch (const DoesNotExistOnWM&) {
        }
      });
    };
    scripts[name].run = [i](auto& self) {
      while (self.sleep_for(std::chrono::milliseconds{10 * (i + 1)}))
        self.add(Note{static_cast<std::int64_t>(
          7 * i + static_cast<std::size_t>(self.now().count() / 10'000))});
    };
  }
  std::string text = "HOST localhost\n";
  for (auto* sa : {"p", "q"}) {
    text += subarchitecture(sa);
    for (int i = 0; i < 3; ++i)
      text += std::string{"CPP MG "} + names[static_cast<std::size_t>(i + (*sa == 'q' ? 3 : 0))] +
              " Managed\n";
  }
  System system{architecture(text), std::move(options)};
  EXPECT_TRUE(system.start());
  system.wait({300ms, std::nullopt});
  system.catch_up();
  system.stop();
  clear_scripts();
  return events;
}

TEST(ReproducibleTime, GivesTheSameEventsInEachRun) {
  SystemOptions options;
  options.clock.pace = Pace{};
  options.clock.reproducible = true;
  auto first = events_of_a_tangle(options);
  ASSERT_GT(first.size(), 300u);
  for (int i = 0; i < 5; ++i)
    ASSERT_EQ(events_of_a_tangle(options), first);
}

} // namespace

} // namespace castor::test
