#include "castor/tests/actors/component/scripted.hpp"

#include "castor/wm/entries/failure.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <string>

namespace castor::test {

namespace {

class LockGuards : public testing::Test {
protected:
  void TearDown() override { clear_scripts(); }

  static int run_two() {
    System system{
      architecture(subarchitecture("a") + "CPP UM one Unmanaged\nCPP UM two Unmanaged\n"),
      without_restarts()};
    return run(system);
  }

  static void await(UnmanagedScript& self, const std::atomic<int>& step, int wanted) {
    while (step < wanted && self.is_running())
      self.sleep_for(1ms);
  }

  const Address x{"a", "x"};
  std::atomic<int> step{0};
};

TEST_F(LockGuards, GiveBackTheirOwnLeaseOnly) {
  UnmanagedScript::scripts()["one"].run = [&](auto& self) {
    self.add(x, Note{1, "one"});
    auto old_guard = self.lock(x, LockLevel::o);
    step = 1;
    await(self, step, 2);
    auto guard = self.lock(x, LockLevel::odr);
    EXPECT_GT(guard.token(), old_guard.token());
    EXPECT_FALSE(old_guard.held());
    EXPECT_THROW(old_guard.unlock(), LeaseLostException);
    EXPECT_TRUE(guard.held());
    step = 3;
    await(self, step, 4);
    self.template read<Note>(x);
    EXPECT_NO_THROW(self.overwrite(x, Note{2, "one"}));
    EXPECT_NO_THROW(guard.unlock());
    self.end_system(0, "done");
  };
  UnmanagedScript::scripts()["two"].run = [&](auto& self) {
    await(self, step, 1);
    // The level allows it, and ends the lease.
    self.delete_entry(x);
    self.add(x, Note{1, "two"});
    step = 2;
    await(self, step, 3);
    EXPECT_FALSE(self.try_lock(x, LockLevel::o)) << "the second guard still holds";
    step = 4;
  };
  EXPECT_EQ(run_two(), 0);
}

TEST_F(LockGuards, ThatAreMembersEndWithAComponentThatFails) {
  UnmanagedScript::scripts()["one"].run = [&](auto& self) {
    self.add(x, Note{1, "one"});
    auto guard = std::make_shared<LockGuard>(self.lock(x, LockLevel::odr));
    self.on_adopted = [guard](auto&, auto&) {};
    step = 1;
    throw std::runtime_error("fails on purpose");
  };
  UnmanagedScript::scripts()["two"].run = [&](auto& self) {
    await(self, step, 1);
    auto guard = self.lock(x, LockLevel::odr);
    EXPECT_TRUE(guard.held());
    guard.unlock();
    self.end_system(0, "done");
  };
  EXPECT_EQ(run_two(), 0);
}

} // namespace

} // namespace castor::test
