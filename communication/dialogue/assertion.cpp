#include "castor/communication/dialogue/assertion.hpp"

#include "castor/communication/dialogue/descriptions.hpp"
#include "castor/communication/parsing/hybrid_logic.hpp"

namespace castor::communication {

Truth judge_assertion(const Nominal& root, const LogicalForm& form, Evaluation& evaluation) {
  // What people say of themselves and of others is theirs to know.
  const bool is_sight = root.sort == "perception" && root.proposition == "see";
  if (root.sort != "ascription" && root.sort != "existence" && root.sort != "conjunction" &&
      !is_sight)
    return Truth::unknown;
  const auto* subject = dependent(form, root, "Cop-Restr");
  try {
    return evaluation.clause(root);
  } catch (const Uninterpretable& why) {
    // "This is a ball" tells itself what is meant, if nothing else may be a ball.
    if (subject != nullptr && is_deictic(*subject) &&
        why.reason == Uninterpretable::Reason::ambiguous && why.what == subject->name &&
        evaluation.subjects(root, *subject).possible.size() == 1)
      return Truth::unknown;
    throw;
  }
}

Telling telling_of(const Nominal& root, const LogicalForm& form) {
  const bool is_existence = root.sort == "existence";
  const auto* thing = dependent(form, root, is_existence ? "Subject" : "Cop-Restr");
  if (thing == nullptr || thing->sort != "thing" || is_negated(*thing) ||
      !feature(*thing, "Focus").empty() || feature(root, "Denied") == "true" ||
      (is_existence && is_negated(root)))
    return Telling::nothing;
  const auto delimitation = feature(*thing, "Delimitation");
  if (delimitation == "all" || delimitation == "both" || (is_plural(*thing) && is_definite(*thing)))
    return is_existence ? Telling::nothing : Telling::of_each;
  const bool is_one = !is_plural(*thing) && delimitation != "none" && delimitation != "neither" &&
                      dependent(form, *thing, "PartOf") == nullptr;
  return is_one ? Telling::of_one : Telling::nothing;
}

} // namespace castor::communication
