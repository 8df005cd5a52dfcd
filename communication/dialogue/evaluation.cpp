#include "castor/communication/dialogue/evaluation.hpp"

#include "castor/communication/dialogue/content.hpp"
#include "castor/communication/dialogue/descriptions.hpp"
#include "castor/communication/dialogue/scoped.hpp"
#include "castor/communication/parsing/hybrid_logic.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace castor::communication {

std::optional<NumberRange> number_range(const Nominal& quantity) {
  const auto word = number_of_word(quantity.proposition);
  if (!word)
    return std::nullopt;
  const auto number = *word;
  const auto bound = feature(quantity, "Bound");
  NumberRange range{number, number};
  if (bound == "at_least" || bound == "more_than")
    range = {bound == "at_least" ? number : number + 1};
  else if (bound == "at_most")
    range = {0, number};
  else if (bound == "fewer_than") {
    // Nothing is fewer than none.
    range = number == 0 ? NumberRange{1, 0} : NumberRange{0, number - 1};
  }
  return range;
}

void Evaluation::not_understood(const std::string& word) {
  throw Uninterpretable{Uninterpretable::Reason::word, word};
}

/// "Two balls", "any of the cubes", "no two things".
bool Evaluation::is_of_any_number(const Nominal& subject) {
  const auto delimited = feature(subject, "Delimitation");
  return subject.sort == "thing" && is_plural(subject) && !is_definite_phrase(subject) &&
         delimited != "all" && !bound_.contains(subject.name) && !has_containers();
}

/// "Does anything else have that colour?", "is any ball the same colour?", as what was spoken of.
bool Evaluation::is_as_before(const Nominal& subject, const Nominal& comparison) {
  if (feature(comparison, "Recent") == "true" || dependent(form_, comparison, "Quality") == nullptr)
    return true;
  const auto delimited = feature(subject, "Delimitation");
  return subject.sort == "thing" && !is_plural(subject) && !is_definite_phrase(subject) &&
         delimited != "all" && !bound_.contains(subject.name) && !has_containers();
}

const Nominal& Evaluation::need(const Nominal& of, const char* mode) {
  const auto* result = dependent(form_, of, mode);
  if (result == nullptr)
    not_understood(of.proposition);
  return *result;
}

// -- clauses

Truth Evaluation::clause(const Nominal& e) {
  if (const auto* setting = dependent(form_, e, "Setting"); setting != nullptr && within_.empty()) {
    if (!is_container_noun(setting->proposition) && dependent(form_, *setting, "PartOf") == nullptr)
      not_understood(setting->proposition);
    return quantified(*setting, [&](const std::string& id) {
      ScopedValue within{within_, id};
      return clause(e);
    });
  }
  auto result = affirmed_clause(e);
  return feature(e, "Denied") == "true" ? negation(result) : result;
}

Truth Evaluation::affirmed_clause(const Nominal& e) {
  for (const auto* apart : {"Extraposed", "Alternatives", "Afterthought"})
    if (const auto* x = dependent(form_, e, apart))
      not_understood(x->proposition);
  if (const auto* excepted = dependent(form_, e, "Except");
      excepted != nullptr && dependent(form_, e, "Wh-Restr") == nullptr)
    not_understood(excepted->proposition);
  if (e.sort == "conjunction") {
    if (e.proposition == "and")
      return discourse(need(e, "First"), need(e, "Next"));
    auto first = clause(need(e, "First"));
    auto next = clause(need(e, "Next"));
    return e.proposition == "or" ? either(first, next) : both(first, next);
  }
  if (e.sort == "ascription")
    return ascription(e);
  const bool is_perception = e.sort == "perception" && e.proposition == "see";
  if (e.sort != "existence" && !is_perception)
    not_understood(e.proposition);
  auto result = existence(need(e, is_perception ? "Patient" : "Subject"));
  if (const auto* place = dependent(form_, e, "Location"); place != nullptr && !is_perception)
    not_understood(place->proposition);
  return is_negated(e) ? negation(result) : result;
}

