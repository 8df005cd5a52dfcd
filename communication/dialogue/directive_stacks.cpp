#include "castor/communication/dialogue/descriptions.hpp"
#include "castor/communication/dialogue/directive_things.hpp"
#include "castor/communication/dialogue/stacks.hpp"
#include "castor/communication/parsing/hybrid_logic.hpp"

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

/// Things that are stacked, or are to be.
namespace castor::communication {

MeantThings DirectiveThings::in_stacking_order(const Nominal& patient, const Nominal& x,
                                               MeantThings meant) {
  if (patient.sort != "conjunction") {
    const auto width = [&](const std::string& id) {
      const auto body = scene_.body(id);
      const auto shapes = scene_.words(id, binding::FeatureKind::shape);
      const bool is_round = !shapes.empty() && shapes.front() == "sphere";
      return is_round || !body ? 0.0 : body->extent[0] * body->extent[1];
    };
    std::ranges::stable_sort(meant.things, std::greater{}, width);
  }
  // "The tallest tower you can": of all that can be stacked, one that is round on top.
  if (feature(patient, "Stackable") == "true" || dependent(form_, patient, "Except") != nullptr) {
    const auto is_flat = [&](const std::string& id) {
      const auto shapes = scene_.words(id, binding::FeatureKind::shape);
      return !shapes.empty() && shapes.front() != "sphere";
    };
    std::erase_if(meant.things, [&](const auto& id) { return !is_flat(id); });
  }
  const auto* bottom = dependent(form_, x, "Bottom");
  const auto* top = bottom == nullptr ? dependent(form_, x, "Top") : bottom;
  if (top != nullptr) {
    const auto ends = landmarks_of(*top, {});
    const auto is_end = [&](const auto& id) {
      return (std::ranges::find(ends, id) != ends.end()) == (bottom != nullptr);
    };
    std::stable_partition(meant.things.begin(), meant.things.end(), is_end);
  }
  return meant;
}

/// "The tower": the only thing that others stand on, while it stands on the table itself; nothing
/// for other phrases, and if there are several.
std::vector<std::string> DirectiveThings::bottom_of_stack(const Nominal& phrase) {
  if (is_tower(phrase) && !stack_.empty())
    return stack_;
  auto result = whole_stack(phrase);
  if (result.size() > 1)
    result.resize(1);
  return result;
}

/// "Take the tower apart": all that stands in it.
std::vector<std::string> DirectiveThings::whole_stack(const Nominal& phrase) {
  return is_tower(phrase) ? only_stack(scene_) : std::vector<std::string>{};
}

} // namespace castor::communication
