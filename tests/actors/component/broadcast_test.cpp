#include "castor/tests/actors/component/scripted.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <string>

namespace castor::test {

namespace {

/// A system that broadcasts: two components in a, one in b.
class Broadcast : public testing::Test {
protected:
  void TearDown() override { clear_scripts(); }

  static auto& script(const std::string& name) { return ManagedScript::scripts()[name]; }

  static ArchitectureDescription description() {
    return architecture(subarchitecture("a") + "CPP MG writer Managed\nCPP MG deaf Managed\n" +
                        subarchitecture("b") + "CPP MG reader Managed\n");
  }

  static SystemOptions broadcasting() {
    SystemOptions result;
    result.broadcast = true;
    return result;
  }

  static ComponentStatus status(System& system, const std::string& name) {
    for (auto& x : system.summary().components)
      if (x.identity.name == name)
        return x;
    ADD_FAILURE() << name;
    return {};
  }
};

TEST_F(Broadcast, SendsEveryEventToEveryComponentWhichFiltersForItself) {
  std::atomic<int> notes{0}, others{0}, loud{0}, changes{0};
  script("reader").start = [&](auto& self) {
    self.on_change(added<Note>().in("a"), [&](auto&) { ++notes; });
    self.on_change(added<Note>().in("a").where(&Note::number, 3), [&](auto&) { ++loud; });
    self.on_change(changed(&Other::x).in("a"), [&](auto&) { ++changes; });
    auto id = self.on_change(added<Other>().anywhere(), [&](auto&) { ++others; });
    self.remove_receiver(id);
  };
  script("writer").run = [&](auto& self) {
    for (int i = 0; i < 5; ++i)
      self.add(Note{i});
    auto other = self.add(Other{});
    self.overwrite(other, Other{1});
    for (int i = 0; i < 3; ++i)
      self.add(Other{});
    // Its own come to it as well.
    self.sleep_for(1h);
  };
  System system{description(), broadcasting()};
  ASSERT_TRUE(system.start());
  EXPECT_TRUE(eventually([&] {
    return status(system, "reader").events_received == 10 &&
           status(system, "deaf").events_received == 10 &&
           status(system, "writer").events_received == 10;
  }));
  EXPECT_TRUE(eventually([&] { return notes == 5 && loud == 1 && changes == 1; }));
  EXPECT_EQ(others, 0) << "the filter was removed";
  EXPECT_EQ(status(system, "reader").events_rejected, 4u);
  EXPECT_EQ(status(system, "deaf").events_rejected, 10u);
  EXPECT_EQ(status(system, "writer").events_rejected, 10u);
  std::uint64_t forwarded = 0;
  auto summary = system.summary();
  for (auto& x : summary.working_memories)
    forwarded += x.forwarded;
  EXPECT_EQ(forwarded, 10u) << "to b, and not to Castor's own working memory";
  for (auto& x : summary.components) {
    if (x.is_task_manager) {
      EXPECT_EQ(x.events_received, 0u) << x.identity.name;
    }
  }
  system.stop();
}

TEST_F(Broadcast, LeavesCallsAsTheyAre) {
  script("reader").start = [](auto& self) {
    self.template on_call<Note>(
      [](const Note& x) { return Other{2.0 * static_cast<double>(x.number)}; });
  };
  script("writer").run = [](auto& self) {
    for (int i = 0; i < 10; ++i)
      EXPECT_EQ((self.template call<Note, Other>("b", Note{i}).x), 2 * i);
    self.end_system(0, "done");
  };
  System system{description(), broadcasting()};
  EXPECT_EQ(run(system), 0);
}

TEST_F(Broadcast, IsNotCountedWithoutIt) {
  script("reader").start = [](auto& self) {
    self.on_change(added<Note>().in("a"), [&](auto&) { self.end_system(0, "done"); });
  };
  script("writer").run = [](auto& self) {
    self.add(Other{});
    self.add(Note{});
  };
  System system{description()};
  EXPECT_EQ(run(system), 0);
  EXPECT_EQ(status(system, "reader").events_received, 1u);
  EXPECT_EQ(status(system, "reader").events_rejected, 0u);
}

} // namespace

} // namespace castor::test
