#include <castor/castor.hpp>

#include <chrono>

using namespace std::chrono_literals;

/// What the arm is to do.
struct PickUp {
  std::string thing;
};
CASTOR_REFLECT(PickUp, thing)

class Arm : public castor::ManagedComponent {
  void start() override {
    on_action<PickUp>(
      [this](castor::ActionInProgress& action, const PickUp& what) {
        if (what.thing == "table")
          return castor::ActionResult::failed("it is too heavy");
        for (int i = 1; i <= 4; ++i) {
          if (action.cancelled())
            return castor::ActionResult::cancelled("the arm is at rest");
          action.sleep_for(50ms);
          action.progress(i / 4.0);
        }
        return castor::ActionResult::succeeded({"holds(arm, " + what.thing + ")"});
      },
      {.preconditions = "the arm is empty"});
  }
};
CASTOR_COMPONENT(Arm, "pretends to pick up things")

class Planner : public castor::UnmanagedComponent {
  void run() override {
    auto cup = perform("manipulation", PickUp{"cup"}).wait(5s);
    info("{}", cup.became_true.at(0));
    info("the table: {}", perform("manipulation", PickUp{"table"}).wait(5s).reason);
    auto ball = perform("manipulation", PickUp{"ball"});
    while (ball.progress() == 0)
      sleep_for(10ms);
    ball.cancel();
    info("the ball: {}", ball.wait(5s).reason);
  }
};
CASTOR_COMPONENT(Planner, "has things picked up")
