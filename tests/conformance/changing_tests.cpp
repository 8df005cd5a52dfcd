#include "castor/tests/conformance/basic_tests.hpp"

#include "castor/wm/entries/failure.hpp"

#include <map>
#include <string>

namespace castor::conformance {

namespace {

constexpr int overwrites = 10;

/// Reads the entry and overwrites it, adding `step` to its count; again and again if somebody else
/// writes in between: only then may the overwrite be refused.
void overwrite_latest(Tester& tester, const Address& address, std::int64_t step) {
  for (;;) {
    auto entry = tester.read<TestStruct>(address);
    try {
      tester.overwrite(address, tester.made(Operation::overwrite, address, entry->count + step));
      return;
    } catch (const ConsistencyException&) {
      if (tester.version(address) == entry.version)
        throw;
    }
  }
}

/// The owner of an entry, which begins when somebody else has overwritten it or never will.
class Generator : public Test {
public:
  Generator(Tester& tester, std::chrono::milliseconds pause) : Test(tester), pause_(pause) {}

  void start() override {
    address_ = tester_.new_address();
    tester_.on_change(overwritten<TestStruct>().at(address_), [this](const ChangeEvent& event) {
      replaced_ = replaced_ || event.source != tester_.component_name();
    });
  }

  void run() override {
    tester_.add(address_, tester_.made(Operation::add, address_, 0));
    tester_.wait_until([this] { return replaced_; }, pause_);
    generate();
  }

  std::string awaited() const override { return "its own entry"; }

protected:
  virtual void generate() = 0;

  Address address_;

private:
  std::chrono::milliseconds pause_;
  bool replaced_ = false;
};

class Overwrite final : public Generator {
public:
  using Generator::Generator;

private:
  void generate() override {
    for (int i = 0; i < overwrites; ++i)
      overwrite_latest(tester_, address_, 1);
    pass();
  }
};

class UnsafeOverwrite final : public Generator {
public:
  using Generator::Generator;

private:
  void generate() override {
    Version last = 0;
    int refused = 0;
    for (int i = 1; i <= overwrites; ++i) {
      try {
        auto version = tester_.overwrite(address_, tester_.made(Operation::overwrite, address_, i));
        if (version != last + 1)
          return fail("version " + std::to_string(version) + " was written over version " +
                      std::to_string(version - 1) + ", which it has never seen");
        last = version;
      } catch (const ConsistencyException&) {
        ++refused;
      }
    }
    if (refused > 0 && tester_.version(address_) == last)
      return fail(std::to_string(refused) +
                  " overwrites were refused, but nobody else has written");
    tester_.info("{} of {} overwrites were refused", refused, overwrites);
    pass();
  }
};

class Replace final : public Test {
public:
  using Test::Test;

  void start() override {
    when_others(added<TestStruct>().in(tester_.home()), [this](const ChangeEvent& event) {
      try {
        overwrite_latest(tester_, event.address, 0);
      } catch (const DoesNotExistOnWM&) {
        // Its owner was faster.
      }
    });
  }

  std::string awaited() const override { return {}; }
};

class Remove final : public Test {
public:
  Remove(Tester& tester, std::int64_t divisor, std::int64_t wanted)
    : Test(tester), divisor_(divisor), wanted_(wanted) {}

  void start() override {
    auto remove = [this](const ChangeEvent& event) {
      try {
        if (tester_.read<TestStruct>(event.address)->count % divisor_ != 0)
          return;
        tester_.delete_entry(event.address);
      } catch (const DoesNotExistOnWM&) {
        return; // somebody else was faster
      }
      if (++removed_ == wanted_)
        pass();
    };
    when_others(added<TestStruct>().anywhere(), remove);
    when_others(overwritten<TestStruct>().anywhere(), remove);
  }

  std::string awaited() const override {
    return wanted_ == 0 ? ""
                        : "entries to delete, " + std::to_string(removed_) + " of " +
                            std::to_string(wanted_) + " so far";
  }

private:
  std::int64_t divisor_;
  std::int64_t wanted_;
  std::int64_t removed_ = 0;
};

class Readd final : public Test {
public:
  using Test::Test;

  void start() override {
    when(added<TestStruct>().in(tester_.home()).from(tester_.component_name()),
         [this](const ChangeEvent& event) { hear(event); });
    when_others(deleted<TestStruct>().in(tester_.home()),
                [this](const ChangeEvent& event) { add_again(event); });
  }

  void run() override { add_next(); }

  std::string awaited() const override {
    return "events of its own additions, " + std::to_string(heard_) + " of " +
           std::to_string(wanted) + ", and for somebody who deletes entries; " +
           std::to_string(added_again_) + " were added again";
  }

private:
  static constexpr std::size_t wanted = 100;

  struct Added {
    std::int64_t count = 0;
    Version version = 0;
  };

  void add_next() {
    auto address = tester_.new_address();
    auto count = static_cast<std::int64_t>(added_.size());
    added_[address] = {count, 0};
    tester_.add(address, tester_.made(Operation::add, address, count));
  }

  void add_again(const ChangeEvent& event) {
    auto i = added_.find(event.address);
    if (i == added_.end())
      return;
    auto& [count, version] = i->second;
    if (event.version != version)
      return fail(to_string(event) + ", but version " + std::to_string(version) + " was added");
    version =
      tester_.add_async(event.address, tester_.made(Operation::add, event.address, count)).get();
    ++added_again_;
    if (version != event.version + 1)
      fail(to_string(event.address) + " had version " + std::to_string(event.version) +
           " when it was deleted, but has version " + std::to_string(version) + " now");
  }

  void hear(const ChangeEvent& event) {
    auto i = added_.find(event.address);
    if (i == added_.end())
      return; // of another test of this tester
    if (event.version != i->second.version)
      return fail(to_string(event) + ", but version " + std::to_string(i->second.version) +
                  " was added");
    ++heard_;
    if (heard_ >= wanted && added_again_ > 0)
      pass();
    else if (event.version == 0 && added_.size() < wanted)
      add_next();
  }

  std::map<Address, Added> added_;
  std::size_t heard_ = 0;
  std::size_t added_again_ = 0;
};

} // namespace

std::unique_ptr<Test> overwrite(Tester& tester, std::chrono::milliseconds pause) {
  return std::make_unique<Overwrite>(tester, pause);
}

std::unique_ptr<Test> unsafe_overwrite(Tester& tester, std::chrono::milliseconds pause) {
  return std::make_unique<UnsafeOverwrite>(tester, pause);
}

std::unique_ptr<Test> replace(Tester& tester) {
  return std::make_unique<Replace>(tester);
}

std::unique_ptr<Test> remove(Tester& tester, std::int64_t divisor, std::int64_t wanted) {
  return std::make_unique<Remove>(tester, divisor, wanted);
}

std::unique_ptr<Test> readd(Tester& tester) {
  return std::make_unique<Readd>(tester);
}

} // namespace castor::conformance