Truth Evaluation::ascription(const Nominal& e) {
  auto& subject = need(e, "Cop-Restr");
  auto& scope = need(e, "Cop-Scope");
  const bool negated = is_negated(e);
  if (is_of_comparisons(scope))
    return ascription_of_each(e, scope);
  if (is_only_plural(scope)) {
    const auto result = are_the_only(subject, scope);
    return negated ? negation(result) : result;
  }
  if (subject.sort == "quality") {
    // "Only one colour touches the wall."
    auto result = dependent(form_, subject, "Quantity") != nullptr && has_containers()
                    ? there_are(subject, [&](const std::string& id) { return is(id, scope); })
                    : about_qualities(subject, scope);
    return negated ? negation(result) : result;
  }
  if (scope.sort == "comparison" && dependent(form_, scope, "Than") == nullptr &&
      !is_as_before(subject, scope)) {
    // "Two towers are the same height": of however many there are.
    const bool is_of_some = subject.sort == "thing" && !is_definite(subject) && has_containers() &&
                            dependent(form_, subject, "Quantity") != nullptr;
    auto result = is_of_some ? collectively(subject, scope, [](auto&) { return Truth::yes; })
                  : is_of_any_number(subject) ? of_some_together(subject, scope)
                                              : collectively(subject, scope);
    return negated ? negation(result) : result;
  }
  if (scope.sort == "region" && scope.proposition == "near-each-other") {
    auto result = are_near_each_other(subject);
    return negated ? negation(result) : result;
  }
  // "Two blocks are stacked on each other."
  if (scope.sort == "region" && is_mutual(scope)) {
    auto result = quantified(subject, [&](const std::string& id) {
      return is_with_the_others(id, subject, scope).value_or(Truth::unknown);
    });
    return negated ? negation(result) : result;
  }
  if (auto together = are_in_one(subject, scope))
    return negated ? negation(*together) : *together;
  ScopedValue group{related_group_, compared_together(subject)};
  return quantified(
    subject,
    [&](const std::string& id) {
      auto result = is_so_of(e, id);
      return negated ? denial(id, scope, result, &subject) : result;
    },
    landmarks_of(scope));
}

Truth Evaluation::is_so_of(const Nominal& ascription, const std::string& id) {
  auto& scope = need(ascription, "Cop-Scope");
  if (ascription.proposition == "have")
    return has(id, scope);
  auto& subject = need(ascription, "Cop-Restr");
  // "Is the ball larger?", than what?
  if (feature(scope, "Of") == "before" && is_definite_phrase(subject) && scene_.things().size() > 2)
    not_understood(scope.proposition == "largest" ? "larger" : "smaller");
  // "The black ball is the larger": of the balls.
  if (feature(scope, "Of") == "two" && subject.sort == "thing" && is_definite(subject) &&
      !is_pronoun(subject)) {
    const Nominal kind{subject.name + "-kind", subject.sort, subject.proposition, {}, {}};
    return is(id, scope, &kind);
  }
  // "Which grey thing is the largest one?": of the grey things.
  const auto* selection = dependent(form_, scope, "Selection");
  if (scope.proposition == "one" && selection != nullptr && scope.relations.size() == 1 &&
      subject.sort == "thing" && !is_definite(subject) && !is_negated(scope))
    return is(id, *selection, &subject);
  // "The ball is the largest": of all things. "The ball that is the largest": of the balls.
  const bool is_among_all = scope.sort == "selection" && is_definite(subject) &&
                            !is_plural(subject) && !bound_.contains(subject.name);
  return is(id, scope, is_among_all ? nullptr : &subject);
}

/// "The cube has a ball beside it", "the ball has a different colour".
Truth Evaluation::has(const std::string& id, const Nominal& scope) {
  if (scope.sort == "comparison")
    return compares(id, scope);
  // "A ball in front of it and a cube behind it".
  if (scope.sort == "conjunction" && !is_container(id)) {
    const auto& last = need(scope, "Next");
    // "The ball or the cube behind it": both behind it.
    auto same_place = need(scope, "First");
    if (dependent(form_, same_place, "Location") == nullptr)
      std::ranges::copy_if(last.relations, std::back_inserter(same_place.relations),
                           [](auto& relation) { return relation.mode == "Location"; });
    const auto first = has(id, same_place);
    const auto next = has(id, last);
    if (scope.proposition == "nor")
      return both(negation(first), negation(next));
    return scope.proposition == "or" ? either(first, next) : both(first, next);
  }
  // What "it" is in "a ball beside it".
  for (auto& [mode, name] : scope.relations) {
    const auto* region = find_nominal(form_, name);
    const auto* anchor = region == nullptr ? nullptr : dependent(form_, *region, "Anchor");
    if (mode == "Location" && anchor != nullptr && is_pronoun(*anchor)) {
      ScopedBinding binding{bound_, anchor->name};
      binding.set(id);
      // "The ball beside it": of other things than this one there is none.
      return is_definite(scope) ? is_within(described(scope).count(), {1}) : existence(scope);
    }
  }
  if (!is_container(id))
    not_understood("have");
  return contains(id, scope);
}

