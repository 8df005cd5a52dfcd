#include "castor/communication/dialogue/dialogue_move.hpp"

#include "castor/communication/parsing/hybrid_logic.hpp"

namespace castor::communication {

DialogueMoveType dialogue_move_type(const LogicalForm& form) {
  const auto* root = find_nominal(form, form.root);
  if (root == nullptr)
    return DialogueMoveType::none;
  if (root->sort == "greeting")
    return DialogueMoveType::opening;
  if (root->sort == "closing")
    return DialogueMoveType::closing;
  if (root->sort == "marker") {
    if (root->proposition == "yes" || root->proposition == "ok")
      return DialogueMoveType::accept;
    return root->proposition == "no" ? DialogueMoveType::reject : DialogueMoveType::none;
  }
  if (dependent(form, *root, "Wh-Restr") != nullptr)
    return DialogueMoveType::question_w;
  const auto mood = feature(*root, "Mood");
  if (mood == "int")
    return DialogueMoveType::question_yn;
  if (mood == "imp")
    return DialogueMoveType::action_directive;
  return mood == "ind" ? DialogueMoveType::assertion : DialogueMoveType::none;
}

} // namespace castor::communication
