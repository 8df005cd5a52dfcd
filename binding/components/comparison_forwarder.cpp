#include "castor/actors/component/registry.hpp"
#include "castor/binding/feature_comparator.hpp"
#include "castor/binding/types.hpp"
#include "castor/wm/entries/failure.hpp"

#include <chrono>
#include <string>

namespace castor::binding {

namespace {

using namespace std::chrono_literals;

/// Has features compared by the subarchitecture that is competent for them, by calls with a
/// FeatureComparison. The scorer does not wait for that.
class ComparisonForwarder final : public UnmanagedComponent {
  void start() override {
    on_change(changed<FeatureComparisonCompetence>(),
              [this](const ChangeEvent&) { forward_all(); });
    on_change(added<FeatureComparison>(), [this](const ChangeEvent&) { forward_all(); });
    forward_all();
  }

  void forward_all() {
    FeatureComparator comparator;
    for (auto& x : read_all<FeatureComparisonCompetence>())
      comparator.add(*x);
    for (auto& x : read_where<FeatureComparison>(field(&FeatureComparison::answered) == false))
      if (auto* competent = comparator.competent_for(x->proxy_feature, x->union_feature))
        forward(x, competent->subarchitecture);
  }

  void forward(const EntryOf<FeatureComparison>& x, const std::string& subarchitecture_name) {
    try {
      auto answer = call<FeatureComparison, FeatureComparison>(subarchitecture_name, *x,
                                                               {.timeout = patience_.get()});
      auto answered = *x;
      answered.equivalent = answer.equivalent;
      answered.answered = true;
      overwrite(x.address, answered);
    } catch (const WorkingMemoryException& e) {
      // Asked again with the next comparison, or when who is competent changes.
      warning("{} is not answered: {}", x.address.id, e.what());
    }
  }

  Option<std::chrono::milliseconds> patience_{this, "patience", 2s, "how long an answer may take"};
};

CASTOR_COMPONENT(ComparisonForwarder, "asks other subarchitectures to compare features")

} // namespace

} // namespace castor::binding
