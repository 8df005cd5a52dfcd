#include "action.hpp"

#include <castor/castor.hpp>

#include <utility>

class Planner : public castor::UnmanagedComponent {
  castor::Option<castor::SubarchitectureName> executor_{this, "executor", "manipulation",
                                                        "the subarchitecture that acts"};

  void run() override {
    castor::EntryPointer<Cup> cup{add(Cup{0.5, "mug"})};
    info("pick and place: {}", act(PickAndPlaceCmd{cup, "shelf"}));
    info("wave: {}", act(WaveCmd{3}));
    auto result = call<PickAndPlaceCmd, ActionResult>(executor_, {cup, "table"});
    info("pick and place by a call: {}", result.succeeded);
  }

  /// Whether it succeeded.
  template <castor::ReflectedRecord Command>
  bool act(Command command) {
    castor::Address specific{executor_, new_id()};
    castor::Address generic{executor_, new_id()};
    add(specific, std::move(command));
    bool complete = false;
    auto receiver = on_change(
      castor::overwritten<Action>().at(generic).where(&Action::status, ActionStatus::complete),
      [&](const castor::ChangeEvent&) { complete = true; });
    add(generic, Action{castor::EntryPointer<Command>{specific}});
    while (!complete && wait_for_changes()) {
      // It was another change.
    }
    remove_receiver(receiver);
    auto action = read<Action>(generic);
    write(castor::WriteBatch{}.delete_entry(generic).delete_entry(specific));
    return action->succeeded.value_or(false);
  }
};
CASTOR_COMPONENT(Planner, "has a cup carried about")
