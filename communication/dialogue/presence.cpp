#include "castor/communication/dialogue/presence.hpp"

#include "castor/communication/dialogue/descriptions.hpp"
#include "castor/communication/parsing/hybrid_logic.hpp"

#include <algorithm>
#include <optional>
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
  // "Is this the kitchen or the office?"
  if (other != nullptr && other->sort == "conjunction")
    other = dependent(form, *other, "First");
  return other == nullptr || other->sort != "thing" || is_pronoun(*other) ? std::string{}
                                                                          : other->proposition;
}

/// "What is this?", where there are no things that could be meant.
bool is_asked_of_place(const LogicalForm& form, const Nominal& phrase, SceneKnowledge& scene) {
  const auto* other = is_deictic(phrase) && !is_plural(phrase) ? other_side(form, phrase) : nullptr;
  return other != nullptr && other->sort == "entity" && scene.things().empty();
}

void resolve(const LogicalForm& form, SceneKnowledge& scene, Antecedents& result) {
  for (auto& x : form.nominals) {
    const auto noun = noun_shown(form, x);
    const bool is_of_kind = !noun.empty() && scene.vocabulary().is_of_other_kind(noun);
    if (!is_of_kind && !is_asked_of_place(form, x, scene))
      continue;
    const auto& possible = is_of_kind ? scene.candidates(noun) : scene.individuals();
    std::vector<std::string> proxies;
    for (auto& self : scene.addressee())
      for (auto& around : scene.surroundings(self))
        if (std::ranges::find(possible, around) != possible.end())
          proxies.push_back(scene.proxy_of(around));
    if (!proxies.empty())
      result.insert_or_assign(x.name + std::string{pointed_at}, std::move(proxies));
  }
}

/// The place that a statement says who speaks is in, and who is said to be there: "we are in the
/// kitchen", "the kitchen is here". Null if it does not.
struct PlaceHere {
  const Nominal* place = nullptr;
  const Nominal* who = nullptr;
};

PlaceHere place_here(const LogicalForm& form, const Nominal& root, const Vocabulary& vocabulary) {
  const auto* subject = dependent(form, root, "Cop-Restr");
  const auto* region = dependent(form, root, "Cop-Scope");
  if (root.sort != "ascription" || is_negated(root) || subject == nullptr || region == nullptr ||
      region->sort != "region" || is_negated(*region))
    return {};
  PlaceHere result;
  if (is_participant(*subject) && region->proposition == "in")
    result = {dependent(form, *region, "Anchor"), subject};
  else if (region->proposition == "here")
    result = {subject, region};
  if (result.place == nullptr || result.place->sort != "thing" || is_plural(*result.place) ||
      is_deictic(*result.place) || feature(*result.place, "Proximity") == "proximal" ||
      !vocabulary.is_of_other_kind(result.place->proposition))
    return {};
  return result;
}

/// "We are in the kitchen" becomes "this is the kitchen".
void show_place(LogicalForm& form, const Vocabulary& vocabulary) {
  const auto* root = find_nominal(form, form.root);
  const auto here = root == nullptr ? PlaceHere{} : place_here(form, *root, vocabulary);
  if (here.place == nullptr)
    return;
  for (auto& x : find_nominal(form, root->name)->relations)
    if (x.mode == "Cop-Restr")
      x.dependent = here.who->name;
    else if (x.mode == "Cop-Scope")
      x.dependent = here.place->name;
  auto& shown = *find_nominal(form, here.who->name);
  shown.sort = "thing";
  shown.proposition = "this";
  shown.features = {{"Number", "sg"}};
}

void tell_name(LogicalForm& form, const Vocabulary& vocabulary) {
  show_place(form, vocabulary);
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

std::optional<NameTold> name_told(const LogicalForm& statement, SceneKnowledge& scene) {
  const auto* root = find_nominal(statement, statement.root);
  if (root == nullptr || root->sort != "ascription" || is_negated(*root) ||
      feature(*root, "Denied") == "true" || !feature(*root, "Mood").empty())
    return std::nullopt;
  const auto* subject = dependent(statement, *root, "Cop-Restr");
  const auto* name = dependent(statement, *root, "Cop-Scope");
  if (subject == nullptr || name == nullptr || noun_shown(statement, *subject).empty() ||
      name->sort != "thing" || is_pronoun(*name) || is_plural(*name) || is_negated(*name) ||
      !name->relations.empty())
    return std::nullopt;
  auto learner = scene.learner_of(name->proposition);
  if (learner.empty())
    return std::nullopt;
  return NameTold{std::move(learner), scene.vocabulary().concept_of(name->proposition)};
}

} // namespace castor::communication
