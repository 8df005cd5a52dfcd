#include "castor/communication/dialogue/content.hpp"
#include "castor/communication/dialogue/descriptions.hpp"
#include "castor/communication/dialogue/evaluation.hpp"
#include "castor/communication/dialogue/stacks.hpp"
#include "castor/communication/parsing/hybrid_logic.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace castor::communication {

bool Evaluation::has_pronoun(const Nominal& phrase) const {
  return std::ranges::any_of(part_of(form_, phrase.name).nominals, is_pronoun);
}

void Evaluation::check_presuppositions() {
  if (has_containers()) {
    // What is spoken of may be in whatever container is spoken of. What "two" are of is not clear.
    for (auto& x : form_.nominals)
      if (feature(x, "Elided") == "true")
        not_understood(x.proposition);
    return;
  }
  // "It is a ball, and the green one is not" says nothing of a ball that the green one is not.
  for (auto& x : form_.nominals)
    if (const auto* relative = dependent(form_, x, "GenRelation");
        relative != nullptr && is_negated(*relative) &&
        dependent(form_, *relative, "Cop-Scope") == &x)
      not_understood("not");
  const auto& root = *find_nominal(form_, form_.root);
  const auto topic_of = [&](const char* mode) {
    const auto* part = root.sort == "conjunction" ? dependent(form_, root, mode) : nullptr;
    return part == nullptr ? nullptr : dependent(form_, *part, "Cop-Restr");
  };
  const auto* one = topic_of("First");
  const auto* other = topic_of("Next");
  // Which is the other one depends on the one.
  const bool is_other = one != nullptr && other != nullptr && is_the_other_of(*one, *other);
  std::vector<std::pair<const Nominal*, Fitting>> phrases;
  // What the sentence is about comes first.
  std::vector<std::string> names;
  for (const auto* x : things_spoken_of(form_, vocabulary()))
    names.push_back(x->name);
  for (auto& x : part_of(form_, form_.root).nominals)
    if (std::ranges::find(names, x.name) == names.end())
      names.push_back(x.name);
  for (auto& name : names) {
    const auto& x = *find_nominal(form_, name);
    const auto delimited = feature(x, "Delimitation");
    const bool is_universal = delimited == "all" || delimited == "most";
    // What a pronoun stands for may be bound by what surrounds it; of "all of the balls", the balls
    // are definite.
    if (x.sort != "thing" || vocabulary().surroundings(x) != nullptr || has_pronoun(x) ||
        is_stack(x) || (is_other && &x == other) || is_only_plural(x) ||
        is_other_than_subject(root, x) ||
        (!is_definite_phrase(x) && (!is_universal || dependent(form_, x, "PartOf") != nullptr)))
      continue;
    phrases.emplace_back(&x, presupposed(x));
  }
  check_consistency(phrases);
}

/// "The tower", where some things stand on each other.
bool Evaluation::is_stack(const Nominal& x) {
  return is_tower(x) && !has_containers() && !only_stack(scene_).empty();
}

/// "Is one of the balls larger than the other?": which the other is depends on the one.
bool Evaluation::is_other_than_subject(const Nominal& clause, const Nominal& x) const {
  const auto* subject = dependent(form_, clause, "Cop-Restr");
  const auto* scope = dependent(form_, clause, "Cop-Scope");
  return subject != nullptr && scope != nullptr && scope->sort == "comparison" &&
         subject->sort == "thing" && !is_plural(x) &&
         (!is_definite_phrase(*subject) || !antecedents_.contains(x.name)) && is_definite(x) &&
         is_about_others(form_, x) && dependent(form_, *scope, "Than") == &x;
}

/// What is like the phrase, of which there is what it takes for granted.
Fitting Evaluation::presupposed(const Nominal& x) {
  if (is_definite_phrase(x))
    meant(x);
  auto found = described(x);
  if (found.possible.empty() && !is_definite_phrase(x) && scene_.open_questions().empty())
    throw Uninterpretable{Uninterpretable::Reason::nothing_like, x.name};
  return found;
}

/// Something that is not known well enough may be taken for the ball or for the cube, not for both;
/// and if it is taken for the red ball, there is another ball than the one that is known.
void Evaluation::check_consistency(
  const std::vector<std::pair<const Nominal*, Fitting>>& phrases) const {
  using Reason = Uninterpretable::Reason;
  for (auto& [phrase, found] : phrases)
    for (auto& [other, others] : phrases) {
      if (phrase == other || !found.certain.empty() || found.possible.size() != 1)
        continue;
      const auto& id = found.possible.front();
      if (std::ranges::find(others.possible, id) == others.possible.end())
        continue;
      if (others.certain.empty() && exclude_each_other(*phrase, *other))
        throw Uninterpretable{Reason::nothing_like, other->name};
      if (!others.certain.empty() && is_definite(*other) && !is_plural(*other) &&
          std::ranges::find(others.certain, id) == others.certain.end())
        throw Uninterpretable{Reason::unknown, other->name};
    }
}

bool Evaluation::exclude_each_other(const Nominal& a, const Nominal& b) const {
  auto shape = vocabulary().shape_of(a.proposition);
  auto other_shape = vocabulary().shape_of(b.proposition);
  if (shape && other_shape && *shape != *other_shape)
    return true;
  for (const auto* mode : {"Colour", "Size", "Shape"}) {
    const auto* one = dependent(form_, a, mode);
    const auto* other = dependent(form_, b, mode);
    if (one != nullptr && other != nullptr && one->proposition != other->proposition)
      return true;
  }
  return false;
}

} // namespace castor::communication
