// The pretended body of a robot at a desk. The world is an entry, so that it outlives the body.

#include "castor/actors/component/managed_component.hpp"
#include "castor/actors/component/registry.hpp"
#include "castor/planning/continual/types.hpp"
#include "castor/tests/planning/motivation/desk.hpp"

#include <chrono>
#include <cstddef>
#include <cstdint>

namespace castor::planning::test {

namespace {

using namespace std::chrono_literals;

/// Puts a ball somewhere, and charges its battery.
class DeskBody final : public ManagedComponent {
  void start() override {
    if (!exists(desk_))
      add(desk_, Desk{});
    on_call<StateRequest>([this](const StateRequest&) {
      const auto desk = *read<Desk>(desk_);
      StateReply result{{{"robby", "agent"}, {"ball", "thing"}}, {"(" + desk.ball + " ball)"}};
      if (desk.is_charged)
        result.facts.emplace_back("(charged robby)");
      else if (now() >= low_after_.get())
        result.facts.emplace_back("(battery-low robby)");
      return result;
    });
    on_action<PlannedAction>([this](ActionInProgress& action, const PlannedAction& step) {
      if (!action.sleep_for(step_.get()))
        return ActionResult::cancelled("the arm is at rest");
      execute(step.name);
      return ActionResult::succeeded();
    });
  }

  void execute(const std::string& step) {
    auto desk = *read<Desk>(desk_);
    desk.log.push_back(step);
    if (desk.log.size() > longest_log)
      desk.log.erase(desk.log.begin());
    if (step == "charge") {
      desk.needless += desk.is_charged ? 1 : 0;
      desk.is_charged = true;
      desk.puts = 0;
    } else {
      const std::string place = step == "put-left" ? "left" : "right";
      desk.needless += desk.ball == place ? 1 : 0;
      desk.ball = place;
      if (++desk.puts == lasts_.get())
        desk.is_charged = false;
    }
    put(desk_, desk);
  }

  static constexpr std::size_t longest_log = 100;

  Option<std::chrono::milliseconds> step_{this, "step", 3s, "how long each step takes"};
  Option<std::chrono::milliseconds> low_after_{this, "low-after", 1500ms,
                                               "when the battery becomes low for the first time"};
  Option<std::int64_t> lasts_{this, "lasts", 0, "puts for which a charge lasts; 0: for ever"};
  const Address desk_{"body", "desk"};
};

CASTOR_COMPONENT(DeskBody, "puts a ball left or right, and charges itself")

} // namespace

} // namespace castor::planning::test
