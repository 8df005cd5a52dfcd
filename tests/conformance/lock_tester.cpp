#include "castor/tests/conformance/tester.hpp"

#include "castor/actors/component/registry.hpp"
#include "castor/wm/entries/failure.hpp"

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

namespace castor::conformance {

namespace {

/// Owns an entry that others count up under locks: they must not get in one another's way.
class CounterOwner final : public Test {
public:
  CounterOwner(Tester& tester, std::int64_t wanted) : Test(tester), wanted_(wanted) {}

  void start() override {
    address_ = tester_.new_address();
    when(overwritten<TestStruct>().at(address_), [this](const ChangeEvent&) { look(); });
  }

  void run() override { tester_.add(address_, tester_.made(Operation::add, address_, 0)); }

  std::string awaited() const override {
    return "count " + std::to_string(wanted_) + "; it is " + std::to_string(count_);
  }

private:
  void look() {
    auto entry = tester_.read<TestStruct>(address_);
    count_ = entry->count;
    if (count_ != static_cast<std::int64_t>(entry.version))
      return fail("an update was lost: after " + std::to_string(entry.version) +
                  " overwrites the count is " + std::to_string(count_));
    if (count_ < wanted_)
      return;
    if (count_ > wanted_)
      return fail("the count is " + std::to_string(count_) + ", not " + std::to_string(wanted_));
    tester_.delete_entry(address_);
    pass();
  }

  std::int64_t wanted_;
  std::int64_t count_ = 0;
  Address address_;
};

/// Counts up the entry of somebody else ten times, in one lock.
class CountUp final : public Test {
public:
  CountUp(Tester& tester, bool polls, std::chrono::milliseconds pause)
    : Test(tester), polls_(polls), pause_(pause) {}

  void start() override {
    when_others(added<TestStruct>().anywhere(),
                [this](const ChangeEvent& event) { count_up(event.address); });
  }

  std::string awaited() const override { return "an entry to overwrite"; }

private:
  LockGuard locked(const Address& address) {
    if (!polls_)
      return tester_.lock(address, LockLevel::odr);
    std::optional<LockGuard> guard;
    tester_.poll("a lock of " + to_string(address), [&] {
      guard = tester_.try_lock(address, LockLevel::odr);
      return guard.has_value();
    });
    return *std::move(guard);
  }

  void count_up(const Address& address) {
    auto guard = locked(address);
    auto count = tester_.read<TestStruct>(address)->count;
    for (int i = 1; i <= 10; ++i) {
      tester_.overwrite(address, tester_.made(Operation::overwrite, address, count + i));
      // So that others have time to interfere.
      tester_.sleep_for(pause_);
    }
    guard.unlock();
    pass();
  }

  bool polls_;
  std::chrono::milliseconds pause_;
};

/// Keeps its own entry locked for a while.
class Lock final : public Test {
public:
  Lock(Tester& tester, LockLevel level, std::chrono::milliseconds hold)
    : Test(tester), level_(level), hold_(hold) {}

  void run() override {
    auto address = tester_.new_address();
    tester_.add(address, tester_.made(Operation::add, address, 0));
    auto guard = tester_.lock(address, level_);
    tester_.sleep_for(hold_);
    guard.unlock();
    pass();
  }

  std::string awaited() const override { return "its own entry"; }

private:
  LockLevel level_;
  std::chrono::milliseconds hold_;
};

/// Tries what a lock of that level forbids, once somebody else has locked the entry it has added.
class Sneak final : public Test {
public:
  Sneak(Tester& tester, LockLevel level) : Test(tester), level_(level) {}

  void start() override {
    when_others(added<TestStruct>().anywhere(),
                [this](const ChangeEvent& event) { sneak(event.address); });
  }

  std::string awaited() const override { return "an entry that somebody adds and locks"; }

private:
  template <class F>
  bool refused(const Address& address, const std::string& verb, F&& f) {
    try {
      f();
    } catch (const PermissionException&) {
      return true;
    }
    fail("it may " + verb + " " + to_string(address) + ", which somebody else has locked");
    return false;
  }

  void sneak(const Address& address) {
    tester_.poll("a lock of " + to_string(address),
                 [&] { return !tester_.is_overwritable(address); });
    if (!refused(address, "overwrite", [&] {
          tester_.overwrite(address, tester_.made(Operation::overwrite, address, 1));
        }))
      return;
    if (level_ != LockLevel::o &&
        !refused(address, "delete", [&] { tester_.delete_entry(address); }))
      return;
    if (level_ == LockLevel::odr && tester_.is_readable(address))
      return fail(to_string(address) + " is said to be readable, but somebody else has locked it");
    pass();
  }

  LockLevel level_;
};

class LockTester final : public Tester {
public:
  LockTester() {
    for (std::int64_t n : {10, 40})
      offer("write-" + std::to_string(n),
            [this, n] { return std::make_unique<CounterOwner>(*this, n); });
    offer("overwrite-10", [this] { return std::make_unique<CountUp>(*this, false, pause_); });
    offer("try-overwrite-10", [this] { return std::make_unique<CountUp>(*this, true, pause_); });
    offer_lock_tests("lock-o", "sneak-o", LockLevel::o);
    offer_lock_tests("lock-od", "sneak-d", LockLevel::od);
    offer_lock_tests("lock-odr", "sneak-r", LockLevel::odr);
  }

private:
  void offer_lock_tests(const std::string& lock_name, const std::string& sneak_name,
                        LockLevel level) {
    offer(lock_name, [this, level] { return std::make_unique<Lock>(*this, level, hold_); });
    offer(sneak_name, [this, level] { return std::make_unique<Sneak>(*this, level); });
  }

  Option<std::chrono::milliseconds> pause_{this, "pause", std::chrono::milliseconds{2},
                                           "overwrite: between two overwrites in one lock"};
  Option<std::chrono::milliseconds> hold_{this, "hold", std::chrono::seconds{3},
                                          "lock: for how long the entry is locked"};
};
CASTOR_COMPONENT(LockTester, "tests locks: at which level they keep others from doing what")

} // namespace

} // namespace castor::conformance
