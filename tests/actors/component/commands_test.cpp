#include "castor/tests/actors/component/scripted.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <functional>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace castor::test {

namespace {

using testing::HasSubstr;

/// What the wheel of these tests did, in order; safe to use from any thread.
class WheelLog {
public:
  void add(const std::string& x) {
    std::lock_guard guard{mutex_};
    lines_.push_back(x);
  }

  std::vector<std::string> lines() const {
    std::lock_guard guard{mutex_};
    return lines_;
  }

  std::string last() const {
    auto x = lines();
    return x.empty() ? "" : x.back();
  }

  std::ptrdiff_t count(const std::string& x) const {
    auto all = lines();
    return std::count(all.begin(), all.end(), x);
  }

private:
  mutable std::mutex mutex_;
  std::vector<std::string> lines_;
};

class Commands : public testing::Test {
protected:
  void TearDown() override { clear_scripts(); }

  static constexpr auto with_wheel = "HOST localhost\nCOMPONENT CPP wheel Standalone\n";

  void wheel(CommandTerms terms = {}) {
    StandaloneScript::scripts()["wheel"].start = [this, terms](auto& self) {
      self.template on_command<Note>(
        [this](const Note& x) { log_.add("turn " + std::to_string(x.number)); },
        [this] { log_.add("stand still"); }, terms);
    };
  }

  void wheel_with_lease(std::chrono::microseconds valid_for = 10s) {
    wheel({valid_for, Address{"a", "drive"}});
  }

  using Body = std::function<void(UnmanagedScript&)>;

  /// Runs a commander in subarchitecture a until it returns.
  void run_driver(const Body& driver, const SystemOptions& options = without_restarts()) {
    UnmanagedScript::scripts()["driver"].run = [driver](auto& self) {
      driver(self);
      self.end_system(0, "done");
    };
    System system{architecture(with_wheel + subarchitecture("a") + "CPP UM driver Unmanaged\n"),
                  options};
    EXPECT_EQ(run(system), 0) << system.summary().components.back().failure;
  }

  /// Runs two, one of which ends the system.
  void run_two(const Body& first, const Body& second) {
    UnmanagedScript::scripts()["first"].run = first;
    UnmanagedScript::scripts()["second"].run = second;
    System system{architecture(with_wheel + subarchitecture("a") +
                               "CPP UM first Unmanaged\nCPP UM second Unmanaged\n"),
                  without_restarts()};
    EXPECT_EQ(run(system), 0);
  }

  static std::string refusal_of(const std::function<void()>& f) {
    try {
      f();
    } catch (const CommandRefused& e) {
      return e.what();
    }
    return "obeyed";
  }

  static std::string error_of(const std::function<void()>& f) {
    try {
      f();
    } catch (const ConnectionError& e) {
      return e.what();
    }
    return "no error";
  }

