#include "castor/communication/dialogue/descriptions.hpp"
#include "castor/communication/dialogue/evaluation.hpp"
#include "castor/communication/dialogue/scoped.hpp"
#include "castor/communication/parsing/hybrid_logic.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace castor::communication {

namespace {

using binding::FeatureKind;

/// "Base-colour" speaks of the colour of the block at the base.
constexpr std::string_view colour_of_base = "base-colour";
constexpr std::string_view colour_of_top = "top-colour";

bool has_group_of(const std::map<std::string, std::size_t>& groups, const NumberRange& range) {
  return std::ranges::any_of(groups, [&range](auto& group) {
    return is_within({group.second, group.second}, range) == Truth::yes;
  });
}

} // namespace

// -- what is said of several things together

/// "Blocks of the same colour", "items of only one colour": not said of each of them.
const Nominal* Evaluation::collective_modifier(const Nominal& phrase) {
  if (phrase.sort != "thing" || bound_.contains(phrase.name))
    return nullptr;
  for (auto& [mode, name] : phrase.relations) {
    const auto* x = find_nominal(form_, name);
    // "One item of every colour": there are several.
    if (x == nullptr ||
        (!is_plural(phrase) && (mode != "Accompaniment" || feature(*x, "Delimitation") != "all")))
      continue;
    if (mode == "Members")
      return x;
    // "That are the same colour".
    if (const auto* scope = dependent(form_, *x, "Cop-Scope");
        mode == "GenRelation" && scope != nullptr && scope->sort == "comparison" &&
        dependent(form_, *scope, "Than") == nullptr &&
        dependent(form_, *x, "Cop-Restr") == find_nominal(form_, phrase.name))
      return scope;
    if (mode == "Property" && x->sort == "comparison" && feature(*x, "Recent").empty() &&
        dependent(form_, *x, "Quality") != nullptr && dependent(form_, *x, "Than") == nullptr)
      return x;
    if (mode == "Accompaniment" && x->sort == "quality" && !is_container_noun(phrase.proposition) &&
        (dependent(form_, *x, "Quantity") != nullptr || feature(*x, "Delimitation") == "all"))
      return x;
  }
  return nullptr;
}

Truth Evaluation::collectively(const Nominal& phrase, const Nominal& modifier,
                               const Property& scope) {
  Things things;
  const auto candidates = described(phrase);
  for (auto& id : candidates.best())
    if (scope(id) == Truth::yes)
      things.push_back(id);
  if (!scene_.open_questions().empty())
    return Truth::unknown;
  const auto* quantity = dependent(form_, phrase, "Quantity");
  auto range = quantity == nullptr ? std::nullopt : number_range(*quantity);
  const bool is_definite_or_all = is_definite(phrase) || feature(phrase, "Delimitation") == "all";
  if (modifier.sort == "ascription")
    return both(is_within({things.size(), things.size()}, range.value_or(NumberRange{1})),
                clause(modifier));
  if (modifier.sort == "quality") {
    const auto number = Count{things.size(), things.size()};
    return both(is_within(number, range.value_or(NumberRange{1})),
                distinct_values(things, modifier));
  }
  auto& quality = need(modifier, "Quality");
  if (dependent(form_, quality, "Location") != nullptr)
    not_understood(quality.proposition);
  std::map<std::string, std::size_t> groups;
  for (auto& id : things) {
    auto value = value_of(id, quality);
    if (!value)
      return Truth::unknown;
    ++groups[*value];
  }
  std::size_t largest = 0;
  for (auto& [value, size] : groups)
    largest = std::max(largest, size);
  if (modifier.proposition == "same") {
    if (is_definite_or_all)
      return truth_of(groups.size() == 1);
    return is_within({largest, largest}, range.value_or(NumberRange{2}));
  }
  if (modifier.proposition != "different")
    not_understood(modifier.proposition);
  return both(is_within({things.size(), things.size()}, range.value_or(NumberRange{2})),
              truth_of(largest == 1));
}

