#include "castor/communication/dialogue/content.hpp"
#include "castor/communication/dialogue/descriptions.hpp"
#include "castor/communication/dialogue/evaluation.hpp"
#include "castor/communication/dialogue/scoped.hpp"
#include "castor/communication/parsing/hybrid_logic.hpp"

#include <algorithm>
#include <set>
#include <utility>

namespace castor::communication {

namespace {

using binding::FeatureKind;

std::string_view delimitation(const Nominal& x) {
  return feature(x, "Delimitation");
}

/// Those that others are compared with are left out, unless there are no others.
std::vector<std::string> without(std::vector<std::string> things,
                                 const std::vector<std::string>& landmarks) {
  auto others = things;
  std::erase_if(others,
                [&](auto& id) { return std::ranges::find(landmarks, id) != landmarks.end(); });
  return others.empty() ? things : others;
}

/// How many things a definite phrase says that there are; one at least if it does not say.
struct WantedNumber {
  NumberRange range{1};
  bool is_said = false;
};

WantedNumber wanted_number(const LogicalForm& form, const Nominal& phrase) {
  if (delimitation(phrase) == "both" || delimitation(phrase) == "neither")
    return {{2, 2}, true};
  const auto* quantity = dependent(form, phrase, "Quantity");
  const auto range = quantity == nullptr ? std::nullopt : number_range(*quantity);
  return {range.value_or(NumberRange{1}), range.has_value()};
}

} // namespace

/// "Both" and "either" are said of two phrases.
void Evaluation::check_coordination(const Nominal& x) {
  if (x.sort != "conjunction" && !feature(x, "Coordination").empty())
    not_understood(std::string{feature(x, "Coordination")});
}

Fitting Evaluation::described(const Nominal& phrase) {
  Fitting result;
  const auto& all = candidates(phrase);
  if (scene_.open_questions().empty() && phrase.sort == "thing" && !is_pronoun(phrase) &&
      !scene_.is_kind_known(phrase.proposition))
    throw Uninterpretable{Uninterpretable::Reason::unknown_kind, phrase.name};
  for (auto& id : all)
    if (!is_outside(id, phrase))
      result.add(id, fits(id, phrase));
  return result;
}

/// What may be called as the phrase says. Things, if its noun stands for others.
const Evaluation::Things& Evaluation::candidates(const Nominal& phrase) {
  if (phrase.sort == "conjunction")
    return candidates(need(phrase, "First"));
  if (const auto* whole = dependent(form_, phrase, "PartOf"); whole != nullptr && whole != &phrase)
    return candidates(*whole);
  // What was spoken of, or is shown, may be anything.
  if (is_pronoun(phrase))
    return scene_.individuals();
  if (const auto* room = room_asked_beside(phrase)) {
    scene_.candidates(room->proposition);
    return scene_.individuals();
  }
  return phrase.sort == "thing" ? scene_.candidates(phrase.proposition) : scene_.things();
}

/// "What is next to the kitchen?" asks for rooms, too. Null for what does not.
const Nominal* Evaluation::room_asked_beside(const Nominal& asked) const {
  const auto* root = find_nominal(form_, form_.root);
  if (asked.sort != "entity" || root == nullptr || root->sort != "ascription" ||
      dependent(form_, *root, "Wh-Restr") != &asked)
    return nullptr;
  const auto* place = dependent(form_, *root, "Cop-Scope");
  if (place == nullptr || place->sort != "region" ||
      place->proposition == binding::containment_label)
    return nullptr;
  const auto* anchor = dependent(form_, *place, "Anchor");
  if (anchor != nullptr && anchor->sort == "conjunction")
    anchor = dependent(form_, *anchor, "First");
  return anchor != nullptr && anchor->sort == "thing" &&
             vocabulary().is_of_other_kind(anchor->proposition)
           ? anchor
           : nullptr;
}

bool Evaluation::is_addressee(const Nominal& phrase) {
  // Who speaks is where the robot is.
  return is_participant(phrase) && !scene_.addressee().empty();
}

bool Evaluation::is_pointed_at(const Nominal& phrase) const {
  return antecedents_.contains(phrase.name + std::string{pointed_at});
}

Fitting Evaluation::members_pointed_at(const Nominal& phrase) {
  using Reason = Uninterpretable::Reason;
  auto things = antecedents_of(phrase.name + std::string{pointed_at});
  // It may be the room that the robot is in, of which nobody has told yet.
  if (things.empty())
    scene_.addressee();
  if (!scene_.open_questions().empty())
    return {};
  if (things.empty())
    throw Uninterpretable{Reason::nothing_pointed_at, phrase.name};
  const auto [range, has_number] = wanted_number(form_, phrase);
  if (has_number && is_within({things.size(), things.size()}, range) != Truth::yes)
    throw Uninterpretable{Reason::nothing_pointed_at, phrase.name};
  if (!has_number && !is_plural(phrase) && things.size() > 1)
    throw Uninterpretable{Reason::ambiguous, phrase.name};
  return {things, things};
}

std::vector<std::string> Evaluation::meant(const Nominal& phrase) {
  return members_of(phrase).best();
}

/// The things that a definite phrase means. Those of "the balls" that may be no balls are possible
/// only, unless all are.
Fitting Evaluation::members_of(const Nominal& phrase) {
  using Reason = Uninterpretable::Reason;
  if (auto known = bound_.find(phrase.name); known != bound_.end())
    return {{known->second}, {known->second}};
  if (is_addressee(phrase)) {
    const auto self = scene_.addressee();
    return {self, self};
  }
  if (is_pointed_at(phrase))
    return members_pointed_at(phrase);
  if (is_pronoun(phrase))
    return members_of_pronoun(phrase);
  // The table is where everything is; what it is like, nobody has said.
  if (vocabulary().surroundings(phrase) != nullptr)
    throw Uninterpretable{Reason::unknown, phrase.name};
  // "The side" is nothing that is seen.
  if (phrase.sort == "place" && !has_containers())
    not_understood(phrase.proposition);
  if (auto spoken_of = pointed_out_before(phrase); !spoken_of.empty())
    return {spoken_of, spoken_of};
  // "The two", of which was spoken.
  if (is_counted_group(form_, phrase) && !has_containers())
    if (auto group = antecedents_of(phrase.name); !group.empty())
      return {group, group};
  auto found = described(phrase);
  // "What colour are the cubes? What shape is the yellow one?": the yellow thing, if no cube is.
  if (found.possible.empty() && feature(phrase, "Called") == "one" && !is_request()) {
    auto thing = phrase;
    thing.proposition = vocabulary().general_concept();
    found = described(thing);
  }
  const bool is_lenient = found.possible.empty();
  if (is_lenient) {
    ScopedValue lenience{is_lenient_, true};
    ScopedValue wide{has_wide_sides_, is_request() && may_have_wide_sides()};
    found = described(phrase);
  }
  if (!scene_.open_questions().empty())
    return {};
  const auto [range, has_number] = wanted_number(form_, phrase);
  if (is_plural(phrase) || has_number) {
    const auto number = found.best().size();
    if (number == 0 || found.possible.size() < range.least)
      throw Uninterpretable{Reason::nothing_like, phrase.name};
    if (number < range.least)
      throw Uninterpretable{Reason::unknown, phrase.name};
    if (is_within({number, number}, range) != Truth::yes)
      throw Uninterpretable{Reason::ambiguous, phrase.name};
    if (has_number || found.certain.empty())
      return {found.best(), found.best()};
    return found;
  }
  if (found.certain.size() != 1)
    if (const auto one = distinguished(phrase, found.certain))
      return {{*one}, {*one}};
  const bool may_be_seen = vocabulary().is_perceptible(phrase.proposition);
  // A room may be the office, but nobody has said so.
  const bool may_be_called_so =
    vocabulary().is_of_other_kind(phrase.proposition) && !found.possible.empty();
  if (found.certain.empty() && may_be_called_so)
    throw Uninterpretable{Reason::unknown, phrase.name};
  if (found.certain.empty() && found.possible.size() > 1 && !is_lenient && may_be_seen)
    throw Uninterpretable{Reason::unknown, phrase.name};
  if (found.certain.empty() && found.possible.size() != 1)
    throw Uninterpretable{Reason::nothing_like, phrase.name};
  if (found.certain.size() > 1)
    throw Uninterpretable{Reason::ambiguous, phrase.name};
  return {found.best(), found.best()};
}

/// The one of several, or of none that fit in every way, that is meant nevertheless.
std::optional<std::string> Evaluation::distinguished(const Nominal& phrase, const Things& certain) {
  if (auto by_size = distinguished_by_size(phrase))
    return by_size;
  if (auto by_side = distinguished_by_side(phrase))
    return by_side;
  // "What is behind the blue ball? - Put it next to the ball." Of what is told, it is asked.
  if (!is_request())
    return std::nullopt;
  auto last = antecedents_of(phrase.name + std::string{spoken_of_last});
  std::erase_if(last,
                [&](const auto& id) { return std::ranges::find(certain, id) == certain.end(); });
  return last.size() == 1 ? std::optional{last.front()} : std::nullopt;
}

/// Of how many of them `scope` is true.
Count Evaluation::count(const Fitting& candidates, const Property& scope, const Things& landmarks) {
  Count result;
  for (auto& id : without(candidates.possible, landmarks))
    result.add(both(scope(id), candidates.contains(id)));
  return result;
}

Truth Evaluation::quantified(const Nominal& phrase, const Property& scope,
                             const Things& landmarks) {
  check_coordination(phrase);
  if (const auto* first =
        phrase.sort == "conjunction" ? dependent(form_, phrase, "First") : nullptr;
      first != nullptr && feature(*first, "Focus") == "only" &&
      dependent(form_, *first, "Quantity") != nullptr)
    return only_these(phrase, *first, scope);
  auto result = unfocused(phrase, scope, landmarks);
  if (bound_.contains(phrase.name))
    return result;
  // "Not all balls".
  if (is_negated(phrase))
    result = negation(result);
  // "Only two boxes have a lid": the others have none, whatever else has one.
  if (feature(phrase, "Focus") != "only" || dependent(form_, phrase, "Quantity") != nullptr)
    return result;
  // Nothing else is so.
  for (auto& id : candidates(phrase))
    if (!is_outside(id, phrase) && (!is_container(id) || is_one_of(id, phrase) != Truth::no))
      result = both(result, either(negation(scope(id)), is_one_of(id, phrase)));
  return result;
}

Truth Evaluation::unfocused(const Nominal& phrase, const Property& scope, const Things& landmarks) {
  if (auto known = bound_.find(phrase.name); known != bound_.end())
    return scope(known->second);
  if (phrase.sort == "conjunction") {
    auto first = quantified(need(phrase, "First"), scope, landmarks);
    auto next = quantified(need(phrase, "Next"), scope, landmarks);
    if (phrase.proposition == "or")
      return either(first, next);
    return phrase.proposition == "nor" ? both(negation(first), negation(next)) : both(first, next);
  }
  if (is_addressee(phrase)) {
    auto result = Truth::yes;
    for (auto& id : scene_.addressee())
      result = both(result, scope(id));
    return result;
  }
  if (phrase.sort != "thing" && phrase.sort != "entity")
    not_understood(phrase.proposition);
  const auto delimited = delimitation(phrase);
  if (!within_.empty() && is_definite(phrase) && !is_pronoun(phrase) &&
      !is_container_noun(phrase.proposition))
    return definite_inside(phrase, scope);
  if (const auto* modifier = collective_modifier(phrase))
    return collectively(phrase, *modifier, scope);
  if (auto owned = of_own_things(phrase, scope))
    return *owned;
  if (is_definite_phrase(phrase)) {
    if (auto agreed = agreed_by_all(phrase, scope))
      return *agreed;
    auto result = Truth::yes;
    auto members = members_of(phrase);
    for (auto& id : without(members.possible, landmarks)) {
      auto truth = delimited == "neither" ? negation(scope(id)) : scope(id);
      const bool is_certain = members.contains(id) == Truth::yes;
      result = both(result, is_certain ? truth : either(truth, Truth::unknown));
    }
    return scene_.open_questions().empty() ? result : Truth::unknown;
  }
  const auto* quantity = dependent(form_, phrase, "Quantity");
  auto candidates = described(phrase);
  // Of "all balls" there are some: what may be a ball is one if nothing else is.
  if ((delimited == "all" || delimited == "most") && candidates.certain.empty())
    candidates.certain = candidates.possible;
  auto so = count(candidates, scope, landmarks);
  if (quantity != nullptr) {
    const auto& word = quantity->proposition;
    if (word == "several" || word == "many" || word == "multiple")
      return is_within(so, {2});
    if (const auto range = number_range(*quantity))
      return is_within(so, *range);
    not_understood(word);
  }
  if (delimited == "none")
    return is_within(so, {0, 0});
  auto not_so = count(
    candidates, [&](const std::string& id) { return negation(scope(id)); }, landmarks);
  // "All but one of the balls".
  if (const auto* excepted = dependent(form_, phrase, "AllBut"))
    if (const auto range = number_range(*excepted))
      return is_within(not_so, *range);
  if (delimited == "half") {
    if (so.certain != so.possible || not_so.certain != not_so.possible)
      return Truth::unknown;
    if (feature(phrase, "Bound") == "at_least")
      return truth_of(so.certain >= not_so.certain && so.certain > 0);
    return truth_of(so.certain == not_so.certain && so.certain > 0);
  }
  if (delimited == "most") {
    if (so.certain > not_so.possible)
      return Truth::yes;
    return so.possible <= not_so.certain ? Truth::no : Truth::unknown;
  }
  if (delimited == "all") {
    if (scene_.open_questions().empty() && candidates.possible.empty())
      throw Uninterpretable{Uninterpretable::Reason::nothing_like, phrase.name};
    return is_within(not_so, {0, 0});
  }
  return is_within(so, {1});
}

Truth Evaluation::is_one_of(const std::string& id, const Nominal& phrase) {
  if (auto known = bound_.find(phrase.name); known != bound_.end())
    return truth_of(known->second == id);
  return is_definite_phrase(phrase) ? members_of(phrase).contains(id) : fits(id, phrase);
}

/// Fits the phrase without one of its modifiers.
Truth Evaluation::fits_but_for(const std::string& id, const Nominal& phrase,
                               const Nominal& modifier) {
  auto without = phrase;
  std::erase_if(without.relations, [&](auto& x) { return x.dependent == modifier.name; });
  return fits(id, without);
}

Truth Evaluation::fits(const std::string& id, const Nominal& phrase, bool with_selection) {
  if (is_pointed_at(phrase) && !bound_.contains(phrase.name))
    return members_pointed_at(phrase).contains(id);
  if (phrase.sort == "conjunction") {
    // "Cubes and balls" are all that are one or the other.
    auto result = either(fits(id, need(phrase, "First")), fits(id, need(phrase, "Next")));
    for (auto& [mode, name] : phrase.relations)
      if (const auto* x = find_nominal(form_, name);
          x != nullptr && mode != "First" && mode != "Next")
        result = both(result, modified(id, phrase, mode, *x));
    return result;
  }
  auto result = is_called(id, phrase);
  const Nominal* selection = nullptr;
  for (auto& [mode, name] : phrase.relations) {
    const auto* x = find_nominal(form_, name);
    if (x == nullptr || result == Truth::no)
      continue;
    if (const auto* together = collective_modifier(phrase);
        together != nullptr &&
        (x == together || (mode == "GenRelation" && dependent(form_, *x, "Cop-Scope") == together)))
      continue;
    if (mode == "Selection" && selection != nullptr)
      not_understood(x->proposition);
    if (mode == "Selection")
      selection = x;
    else
      result = both(result, modified(id, phrase, mode, *x));
  }
  if (selection == nullptr || !with_selection || result == Truth::no)
    return result;
  Fitting among;
  for (auto& other : candidates(phrase))
    among.add(other, fits(other, phrase, false));
  return both(result, is_selected(id, *selection, among, number_of_selected(phrase)));
}

Truth Evaluation::is_called(const std::string& id, const Nominal& phrase) {
  if (auto known = bound_.find(phrase.name); known != bound_.end() && is_pronoun(phrase))
    return truth_of(known->second == id);
  if (is_pronoun(phrase)) {
    auto things = meant(phrase);
    return truth_of(std::ranges::find(things, id) != things.end());
  }
  auto& noun = phrase.proposition;
  if (auto named = is_named_by_sense(id, phrase))
    return *named;
  // "What is on the left? - Take the taller one": of these.
  if (noun == "one" && dependent(form_, phrase, "Selection") != nullptr &&
      dependent(form_, phrase, "PartOf") == nullptr)
    if (const auto all = antecedents_of(phrase.name + std::string{last_group}); !all.empty())
      return truth_of(std::ranges::find(all, id) != all.end());
  if (vocabulary().is_general(noun))
    return truth_of(scene_.is_thing(id) || dependent(form_, phrase, "PartOf") != nullptr ||
                    room_asked_beside(phrase) != nullptr);
  const auto has_name = scene_.has(id, named(noun));
  const auto& definition = vocabulary().definition(noun);
  // "Box" may mean a container or a cube: what there is.
  if (definition.empty() || has_name == Truth::yes || !scene_.is_thing(id))
    return has_name;
  auto result = Truth::yes;
  for (auto& x : definition)
    result = both(result, x.kind == FeatureKind::shape ? has_shape(id, x.text) : scene_.has(id, x));
  return result;
}

/// A shape that looks like another may be meant where nothing else can be. Of what is only known to
/// be round, vision cannot tell more.
Truth Evaluation::has_shape(const std::string& id, const std::string& shape) {
  const auto known = scene_.words(id, FeatureKind::shape);
  auto result = scene_.has(id, binding::feature(FeatureKind::shape, shape));
  if (result != Truth::unknown || known.empty() ||
      vocabulary().noun_of_shape(known.front()).empty())
    return result;
  // What is known to be a square is no cube.
  if (!is_lenient_ || scene_.is_sure(id, FeatureKind::shape))
    return Truth::no;
  return result;
}

Truth Evaluation::modified(const std::string& id, const Nominal& phrase, const std::string& mode,
                           const Nominal& x) {
  const ScopedElement modifier{modifiers_, phrase.name + ' ' + x.name};
  if (!modifier.is_new())
    return Truth::yes;
  return as_modified(id, phrase, mode, x);
}

Truth Evaluation::as_modified(const std::string& id, const Nominal& phrase, const std::string& mode,
                              const Nominal& x) {
  if (mode == "Quantity" || mode == "AllBut")
    return Truth::yes;
  if (mode == "PartOf")
    return is_plural(x) ? is_one_of(id, x) : fits(id, x);
  if (mode == "Whole")
    return quantified(
      x, [&](auto& whole) { return scene_.is_related(binding::containment_label, id, whole); });
  if (mode == "Accompaniment") {
    // "The blue one of the balls".
    const bool is_of_several = phrase.proposition == "one" && x.sort == "thing" && is_plural(x) &&
                               feature(x, "Delimitation") == "unique" && !has_containers();
    return is_of_several ? is_one_of(id, x) : accompanied(id, phrase, x);
  }
  if (mode == "Lacking")
    return negation(accompanied(id, phrase, x));
  if (mode == "Where") {
    if (has_containers() && !is_container(id))
      not_understood(x.proposition);
    ScopedValue within{within_, id};
    return clause(x);
  }
  if (mode == "Except")
    return negation(is_one_of(id, x));
  if (mode == "GenRelation") {
    // "That you see" says nothing new.
    if (x.sort == "perception" && x.proposition == "see")
      return Truth::yes;
    ScopedBinding binding{bound_, phrase.name};
    binding.set(id);
    return clause(x);
  }
  if (mode == "Owner" || mode == "Name")
    not_understood(x.proposition);
  // "One black and two blue blocks" is no block that is black and two blue ones.
  if (mode == "Property" && x.sort == "conjunction")
    for (const auto* part : {"First", "Next"})
      if (need(x, part).sort == "thing")
        not_understood(x.proposition);
  // "Two different boxes" are two.
  if (mode == "Property" && x.sort == "property" && x.proposition == "different")
    return Truth::yes;
  if (mode == "Property" && x.proposition == "only") {
    Count so;
    for (auto& other : candidates(phrase))
      so.add(other == id ? Truth::no : fits_but_for(other, phrase, x));
    return is_within(so, {0, 0});
  }
  if (mode == "Property" && x.proposition == "other") {
    // "Larger than all the others", "than every other ball".
    const bool is_of_such = !related_.empty() && fits_but_for(related_, phrase, x) == Truth::yes;
    if (!related_.empty() && (is_plural(phrase) || delimitation(phrase) == "all" || is_of_such))
      return truth_of(id != related_ &&
                      std::ranges::find(related_group_, id) == related_group_.end());
    auto contains = [&](const Things& things) {
      return truth_of(std::ranges::find(things, id) != things.end());
    };
    auto all = antecedents_of(phrase.name + std::string{chosen_from});
    auto others = negation(contains(antecedents_of(phrase.name)));
    return all.empty() ? others : both(contains(all), others);
  }
  if (auto together = is_with_the_others(id, phrase, x))
    return *together;
  return is(id, x, &phrase);
}

} // namespace castor::communication
