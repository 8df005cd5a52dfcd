#include "castor/communication/dialogue/directive_things.hpp"

#include "castor/communication/dialogue/descriptions.hpp"
#include "castor/communication/parsing/hybrid_logic.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace castor::communication {

namespace {

using Reason = Uninterpretable::Reason;
using Things = std::vector<std::string>;

std::ptrdiff_t count_of(const MeantThings& x) {
  return x.number == 0 ? std::ssize(x.things) : x.number;
}

/// The phrases of "the ball is left of the box": subject first.
std::vector<const Nominal*> phrases_of(const LogicalForm& form, const Nominal& clause) {
  std::vector<const Nominal*> result;
  for (const auto* mode : {"Cop-Restr", "Subject", "Cop-Scope", "First", "Next"})
    if (const auto* x = dependent(form, clause, mode)) {
      if (x->sort == "thing")
        result.push_back(x);
      else if (const auto* anchor = dependent(form, *x, "Anchor");
               anchor != nullptr && anchor->sort == "thing")
        result.push_back(anchor);
    }
  return result;
}

} // namespace

std::vector<std::string> all_but(std::vector<std::string> things,
                                 const std::vector<std::string>& others) {
  std::erase_if(things, [&](auto& x) { return std::ranges::find(others, x) != others.end(); });
  return things;
}

Things DirectiveThings::proxies(const Things& unions) const {
  Things result;
  for (const auto& id : unions) {
    auto proxy = scene_.proxy_of(id);
    result.push_back(proxy.empty() ? id : std::move(proxy));
  }
  return result;
}

void DirectiveThings::end_step(bool names_things) {
  if (names_things) {
    last_ = current_;
    const auto further = all_but(current_.things, of_steps_);
    of_steps_.insert(of_steps_.end(), further.begin(), further.end());
  } else
    last_.reset();
  is_last_each_ = is_current_each_;
}

void DirectiveThings::note_clause(const Nominal& clause) {
  for (const auto* phrase : phrases_of(form_, clause)) {
    if (vocabulary().surroundings(*phrase) != nullptr)
      continue;
    if (is_pronoun(*phrase) && !antecedents_.contains(phrase->name))
      continue;
    auto meant = is_definite_phrase(*phrase)
                   ? MeantThings{evaluation_.meant(*phrase), 0}
                   : MeantThings{evaluation_.described(*phrase).best(), is_plural(*phrase) ? 0 : 1};
    // "If anything is higher than 7 cm, take it": what is so.
    if (!is_definite_phrase(*phrase) && dependent(form_, clause, "Cop-Restr") == phrase &&
        !is_negated(clause))
      std::erase_if(meant.things,
                    [&](const auto& id) { return evaluation_.is_so_of(clause, id) == Truth::no; });
    mentioned_.insert(mentioned_.end(), meant.things.begin(), meant.things.end());
    for (const auto& x : meant.things)
      if (std::ranges::find(of_whole_clause_.things, x) == of_whole_clause_.things.end())
        of_whole_clause_.things.push_back(x);
    if (!subject_)
      subject_ = std::move(meant);
  }
}

/// Proxies of what "it" stands for, if none of them is there any more: whoever has moved the
/// thing knows it by the proxy that it had.
Things DirectiveThings::of_before(const Nominal& phrase) {
  const auto before = antecedents_.find(phrase.name);
  if (!is_pronoun(phrase) || before == antecedents_.end() || scene_.things().empty())
    return {};
  const bool is_there = std::ranges::any_of(scene_.things(), [&](const auto& id) {
    return std::ranges::find(before->second, scene_.proxy_of(id)) != before->second.end();
  });
  return is_there ? Things{} : before->second;
}

/// The things of the step before, if there is one that a pronoun can stand for.
std::optional<MeantThings> DirectiveThings::of_step_before(const Nominal& phrase) const {
  if (!is_pronoun(phrase))
    return std::nullopt;
  if (!last_)
    return of_clause(phrase);
  // "Take each cube and put it on the left."
  const bool is_each = !is_plural(phrase) && is_last_each_;
  if (!is_each && is_plural(phrase) != (count_of(*last_) > 1))
    return is_plural(phrase) ? of_steps_together(phrase) : std::nullopt;
  return last_;
}

