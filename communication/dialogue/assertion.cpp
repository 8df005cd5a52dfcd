#include "castor/communication/dialogue/assertion.hpp"

#include "castor/communication/dialogue/descriptions.hpp"
#include "castor/communication/dialogue/salience.hpp"
#include "castor/communication/parsing/hybrid_logic.hpp"

#include <algorithm>
#include <string>
#include <vector>

namespace castor::communication {

namespace {

/// What disagrees with what is perceived is not told, nor what may be about several things.
bool is_not_to_be_told(const LogicalForm& form, const Nominal& root, const Antecedents& antecedents,
                       SceneKnowledge& scene) {
  using Reason = Uninterpretable::Reason;
  Evaluation evaluation{form, antecedents, scene};
  try {
    return judge_assertion(root, form, evaluation) == Truth::no;
  } catch (const Uninterpretable& why) {
    // What is not clear is asked about, and not told; nor what nothing that is seen can be meant
    // by.
    return why.reason == Reason::ambiguous || why.reason == Reason::nothing_pointed_at ||
           why.reason == Reason::nothing_like;
  }
}

bool is_known(const MoveReferents& referents, const Nominal& phrase) {
  return std::ranges::any_of(referents.pronouns, [&phrase](auto& x) {
    return x.nominal == phrase.name || x.nominal == phrase.name + std::string{pointed_at};
  });
}

void add_to(std::vector<binding::Feature>& features, const binding::Feature& x) {
  if (std::ranges::find(features, x) == features.end())
    features.push_back(x);
}

} // namespace

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

Told told_by(const DialogueMove& move, const MoveReferents& referents, SceneKnowledge& scene) {
  const auto& form = move.content;
  const auto* root = find_nominal(form, form.root);
  if (root == nullptr)
    return {};
  Told result{telling_of(*root, form), {}};
  if (result.telling == Telling::nothing ||
      is_not_to_be_told(form, *root, from_entry(referents.pronouns), scene))
    return {};
  const auto* thing = dependent(form, *root, root->sort == "existence" ? "Subject" : "Cop-Restr");
  auto features = features_of(form, *thing);
  if (const auto* scope = dependent(form, *root, "Cop-Scope"))
    for (auto& x : features_of(form, *scope))
      add_to(features, is_negated(*root) && x.text != "thing" ? binding::negation_of(x) : x);
  std::vector<std::string> meant;
  // What is said of "this" tells what is meant, unless something was pointed at or spoken of.
  if (!is_deictic(*thing) || is_known(referents, *thing))
    for (auto& x : referents.referents)
      if (x.nominal == thing->name)
        meant = x.proxies;
  if (result.telling == Telling::of_one && meant.size() != 1)
    meant.assign(1, {});
  for (auto& proxy : meant) {
    auto& of_it = result.proxies.emplace_back(features);
    if (!proxy.empty())
      add_to(of_it, feature(binding::FeatureKind::existing_proxy_id, proxy));
  }
  return result;
}

} // namespace castor::communication
