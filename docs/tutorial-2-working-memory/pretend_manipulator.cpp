#include "action.hpp"

#include <castor/castor.hpp>

#include <random>

class PretendManipulator : public castor::ManagedComponent {
  castor::Option<double> failure_{this, "failure", 0, "probability that an action fails"};
  std::mt19937 random_;

  void start() override {
    on_change(castor::added<Action>(), [this](const castor::ChangeEvent& event) {
      propose_task("act", [this, address = event.address] { act(address); });
    });
    on_call<PickAndPlaceCmd>(
      [this](const PickAndPlaceCmd& command) { return ActionResult{pick_and_place(command)}; });
  }

  void act(const castor::Address& address) {
    auto action = *read<Action>(address);
    action.status = ActionStatus::executing;
    overwrite(address, action);
    if (action.action.points_to<PickAndPlaceCmd>()) {
      action.succeeded = pick_and_place(*follow(action.action.as<PickAndPlaceCmd>()));
    } else {
      warning("does not know how to do a {}", action.action.type);
      action.succeeded = false;
    }
    action.status = ActionStatus::complete;
    overwrite(address, action);
  }

  bool pick_and_place(const PickAndPlaceCmd& command) {
    auto object = follow(command.object);
    bool succeeds = !std::bernoulli_distribution{failure_.get()}(random_);
    info("{} the {} to the {}", succeeds ? "carries" : "fails to carry", object->label,
         command.place);
    return succeeds;
  }
};
CASTOR_COMPONENT(PretendManipulator, "says what a robot arm would do")