/// "Put the ball on the left and the cube on the right, and then push both to the back."
std::optional<MeantThings> DirectiveThings::of_steps_together(const Nominal& phrase) const {
  const auto* quantity = dependent(form_, phrase, "Quantity");
  const auto range = quantity == nullptr ? std::nullopt : number_range(*quantity);
  const auto count = of_steps_.size();
  if (count < 2 || (range && is_within({count, count}, *range) != Truth::yes))
    return std::nullopt;
  return MeantThings{of_steps_, 0};
}

std::optional<MeantThings> DirectiveThings::of_clause(const Nominal& phrase) const {
  if (!subject_)
    return std::nullopt;
  if (is_plural(phrase) == (count_of(*subject_) > 1))
    return subject_;
  return is_plural(phrase) && of_whole_clause_.things.size() > 1 ? std::optional{of_whole_clause_}
                                                                 : std::nullopt;
}

MeantThings DirectiveThings::things(const Nominal& phrase) {
  // "Neither of the balls should be on the left" is no request to put one there.
  if (feature(phrase, "Delimitation") == "neither")
    throw Uninterpretable{Reason::word, "neither"};
  auto result = things_of(phrase);
  if (!result.things.empty()) {
    if (!is_pronoun(phrase) && !is_about_others(form_, phrase))
      noun_ = head_noun(phrase);
    current_ = result;
    is_current_each_ = !is_pronoun(phrase) && !is_plural(phrase) && count_of(result) > 1;
  }
  return result;
}

MeantThings DirectiveThings::things_of(const Nominal& phrase) {
  auto result = things_named(phrase);
  if (result.number == 0 && is_about_others(form_, phrase))
    result.things = without_carriers(scene_, std::move(result.things));
  mentioned_.insert(mentioned_.end(), result.things.begin(), result.things.end());
  return result;
}

/// "Put the cube where the red ball is, and put the ball aside": of several that are like it, the
/// one that the request has named.
std::optional<std::string> DirectiveThings::named_before(const Nominal& phrase) {
  std::set<std::string> named;
  for (const auto& id : evaluation_.described(phrase).certain)
    if (std::ranges::find(mentioned_, id) != mentioned_.end())
      named.insert(id);
  return named.size() == 1 ? std::optional{*named.begin()} : std::nullopt;
}

Things DirectiveThings::as_thing(const Nominal& phrase) {
  const auto form = with_thing_for(phrase);
  return Evaluation{form, antecedents_, scene_}.meant(*find_nominal(form, phrase.name));
}

/// "The yellow one" is any yellow thing.
LogicalForm DirectiveThings::with_thing_for(const Nominal& phrase) const {
  auto result = form_;
  find_nominal(result, phrase.name)->proposition = "thing";
  return result;
}

/// "The glasses", "my forks": what the robot cannot see to be one, and of which nobody has said
/// that it is called so, is not there; what may be one is not taken for it.
bool DirectiveThings::names_nothing_seen(const Nominal& phrase) {
  if (phrase.sort != "thing" || is_pronoun(phrase) || antecedents_.contains(phrase.name) ||
      vocabulary().is_perceptible(phrase.proposition) ||
      dependent(form_, phrase, "PartOf") != nullptr)
    return false;
  // "The brown plate" tells which thing is called so.
  const auto tells = [](const NominalRelation& x) {
    return x.mode == "Colour" || x.mode == "Shape" || x.mode == "Selection" || x.mode == "Location";
  };
  if (!is_plural(phrase) && std::ranges::any_of(phrase.relations, tells))
    return false;
  return evaluation_.described(phrase).certain.empty() && scene_.open_questions().empty();
}

