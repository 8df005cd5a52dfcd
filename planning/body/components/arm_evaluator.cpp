#include "castor/actors/component/registry.hpp"
#include "castor/actors/component/subarchitecture_component.hpp"
#include "castor/planning/body/arm_evaluation.hpp"

#include <string>

namespace castor::manipulation {

namespace {

/// Counts what a simulated arm must not do: drop things, touch something, move without commands.
class ArmEvaluator final : public UnmanagedComponent {
  void start() override {
    if (const auto entry = here(component_name()); exists(entry))
      known_ = told_ = *read<ArmEvaluation>(entry);
    on_push<ArmStatus>(arm_.get(), [this](auto& x) { follow(*x); });
  }

  void follow(const ArmStatus& status) {
    evaluate(known_, status);
    // Where it is just now is told with the rest.
    auto told = known_;
    told.height = told_.height;
    told.moved = told_.moved;
    if (told == told_)
      return;
    told_ = known_;
    put(here(component_name()), told_);
  }

  Option<StandaloneName> arm_{this, "arm", "arm", "the simulated arm"};

  ArmEvaluation known_;
  /// As it was written last.
  ArmEvaluation told_;
};

CASTOR_COMPONENT(ArmEvaluator, "counts what a simulated arm drops and touches")

} // namespace

} // namespace castor::manipulation
