#include "castor/tests/actors/component/scripted.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace castor::test {

namespace {

/// What happened, in the order in which it did; components write from their own threads.
class Diary {
public:
  void add(std::string line) {
    std::lock_guard guard{mutex_};
    lines_.push_back(std::move(line));
  }

  std::vector<std::string> lines() const {
    std::lock_guard guard{mutex_};
    return lines_;
  }

  std::vector<std::string> lines_with(const std::string& part) const {
    std::vector<std::string> result;
    for (auto& line : lines())
      if (line.find(part) != line.npos)
        result.push_back(line);
    return result;
  }

private:
  mutable std::mutex mutex_;
  std::vector<std::string> lines_;
};

class LifeCycle : public testing::Test {
protected:
  void TearDown() override { clear_scripts(); }

  template <class C>
  void keep_diary(const std::string& name) {
    auto note = [this](const std::string& what) {
      return [this, what](C& self) { diary.add(what + " " + self.component_name()); };
    };
    C::scripts()[name] = {note("configure"), note("start"), note("run"), note("stop")};
  }

  Diary diary;
};

TEST_F(LifeCycle, PhasesComeInTheOrderThatTheOriginalHas) {
  keep_diary<ManagedScript>("m1");
  keep_diary<ManagedScript>("m2");
  keep_diary<UnmanagedScript>("u1");
  keep_diary<UnmanagedScript>("u2");
  keep_diary<StandaloneScript>("camera");
  System system{architecture("HOST localhost\nCOMPONENT CPP camera Standalone\n" +
                             subarchitecture("a") + "CPP UM u1 Unmanaged\nCPP MG m1 Managed\n" +
                             subarchitecture("b") + "CPP MG m2 Managed\nCPP UM u2 Unmanaged\n")};
  ASSERT_TRUE(system.start());
  ASSERT_TRUE(eventually([&] { return diary.lines_with("run").size() == 5; }));
  system.stop();
  EXPECT_EQ(diary.lines_with("configure"),
            (std::vector<std::string>{"configure m1", "configure u1", "configure m2",
                                      "configure u2", "configure camera"}));
  EXPECT_EQ(
    diary.lines_with("start"),
    (std::vector<std::string>{"start camera", "start m1", "start u1", "start m2", "start u2"}));
  EXPECT_EQ(diary.lines_with("stop"),
            (std::vector<std::string>{"stop u2", "stop m2", "stop u1", "stop m1", "stop camera"}));
  auto lines = diary.lines();
  auto position = [&](const std::string& line) {
    return std::find(lines.begin(), lines.end(), line) - lines.begin();
  };
  EXPECT_LT(position("configure camera"), position("start camera"));
  EXPECT_LT(position("start u2"), lines.size());
  for (auto name : {"camera", "m1", "u1", "m2", "u2"})
    EXPECT_LT(position("start u2"), position(std::string{"run "} + name)) << name;
}

TEST_F(LifeCycle, AFailureInStartEndsThatComponentOnly) {
  std::atomic<bool> other_ran{false};
  UnmanagedScript::scripts()["bad"].start = [](auto&) { throw std::runtime_error("no eyes"); };
  UnmanagedScript::scripts()["good"].run = [&](auto& self) {
    other_ran = true;
    self.end_system(7, "seen enough");
  };
  System system{architecture(subarchitecture("a") +
                             "CPP UM bad Unmanaged --restart temporary\nCPP UM good Unmanaged\n")};
  EXPECT_EQ(run(system), 7);
  EXPECT_TRUE(other_ran);
  EXPECT_EQ(system.summary().components.at(1).failure, "failed in start(): no eyes");
}

/// Says nothing, as what() may not.
class Silent : public std::exception {
public:
  const char* what() const noexcept override { return nullptr; }
};

TEST_F(LifeCycle, AnExceptionThatSaysNothingIsAFailureLikeAnyOther) {
  UnmanagedScript::scripts()["bad"].run = [](auto&) { throw Silent{}; };
  System system{architecture(subarchitecture("a") + "CPP UM bad Unmanaged --restart temporary\n")};
  ASSERT_TRUE(system.start());
  auto bad = [&] { return system.summary().components.at(1); };
  ASSERT_TRUE(eventually([&] { return bad().state == ComponentState::failed; }));
  EXPECT_EQ(bad().failure, "failed in run(): an exception without a message");
  system.stop();
}

TEST_F(LifeCycle, WhatAnExceptionSaysAtGreatLengthIsShortened) {
  UnmanagedScript::scripts()["bad"].run = [](auto&) {
    throw std::runtime_error("begin " + std::string(1'000'000, 'x'));
  };
  System system{architecture(subarchitecture("a") + "CPP UM bad Unmanaged --restart temporary\n")};
  ASSERT_TRUE(system.start());
  auto bad = [&] { return system.summary().components.at(1); };
  ASSERT_TRUE(eventually([&] { return bad().state == ComponentState::failed; }));
  EXPECT_EQ(bad().failure.find("failed in run(): begin xxx"), 0u);
  EXPECT_LT(bad().failure.size(), 5000u);
  system.stop();
}

TEST_F(LifeCycle, AnotherThreadMayNotUseAComponentAndIsToldSo) {
  std::string name;
  std::string refusal;
  UnmanagedScript::scripts()["threaded"].run = [&](auto& self) {
    std::thread{[&] {
      name = self.component_name();
      try {
        self.add(Note{1, "x"});
      } catch (const std::logic_error& e) {
        refusal = e.what();
      }
    }}.join();
    self.end_system(0, "done");
  };
  System system{architecture(subarchitecture("a") + "CPP UM threaded Unmanaged\n")};
  EXPECT_EQ(run(system), 0);
  EXPECT_EQ(name, "threaded");
  EXPECT_EQ(refusal.find("a.threaded was used by another thread than its own"), 0u) << refusal;
}

TEST_F(LifeCycle, AFailureInConfigureIsReportedAndNothingStarts) {
  std::atomic<int> lives{0};
  std::atomic<bool> started{false};
  UnmanagedScript::scripts()["bad"].configure = [&](auto&) {
    ++lives;
    throw std::logic_error("no map");
  };
  UnmanagedScript::scripts()["good"].start = [&](auto&) { started = true; };
  System system{
    architecture(subarchitecture("a") + "CPP UM bad Unmanaged\nCPP UM good Unmanaged\n")};
  try {
    system.start();
    FAIL() << "it was started";
  } catch (const SystemError& e) {
    ASSERT_EQ(e.diagnostics().size(), 1u);
    EXPECT_EQ(e.diagnostics().front().message, "bad cannot be configured: no map");
    EXPECT_EQ(e.diagnostics().front().line, "CPP UM bad Unmanaged");
  }
  system.stop();
  EXPECT_EQ(lives, 1);
  EXPECT_FALSE(started);
}

TEST_F(LifeCycle, AComponentThatIsRestartedMayFailInConfigureLikeAnywhere) {
  std::atomic<int> lives{0};
  UnmanagedScript::scripts()["bad"].configure = [&](auto&) {
    if (++lives == 2)
      throw std::logic_error("the camera is not plugged in");
  };
  UnmanagedScript::scripts()["bad"].run = [&](auto& self) {
    if (lives == 1)
      throw std::runtime_error("lost the camera");
    self.end_system(0, "is back");
  };
  System system{architecture(subarchitecture("a") + "CPP UM bad Unmanaged\n")};
  EXPECT_EQ(run(system), 0);
  EXPECT_EQ(lives, 3);
}

TEST_F(LifeCycle, AFailureInACallbackNamesTheEvent) {
  UnmanagedScript::scripts()["bad"].start = [](auto& self) {
    self.on_change(added<Note>(), [](const ChangeEvent&) { throw std::runtime_error("oops"); });
  };
  UnmanagedScript::scripts()["writer"].run = [](auto& self) {
    self.add(self.here("n1"), Note{1, "x"});
  };
  System system{architecture(
    subarchitecture("a") + "CPP UM bad Unmanaged --restart temporary\nCPP UM writer Unmanaged\n")};
  ASSERT_TRUE(system.start());
  auto bad = [&] { return system.summary().components.at(1); };
  ASSERT_EQ(bad().identity.name, "bad");
  ASSERT_TRUE(eventually([&] { return bad().state == ComponentState::failed; }));
  EXPECT_EQ(bad().failure, "failed in the callback for ADD Note a/n1 v0 by writer: oops");
  system.stop();
}

TEST_F(LifeCycle, StopReachesAComponentInsideAnOperationAndASwallowingCatch) {
  std::atomic<int> catches{0};
  std::atomic<bool> looping{false};
  UnmanagedScript::scripts()["stubborn"].run = [&](auto& self) {
    for (;;) {
      looping = true;
      try {
        self.exists(self.here("x"));
      } catch (const std::exception&) {
        ++catches;
      }
    }
  };
  System system{architecture(subarchitecture("a") + "CPP UM stubborn Unmanaged\n")};
  ASSERT_TRUE(system.start());
  ASSERT_TRUE(eventually([&] { return looping.load(); }));
  system.stop();
  EXPECT_EQ(system.summary().stuck.size(), 0u);
  EXPECT_EQ(catches, 0);
}

TEST_F(LifeCycle, StopHookMayStillUseWorkingMemory) {
  std::atomic<bool> deleted{false};
  UnmanagedScript::scripts()["tidy"] = {{},
                                        [](auto& self) { self.add(self.here("mine"), Note{}); },
                                        {},
                                        [&](auto& self) {
                                          EXPECT_FALSE(self.is_running());
                                          self.delete_entry(self.here("mine"));
                                          deleted = !self.exists(self.here("mine"));
                                        }};
  System system{architecture(subarchitecture("a") + "CPP UM tidy Unmanaged\n")};
  ASSERT_TRUE(system.start());
  system.stop();
  EXPECT_TRUE(deleted);
  EXPECT_TRUE(system.entries("a").empty());
}

TEST_F(LifeCycle, WorkingMemoryIsNotThereInConfigure) {
  UnmanagedScript::scripts()["early"].configure = [](auto& self) { self.add(Note{}); };
  System system{architecture(subarchitecture("a") + "CPP UM early Unmanaged\n")};
  EXPECT_THROW(system.start(), SystemError);
  auto early = system.summary().components.at(1);
  EXPECT_NE(early.failure.find("use it from start() on"), std::string::npos);
  system.stop();
}

TEST_F(LifeCycle, AComponentThatNeverComesBackIsNamedAndLeftBehind) {
  std::atomic<bool> release{false};
  std::atomic<bool> spinning{false};
  UnmanagedScript::scripts()["endless"].run = [&](auto&) {
    spinning = true;
    while (!release)
      std::this_thread::yield();
  };
  SystemOptions options;
  options.stop_patience = 100ms;
  System system{architecture(subarchitecture("a") + "CPP UM endless Unmanaged\n"), options};
  ASSERT_TRUE(system.start());
  ASSERT_TRUE(eventually([&] { return spinning.load(); }));
  system.stop();
  EXPECT_EQ(system.summary().stuck, std::vector<std::string>{"endless"});
  release = true;
}

TEST_F(LifeCycle, ASystemIsQuietOnceNothingHappensAnyMore) {
  UnmanagedScript::scripts()["writer"].run = [](auto& self) {
    for (int i = 0; i < 5; ++i) {
      self.add(Note{i, ""});
      self.sleep_for(20ms);
    }
  };
  System system{architecture(subarchitecture("a") + "CPP UM writer Unmanaged\n")};
  ASSERT_TRUE(system.start());
  EXPECT_EQ(system.wait({30s, 300ms}), EndReason::quiet);
  EXPECT_EQ(system.entries("a").size(), 5u);
  system.stop();
}

TEST_F(LifeCycle, ASystemWhoseComponentsHaveAllFailedIsOver) {
  UnmanagedScript::scripts()["bad"].run = [](auto&) { throw std::runtime_error("bad day"); };
  System system{architecture(subarchitecture("a") + "CPP UM bad Unmanaged --restart temporary\n")};
  ASSERT_TRUE(system.start());
  EXPECT_EQ(system.wait({30s, {}}), EndReason::all_failed);
  system.stop();
}

} // namespace

} // namespace castor::test