MeantThings DirectiveThings::things_named(const Nominal& phrase) {
  if (auto before = of_step_before(phrase))
    return *before;
  if (phrase.sort == "conjunction")
    return all_or_one_of(phrase);
  if (phrase.sort != "thing" || vocabulary().surroundings(phrase) != nullptr)
    throw Uninterpretable{Reason::word, phrase.proposition};
  if (auto moved = of_before(phrase); !moved.empty())
    return {std::move(moved), 0};
  if (auto stack = whole_stack(phrase); !stack.empty())
    return {std::move(stack), 0};
  if (names_nothing_seen(phrase))
    throw Uninterpretable{Reason::nothing_like, phrase.name};
  const bool is_others = is_about_others(form_, phrase);
  if (is_others && remaining_ && feature(phrase, "Delimitation") != "all")
    return {*remaining_, 0};
  if (auto other = besides(of_steps_, noun_, phrase))
    return *other;
  // "Put the cube on the box, and everything else on the left."
  if (is_others && last_ && feature(phrase, "Delimitation") == "all")
    return {all_but(all_but(scene_.things(), last_->things), mentioned_), 0};
  if (!is_definite_phrase(phrase))
    return indefinite(phrase);
  // "Leave the balls alone, and put the rest at the back."
  if (is_plural(phrase) && is_others && !antecedents_.contains(phrase.name) && last_)
    return {all_but(scene_.things(), of_steps_), 0};
  if (is_plural(phrase) && is_others && !antecedents_.contains(phrase.name) &&
      scene_.open_questions().empty())
    return {all_but_landmarks(phrase), 0};
  Things meant;
  try {
    meant = evaluation_.meant(phrase);
  } catch (const Uninterpretable& e) {
    // "Put the cube on the yellow one": on the yellow thing, if no cube is yellow.
    if (e.reason == Reason::nothing_like && e.what == phrase.name &&
        feature(phrase, "Called") == "one")
      return {as_thing(phrase), 0};
    const auto named = is_plural(phrase) || is_pronoun(phrase) || is_others ||
                           e.reason != Reason::ambiguous || e.what != phrase.name
                         ? std::nullopt
                         : named_before(phrase);
    if (!named)
      throw;
    meant = {*named};
  }
  if (meant.size() == 1 && is_plural(phrase) && is_others)
    meant = all_but_those_before(phrase);
  return {std::move(meant), 0};
}

MeantThings DirectiveThings::indefinite(const Nominal& phrase) {
  auto found = evaluation_.described(phrase).best();
  if (!scene_.open_questions().empty())
    return {};
  if (remaining_)
    std::erase_if(found, [&](const auto& id) {
      return std::ranges::find(mentioned_, id) != mentioned_.end() &&
             std::ranges::find(*remaining_, id) == remaining_->end();
    });
  const auto number = number_of(phrase, found.size());
  if (found.empty() || std::ssize(found) < number)
    throw Uninterpretable{Reason::nothing_like, phrase.name};
  if (number == 0 || std::ssize(found) == number || !is_shared_out(phrase))
    return {found, number};
  remaining_ = Things{found.begin() + number, found.end()};
  found.resize(static_cast<std::size_t>(number));
  return {found, 0};
}

/// Whether the request goes on with the others, or with another one, of the kind.
bool DirectiveThings::is_shared_out(const Nominal& phrase) const {
  return std::ranges::any_of(form_.nominals, [&](const Nominal& x) {
    const bool is_like = x.proposition == phrase.proposition || feature(x, "Called") == "one";
    return x.sort == "thing" && place_of_word(x) > place_of_word(phrase) &&
           (is_about_others(form_, x) || (is_like && !is_definite_phrase(x) && !is_plural(x)));
  });
}

/// "The others" are several: all things, if there are no further ones of the kind spoken of.
Things DirectiveThings::all_but_those_before(const Nominal& phrase) {
  const auto before = antecedents_.find(phrase.name);
  auto result = scene_.things();
  if (before != antecedents_.end())
    std::erase_if(result, [&](auto& id) {
      return std::ranges::find(before->second, scene_.proxy_of(id)) != before->second.end();
    });
  return result;
}

/// "Put the others next to the cube."
Things DirectiveThings::all_but_landmarks(const Nominal& phrase) {
  Things landmarks;
  const bool are_stacked = std::ranges::any_of(
    form_.nominals, [](const auto& x) { return x.sort == "region" && x.proposition == "on"; });
  for (const auto& x : form_.nominals)
    if (!are_stacked && x.name != phrase.name && x.sort == "thing" && is_definite_phrase(x) &&
        !is_pronoun(x) && vocabulary().surroundings(x) == nullptr)
      for (auto& id : evaluation_.meant(x))
        landmarks.push_back(std::move(id));
  if (landmarks.empty())
    throw Uninterpretable{Reason::ambiguous, phrase.name};
  return all_but(scene_.things(), landmarks);
}

