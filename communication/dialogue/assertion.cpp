#include "castor/communication/dialogue/assertion.hpp"

#include "castor/communication/dialogue/descriptions.hpp"
#include "castor/communication/dialogue/presence.hpp"
#include "castor/communication/dialogue/salience.hpp"
#include "castor/communication/parsing/hybrid_logic.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace castor::communication {

namespace {

/// Whether binding may be told what a reading says.
enum class Verdict { told, not_told, not_interpretable };

/// What disagrees with what is perceived is not told, nor what may be about several things.
Verdict verdict_on(const LogicalForm& form, const Nominal& root, const Antecedents& antecedents,
                   SceneKnowledge& scene) {
  using Reason = Uninterpretable::Reason;
  Evaluation evaluation{form, antecedents, scene};
  try {
    return judge_assertion(root, form, evaluation) == Truth::no ? Verdict::not_told : Verdict::told;
  } catch (const Uninterpretable& why) {
    if (why.reason == Reason::word)
      return Verdict::not_interpretable;
    // What is not clear is asked about, and not told; nor what nothing that is seen can be meant
    // by.
    const bool is_unclear = why.reason == Reason::ambiguous ||
                            why.reason == Reason::nothing_pointed_at ||
                            why.reason == Reason::nothing_like;
    return is_unclear ? Verdict::not_told : Verdict::told;
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

namespace {

/// "The ball is a candle and the cube is a gift", "the ball and the cube are toys": the parts that
/// are said, or that it is said of; itself if it is no conjunction.
std::vector<const Nominal*> parts_of(const LogicalForm& form, const Nominal& x) {
  const auto* first = x.sort == "conjunction" ? dependent(form, x, "First") : nullptr;
  const auto* next = x.sort == "conjunction" ? dependent(form, x, "Next") : nullptr;
  if (first == nullptr || next == nullptr)
    return {&x};
  if (x.proposition != "and" || is_negated(x))
    return {};
  auto result = parts_of(form, *first);
  for (const auto* part : parts_of(form, *next))
    result.push_back(part);
  return result;
}

const Nominal* subject_of(const LogicalForm& form, const Nominal& clause) {
  return dependent(form, clause, clause.sort == "existence" ? "Subject" : "Cop-Restr");
}

/// What a clause without conjunctions tells of one of those that it is about.
Telling telling_of(const Nominal& clause, const Nominal& thing, const LogicalForm& form) {
  const bool is_existence = clause.sort == "existence";
  if (thing.sort != "thing" || is_negated(thing) || !feature(thing, "Focus").empty() ||
      feature(clause, "Denied") == "true" || (is_existence && is_negated(clause)))
    return Telling::nothing;
  const auto delimitation = feature(thing, "Delimitation");
  if (delimitation == "all" || delimitation == "both" || (is_plural(thing) && is_definite(thing)))
    return is_existence ? Telling::nothing : Telling::of_each;
  const bool is_one = !is_plural(thing) && delimitation != "none" && delimitation != "neither" &&
                      dependent(form, thing, "PartOf") == nullptr;
  return is_one ? Telling::of_one : Telling::nothing;
}

/// Adds the proxies that say of a thing what a clause says of it.
void tell(const Nominal& clause, const Nominal& thing, const LogicalForm& form,
          const MoveReferents& referents, const Vocabulary& vocabulary, Told& told) {
  const auto telling = telling_of(clause, thing, form);
  const auto* said = dependent(form, clause, "Cop-Scope");
  // "Not red and small" may be one of them.
  if (telling == Telling::nothing ||
      (is_negated(clause) && said != nullptr && said->sort == "conjunction"))
    return;
  auto features = features_of(form, thing, vocabulary);
  if (const auto* scope = dependent(form, clause, "Cop-Scope"))
    for (auto& x : features_of(form, *scope, vocabulary))
      add_to(features, is_negated(clause) && x.text != vocabulary.general_concept()
                         ? binding::negation_of(x)
                         : x);
  leave_out_general_kind(features, vocabulary);
  std::vector<std::string> meant;
  // What is said of "this" tells what is meant, unless something was pointed at or spoken of.
  if (!is_deictic(thing) || is_known(referents, thing))
    for (auto& x : referents.referents)
      if (x.nominal == thing.name)
        meant = x.proxies;
  if (telling == Telling::of_one && meant.size() != 1)
    meant.assign(1, {});
  for (auto& proxy : meant) {
    auto& of_it = told.proxies.emplace_back(features);
    if (!proxy.empty())
      add_to(of_it, feature(binding::FeatureKind::existing_proxy_id, proxy));
  }
}

} // namespace

Telling telling_of(const Nominal& root, const LogicalForm& form) {
  std::size_t number = 0;
  auto result = Telling::nothing;
  for (const auto* clause : parts_of(form, root))
    if (const auto* subject = subject_of(form, *clause))
      for (const auto* thing : parts_of(form, *subject))
        if (const auto one = telling_of(*clause, *thing, form); one != Telling::nothing) {
          result = one;
          ++number;
        }
  return number > 1 ? Telling::of_each : result;
}

Told told_by(const DialogueMove& move, const MoveReferents& referents, SceneKnowledge& scene) {
  for (std::size_t reading = 0; reading <= move.alternatives.size(); ++reading) {
    const auto& form = reading == 0 ? move.content : move.alternatives[reading - 1];
    const auto* root = find_nominal(form, form.root);
    if (root == nullptr || name_told(form, scene))
      return {};
    Told result{telling_of(*root, form), {}};
    const auto verdict = verdict_on(form, *root, from_entry(referents.pronouns), scene);
    if (verdict == Verdict::not_interpretable)
      continue;
    if (verdict == Verdict::not_told || result.telling == Telling::nothing)
      return {};
    for (const auto* clause : parts_of(form, *root))
      if (const auto* subject = subject_of(form, *clause))
        for (const auto* thing : parts_of(form, *subject))
          tell(*clause, *thing, form, referents, scene.vocabulary(), result);
    return result;
  }
  return {};
}

} // namespace castor::communication
