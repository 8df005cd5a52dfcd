#include "castor/tests/conformance/tester.hpp"

#include "castor/actors/component/registry.hpp"

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>

/// What lies on working memory is nobody's own object: neither the writer's, who may change his,
/// nor a reader's.
namespace castor::conformance {

namespace {

using namespace std::chrono_literals;

class ChangeAfterwards final : public Test {
public:
  ChangeAfterwards(Tester& tester, std::int64_t times, std::chrono::milliseconds pause)
    : Test(tester), times_(times), pause_(pause) {}

  void run() override {
    auto address = tester_.new_address();
    auto own = tester_.made(Operation::add, address, 0);
    tester_.add(address, own);
    for (std::int64_t i = 0; times_ == 0 || i < times_; ++i) {
      ++own.count;
      own.change.source += '.';
      if (!tester_.sleep_for(pause_))
        return;
    }
  }

  std::string awaited() const override { return {}; }

private:
  std::int64_t times_;
  std::chrono::milliseconds pause_;
};

class ReadAgain final : public Test {
public:
  ReadAgain(Tester& tester, std::int64_t times, std::chrono::milliseconds pause)
    : Test(tester), times_(times), pause_(pause) {}

  void start() override {
    when_others(added<TestStruct>().anywhere(),
                [this](const ChangeEvent& event) { read_again(event.address); });
  }

  std::string awaited() const override { return times_ == 0 ? "" : "an entry to read"; }

private:
  void read_again(const Address& address) {
    auto entry = tester_.read<TestStruct>(address);
    const auto first = *entry;
    auto said = tester_.now();
    for (std::int64_t i = 0; times_ == 0 || i < times_; ++i) {
      if (!tester_.sleep_for(pause_))
        return;
      if (!(*entry == first) || !(*tester_.read<TestStruct>(address) == first))
        return fail(to_string(address) + " has changed");
      if (tester_.now() - said >= 1s) {
        said = tester_.now();
        tester_.info("fine");
      }
    }
    pass();
  }

  std::int64_t times_;
  std::chrono::milliseconds pause_;
};

template <class T>
class DirectAccess : public Tester {
protected:
  explicit DirectAccess(const std::string& test) {
    offer(test, [this] { return std::make_unique<T>(*this, for_, pause_); });
  }

private:
  Option<std::int64_t> for_{this, "for", 0, "how often; 0: without end"};
  Option<std::chrono::milliseconds> pause_{this, "pause", 1ms, "how long it waits each time"};
};

class DirectAccessWriter final : public DirectAccess<ChangeAfterwards> {
public:
  DirectAccessWriter() : DirectAccess("change-afterwards") {}
};
CASTOR_COMPONENT(DirectAccessWriter,
                 "changes its own object after adding it; leaves the verdict to the reader")

class DirectAccessReader final : public DirectAccess<ReadAgain> {
public:
  DirectAccessReader() : DirectAccess("read-again") {}
};
CASTOR_COMPONENT(DirectAccessReader,
                 "reads an entry again and again, and says \"fine\" once a second while it stays")

} // namespace

} // namespace castor::conformance
