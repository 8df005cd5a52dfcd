#include "castor/communication/dialogue/content.hpp"
#include "castor/communication/dialogue/descriptions.hpp"
#include "castor/communication/dialogue/evaluation.hpp"
#include "castor/communication/parsing/hybrid_logic.hpp"

#include <algorithm>

namespace castor::communication {

namespace {

/// Whether a pronoun may stand for a phrase of the same sentence.
bool may_stand_for(const Nominal& pronoun, const Nominal* phrase) {
  return phrase != nullptr && phrase->sort == "thing" && is_definite(*phrase) &&
         !is_pronoun(*phrase) && !is_deictic(pronoun) && is_plural(*phrase) == is_plural(pronoun);
}

} // namespace

// -- what was spoken of before

Evaluation::Things Evaluation::antecedents_of(const std::string& name) {
  Things result;
  auto known = antecedents_.find(name);
  if (known == antecedents_.end())
    return result;
  for (auto& id : scene_.individuals())
    for (auto& proxy : known->second)
      if (scene_.has(id, binding::feature(binding::FeatureKind::existing_proxy_id, proxy)) ==
          Truth::yes) {
        result.push_back(id);
        break;
      }
  return result;
}

/// What "it", "they" and "all three" stand for. As many things as the pronoun says, else it is not
/// clear which.
Fitting Evaluation::members_of_pronoun(const Nominal& phrase) {
  // "The ball, what colour is it?"
  const auto* root = find_nominal(form_, form_.root);
  const auto* topic = root == nullptr ? nullptr : dependent(form_, *root, "Topic");
  if (topic != nullptr && topic->name != phrase.name)
    return members_of(*topic);
  if (const auto* earlier = earlier_phrase(phrase))
    return members_of(*earlier);
  if (const auto handled = handled_before(phrase); !handled.possible.empty())
    return handled;
  if (!within_.empty() && is_plural(phrase)) {
    const auto inside = items(within_);
    return {inside, inside};
  }
  const auto result = antecedents_of(phrase.name);
  if (!result.empty() || !scene_.open_questions().empty())
    return {result, result};
  const Fitting all{scene_.things(), scene_.things()};
  // "All three" are all that there are, if there are three.
  const auto* quantity = dependent(form_, phrase, "Quantity");
  const auto range = quantity == nullptr ? std::nullopt : number_range(*quantity);
  if (range && is_within(all.count(), *range) == Truth::yes)
    return all;
  // Something that is shown is the only thing there is, if it is not pointed at.
  if (!is_plural(phrase) && is_deictic(phrase) && all.certain.size() == 1)
    return all;
  // "Which one is larger?" and "how many of these are red?" are about all there is, if nothing was
  // spoken of.
  if (!range && (feature(phrase, "Recent") == "true" ||
                 (phrase.proposition == "these" && is_whole(form_, phrase)) ||
                 antecedents_.contains(phrase.name + std::string{first_spoken_of})))
    return all;
  throw Uninterpretable{Uninterpretable::Reason::ambiguous, phrase.name};
}

/// What was spoken of before, if "that thing" or "this red one" is said of it; else nothing.
Evaluation::Things Evaluation::pointed_out_before(const Nominal& phrase) {
  if (!is_anaphoric(phrase, vocabulary()))
    return {};
  const auto* root = find_nominal(form_, form_.root);
  const auto* topic = root == nullptr ? nullptr : dependent(form_, *root, "Topic");
  auto result =
    topic != nullptr && topic->name != phrase.name ? meant(*topic) : antecedents_of(phrase.name);
  std::erase_if(result, [&](auto& id) { return fits(id, phrase) == Truth::no; });
  return result;
}

/// The first definite phrase before a pronoun in the same sentence: "is the ball large, and is it
/// red?", "what is that, is it red?" Null if there is none.
const Nominal* Evaluation::earlier_phrase(const Nominal& pronoun) {
  const auto* root = find_nominal(form_, form_.root);
  if (root == nullptr)
    return nullptr;
  const auto* first = dependent(form_, *root, root->sort == "conjunction" ? "First" : "Preface");
  if (first == nullptr)
    return root->sort == "action" ? phrase_in_request(pronoun) : phrase_in_predicate(pronoun);
  for (const auto* mode : {"Cop-Restr", "Cop-Scope"}) {
    const auto* x = dependent(form_, *first, mode);
    if (x != nullptr && x->sort == "thing" && is_definite(*x) && !is_pronoun(*x) &&
        is_plural(*x) == is_plural(pronoun) && x->name != pronoun.name)
      return x;
  }
  return nullptr;
}

/// "Swap the cube with the thing that is nearest to it": the cube. Null if the pronoun describes no
/// other thing.
const Nominal* Evaluation::patient_described_by(const Nominal& pronoun) {
  const auto* root = find_nominal(form_, form_.root);
  const auto* patient = dependent(form_, *root, "Patient");
  const auto* others = patient != nullptr && patient->sort == "conjunction" ? patient : nullptr;
  if (others != nullptr)
    patient = dependent(form_, *others, "First");
  if (!may_stand_for(pronoun, patient))
    return nullptr;
  const auto* destination = dependent(form_, *root, "Destination");
  const auto* other = others != nullptr        ? dependent(form_, *others, "Next")
                      : destination == nullptr ? dependent(form_, *root, "Counterpart")
                                               : dependent(form_, *destination, "Anchor");
  if (other == nullptr || other->sort != "thing" || is_pronoun(*other))
    return nullptr;
  return find_nominal(part_of(form_, other->name), pronoun.name) == nullptr ? nullptr : patient;
}

/// "If the cube is larger than the ball, put the ball on it", "swap the cube with the thing that is
/// nearest to it": the cube. Null if there is no such phrase.
const Nominal* Evaluation::phrase_in_request(const Nominal& pronoun) {
  if (const auto* patient = patient_described_by(pronoun))
    return patient;
  const auto* root = find_nominal(form_, form_.root);
  const auto* condition = dependent(form_, *root, "Condition");
  const auto* subject = condition == nullptr ? nullptr : dependent(form_, *condition, "Cop-Restr");
  const bool is_outside =
    condition != nullptr && find_nominal(part_of(form_, condition->name), pronoun.name) == nullptr;
  return is_outside && may_stand_for(pronoun, subject) ? subject : nullptr;
}

/// "Put the cube on the box, and the ball beside them": the cube and the box. Nothing if no several
/// things are handled before.
Fitting Evaluation::handled_before(const Nominal& pronoun) {
  const auto* root = find_nominal(form_, form_.root);
  const auto* first =
    root != nullptr && root->sort == "conjunction" ? dependent(form_, *root, "First") : nullptr;
  if (first == nullptr || first->sort != "action" || !is_plural(pronoun) || is_deictic(pronoun))
    return {};
  const auto said = part_of(form_, first->name);
  if (find_nominal(said, pronoun.name) != nullptr)
    return {};
  Fitting result;
  std::size_t phrases = 0;
  for (const auto& x : said.nominals) {
    if (x.sort != "thing" || !is_definite(x) || is_pronoun(x) ||
        vocabulary().surroundings(x) != nullptr)
      continue;
    auto members = members_of(*find_nominal(form_, x.name));
    // "Put the cubes on the box, and the ball beside them": the cubes.
    if (is_plural(x))
      return members;
    ++phrases;
    for (const auto& id : members.possible)
      if (result.contains(id) == Truth::no)
        result.add(id, members.contains(id));
  }
  return phrases > 1 ? result : Fitting{};
}

/// "Is the ball behind the disc or in front of it?": the disc. Null if there is none.
const Nominal* Evaluation::phrase_in_predicate(const Nominal& pronoun) {
  const auto* root = find_nominal(form_, form_.root);
  const auto* scope = dependent(form_, *root, "Cop-Scope");
  if (scope == nullptr || is_deictic(pronoun))
    return nullptr;
  const auto said = part_of(form_, scope->name);
  if (find_nominal(said, pronoun.name) == nullptr)
    return nullptr;
  const Nominal* result = nullptr;
  for (auto& x : said.nominals)
    if (x.sort == "thing" && is_definite(x) && !is_pronoun(x) &&
        vocabulary().surroundings(x) == nullptr && is_plural(x) == is_plural(pronoun) &&
        place_of_word(x) < place_of_word(pronoun) &&
        (result == nullptr || place_of_word(*result) < place_of_word(x)))
      result = find_nominal(form_, x.name);
  return result;
}

} // namespace castor::communication
