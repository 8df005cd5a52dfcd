#include "castor/communication/dialogue/content.hpp"
#include "castor/communication/dialogue/descriptions.hpp"
#include "castor/communication/dialogue/directive.hpp"
#include "castor/communication/parsing/hybrid_logic.hpp"

#include <algorithm>
#include <functional>

/// What kind of request a move is.
namespace castor::communication {

void for_each_action(const LogicalForm& form, const Nominal& x,
                     const std::function<void(const Nominal&)>& f) {
  if (x.sort != "conjunction")
    return f(x);
  for (const auto* mode : {"First", "Next"})
    if (const auto* part = dependent(form, x, mode))
      for_each_action(form, *part, f);
}

bool is_handling(const LogicalForm& request, const WordMeanings& meanings) {
  const auto* root = find_nominal(request, request.root);
  if (root == nullptr)
    return false;
  bool all = true;
  for_each_action(request, *root, [&](auto& x) {
    const auto verb = x.proposition == "same" ? std::string{"put"} : x.proposition;
    all = all && x.sort == "action" && meanings.handling.contains(verb) &&
          meanings.actions.contains(verb);
  });
  return all;
}

bool asks_for_ability(const LogicalForm& form) {
  const auto* root = find_nominal(form, form.root);
  return root != nullptr && root->sort == "action" && feature(*root, "Mood") == "int" &&
         (feature(*root, "Modality") == "able" || feature(*root, "Modality") == "can") &&
         dependent(form, *root, "Wh-Restr") == nullptr;
}

LogicalForm as_request(LogicalForm form) {
  for (auto& x : form.nominals) {
    std::erase_if(x.features, [](const auto& y) { return y.name == "Modality"; });
    for (auto& y : x.features)
      if (y.name == "Mood" && y.value == "int")
        y.value = "imp";
  }
  return form;
}

bool forbids(const Nominal& action) {
  return is_negated(action) || action.proposition == "forbid";
}

bool is_correction(const LogicalForm& said) {
  const auto whole = part_of(said, said.root);
  return std::ranges::any_of(whole.nominals,
                             [](auto& x) { return feature(x, "Corrects") == "true"; });
}

LogicalForm without_correction(LogicalForm form) {
  for (auto& x : form.nominals)
    std::erase_if(x.features, [](auto& y) { return y.name == "Corrects"; });
  return form;
}

bool is_to_be_first(const LogicalForm& request) {
  return std::ranges::any_of(request.nominals,
                             [](auto& x) { return feature(x, "Sequence") == "first"; });
}

bool asks_to_act(const DialogueMove& move) {
  return move.type == DialogueMoveType::action_directive || asks_for_ability(move.content);
}

} // namespace castor::communication