/// "Two balls are the same size", "any of the cubes have different colours", "no two things are the
/// same shape": whether there are some that agree, or differ, in it.
Truth Evaluation::of_some_together(const Nominal& subject, const Nominal& comparison) {
  auto& quality = need(comparison, "Quality");
  const auto candidates = described(subject);
  if (!scene_.open_questions().empty() || candidates.certain != candidates.possible)
    return Truth::unknown;
  std::map<std::string, std::size_t> groups;
  for (auto& id : candidates.certain) {
    const auto value = value_of(id, quality);
    if (!value)
      return Truth::unknown;
    ++groups[*value];
  }
  if (comparison.proposition != "same" && comparison.proposition != "different")
    not_understood(comparison.proposition);
  const bool same = comparison.proposition == "same";
  std::size_t together = same ? 0 : groups.size();
  if (same)
    for (auto& [value, size] : groups)
      together = std::max(together, size);
  const auto delimited = feature(subject, "Delimitation");
  if (delimited == "most" || delimited == "half")
    return !same                 ? Truth::unknown
           : delimited == "most" ? truth_of(2 * together > candidates.certain.size())
                                 : truth_of(2 * together == candidates.certain.size());
  const auto* quantity = dependent(form_, subject, "Quantity");
  const auto range = quantity == nullptr ? std::nullopt : number_range(*quantity);
  const auto least = range ? range->least : std::size_t{2};
  auto result = truth_of(together >= least);
  // "Three balls are the same size" where four are: three are, but not just three.
  if (range && result == Truth::yes && is_within({together, together}, *range) != Truth::yes)
    result = same && !has_group_of(groups, *range) ? Truth::unknown : Truth::yes;
  return delimited == "none" ? negation(result) : result;
}

/// "The balls are larger than all the others": than what is no ball.
Evaluation::Things Evaluation::compared_together(const Nominal& subject) {
  const bool speaks_of_others =
    std::ranges::any_of(form_.nominals, [](auto& x) { return x.proposition == "other"; });
  if (!speaks_of_others || bound_.contains(subject.name) || has_containers())
    return {};
  const bool are_several =
    (subject.sort == "conjunction" && subject.proposition == "and") ||
    (subject.sort == "thing" && is_plural(subject) &&
     (is_definite_phrase(subject) || feature(subject, "Delimitation") == "all"));
  return are_several ? members(subject) : Things{};
}

/// "The same colour or the same size".
bool Evaluation::is_of_comparisons(const Nominal& scope) {
  if (scope.sort != "conjunction")
    return false;
  const auto is_alone = [this](const Nominal& x) {
    return x.sort == "comparison" && dependent(form_, x, "Than") == nullptr;
  };
  return is_alone(need(scope, "First")) && is_alone(need(scope, "Next"));
}

Truth Evaluation::ascription_of_each(const Nominal& e, const Nominal& scopes) {
  const auto with = [&](const char* mode) {
    auto one = e;
    for (auto& x : one.relations)
      if (x.dependent == scopes.name)
        x.dependent = need(scopes, mode).name;
    std::erase_if(one.features, [](auto& x) { return x.name == "Polarity"; });
    return ascription(one);
  };
  const bool is_any = scopes.proposition == "or";
  const auto result =
    is_any ? either(with("First"), with("Next")) : both(with("First"), with("Next"));
  if (scopes.proposition == "nor")
    not_understood("nor");
  return is_negated(e) ? negation(result) : result;
}

/// "The only red things".
bool Evaluation::is_only_plural(const Nominal& phrase) {
  return phrase.sort == "thing" && is_plural(phrase) && is_definite(phrase) &&
         std::ranges::any_of(phrase.relations, [this](auto& relation) {
           const auto* x = find_nominal(form_, relation.dependent);
           return relation.mode == "Property" && x != nullptr && x->proposition == "only";
         });
}

/// "The cubes are the only red things": they are red, and nothing else is.
Truth Evaluation::are_the_only(const Nominal& subject, const Nominal& only) {
  auto like = only;
  std::erase_if(like.relations, [this](auto& relation) {
    const auto* x = find_nominal(form_, relation.dependent);
    return x != nullptr && x->proposition == "only";
  });
  const auto things = members(subject);
  if (!scene_.open_questions().empty())
    return Truth::unknown;
  auto result = Truth::yes;
  for (auto& id : scene_.things()) {
    const auto is_like = fits(id, like);
    const bool is_meant = std::ranges::find(things, id) != things.end();
    result = both(result, is_meant ? is_like : negation(is_like));
  }
  return result;
}

/// "One ball is red and the other is black."
bool Evaluation::is_the_other_of(const Nominal& one, const Nominal& other) {
  return one.sort == "thing" && other.sort == "thing" && !is_plural(one) && !is_plural(other) &&
         !is_definite(one) && is_definite(other) && is_about_others(form_, other) &&
         !has_containers();
}

