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

} // namespace castor::communication
