#include "castor/tests/conformance/tester.hpp"

#include "castor/actors/component/registry.hpp"

#include <memory>
#include <string>
#include <vector>

namespace castor::conformance {

namespace {

class InOrderOfPriority final : public Test {
public:
  using Test::Test;

  void start() override {
    address_ = tester_.new_address();
    receive("low", Priority::low);
    receive("medium", Priority::medium);
    receive("high", Priority::high);
  }

  void run() override { tester_.add(address_, tester_.made(Operation::add, address_, 0)); }

  std::string awaited() const override {
    return "three receivers to be called; those called are: " + called_;
  }

private:
  void receive(const std::string& name, Priority priority) {
    tester_.on_change(
      added<TestStruct>().at(address_),
      [this, name](const ChangeEvent&) {
        tester_.info("{}", name);
        called_ += (called_.empty() ? "" : ", ") + name;
        if (++calls_ == 3)
          judge();
      },
      priority);
  }

  void judge() {
    if (called_ == "high, medium, low")
      pass();
    else
      fail("the receivers were called in the order " + called_);
  }

  Address address_;
  std::string called_;
  int calls_ = 0;
};

class PriorityTester final : public Tester {
public:
  PriorityTester() {
    offer("priority", [this] { return std::make_unique<InOrderOfPriority>(*this); });
  }
};
CASTOR_COMPONENT(PriorityTester, "has three receivers of one filter called by their priority")

} // namespace

} // namespace castor::conformance