/// Whether there is one of which the first clause is so, and the second of the only other one.
Truth Evaluation::one_and_the_other(const Nominal& first, const Nominal& next) {
  const auto& subject = need(first, "Cop-Restr");
  const auto& other = need(next, "Cop-Restr");
  const auto things = described(subject);
  if (!scene_.open_questions().empty() || things.certain != things.possible)
    return Truth::unknown;
  if (things.certain.size() != 2)
    throw Uninterpretable{Uninterpretable::Reason::ambiguous, other.name};
  auto result = Truth::no;
  for (const std::size_t i : {0U, 1U}) {
    ScopedBinding binding{bound_, other.name};
    binding.set(things.certain[1 - i]);
    result = either(result, both(is_so_of(first, things.certain[i]), clause(next)));
  }
  return result;
}

/// "Only one colour", "all three colours".
Truth Evaluation::distinct_values(const Things& things, const Nominal& quality) {
  std::set<std::string> values;
  for (auto& id : things)
    if (auto value = value_of(id, quality))
      values.insert(*value);
  const Count number{values.size(), values.size()};
  if (const auto* quantity = dependent(form_, quality, "Quantity")) {
    auto range = number_range(*quantity);
    if (quantity->proposition == "several" || quantity->proposition == "multiple")
      range = NumberRange{2};
    if (!range)
      not_understood(quantity->proposition);
    return is_within(number, *range);
  }
  if (feature(quality, "Delimitation") == "all") {
    std::set<std::string> all;
    for (auto& id : scene_.things())
      if (!is_container(id))
        if (auto value = value_of(id, quality))
          all.insert(*value);
    return truth_of(values == all);
  }
  return is_within(number, {is_plural(quality) ? std::size_t{2} : std::size_t{1}});
}

/// A thing's colour, its number of blocks...
std::optional<std::string> Evaluation::value_of(const std::string& id, const Nominal& quality) {
  auto& name = quality.proposition;
  if (name == "height" || name == "number" || (name == "size" && is_container(id))) {
    const auto* owner = dependent(form_, quality, "Owner");
    std::size_t number = 0;
    for (auto& item : items(id))
      number += owner == nullptr || fits(item, *owner) == Truth::yes ? 1 : 0;
    return is_container(id) ? std::optional{std::to_string(number)} : std::nullopt;
  }
  const bool is_top = name == colour_of_top || name == "top";
  if (is_top || name == colour_of_base || name == "base" || name == "bottom") {
    for (auto& item : items(id))
      if (is_at_end(item, id, is_top) == Truth::yes)
        return value_of(item, {"", "quality", "colour", {}, {}});
    return std::nullopt;
  }
  auto kind = name == "kind" ? FeatureKind::shape : vocabulary().kind_of_quality(name);
  if (!kind)
    not_understood(name);
  auto words = scene_.words(id, *kind);
  if (!words.empty())
    return words.front();
  std::set<std::string> values;
  for (auto& item : items(id))
    for (auto& word : scene_.words(item, *kind))
      values.insert(word);
  return values.size() == 1 ? std::optional{*values.begin()} : std::nullopt;
}

/// "Has that colour", "is larger": as what was spoken of last, or than that.
Truth Evaluation::compares_with_before(const std::string& id, const Nominal& comparison) {
  const auto others = antecedents_of(comparison.name);
  if (!scene_.open_questions().empty())
    return Truth::unknown;
  if (others.size() != 1)
    not_understood(comparison.proposition);
  const auto& word = comparison.proposition;
  const auto& other = others.front();
  const auto* quality = dependent(form_, comparison, "Quality");
  if (quality == nullptr) {
    if (other == id || (word != "larger" && word != "smaller"))
      not_understood(word);
    return word == "larger" ? is_more(id, other, "size", nullptr)
                            : is_more(other, id, "size", nullptr);
  }
  if (word != "same" && word != "different")
    not_understood(word);
  const auto shared = shares(id, other, quality->proposition);
  return word == "same" ? shared : negation(shared);
}

/// "A block over a different coloured block".
Truth Evaluation::differs_from_context(const std::string& id, const Nominal& comparison) {
  auto& quality = need(comparison, "Quality");
  auto shared = shares(id, related_, quality.proposition);
  if (comparison.proposition == "same")
    return shared;
  if (comparison.proposition != "different")
    not_understood(comparison.proposition);
  return negation(shared);
}

} // namespace castor::communication
