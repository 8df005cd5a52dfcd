#include "castor/communication/dialogue/descriptions.hpp"
#include "castor/communication/dialogue/evaluation.hpp"
#include "castor/communication/dialogue/scoped.hpp"
#include "castor/communication/parsing/hybrid_logic.hpp"

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace castor::communication {

namespace {

using binding::FeatureKind;

} // namespace

// -- containers and what is in them

/// What is in a container and contains nothing itself: a box has blocks rather than towers.
Evaluation::Things Evaluation::items(const std::string& container) {
  Things result;
  for (auto& id : scene_.contents(container))
    if (!is_container(id))
      result.push_back(id);
  return result;
}

bool Evaluation::has_containers() {
  return std::ranges::any_of(scene_.things(), [this](auto& id) { return is_container(id); });
}

bool Evaluation::is_container_noun(const std::string& noun) {
  return std::ranges::any_of(scene_.things(), [&](auto& id) {
    return is_container(id) && scene_.has(id, named(noun)) == Truth::yes;
  });
}

binding::Feature Evaluation::named(const std::string& noun) const {
  return binding::feature(FeatureKind::concept_name, vocabulary().concept_of(noun));
}

/// "A box", "one of the towers".
bool Evaluation::is_container_phrase(const Nominal& phrase) {
  const auto* group = dependent(form_, phrase, "PartOf");
  return phrase.sort == "thing" &&
         is_container_noun((group == nullptr ? phrase : *group).proposition);
}

/// Other than what the phrase may mean while a container is spoken about.
bool Evaluation::is_outside(const std::string& id, const Nominal& phrase) {
  if (within_.empty() || bound_.contains(phrase.name) || is_container_noun(phrase.proposition))
    return false;
  return is_container(id) ||
         scene_.is_related(binding::containment_label, id, within_) != Truth::yes;
}

/// Nouns with several senses mean what there is: where things contain others, a box is one of
/// those and no cube, "item" is what they contain, and so is "block" if nothing is called that. A
/// container is called by its shape only together with its colour: "grey square".
std::optional<Truth> Evaluation::is_named_by_sense(const std::string& id, const Nominal& phrase) {
  auto& noun = phrase.proposition;
  if (!has_containers())
    return std::nullopt;
  // Where there are rooms, containers are in something, too.
  if (vocabulary().is_content(noun) && !scene_.has_places())
    return truth_of(!is_container(id));
  if (vocabulary().is_general(noun))
    return std::nullopt;
  if (is_container_noun(noun))
    return scene_.has(id, named(noun));
  auto shape = vocabulary().shape_of(noun);
  // A "grey square" may be a box.
  if (is_container(id) && shape &&
      (*shape != "square" || dependent(form_, phrase, "Colour") == nullptr))
    return Truth::no;
  if (shape == "cube") {
    // Pictures are flat: cubes look like squares, or like anything that is stacked.
    const bool is_known = std::ranges::any_of(scene_.things(), [&](auto& other) {
      return scene_.has(other, named(noun)) == Truth::yes ||
             scene_.has(other, binding::feature(FeatureKind::shape, *shape)) == Truth::yes;
    });
    if (!is_known)
      return truth_of(!is_container(id));
  }
  return std::nullopt;
}

/// Of existence and possession: "only two" are no more than two, whatever else there is.
Truth Evaluation::there_are(const Nominal& subject, const Property& scope) {
  for (auto& [mode, name] : subject.relations) {
    const auto* region = mode == "Location" ? find_nominal(form_, name) : nullptr;
    const auto* whole = region == nullptr ? nullptr : dependent(form_, *region, "Anchor");
    // "Two blue squares in a box" are in one box.
    if (whole != nullptr && within_.empty() && is_container_phrase(*whole) &&
        (is_in_each(*whole) || (region->proposition == "in" && is_plural(subject) &&
                                feature(*whole, "Delimitation") == "existential")))
      return in_each(subject, *region, *whole);
  }
  if (subject.sort == "quality") {
    Things things;
    for (auto& id : scene_.things()) {
      auto truth = is_container(id) || is_outside(id, subject) ? Truth::no : scope(id);
      for (auto& [mode, name] : subject.relations)
        if (const auto* x = find_nominal(form_, name);
            x != nullptr && x->sort != "number" && x->proposition != "different")
          truth = both(truth, modified(id, subject, mode, *x));
      if (truth == Truth::yes)
        things.push_back(id);
    }
    return distinct_values(things, subject);
  }
  const bool is_only_so_many =
    feature(subject, "Focus") == "only" && dependent(form_, subject, "Quantity") != nullptr;
  return is_only_so_many ? unfocused(subject, scope) : quantified(subject, scope);
}

Truth Evaluation::contains(const std::string& container, const Nominal& what) {
  if (what.sort == "conjunction" && feature(what, "Focus") != "only")
    return contains_both(container, what);
  if (what.sort == "place")
    return has_end(container, what);
  const auto* quantity = dependent(form_, what, "Quantity");
  const auto* than = quantity == nullptr || quantity->sort != "comparison"
                       ? nullptr
                       : dependent(form_, *quantity, "Than");
  // "More items than the second box."
  if (than != nullptr && is_container_phrase(*than)) {
    const auto number = number_inside(container, what);
    return quantified(*than, [&](const std::string& other) {
      return compared(quantity->proposition, number, number_inside(other, what));
    });
  }
  ScopedValue within{within_, container};
  if (quantity != nullptr && quantity->sort == "comparison")
    return compared_counts(what, *quantity);
  auto result = has_some_of_each(what);
  if (what.sort == "thing" && feature(what, "Delimitation") == "all" &&
      dependent(form_, what, "Quantity") == nullptr && !items(container).empty() &&
      collective_modifier(what) == nullptr)
    // "A tower with all yellow blocks."
    for (auto& id : items(container))
      result = both(result, fits(id, what));
  else
    result = both(result, there_are(what, [&](const std::string& id) {
                    return scene_.is_related(binding::containment_label, id, container);
                  }));
  // "Only one block, which is blue": there is no other block either.
  if (feature(what, "Focus") == "only" && dependent(form_, what, "Quantity") != nullptr) {
    auto alone = what;
    std::erase_if(alone.relations, [&](auto& x) {
      return x.mode == "GenRelation" || (x.mode == "Property" && is_after_noun(what, x.dependent));
    });
    if (alone.relations.size() < what.relations.size())
      result = both(result, there_are(alone, [](auto&) { return Truth::yes; }));
  }
  return result;
}

/// "A circle and a square", "a ball and a cube in it", "a circle or a square".
Truth Evaluation::contains_both(const std::string& container, const Nominal& both_of) {
  auto first = need(both_of, "First");
  auto next = need(both_of, "Next");
  // What is said of both is said of each.
  for (auto& x : both_of.relations)
    if (x.mode != "First" && x.mode != "Next")
      for (auto* one : {&first, &next})
        one->relations.push_back(x);
  if (const auto* it = pronoun_in(next); it != nullptr && both_of.proposition == "and") {
    ScopedValue within{within_, container};
    if (auto related = one_and_its_own(first, next))
      return *related;
    ScopedBinding binding{bound_, it->name};
    binding.set(container);
    return both(contains(container, first), contains(container, next));
  }
  auto has_first = contains(container, first);
  auto has_next = contains(container, with_bound_of(first, next));
  if (both_of.proposition == "nor")
    return both(negation(has_first), negation(has_next));
  return both_of.proposition == "or" ? either(has_first, has_next) : both(has_first, has_next);
}

/// "At least one circle and one square": at least one of both.
Nominal Evaluation::with_bound_of(const Nominal& first, Nominal next) {
  const auto* quantity = dependent(form_, first, "Quantity");
  const auto* other = dependent(form_, next, "Quantity");
  if (quantity != nullptr && other != nullptr && quantity->proposition == other->proposition &&
      feature(*quantity, "Bound") == "at_least" && feature(*other, "Bound").empty())
    for (auto& x : next.relations)
      if (x.mode == "Quantity")
        x.dependent = quantity->name;
  return next;
}

/// "A tower with a black base".
Truth Evaluation::has_end(const std::string& container, const Nominal& end) {
  const bool is_top = end.proposition == "top";
  if ((!is_top && end.proposition != "base" && end.proposition != "bottom") ||
      !scene_.knows_relation("on") || dependent(form_, end, "Quantity") != nullptr)
    not_understood(end.proposition);
  auto result = Truth::no;
  for (auto& id : items(container)) {
    auto truth = is_at_end(id, container, is_top);
    for (auto& [mode, name] : end.relations)
      if (const auto* x = find_nominal(form_, name); x != nullptr && !is_pronoun(*x))
        truth = both(truth, modified(id, end, mode, *x));
    result = either(result, truth);
  }
  return result;
}

/// How many of the things that a phrase describes are in a container.
Count Evaluation::number_inside(const std::string& container, const Nominal& phrase) {
  ScopedValue within{within_, container};
  return described(phrase).count();
}

/// "Only two yellow and one black item are touching the wall": nothing else is.
Truth Evaluation::only_these(const Nominal& phrases, const Nominal& first, const Property& scope) {
  auto result = both(unfocused(first, scope), quantified(need(phrases, "Next"), scope));
  for (auto& id : scene_.things())
    if (!is_container(id))
      result = both(result, either(negation(scope(id)), fits(id, phrases)));
  return result;
}

/// "A black item in each box": there need not be one that is in all of them.
Truth Evaluation::in_each(const Nominal& subject, const Nominal& region, const Nominal& container) {
  auto item = subject;
  std::erase_if(item.relations, [&](auto& x) { return x.dependent == region.name; });
  auto place = region;
  std::erase_if(place.relations, [](auto& x) { return x.mode == "Anchor"; });
  auto holds = [&](const std::string& id) {
    if (region.proposition == "in")
      return contains(id, item);
    ScopedValue within{within_, id};
    return there_are(item, [&](const std::string& other) { return is_in(other, place); });
  };
  if (feature(container, "Delimitation") != "same")
    return quantified(container, holds);
  auto result = Truth::no;
  const auto candidates = described(container);
  for (auto& id : candidates.best())
    result = either(result, holds(id));
  return result;
}

/// Containers that things are in one by one.
bool Evaluation::is_in_each(const Nominal& container) {
  const auto delimited = feature(container, "Delimitation");
  // "No ball in any of the boxes".
  if (delimited == "any")
    return false;
  return delimited == "all" || delimited == "same" ||
         dependent(form_, container, "Quantity") != nullptr ||
         dependent(form_, container, "PartOf") != nullptr;
}

/// "All blue items are in the same box", "exactly five items are in one of the boxes": together.
std::optional<Truth> Evaluation::are_in_one(const Nominal& subject, const Nominal& scope) {
  const auto* anchor = scope.sort == "region" && scope.proposition == "in"
                         ? dependent(form_, scope, "Anchor")
                         : nullptr;
  if (anchor == nullptr || bound_.contains(subject.name) || !is_in_each(*anchor))
    return std::nullopt;
  auto are_in = [&](const std::string& container) {
    return quantified(subject, [&](const std::string& id) {
      return scene_.is_related(binding::containment_label, id, container);
    });
  };
  if (feature(*anchor, "Delimitation") != "same") {
    const auto* group = dependent(form_, *anchor, "PartOf");
    const bool may_be_container =
      is_container_phrase(*anchor) || (group != nullptr && group->proposition == "square");
    return may_be_container && within_.empty() && !is_negated(scope)
             ? std::optional{quantified(*anchor, are_in)}
             : std::nullopt;
  }
  auto result = Truth::no;
  const auto candidates = described(*anchor);
  for (auto& container : candidates.best())
    result = either(result, are_in(container));
  return result;
}

/// "The base of a tower is blue", "all blocks in one tower are": of each container that is meant
/// its own.
std::optional<Truth> Evaluation::of_own_things(const Nominal& phrase, const Property& scope) {
  const bool is_universal = feature(phrase, "Delimitation") == "all";
  if ((!is_definite_phrase(phrase) && !is_universal) || is_pronoun(phrase) || !within_.empty())
    return std::nullopt;
  for (auto& [mode, name] : phrase.relations) {
    const auto* region = mode == "Location" ? find_nominal(form_, name) : nullptr;
    const auto* whole = region == nullptr ? nullptr : dependent(form_, *region, "Anchor");
    if (whole == nullptr || is_negated(*region) || is_pronoun(*whole) ||
        (is_definite(*whole) && !is_plural(*whole)) || !is_container_phrase(*whole))
      continue;
    auto& place = region->proposition;
    const bool is_end = place == "base" || place == "top";
    if (!is_end && (place != "in" || is_definite(*whole)))
      continue;
    auto own = phrase;
    std::erase_if(own.relations, [&](auto& x) { return x.dependent == name; });
    return quantified(*whole, [&](const std::string& container) {
      ScopedValue within{within_, container};
      Count so;
      Count not_so;
      for (auto& id : items(container)) {
        if (fits(id, own) != Truth::yes ||
            (is_end && is_at_end(id, container, place == "top") != Truth::yes))
          continue;
        so.add(scope(id));
        not_so.add(negation(scope(id)));
      }
      return both(is_within(so, {1}), is_within(not_so, {0, 0}));
    });
  }
  return std::nullopt;
}

/// What is so of all things that one phrase may mean, so that it need not be known which one is
/// meant.
std::optional<Truth> Evaluation::agreed_by_all(const Nominal& phrase, const Property& scope) {
  if (is_plural(phrase) || is_pronoun(phrase) || !is_definite(phrase) ||
      dependent(form_, phrase, "Quantity") != nullptr)
    return std::nullopt;
  const auto found = described(phrase);
  if (found.certain.size() < 2 || !scene_.open_questions().empty())
    return std::nullopt;
  auto result = scope(found.certain.front());
  for (auto& id : found.certain)
    if (scope(id) != result)
      return std::nullopt;
  return result == Truth::unknown ? std::nullopt : std::optional{result};
}

/// "Blue and yellow items" are some of each.
Truth Evaluation::has_some_of_each(const Nominal& what) {
  auto result = Truth::yes;
  const auto* colours = dependent(form_, what, "Property");
  if (!is_plural(what) || feature(what, "Focus") != "only" || colours == nullptr ||
      colours->sort != "conjunction" || colours->proposition != "and")
    return result;
  for (const auto* mode : {"First", "Next"}) {
    auto one = what;
    one.features.clear();
    std::erase_if(one.relations, [](auto& x) { return x.mode == "Quantity"; });
    for (auto& x : one.relations)
      if (x.mode == "Property")
        x.dependent = need(*colours, mode).name;
    result = both(result, unfocused(one, [](auto&) { return Truth::yes; }));
  }
  return result;
}

/// Words are numbered as they are said.
bool Evaluation::is_after_noun(const Nominal& phrase, const std::string& modifier) {
  auto number = [](const std::string& name) {
    return std::atoi(name.c_str() + std::min<std::size_t>(1, name.size()));
  };
  return number(modifier) > number(phrase.name);
}

/// "With four blocks", "of black colour", "with a ball beside it".
Truth Evaluation::accompanied(const std::string& id, const Nominal& phrase, const Nominal& what) {
  // "Three items including a circle": it is in the same container.
  if ((what.sort == "thing" || what.sort == "conjunction") && !is_container(id) &&
      !within_.empty() && !has_pronoun(what))
    return contains(within_, what);
  if (what.sort != "quality" || is_container(id))
    return has(id, what);
  auto result = Truth::yes;
  bool is_property = false;
  for (auto& [mode, name] : what.relations)
    if (const auto* x = find_nominal(form_, name); x != nullptr && x->sort != "number") {
      is_property = true;
      result = both(result, is(id, *x, &phrase));
    }
  if (!is_property)
    not_understood(what.proposition);
  return result;
}

/// "There is a tower with three blocks, and it has a blue base": the second clause goes on about
/// what the first one says is there.
Truth Evaluation::discourse(const Nominal& first, const Nominal& next) {
  const auto* subject = first.sort == "existence" ? dependent(form_, first, "Subject") : nullptr;
  const auto* topic = dependent(form_, next, "Cop-Restr");
  const auto* group = topic == nullptr ? nullptr : dependent(form_, *topic, "PartOf");
  const bool is_known = topic != nullptr && (is_definite(*topic) || topic->proposition == "one" ||
                                             (group != nullptr && is_pronoun(*group)));
  const bool is_about_it = subject != nullptr && subject->sort == "thing" && is_known &&
                           !is_negated(first) &&
                           (is_pronoun(*topic) || is_container_noun(subject->proposition));
  // "One tower has three blocks, and the base is blue."
  const auto* owner = first.sort == "ascription" ? dependent(form_, first, "Cop-Restr") : nullptr;
  if (owner != nullptr && is_known && is_container_phrase(*owner) && !is_definite(*owner) &&
      !is_negated(first) && !is_pronoun(*topic) && first.proposition == "have")
    return quantified(*owner, [&](const std::string& id) {
      ScopedValue within{within_, id};
      return both(has(id, need(first, "Cop-Scope")), clause(next));
    });
  if (owner != nullptr && topic != nullptr && is_the_other_of(*owner, *topic))
    return one_and_the_other(first, next);
  if (!is_about_it)
    return both(clause(first), clause(next));
  // "There is only one ball, and it is red": there is no other ball either.
  const auto alone = feature(*subject, "Focus") == "only" ? existence(*subject) : Truth::yes;
  return both(alone, there_are(*subject, [&](const std::string& id) {
                if ((is_pronoun(*topic) && !is_plural(*topic)) ||
                    topic->proposition == subject->proposition) {
                  ScopedBinding binding{bound_, topic->name};
                  binding.set(id);
                  return clause(next);
                }
                ScopedValue within{within_, id};
                return clause(next);
              }));
}

/// "The black one" of a container; there need be none.
Truth Evaluation::definite_inside(const Nominal& phrase, const Property& scope) {
  auto things = described(phrase).best();
  const auto* quantity = dependent(form_, phrase, "Quantity");
  auto range = quantity == nullptr ? std::nullopt : number_range(*quantity);
  if (things.empty())
    return Truth::no;
  if (range && feature(phrase, "Delimitation") == "unique" && things.size() != range->least) {
    // "The two are black": two of them are.
    Count so;
    for (auto& id : things)
      so.add(scope(id));
    return is_within(so, *range);
  }
  auto result = truth_of(is_plural(phrase));
  for (auto& id : things)
    result = is_plural(phrase) ? both(result, scope(id)) : either(result, scope(id));
  return result;
}

} // namespace castor::communication
