#include "castor/tests/actors/component/scripted.hpp"

#include "castor/actors/component/health.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <mutex>
#include <stdexcept>
#include <string>
#include <vector>

namespace castor::test {

namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

class Supervision : public testing::Test {
protected:
  void TearDown() override { clear_scripts(); }

  static UnmanagedScript::Script& script(const std::string& name) {
    return UnmanagedScript::scripts()[name];
  }

  static const ComponentStatus& status_of(const SystemSummary& summary, const std::string& name) {
    for (auto& x : summary.components)
      if (x.identity.name == name)
        return x;
    throw std::logic_error("there is no component " + name);
  }

  /// Starts the system and waits until it ends itself; the status it ends with.
  static int run(System& system) { return test::run(system); }

  void note(const std::string& line) {
    std::lock_guard guard{mutex_};
    lines_.push_back(line);
  }

  std::vector<std::string> lines() const {
    std::lock_guard guard{mutex_};
    return lines_;
  }

private:
  mutable std::mutex mutex_;
  std::vector<std::string> lines_;
};

TEST_F(Supervision, AComponentThatFailsIsBackWithItsOptionsAndFilters) {
  std::atomic<int> lives{0};
  std::vector<std::int64_t> heard;
  script("listener").start = [&](auto& self) {
    ++lives;
    self.on_change(added<Note>(), [&](const ChangeEvent& e) {
      heard.push_back(self.template read<Note>(e.address)->number);
      if (heard.back() == 1)
        throw std::runtime_error("one is too much");
      self.end_system(0, "done");
    });
  };
  script("writer").run = [&](auto& self) {
    self.add(Note{1, ""});
    EXPECT_TRUE(eventually([&] { return lives == 2; }));
    self.sleep_for(10ms);
    self.add(Note{2, ""});
  };
  System system{architecture(subarchitecture("a") + "CPP UM listener Unmanaged --deadline 7s\n"
                                                    "CPP UM writer Unmanaged\n")};
  EXPECT_EQ(run(system), 0);
  EXPECT_THAT(heard, ElementsAre(1, 2));
  auto listener = status_of(system.summary(), "listener");
  EXPECT_EQ(listener.state, ComponentState::stopped);
  EXPECT_EQ(listener.identity.incarnation, 2U);
  EXPECT_EQ(listener.restarts, 1U);
}

TEST_F(Supervision, ItsLeasesAreFreeAndItsIdsAreNew) {
  std::atomic<int> lives{0};
  script("holder").run = [&](auto& self) {
    auto address = self.add(Note{++lives, ""});
    note(address.id);
    if (lives > 1)
      return;
    self.lock_entry(address, LockLevel::odr);
    throw std::runtime_error("with a lease in hand");
  };
  script("other").run = [&](auto& self) {
    EXPECT_TRUE(eventually([&] { return lives == 2; }));
    EXPECT_TRUE(eventually([&] { return self.template read_all<Note>().size() == 2; }));
    auto guard = self.lock(self.here(lines().front()), LockLevel::odr);
    self.end_system(0, "done");
  };
  System system{
    architecture(subarchitecture("a") + "CPP UM holder Unmanaged\nCPP UM other Unmanaged\n")};
  EXPECT_EQ(run(system), 0);
  EXPECT_THAT(lines(), ElementsAre("0:2", "0:2:2"));
}

TEST_F(Supervision, OthersHearOfIt) {
  std::atomic<int> lives{0};
  script("shaky").run = [&](auto&) {
    if (++lives == 1)
      throw std::runtime_error("no grip");
  };
  script("watcher").start = [&](auto& self) {
    self.on_change(added<ComponentDown>().in(health_subarchitecture), [&](const ChangeEvent& e) {
      EXPECT_EQ(e.address.id, "shaky");
      note("down");
    });
    self.on_change(added<ComponentUp>().in(health_subarchitecture), [&](const ChangeEvent& e) {
      auto up = self.template read<ComponentUp>(e.address);
      note("up");
      EXPECT_EQ(up->subarchitecture, "a");
      EXPECT_EQ(up->incarnation, 2U);
      EXPECT_GT(up->down_us, 0);
      self.end_system(0, "done");
    });
  };
  System system{architecture(subarchitecture("b") + "CPP UM watcher Unmanaged\n" +
                             subarchitecture("a") + "CPP UM shaky Unmanaged\n")};
  EXPECT_EQ(run(system), 0);
  EXPECT_THAT(lines(), ElementsAre("down", "up"));
}

TEST_F(Supervision, WhoFailsTooOftenTakesItsSubarchitectureWithItAndThenTheSystem) {
  std::atomic<int> attempts{0};
  std::atomic<int> neighbour{0};
  script("hopeless").start = [&](auto&) {
    ++attempts;
    throw std::runtime_error("never works");
  };
  script("neighbour").start = [&](auto&) { ++neighbour; };
  System system{architecture("SUPERVISE a RESTARTS 2 IN 1min DELAY 1ms TO 2ms\n"
                             "SUPERVISE SYSTEM RESTARTS 1 IN 1min DELAY 1ms TO 2ms\n" +
                             subarchitecture("a") +
                             "CPP UM hopeless Unmanaged\n"
                             "CPP UM neighbour Unmanaged\n")};
  EXPECT_EQ(run(system), 1);
  EXPECT_THAT(system.ended()->second, HasSubstr("a has failed as a whole"));
  EXPECT_THAT(system.ended()->second, HasSubstr("never works"));
  // Once and two restarts, and all of that again.
  EXPECT_EQ(attempts, 6);
  EXPECT_EQ(neighbour, 2);
}

TEST_F(Supervision, StrategiesTakeOthersAlong) {
  std::atomic<int> lives{0};
  auto keep_diary = [&](const std::string& name) {
    script(name).start = [&, name](auto&) { note("start " + name); };
    script(name).stop = [&, name](auto&) { note("stop " + name); };
  };
  for (auto name : {"first", "second", "third"})
    keep_diary(name);
  script("second").run = [&](auto&) {
    if (++lives == 1)
      throw std::runtime_error("stumbles");
  };
  System system{architecture("SUPERVISE a rest_for_one\n" + subarchitecture("a") +
                             "CPP UM first Unmanaged\nCPP UM second Unmanaged\n"
                             "CPP UM third Unmanaged\n")};
  ASSERT_TRUE(system.start());
  ASSERT_TRUE(eventually([&] { return lives == 2; }));
  EXPECT_THAT(lines(), ElementsAre("start first", "start second", "start third", "stop third",
                                   "start second", "start third"));
  system.stop();
}

TEST_F(Supervision, ATransientComponentThatHasDoneItsWorkStaysAway) {
  std::atomic<int> lives{0};
  auto work_once = [&](auto& self) {
    ++lives;
    self.end_component();
  };
  script("transient").run = work_once;
  script("permanent").run = [&](auto& self) {
    if (++lives < 4)
      self.end_component();
  };
  System system{architecture(subarchitecture("a") +
                             "CPP UM transient Unmanaged --restart transient\n"
                             "CPP UM permanent Unmanaged\n")};
  ASSERT_TRUE(system.start());
  ASSERT_TRUE(eventually([&] { return lives == 4; }));
  ASSERT_TRUE(eventually(
    [&] { return status_of(system.summary(), "transient").state == ComponentState::stopped; }));
  // A life counts once its start is over, which its run() may come before.
  EXPECT_TRUE(eventually([&] { return status_of(system.summary(), "permanent").restarts == 2; }));
  EXPECT_EQ(status_of(system.summary(), "transient").restarts, 0U);
  system.stop();
}

TEST_F(Supervision, PushesGoOnWhenTheirSenderIsBack) {
  std::atomic<int> lives{0};
  std::atomic<std::int64_t> got{0};
  StandaloneScript::scripts()["server"].run = [&](auto& self) {
    auto life = ++lives;
    while (self.sleep_for(1ms)) {
      self.push(Note{life, ""});
      if (life == 1 && got == 1)
        throw std::runtime_error("the cable is out");
    }
  };
  script("client").start = [&](auto& self) {
    self.template on_push<Note>("server",
                                [&](const std::shared_ptr<const Note>& x) { got = x->number; });
  };
  System system{architecture("COMPONENT CPP server Standalone\n" + subarchitecture("a") +
                             "CPP UM client Unmanaged\n")};
  ASSERT_TRUE(system.start());
  EXPECT_TRUE(eventually([&] { return got == 2; }));
  system.stop();
}

} // namespace

} // namespace castor::test
