#include "castor/communication/dialogue/presence.hpp"

#include "castor/communication/dialogue/descriptions.hpp"
#include "castor/communication/parsing/hybrid_logic.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace castor::communication {

namespace {

/// The other side of the ascription that a phrase is one side of; null if there is none.
const Nominal* other_side(const LogicalForm& form, const Nominal& phrase) {
  for (auto& x : form.nominals) {
    if (x.sort != "ascription")
      continue;
    const auto* subject = dependent(form, x, "Cop-Restr");
    const auto* scope = dependent(form, x, "Cop-Scope");
    if (subject == &phrase)
      return scope;
    if (scope == &phrase)
      return subject;
  }
  return nullptr;
}

/// The noun for the kind of what is shown by a phrase; empty if it is not said.
std::string noun_shown(const LogicalForm& form, const Nominal& phrase) {
  if (phrase.sort != "thing" || is_plural(phrase))
    return {};
  if (!is_deictic(phrase))
    return feature(phrase, "Proximity") == "proximal" ? phrase.proposition : std::string{};
  const auto* other = other_side(form, phrase);
  return other == nullptr || other->sort != "thing" || is_pronoun(*other) ? std::string{}
                                                                          : other->proposition;
}

void resolve(const LogicalForm& form, SceneKnowledge& scene, Antecedents& result) {
  for (auto& x : form.nominals) {
    const auto noun = noun_shown(form, x);
    if (noun.empty() || !scene.vocabulary().is_of_other_kind(noun))
      continue;
    const auto& possible = scene.candidates(noun);
    std::vector<std::string> proxies;
    for (auto& self : scene.addressee())
      for (auto& around : scene.surroundings(self))
        if (std::ranges::find(possible, around) != possible.end())
          proxies.push_back(scene.proxy_of(around));
    if (!proxies.empty())
      result.insert_or_assign(x.name + std::string{pointed_at}, std::move(proxies));
  }
}

void tell_name(LogicalForm& form, const Vocabulary& vocabulary) {
  const auto* root = find_nominal(form, form.root);
  const auto* subject = root == nullptr ? nullptr : dependent(form, *root, "Cop-Restr");
  const auto* scope = root == nullptr ? nullptr : dependent(form, *root, "Cop-Scope");
  if (subject == nullptr || scope == nullptr || root->sort != "ascription" ||
      noun_shown(form, *subject).empty() || scope->sort != "thing" || is_pronoun(*scope) ||
      !vocabulary.is_of_other_kind(scope->proposition))
    return;
  for (auto& x : find_nominal(form, scope->name)->features)
    if (x.name == "Delimitation" && x.value == "unique")
      x.value = "existential";
}

} // namespace

Antecedents antecedents_by_presence(const DialogueMove& move, SceneKnowledge& scene) {
  Antecedents result;
  resolve(move.content, scene, result);
  for (auto& alternative : move.alternatives)
    resolve(alternative, scene, result);
  return result;
}

DialogueMove with_names_told(DialogueMove move, const Vocabulary& vocabulary) {
  if (move.type == DialogueMoveType::assertion)
    tell_name(move.content, vocabulary);
  for (auto& alternative : move.alternatives) {
    const auto* root = find_nominal(alternative, alternative.root);
    if (root != nullptr && feature(*root, "Mood").empty())
      tell_name(alternative, vocabulary);
  }
  return move;
}

} // namespace castor::communication