Truth Evaluation::are_near_each_other(const Nominal& subject) {
  auto things = members(subject);
  auto result = truth_of(things.size() > 1);
  for (auto& a : things)
    for (auto& b : things)
      if (a != b)
        result = both(result, scene_.is_related("near", a, b));
  return result;
}

Evaluation::Things Evaluation::members(const Nominal& subject) {
  Things things;
  if (auto known = bound_.find(subject.name); known != bound_.end())
    things.push_back(known->second);
  else if (subject.sort == "conjunction") {
    for (const auto* mode : {"First", "Next"})
      for (auto& id : members(need(subject, mode)))
        things.push_back(id);
  } else if (is_definite_phrase(subject))
    things = meant(subject);
  else
    things = described(subject).best();
  return things;
}

/// "The colour of the ball is red", "the number of balls is greater than the number of cubes".
Truth Evaluation::about_qualities(const Nominal& subject, const Nominal& scope) {
  auto& owner = need(subject, "Owner");
  if (scope.sort == "region")
    not_understood(scope.proposition);
  if (subject.proposition != "number")
    return quantified(owner, [&](const std::string& id) { return is(id, scope); });
  if (const auto range = scope.sort == "number" ? number_range(scope) : std::nullopt)
    return is_within(described(owner).count(), *range);
  const auto* other = dependent(form_, scope, "Than");
  if (scope.sort != "comparison" || other == nullptr || other->sort != "quality")
    not_understood(scope.proposition);
  auto a = described(owner).count();
  auto b = described(need(*other, "Owner")).count();
  return compared(scope.proposition, a, b);
}

Truth Evaluation::existence(const Nominal& subject) {
  if (const auto* quantity = dependent(form_, subject, "Quantity");
      quantity != nullptr && quantity->sort == "comparison")
    return compared_counts(subject, *quantity);
  if (subject.sort == "conjunction") {
    // "A tower with a black block and two blue blocks": it has all of them.
    auto& one = need(subject, "First");
    auto& other = need(subject, "Next");
    if (const auto* region = dependent(form_, other, "Location"))
      if (const auto* whole = dependent(form_, *region, "Anchor");
          whole != nullptr &&
          (feature(*whole, "Delimitation") == "same" ||
           (within_.empty() && is_container_phrase(*whole) && !is_definite(*whole)))) {
        const ScopedElement place{modifiers_, other.name + ' ' + region->name};
        auto all = subject;
        all.relations.push_back({"Location", region->name});
        return in_each(all, *region, *whole);
      }
    if (dependent(form_, one, "Accompaniment") != nullptr && is_container_noun(one.proposition) &&
        !is_container_noun(other.proposition) && subject.proposition == "and")
      return there_are(one, [&](const std::string& id) { return contains(id, other); });
    if (auto related = one_and_its_own(one, other); related && subject.proposition == "and")
      return *related;
    // "Two cubes, one large and one small" are no four things.
    for (auto& x : part_of(form_, other.name).nominals)
      if (feature(x, "Apposed") == "true" && !has_containers())
        not_understood(x.proposition);
    auto first = existence(one);
    auto next = existence(other);
    if (subject.proposition == "nor")
      return both(negation(first), negation(next));
    return subject.proposition == "or" ? either(first, next) : both(first, next);
  }
  return there_are(subject, [](auto&) { return Truth::yes; });
}

/// The "it" in a phrase that stands for nothing said before; null if there is none.
const Nominal* Evaluation::pronoun_in(const Nominal& phrase) {
  for (auto& x : part_of(form_, phrase.name).nominals)
    if (x.proposition == "it" && is_pronoun(x) && !bound_.contains(x.name) &&
        antecedents_of(x.name).empty())
      return find_nominal(form_, x.name);
  return nullptr;
}

