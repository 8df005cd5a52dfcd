#include "castor/tests/conformance/tester.hpp"

#include "castor/actors/component/registry.hpp"
#include "castor/wm/entries/failure.hpp"

#include <chrono>
#include <memory>
#include <string>

namespace castor::conformance {

namespace {

/// A reader says of an entry that it waits for being let to read it.
struct ReaderWaits {
  Address entry;
};
CASTOR_REFLECT(ReaderWaits, entry)

class LockAndDelete final : public Test {
public:
  LockAndDelete(Tester& tester, std::chrono::milliseconds hold) : Test(tester), hold_(hold) {}

  void start() override {
    tester_.on_change(added<ReaderWaits>().anywhere(),
                      [this](const ChangeEvent&) { somebody_waits_ = true; });
  }

  /// The verdict is left to the reader.
  void run() override {
    auto address = tester_.new_address();
    tester_.add(address, tester_.made(Operation::add, address, 0));
    auto guard = tester_.lock(address, LockLevel::odr);
    tester_.wait_until([this] { return somebody_waits_; }, hold_);
    tester_.delete_entry(address);
  }

  std::string awaited() const override { return {}; }

private:
  std::chrono::milliseconds hold_;
  bool somebody_waits_ = false;
};

class LockingDeleteWriter final : public Tester {
public:
  LockingDeleteWriter() {
    offer("lock-and-delete", [this] { return std::make_unique<LockAndDelete>(*this, hold_); });
  }

private:
  Option<std::chrono::milliseconds> hold_{this, "hold", std::chrono::seconds{5},
                                          "for how long it waits for a reader before it deletes"};
};
CASTOR_COMPONENT(LockingDeleteWriter,
                 "locks the entry it has added, and deletes it when somebody waits to read it")

class ReadLocked final : public Test {
public:
  using Test::Test;

  void start() override {
    when_others(added<TestStruct>().anywhere(),
                [this](const ChangeEvent& event) { read_locked(event.address); });
  }

  std::string awaited() const override { return "an entry that somebody adds and locks"; }

private:
  void read_locked(const Address& address) {
    tester_.poll("a lock of " + to_string(address), [&] { return !tester_.is_readable(address); });
    // The read waits already when the writer hears of that.
    auto reading = tester_.read_async<TestStruct>(address);
    tester_.add(tester_.here(tester_.new_id()), ReaderWaits{address});
    try {
      reading.get();
    } catch (const DoesNotExistOnWM&) {
      return pass();
    }
    fail(to_string(address) + " was read, but it was to be deleted before its lock ended");
  }
};

class LockingDeleteReader final : public Tester {
public:
  LockingDeleteReader() {
    offer("read-locked", [this] { return std::make_unique<ReadLocked>(*this); });
  }
};
CASTOR_COMPONENT(LockingDeleteReader,
                 "waits to read an entry that is locked, and has to hear that it was deleted")

} // namespace

} // namespace castor::conformance