/// "The red cube and then the other one": the only one of the noun besides those; nothing for other
/// phrases.
std::optional<MeantThings> DirectiveThings::besides(const Things& those, const std::string& noun,
                                                    const Nominal& phrase) {
  if (those.empty() || !is_about_others(form_, phrase) || is_plural(phrase))
    return std::nullopt;
  auto like = form_;
  auto& other = *find_nominal(like, phrase.name);
  other.relations.clear();
  if (other.proposition == "one")
    other.proposition = noun;
  auto others = all_but(Evaluation{like, antecedents_, scene_}.described(other).certain, those);
  if (other.proposition == "one")
    std::erase_if(others, [&](const auto& id) {
      return scene_.words(id, binding::FeatureKind::shape) !=
             scene_.words(those.back(), binding::FeatureKind::shape);
    });
  return others.size() == 1 ? std::optional{MeantThings{std::move(others), 0}} : std::nullopt;
}

/// "Cube" of "the red cube and the green one".
std::string DirectiveThings::head_noun(const Nominal& phrase) const {
  const auto* first = dependent(form_, phrase, "First");
  return first == nullptr ? phrase.proposition : head_noun(*first);
}

/// "The ball and a cube"; "the ball or the cube".
MeantThings DirectiveThings::all_or_one_of(const Nominal& phrase) {
  MeantThings result;
  for (const auto* mode : {"First", "Next"}) {
    const auto* x = dependent(form_, phrase, mode);
    if (x == nullptr)
      throw Uninterpretable{Reason::word, phrase.proposition};
    auto other = besides(result.things, head_noun(phrase), *x);
    auto part = other ? *std::move(other) : things_of(*x);
    part.things = all_but(std::move(part.things), result.things);
    if (part.number > 0 && std::ssize(part.things) > part.number)
      part.things.resize(static_cast<std::size_t>(part.number));
    result.things.insert(result.things.end(), part.things.begin(), part.things.end());
  }
  result.number = phrase.proposition == "or" ? 1 : 0;
  return result;
}

/// How many of `all` an indefinite phrase means; 0 for all.
std::int32_t DirectiveThings::number_of(const Nominal& phrase, std::size_t all) const {
  if (const auto* quantity = dependent(form_, phrase, "Quantity")) {
    if (const auto range = number_range(*quantity))
      return static_cast<std::int32_t>(std::max<std::size_t>(range->least, 1));
    return static_cast<std::int32_t>(std::min<std::size_t>(all, 3)); // several, many
  }
  const auto delimited = feature(phrase, "Delimitation");
  if (delimited == "all" || delimited == "both")
    return 0;
  if (delimited == "none" || delimited == "neither")
    throw Uninterpretable{Reason::word, phrase.proposition};
  if (delimited == "half")
    return static_cast<std::int32_t>((all + 1) / 2);
  if (delimited == "most")
    return static_cast<std::int32_t>(all / 2 + 1);
  if (!is_plural(phrase))
    return 1;
  return delimited.empty() ? 0 : static_cast<std::int32_t>(std::min<std::size_t>(all, 2));
}

/// "Take the thing next to the ball and put it behind it": the only other thing that is spoken of
/// before.
Things DirectiveThings::only_other_before(const Nominal& pronoun, const Things& patients) {
  std::set<std::string> others;
  for (const auto& x : form_.nominals)
    if (x.sort == "thing" && !is_pronoun(x) && is_definite_phrase(x) && !is_plural(x) &&
        place_of_word(x) < place_of_word(pronoun) && vocabulary().surroundings(x) == nullptr)
      for (const auto& id : all_but(evaluation_.meant(x), patients))
        others.insert(id);
  return others.size() == 1 ? Things{*others.begin()} : Things{};
}

/// Of several that will do, the nearest to what is put there.
Things DirectiveThings::nearest_of(const MeantThings& all, const Things& patients) const {
  auto result = all_but(all.things, patients);
  const auto own = patients.empty() ? std::nullopt : scene_.place(patients.front());
  if (own)
    std::ranges::stable_sort(result, {}, [&](const std::string& id) {
      const auto place = scene_.place(id);
      return place ? std::hypot(place->x - own->x, place->y - own->y) : 1e9;
    });
  if (std::ssize(result) > all.number)
    result.resize(static_cast<std::size_t>(all.number));
  return result;
}

