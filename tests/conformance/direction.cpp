#include "castor/tests/conformance/tester.hpp"

#include "castor/actors/component/registry.hpp"

#include <memory>
#include <string>

/// A connection past working memory, to a component outside the subarchitectures.
namespace castor::conformance {

namespace {

struct Direction {
  int number = 0;
};
CASTOR_REFLECT(Direction, number)

/// A stand-alone component: who asks is given the next direction, and it is called out to all.
class AssistantDirector final : public StandaloneComponent {
  void start() override {
    provide<Direction>([this] {
      Direction next{++number_};
      push(next);
      return next;
    });
  }

  int number_ = 0;
};
CASTOR_COMPONENT(AssistantDirector, "numbers the directions, for whoever asks")

class Direct final : public Test {
public:
  Direct(Tester& tester, std::string assistant, int directions)
    : Test(tester), assistant_(std::move(assistant)), directions_(directions) {}

  void start() override {
    tester_.on_push<Direction>(assistant_, [this](auto& direction) {
      if (direction->number != ++heard_)
        fail("direction " + std::to_string(direction->number) + " was called out, not " +
             std::to_string(heard_));
      else if (heard_ == directions_)
        pass();
    });
  }

  void run() override {
    for (int i = 1; i <= directions_; ++i)
      if (auto number = tester_.pull<Direction>(assistant_)->number; number != i)
        return fail("direction " + std::to_string(number) + " was given, not " + std::to_string(i));
  }

  std::string awaited() const override {
    return "direction " + std::to_string(heard_ + 1) + " of " + std::to_string(directions_) +
           " to be called out";
  }

private:
  std::string assistant_;
  int directions_;
  int heard_ = 0;
};

class Director final : public Tester {
public:
  Director() {
    offer("direct", [this] { return std::make_unique<Direct>(*this, assistant_, directions_); });
  }

private:
  Option<StandaloneName> assistant_{this, "assistant", "assistant",
                                    "name of the AssistantDirector"};
  Option<int> directions_{this, "directions", 10, "how many directions it asks for"};
};
CASTOR_COMPONENT(Director, "asks the assistant for directions, which have to come in order")

} // namespace

} // namespace castor::conformance
