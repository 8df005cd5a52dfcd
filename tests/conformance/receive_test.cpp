#include "castor/tests/conformance/basic_tests.hpp"

#include <array>
#include <string>

namespace castor::conformance {

namespace {

class Receive final : public Test {
public:
  using Test::Test;

  void start() override {
    address_ = tester_.here(tester_.new_id());
    auto& own = tester_.component_name();
    const std::array<ChangeFilter, receivers> filters{
      any_change(),
      any_change().anywhere(),
      any_change().in(address_.subarchitecture),
      any_change().from(own),
      changes_by(Operation::add),
      changes_of(address_),
      changed<TestStruct>(),
      changed<TestStruct>().anywhere().from(own),
      added<TestStruct>(),
      added<TestStruct>().anywhere(),
      added<TestStruct>().at(address_),
      added<TestStruct>().at(address_).from(own),
    };
    for (std::size_t i = 0; i < receivers; ++i)
      ids_[i] = tester_.on_change(filters[i], [this, i](const ChangeEvent&) { receive(i); });
  }

  void run() override {
    others_ = tester_.receiver_count() + called_ - receivers;
    tester_.add(address_, tester_.made(Operation::add, address_, 0));
  }

  std::string awaited() const override {
    std::string missing;
    for (std::size_t i = 0; i < receivers; ++i)
      if (calls_[i] == 0)
        missing += (missing.empty() ? "" : ", ") + std::to_string(i + 1);
    return "a call of each of twelve receivers; these were not called: " + missing;
  }

private:
  static constexpr std::size_t receivers = 12;

  void receive(std::size_t i) {
    ++calls_[i];
    tester_.remove_receiver(ids_[i]);
    if (++called_ == receivers)
      tester_.post(*this, [this] { add_once_more(); });
  }

  /// No receiver may hear of this entry, save a last one that hears of it after all others would.
  void add_once_more() {
    if (auto now = tester_.receiver_count(); now != others_)
      return fail(std::to_string(now - others_) + " receivers are left that removed themselves");
    auto last = tester_.here(tester_.new_id());
    tester_.on_change(
      changes_of(last),
      [this](const ChangeEvent&) { tester_.post(*this, [this] { check_calls(); }); },
      Priority::low);
    tester_.add(last, tester_.made(Operation::add, last, 1));
  }

  void check_calls() {
    for (std::size_t i = 0; i < receivers; ++i)
      if (calls_[i] != 1)
        return fail("receiver " + std::to_string(i + 1) + " was called " +
                    std::to_string(calls_[i]) + " times before it was removed and after");
    pass();
  }

  Address address_;
  /// How many receivers other tests of this tester have.
  std::size_t others_ = 0;
  std::size_t called_ = 0;
  std::array<ReceiverId, receivers> ids_{};
  std::array<int, receivers> calls_{};
};

} // namespace

std::unique_ptr<Test> receive(Tester& tester) {
  return std::make_unique<Receive>(tester);
}

} // namespace castor::conformance