Things DirectiveThings::landmarks_of(const Nominal& phrase, const Things& patients) {
  if (auto bottom = bottom_of_stack(phrase); !bottom.empty())
    return bottom;
  // "On itself": whoever knows what can be put where says why not.
  if (phrase.proposition == "itself")
    return patients;
  try {
    // "One ball left of the disc and one right of it."
    if (remaining_ && is_pronoun(phrase) && !is_plural(phrase) && landmarks_before_.size() == 1)
      return landmarks_before_;
    const auto before = of_step_before(phrase);
    if (before && before->things != patients)
      return before->things;
    if (before && !is_plural(phrase))
      if (auto other = only_other_before(phrase, patients); !other.empty())
        return other;
    const auto all = things_of(phrase);
    // "Put the red ball next to the ball."
    if (all.things == patients && !is_pronoun(phrase) && !is_plural(phrase))
      if (auto others = all_but(evaluation_.described(phrase).certain, patients);
          others.size() == 1)
        return others;
    return all.number > 0 ? nearest_of(all, patients) : all.things;
  } catch (const Uninterpretable& e) {
    if (e.reason != Reason::ambiguous || e.what != phrase.name || is_pronoun(phrase))
      throw;
    auto others = all_but(evaluation_.described(phrase).certain, patients);
    if (others.size() != 1)
      throw;
    return others;
  }
}

/// "The green one" is one of those that are put in the row.
Things DirectiveThings::ends_named(const Nominal& phrase, const Things& things) {
  const auto is_other = [&](const auto& id) {
    return std::ranges::find(things, id) == things.end();
  };
  std::optional<Uninterpretable> problem;
  try {
    if (auto named = landmarks_of(phrase, {}); std::ranges::none_of(named, is_other))
      return named;
  } catch (const Uninterpretable& e) {
    if (e.what != phrase.name)
      throw;
    problem = e;
  }
  auto form = with_thing_for(phrase);
  // "On the left" is where it is to stand.
  std::erase_if(find_nominal(form, phrase.name)->relations, [&](const NominalRelation& x) {
    const auto* place = find_nominal(form, x.dependent);
    return x.mode == "Location" && place != nullptr && dependent(form, *place, "Anchor") == nullptr;
  });
  auto like = Evaluation{form, antecedents_, scene_}.described(*find_nominal(form, phrase.name));
  std::erase_if(like.certain, is_other);
  if (like.certain.size() == 1)
    return like.certain;
  throw problem.value_or(Uninterpretable{Reason::nothing_like, phrase.name});
}

std::optional<Things> DirectiveThings::from_left(const Nominal& x, const Things& things) {
  const auto* left = dependent(form_, x, "Leftmost");
  const auto* middle = dependent(form_, x, "Middlemost");
  const auto* end = left != nullptr     ? left
                    : middle != nullptr ? middle
                                        : dependent(form_, x, "Rightmost");
  if (end == nullptr)
    return std::nullopt;
  const auto named = ends_named(*end, things);
  auto result = things;
  std::ranges::stable_sort(result, {}, [&](const std::string& id) {
    const auto place = scene_.place_in_view(id);
    return place ? place->x : 0.0;
  });
  const auto others = std::ranges::stable_partition(
    result, [&](const auto& id) { return std::ranges::find(named, id) != named.end(); });
  if (left != nullptr)
    return result;
  // To the end, or to the middle.
  const auto before = middle == nullptr ? std::ssize(others) : (std::ssize(others) + 1) / 2;
  std::ranges::rotate(result.begin(), others.begin(), others.begin() + before);
  return result;
}

MeantThings DirectiveThings::one_of_like(const Nominal& phrase) {
  try {
    return things(phrase);
  } catch (const Uninterpretable& e) {
    if (e.reason != Reason::ambiguous)
      throw;
    return {is_pronoun(phrase) ? scene_.things() : evaluation_.described(phrase).certain, 1};
  }
}

} // namespace castor::communication