  WheelLog log_;
};

TEST_F(Commands, AnEffectorHasObeyedWhenTheCommandReturns) {
  wheel();
  run_driver([this](auto& self) {
    self.command("wheel", Note{3, ""});
    EXPECT_EQ(log_.lines(), (std::vector<std::string>{"turn 3"}));
  });
}

TEST_F(Commands, AnExpiredCommandEndsInTheSafeState) {
  wheel({50ms});
  run_driver([this](auto& self) {
    self.command("wheel", Note{3, ""});
    EXPECT_TRUE(eventually([&] { return log_.count("stand still") == 1; }));
    self.command("wheel", Note{4, ""});
    EXPECT_EQ(log_.lines(), (std::vector<std::string>{"turn 3", "stand still", "turn 4"}));
  });
}

TEST_F(Commands, ACommanderMayAskForLessTime) {
  wheel({1h});
  run_driver([this](auto& self) {
    self.command("wheel", Note{3, ""}, 20ms);
    EXPECT_TRUE(eventually([&] { return log_.count("stand still") == 1; }));
  });
}

TEST_F(Commands, TheSafeStateIsTakenWhenTheEffectorEnds) {
  wheel({1h});
  run_driver([](auto& self) { self.command("wheel", Note{3, ""}); });
  EXPECT_EQ(log_.lines(), (std::vector<std::string>{"turn 3", "stand still"}));
}

TEST_F(Commands, TheSafeStateIsTakenWhenTheCommanderEnds) {
  wheel({1h});
  run_two(
    [](auto& self) {
      self.command("wheel", Note{3, ""});
      self.end_component();
    },
    [this](auto& self) {
      EXPECT_TRUE(eventually([&] { return log_.count("stand still") == 1; }));
      self.end_system(0, "done");
    });
}

TEST_F(Commands, AnEffectorWithoutHandlerSaysWhatItObeys) {
  wheel();
  run_driver([](auto& self) {
    EXPECT_EQ(error_of([&] { self.command("wheel", Other{}); }),
              "cannot send a Other to wheel: wheel obeys commands of the type "
              "Note");
    EXPECT_THAT(error_of([&] { self.command("weel", Note{}); }), HasSubstr("wheel"));
  });
}

TEST_F(Commands, OnlyTheHolderOfTheLeaseIsObeyed) {
  wheel_with_lease();
  run_driver([this](auto& self) {
    EXPECT_EQ(refusal_of([&] {
                self.command("wheel", Note{1, ""});
              }),
              "wheel obeys only the holder of the lease of a/drive; driver of a holds none");
    self.add(self.here("drive"), Note{});
    {
      auto lease = self.lock(self.here("drive"), LockLevel::o);
      self.command("wheel", Note{2, ""});
      self.command("wheel", Note{3, ""});
    }
    // The lease has ended, and with it the command.
    EXPECT_TRUE(eventually([&] { return log_.count("stand still") == 1; }));
    EXPECT_NE(refusal_of([&] { self.command("wheel", Note{4, ""}); }), "obeyed");
    EXPECT_EQ(log_.lines(), (std::vector<std::string>{"turn 2", "turn 3", "stand still"}));
  });
}

TEST_F(Commands, OfTwoCommandersOnlyTheHolderIsObeyed) {
  wheel_with_lease();
  std::atomic<int> turn{0};
  run_two(
    [&](auto& self) {
      self.add(self.here("drive"), Note{});
      {
        auto lease = self.lock(self.here("drive"), LockLevel::o);
        self.command("wheel", Note{1, ""});
        turn = 1;
        EXPECT_TRUE(eventually([&] { return turn == 2; }));
        self.command("wheel", Note{2, ""});
      }
      turn = 3;
      EXPECT_TRUE(eventually([&] { return turn == 4; }));
      EXPECT_THAT(refusal_of([&] {
                    self.command("wheel", Note{3, ""});
                  }),
                  HasSubstr("first of a holds none, now second of a holds it"));
      self.end_system(0, "done");
    },
    [&](auto& self) {
      EXPECT_TRUE(eventually([&] { return turn == 1; }));
      EXPECT_THAT(refusal_of([&] {
                    self.command("wheel", Note{4, ""});
                  }),
                  HasSubstr("second of a holds none, now first of a holds it"));
      turn = 2;
      EXPECT_TRUE(eventually([&] { return turn == 3; }));
      auto lease = self.lock(self.here("drive"), LockLevel::o);
      self.command("wheel", Note{5, ""});
      turn = 4;
      while (self.sleep_for(1h)) {
      }
    });
  auto lines = log_.lines();
  std::erase(lines, "stand still");
  EXPECT_EQ(lines, (std::vector<std::string>{"turn 1", "turn 2", "turn 5"}));
}

TEST_F(Commands, WithoutTheEntryNobodyIsObeyed) {
  wheel_with_lease();
  run_driver([](auto& self) {
    self.add(self.here("drive"), Note{});
    auto lease = self.lock(self.here("drive"), LockLevel::o);
    self.command("wheel", Note{1, ""});
    self.delete_entry(self.here("drive"));
    EXPECT_NE(refusal_of([&] { self.command("wheel", Note{2, ""}); }), "obeyed");
  });
  EXPECT_EQ(log_.count("turn 2"), 0);
}

TEST_F(Commands, ACommandThatWaitedForTheEffectorIsRefusedForItsAge) {
  std::atomic<bool> is_known{false};
  std::atomic<bool> is_busy{false};
  StandaloneScript::scripts()["wheel"].start = [&](auto& self) {
    self.template on_command<Note>(
      [&](const Note& x) {
        log_.add("turn " + std::to_string(x.number));
        if (x.number != 1)
          return;
        is_busy = true;
        std::this_thread::sleep_for(200ms);
      },
      [] {}, CommandTerms{1h});
  };
  run_two(
    [&](auto& self) {
      EXPECT_TRUE(eventually([&] { return is_known.load(); }));
      self.command("wheel", Note{1, ""});
    },
    [&](auto& self) {
      self.command("wheel", Note{0, ""});
      is_known = true;
      EXPECT_TRUE(eventually([&] { return is_busy.load(); }));
      EXPECT_THAT(refusal_of([&] {
                    self.command("wheel", Note{2, ""}, 50ms);
                  }),
                  HasSubstr("and is valid for 0.05 s"));
      self.end_system(0, "done");
    });
  EXPECT_EQ(log_.lines(), (std::vector<std::string>{"turn 0", "turn 1"}));
}

TEST_F(Commands, OfAStreamTheNewestIsObeyed) {
  std::atomic<bool> released{false};
  StandaloneScript::scripts()["wheel"].start = [&](auto& self) {
    self.template on_command<Note>(
      [&](const Note& x) {
        if (x.number == 1) {
          EXPECT_TRUE(eventually([&] { return released.load(); }));
        }
        log_.add("turn " + std::to_string(x.number));
      },
      [] {}, CommandTerms{1h});
  };
  run_driver([&](auto& self) {
    for (int i = 1; i <= 1000; ++i)
      self.stream_command("wheel", Note{i, ""});
    released = true;
    while (log_.last() != "turn 1000")
      ASSERT_TRUE(self.sleep_for(1ms));
  });
  EXPECT_EQ(log_.lines(), (std::vector<std::string>{"turn 1", "turn 1000"}));
}

TEST_F(Commands, ARefusalOfAStreamedCommandIsThrownByALaterOne) {
  wheel_with_lease();
  run_driver([](auto& self) {
    std::string refusal = "obeyed";
    for (int i = 0; refusal == "obeyed" && self.sleep_for(1ms); ++i)
      refusal = refusal_of([&] { self.stream_command("wheel", Note{i, ""}); });
    EXPECT_THAT(refusal, HasSubstr("driver of a holds none"));
  });
  EXPECT_TRUE(log_.lines().empty());
}

TEST_F(Commands, AnEffectorThatFailsTakesItsSafeStateAndTellsTheCommander) {
  StandaloneScript::scripts()["wheel"].start = [this](auto& self) {
    self.template on_command<Note>(
      [](const Note&) { throw std::runtime_error("the motor is too hot"); },
      [this] { log_.add("stand still"); }, CommandTerms{1h});
  };
  run_driver([this](auto& self) {
    EXPECT_EQ(error_of([&] {
                self.command("wheel", Note{1, ""});
              }),
              "wheel failed with the command Note: the motor is too hot");
    EXPECT_TRUE(eventually([&] { return log_.last() == "stand still"; }));
  });
}

TEST_F(Commands, AnEffectorThatWasStartedAgainIsCommandedAgain) {
  std::atomic<int> lives{0};
  StandaloneScript::scripts()["wheel"].start = [&](auto& self) {
    ++lives;
    self.template on_command<Note>(
      [&, &wheel = self](const Note& x) {
        log_.add("turn " + std::to_string(x.number));
        if (x.number == 2)
          wheel.end_component();
      },
      [] {}, CommandTerms{1h});
  };
  run_driver(
    [&](auto& self) {
      self.command("wheel", Note{1, ""});
      // Whether it has obeyed is not known, so it is not asked again.
      EXPECT_THAT(error_of([&] {
                    self.command("wheel", Note{2, ""});
                  }),
                  HasSubstr("it ended before it answered"));
      self.command("wheel", Note{3, ""});
      self.stream_command("wheel", Note{4, ""});
      EXPECT_TRUE(eventually([&] { return log_.last() == "turn 4"; }));
    },
    {});
  EXPECT_EQ(lives, 2);
  EXPECT_EQ(log_.lines(), (std::vector<std::string>{"turn 1", "turn 2", "turn 3", "turn 4"}));
}

TEST_F(Commands, APullMayHaveAnArgument) {
  StandaloneScript::scripts()["wheel"].start = [](auto& self) {
    self.template provide<Note>([] { return Note{0, "any"}; });
    self.template provide_for<Note, Other>([](const Other& x) {
      return Note{static_cast<int>(x.x) * 2, "for you"};
    });
  };
  run_driver([](auto& self) {
    EXPECT_EQ(*self.template pull<Note>("wheel", Other{21}), (Note{42, "for you"}));
    EXPECT_EQ(*self.template pull<Note>("wheel"), (Note{0, "any"}));
    EXPECT_EQ(error_of([&] { self.template pull<Note>("wheel", Note{}); }),
              "cannot pull a Note from wheel: wheel provides Note, Note with an argument Other");
  });
}

} // namespace

} // namespace castor::test