/// "A box and a ball on it": "it" is the box. Nothing for "a ball and a cube in it".
std::optional<Truth> Evaluation::one_and_its_own(const Nominal& one, const Nominal& other) {
  const auto* pronoun = pronoun_in(other);
  if (one.sort != "thing" || is_plural(one) || pronoun == nullptr)
    return std::nullopt;
  const auto* region = dependent(form_, other, "Location");
  if (region != nullptr && region->proposition == "in" && !is_container_phrase(one))
    return std::nullopt;
  return there_are(one, [&](const std::string& id) {
    ScopedBinding binding{bound_, pronoun->name};
    binding.set(id);
    return existence(other);
  });
}

/// Whether one number is greater than another, or what else the word says.
Truth Evaluation::compared(const std::string& word, const Count& a, const Count& b) {
  if (word == "greater" || word == "more")
    return is_greater(a, b);
  if (word == "smaller" || word == "fewer")
    return is_greater(b, a);
  if (word != "same")
    not_understood(word);
  return both(negation(is_greater(a, b)), negation(is_greater(b, a)));
}

/// "More cubes than balls", "an equal number of cubes and balls".
Truth Evaluation::compared_counts(const Nominal& subject, const Nominal& quantity) {
  const auto* other = dependent(form_, quantity, "Than");
  const auto* one = &subject;
  if (other == nullptr && subject.sort == "conjunction") {
    one = &need(subject, "First");
    other = &need(subject, "Next");
  }
  // "An equal number of blue and yellow items".
  if (const auto* property = dependent(form_, subject, "Property");
      other == nullptr && property != nullptr && property->sort == "conjunction") {
    auto with = [&](const char* mode) {
      auto result = subject;
      for (auto& x : result.relations)
        if (x.mode == "Property")
          x.dependent = need(*property, mode).name;
      return described(result).count();
    };
    auto a = with("First");
    auto b = with("Next");
    if (quantity.proposition != "same")
      not_understood(quantity.proposition);
    return truth_of(a.certain == b.certain);
  }
  if (other == nullptr)
    not_understood(quantity.proposition);
  const auto things = described(*one);
  if (is_about_others(form_, *other)) {
    // "More balls than anything else" may be meant of each other kind.
    if (!is_plural(*other) || things.possible.empty())
      not_understood("other");
    // "As many red balls as other balls": as balls that are not red.
    ScopedValue group{related_group_, things.possible};
    ScopedValue related{related_, things.possible.front()};
    return compared(quantity.proposition, things.count(), described(*other).count());
  }
  return compared(quantity.proposition, things.count(), described(*other).count());
}

/// "The ball and the cube are the same colour", "all cubes have different colours".
Truth Evaluation::collectively(const Nominal& subject, const Nominal& comparison) {
  auto& quality = need(comparison, "Quality");
  if (const auto* with = dependent(form_, quality, "Accompaniment"))
    not_understood(with->proposition);
  auto things = members(subject);
  const bool same = comparison.proposition == "same";
  if (!same && comparison.proposition != "different")
    not_understood(comparison.proposition);
  auto result = Truth::yes;
  // "Which things have the same colour?": each that has the colour of another one.
  if (bound_.contains(subject.name) && !is_container(things.front())) {
    if (!same)
      not_understood(comparison.proposition);
    result = Truth::no;
    for (auto& other : scene_.things())
      if (other != things.front())
        result = either(
          result, both(fits(other, subject), shares(things.front(), other, quality.proposition)));
    return result;
  }
  // "Is the ball the same colour?", as what was spoken of.
  if (things.size() == 1 && subject.sort == "thing" && !is_plural(subject)) {
    const auto others = antecedents_of(comparison.name);
    if (others.size() != 1 || others.front() == things.front())
      not_understood(comparison.proposition);
    const auto shared = shares(things.front(), others.front(), quality.proposition);
    return same ? shared : negation(shared);
  }
  for (std::size_t i = 0; i < things.size(); ++i)
    for (std::size_t k = i + 1; k < things.size(); ++k) {
      auto shared = Truth::unknown;
      if (is_container(things[i]) && is_container(things[k])) {
        auto a = value_of(things[i], quality);
        auto b = value_of(things[k], quality);
        shared = a && b ? truth_of(*a == *b) : Truth::no;
      } else
        shared = shares(things[i], things[k], quality.proposition);
      result = both(result, same ? shared : negation(shared));
    }
  return result;
}

} // namespace castor::communication
