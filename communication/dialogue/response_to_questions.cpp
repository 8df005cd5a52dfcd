#include "castor/communication/dialogue/content.hpp"
#include "castor/communication/dialogue/descriptions.hpp"
#include "castor/communication/dialogue/referring_expression.hpp"
#include "castor/communication/dialogue/responder.hpp"
#include "castor/communication/parsing/hybrid_logic.hpp"

#include <algorithm>
#include <set>
#include <utility>

namespace castor::communication {

namespace {

using binding::FeatureKind;

Nominal affirmed(Nominal x) {
  std::erase_if(x.features, [](auto& feature) { return feature.name == "Polarity"; });
  return x;
}

/// Its attribute that says what the scope of an ascription says; null if there is none.
const char* attribute_mode(const Nominal& scope) {
  if (is_negated(scope))
    return nullptr;
  if (scope.sort == "region")
    return "Location";
  if (scope.sort == "colour")
    return "Colour";
  if (scope.sort == "size")
    return "Size";
  if (scope.sort == "material")
    return "Material";
  return scope.sort == "shape" ? "Shape" : nullptr;
}

} // namespace

/// "The number of balls", "its colour", "its colour and size".
Response Responder::owned_quality(const Nominal& x) {
  auto& owner = need(x, "Owner");
  if (x.sort == "conjunction")
    return quality(x, owner);
  if (x.proposition == "number")
    return count(evaluation_.described(owner), owner, nullptr);
  return quality(x.proposition, owner);
}

/// One or several qualities of something.
Response Responder::quality(const Nominal& asked, const Nominal& of) {
  if (asked.sort != "conjunction")
    return quality(asked.proposition, of);
  auto result = quality(need(asked, "First"), of);
  auto next = quality(need(asked, "Next"), of);
  for (auto& sentence : next.sentences)
    result.sentences.push_back(std::move(sentence));
  return result;
}

Response Responder::to_question_w() {
  if (root().sort == "quality")
    return owned_quality(root());
  auto& asked = need(root(), "Wh-Restr");
  const auto is_quality = [this](const Nominal& x) {
    const auto* first = x.sort == "conjunction" ? dependent(form_, x, "First") : &x;
    return first != nullptr && first->sort == "quality";
  };
  if (root().sort == "existence" && is_quality(asked))
    return dependent(form_, asked, "Owner") == nullptr ? values_seen(asked) : owned_quality(asked);
  if (const auto* common = commonest_quality(asked))
    return most_common(*common);
  if (asked.sort == "person" || asked.proposition == "who")
    return answer(i_do_not_know());
  // "Which shape is there most of?"
  if (const auto* subject = dependent(form_, root(), "Subject");
      subject != nullptr && dependent(form_, *subject, "PartOf") == &asked)
    throw Uninterpretable{Uninterpretable::Reason::word, subject->proposition};
  if (root().sort != "ascription")
    return about(asked);
  const auto* restriction = dependent(form_, root(), "Cop-Restr");
  const auto* scope = dependent(form_, root(), "Cop-Scope");
  if (restriction == nullptr || scope == nullptr)
    throw Uninterpretable{Uninterpretable::Reason::word, root().proposition};
  const bool asks_for_scope = asked.name == scope->name;
  // "What colour is the ball, apart from the cube?"
  if (const auto* excepted = dependent(form_, root(), "Except");
      excepted != nullptr && asks_for_scope && is_definite(*restriction))
    throw Uninterpretable{Uninterpretable::Reason::word, excepted->proposition};
  const auto& other = asks_for_scope ? *restriction : *scope;
  if (asked.sort == "region")
    return where(other);
  if (asked.sort == "way")
    return way_to(other);
  // "How many shapes are not squares?" asks for no quality of something.
  if (is_quality(asked) && asks_for_number(asked) && other.sort != "region")
    throw Uninterpretable{Uninterpretable::Reason::word, asked.proposition};
  // "Which colours are on the left?"
  if (is_quality(asked) && other.sort == "region")
    return values_seen(asked, &other);
  if (is_quality(asked))
    return quality(asked, other);
  if ((asked.sort == "entity" || asked.proposition == "one") && is_quality(other) &&
      dependent(form_, other, "Owner") != nullptr) {
    // "What is the colour of the ball?", "which is the colour of the ball?"
    return owned_quality(other);
  }
  // "What is the ball made of?"
  if (other.sort == "composition" || restriction->sort == "composition" ||
      scope->sort == "composition")
    throw Uninterpretable{Uninterpretable::Reason::word, "made of"};
  // "Which thing has the cube behind it?" does not ask what the cube has.
  if (root().proposition == "have" && asks_for_scope)
    throw Uninterpretable{Uninterpretable::Reason::word, "have"};
  // "What is not a cube?"
  if (asks_for_scope && is_negated(root()) && other.sort == "thing" && !is_definite(other)) {
    Fitting others;
    for (auto& id : scene_.things())
      others.add(id, negation(evaluation_.is(id, other)));
    return list(others.best());
  }
  // "What is this?", "which is the largest thing?"
  if (asked.sort == "entity" && other.sort == "thing" && !is_negated(root()) &&
      root().proposition == "be" && (is_definite(other) || asks_for_scope))
    return what(other);
  return about(asked);
}

/// Of which things the whole question is true.
Response Responder::about(const Nominal& asked) {
  auto found = evaluation_.answers(root(), asked);
  if (auto where = where_it_is(found, asked))
    return answer(std::move(*where));
  if (root().sort == "existence" && is_number(asked))
    return some_of(found, asked);
  const auto* scope = root().sort == "ascription" ? dependent(form_, root(), "Cop-Scope") : nullptr;
  if (asks_for_number(asked))
    return count(found, asked, scope);
  // "Which room is this?"
  const auto* subject =
    root().sort == "ascription" ? dependent(form_, root(), "Cop-Restr") : nullptr;
  for (const auto* shown : {subject, scope})
    if (shown != nullptr && shown != &asked && is_deictic(*shown) && found.certain.size() == 1 &&
        !scene_.is_thing(found.certain.front()))
      return what(*shown);
  // Of things that are as large as one another, any may be the largest.
  const bool is_about_order =
    scope != nullptr &&
    (scope->sort == "selection" || dependent(form_, *scope, "Selection") != nullptr);
  const bool is_tie = is_about_order && found.possible.size() > 1 &&
                      (asked.proposition == "one" || !evaluation_.described(asked).certain.empty());
  if (found.certain.empty() && !found.possible.empty() && !is_tie)
    return answer(i_do_not_know());
  const auto& things = found.certain.empty() ? found.possible : found.certain;
  // "The tallest" is one that everybody knows already.
  if (is_about_order && things.size() == 1 && scene_.is_thing(things.front()))
    return answer(ascribe(pronoun("it"), full_description(scene_, things.front())),
                  exists(indefinite_description(scene_, things.front())));
  return list(things);
}

/// "Which room are you in?": "I am in the kitchen."; "which room is the ball in?"
std::optional<LogicalForm> Responder::where_it_is(const Fitting& found, const Nominal& asked) {
  const auto* subject = dependent(form_, root(), "Cop-Restr");
  const auto* scope = dependent(form_, root(), "Cop-Scope");
  if (subject == nullptr || scope == nullptr || scope->sort != "region" ||
      dependent(form_, *scope, "Anchor") != &asked || is_negated(root()) ||
      asks_for_number(asked) || found.certain.size() != 1 || scene_.is_thing(found.certain.front()))
    return std::nullopt;
  const bool is_addressee = evaluation_.is_addressee(*subject);
  if (!is_addressee && (!is_definite(*subject) || is_plural(*subject)))
    return std::nullopt;
  return ascribe(is_addressee ? participant(*subject) : pronoun("it"),
                 region(scope->proposition, referring_expression(scene_, found.certain.front())));
}

/// Whether it is said how many are asked for: "two red things".
bool Responder::is_number(const Nominal& asked) const {
  const auto* quantity = dependent(form_, asked, "Quantity");
  return quantity != nullptr && feature(*quantity, "Bound").empty() &&
         number_range(*quantity).value_or(NumberRange{0}).least > 0;
}

/// "Name two red things": as many of them, or all if there are fewer.
Response Responder::some_of(const Fitting& found, const Nominal& asked) const {
  auto things = found.certain;
  if (things.empty() && !found.possible.empty())
    return answer(i_do_not_know());
  if (const auto range = number_range(need(asked, "Quantity")); things.size() > range->least)
    things.resize(range->least);
  return list(things);
}

Response Responder::count(const Fitting& found, const Nominal& phrase, const Nominal* scope) {
  const auto number = found.count();
  if (number.certain == 0 && number.possible > 0)
    return answer(i_do_not_know());
  if (auto share = share_of(number, phrase, scope))
    return answer(std::move(*share),
                  exists(counted(number, indefinite(vocabulary().general_concept()))));
  auto thing = part_of(form_, phrase.name);
  auto simpler = exists(counted(number, indefinite(vocabulary().general_concept())));
  const auto* mode = scope == nullptr ? nullptr : attribute_mode(*scope);
  if (mode != nullptr && !is_negated(root()))
    thing = with(std::move(thing), mode, part_of(form_, scope->name));
  else if (scope != nullptr)
    return answer(simpler);
  return answer(exists(counted(number, std::move(thing))), std::move(simpler));
}

/// "Two of the three cubes are red", if it is asked how many of them are.
std::optional<LogicalForm> Responder::share_of(const Count& number, const Nominal& phrase,
                                               const Nominal* scope) {
  const auto* whole = dependent(form_, phrase, "PartOf");
  if (whole == nullptr || scope == nullptr || scope->sort == "thing" || is_negated(root()) ||
      number.certain != number.possible || number.certain == 0 || is_pronoun(*whole) ||
      !is_definite(*whole))
    return std::nullopt;
  const auto all = evaluation_.meant(*whole).size();
  if (number.certain >= all)
    return std::nullopt;
  auto part = indefinite("one");
  part.nominals.front().features = {{"Number", number.certain == 1 ? "sg" : "pl"}};
  auto those = counted(all, part_of(form_, whole->name));
  those.nominals.front().features.push_back({"Delimitation", "unique"});
  part = with(std::move(part), "PartOf", those);
  part = with(std::move(part), "Quantity", property("number", number_word(number.certain)));
  return ascribe(part, part_of(form_, scope->name));
}

/// "What are you holding?"
bool Responder::asks_what_is_held() const {
  const auto* place = dependent(form_, root(), "Cop-Scope");
  const auto* holder = place == nullptr ? nullptr : dependent(form_, *place, "Anchor");
  return holder != nullptr && place->proposition == "in" && holder->proposition == "gripper" &&
         feature(*holder, "Whose") == "yours";
}

Response Responder::list(const Things& things) const {
  if (things.empty())
    return answer(exists(none_of(indefinite(vocabulary().general_concept()))));
  std::vector<LogicalForm> descriptions;
  for (auto& id : things)
    descriptions.push_back(indefinite_description(scene_, id));
  if (descriptions.size() == 1 && asks_what_is_held())
    return answer(ascribe(pronoun("it"), descriptions.front()));
  return answer(exists(listed(std::move(descriptions))),
                exists(counted(things.size(), indefinite(vocabulary().general_concept()))));
}

Response Responder::quality(const std::string& name, const Nominal& of) {
  if (name == "name" || name == "kind")
    return what(of);
  auto kind = vocabulary().kind_of_quality(name);
  if (!kind)
    throw Uninterpretable{Uninterpretable::Reason::word, name};
  // "What colour do most things have?" is no question of what all of them are.
  if (const auto part = feature(of, "Delimitation"); part == "most" || part == "half")
    throw Uninterpretable{Uninterpretable::Reason::unknown, of.name};
  Things things;
  if (of.sort == "conjunction")
    things = evaluation_.members(of);
  else if (feature(of, "Delimitation") == "all")
    things = evaluation_.described(of).certain;
  else
    things = evaluation_.meant(of);
  if (things.size() > 1)
    return qualities(things, of, name, *kind);
  Response result{RhetoricalRelation::answer, {}, {}, {}};
  for (auto& id : things) {
    auto words = scene_.words(id, *kind);
    auto thing = pronoun("it");
    if (words.empty())
      return answer(i_do_not_know());
    const bool has_noun =
      *kind == FeatureKind::shape && !vocabulary().noun_of_shape(words.front()).empty();
    auto value = has_noun ? indefinite(words.front()) : property(name, words.front());
    auto sentence = ascribe(thing, value);
    result.sentences.push_back(
      {scene_.is_sure(id, *kind) ? std::move(sentence) : unsure(std::move(sentence))});
  }
  return result;
}

/// "Both are red", "the large cube is red. The small cube is green.", or "they are red and green"
/// if nothing else tells them apart.
Response Responder::qualities(const Things& things, const Nominal& of, const std::string& name,
                              FeatureKind kind) {
  std::vector<std::string> values;
  std::set<std::string> distinct;
  bool is_sure = true;
  for (auto& id : things) {
    auto words = scene_.words(id, kind);
    if (words.empty())
      return answer(i_do_not_know());
    values.push_back(words.front());
    distinct.insert(words.front());
    is_sure = is_sure && scene_.is_sure(id, kind);
  }
  auto value_of = [&](const std::string& word) {
    return kind == FeatureKind::shape ? indefinite(word) : property(name, word);
  };
  auto said = [&](LogicalForm sentence) {
    return is_sure ? std::move(sentence) : unsure(std::move(sentence));
  };
  // "What colour is that?", after several things were spoken of, asks for the one that they have.
  if (distinct.size() > 1 && is_pronoun(of) && !is_plural(of))
    throw Uninterpretable{Uninterpretable::Reason::ambiguous, of.name};
  if (distinct.size() == 1) {
    auto value = kind == FeatureKind::shape ? plural(values.front()) : value_of(values.front());
    return answer(said(ascribe(all_of_them(things.size()), value)));
  }
  Response result{RhetoricalRelation::answer, {}, {}, {}};
  for (std::size_t i = 0; i < things.size(); ++i)
    if (auto thing = definite_description(scene_, things[i], kind))
      result.sentences.push_back({said(ascribe(*thing, value_of(values[i])))});
  if (result.sentences.size() == things.size())
    return result;
  std::vector<LogicalForm> all;
  for (auto& word : distinct)
    all.push_back(value_of(word));
  return answer(said(ascribe(pronoun("they"), listed(std::move(all)))));
}

Response Responder::what(const Nominal& phrase) {
  auto things = evaluation_.meant(phrase);
  if (things.size() != 1)
    return list(things);
  auto& id = things.front();
  auto sentence = ascribe(pronoun("it"), indefinite_description(scene_, id));
  const bool is_sure =
    scene_.is_sure(id, FeatureKind::shape) && scene_.is_sure(id, FeatureKind::colour);
  return answer(is_sure ? std::move(sentence) : unsure(std::move(sentence)));
}

Response Responder::where(const Nominal& phrase) {
  const bool is_addressee = evaluation_.is_addressee(phrase);
  // Where people are, nobody tells.
  if (phrase.sort == "person" && !is_addressee)
    return answer(i_do_not_know());
  Response result{RhetoricalRelation::answer, {}, {}, {}};
  // "Where do you see a cube?" asks for all of them.
  const bool is_any = phrase.sort == "thing" && !is_definite_phrase(phrase);
  auto things = phrase.sort == "conjunction" ? evaluation_.members(phrase)
                : is_any                     ? evaluation_.described(phrase).certain
                                             : evaluation_.meant(phrase);
  if (things.empty())
    throw Uninterpretable{Uninterpretable::Reason::nothing_like, phrase.name};
  for (auto& id : things) {
    auto thing = is_addressee         ? participant(phrase)
                 : things.size() == 1 ? pronoun("it")
                                      : referring_expression(scene_, id);
    const auto place = place_of(id);
    if (!place)
      return answer(i_do_not_know());
    // Beside each other, none of many things would be anywhere.
    constexpr std::size_t many = 3;
    const auto sides = things.size() < many || is_on_another(id) ? std::vector<std::string>{}
                                                                 : evaluation_.sides_of(id);
    if (sides.empty())
      result.sentences.push_back({ascribe(thing, *place)});
    else
      result.sentences.push_back({ascribe(thing, region(sides)), ascribe(thing, *place)});
  }
  return result;
}

/// Whether it stands on another thing.
bool Responder::is_on_another(const std::string& id) {
  const auto facts = scene_.spatial_facts(id);
  return std::ranges::find(facts, "on", &SpatialFact::relation) != facts.end();
}

/// Where an individual is, by what it is in, or by what is near; nothing if nobody tells.
std::optional<LogicalForm> Responder::place_of(const std::string& id) {
  // "Where is this room?", if the robot is in it.
  for (auto& self : scene_.addressee())
    if (const auto around = scene_.surroundings(self);
        std::ranges::find(around, id) != around.end())
      return region("here");
  if (const auto around = scene_.surroundings(id); !around.empty())
    return region(binding::containment_label, referring_expression(scene_, around.front()));
  auto facts = scene_.spatial_facts(id);
  // What it stands on says more than what it is beside.
  auto best = std::ranges::find(facts, "on", &SpatialFact::relation);
  // What is no thing lies where somebody says so of it, not where it seems by its place.
  if (best == facts.end())
    best = std::ranges::find_if(facts, [](auto& fact) { return fact.relation != "near"; });
  if (best == facts.end())
    best = facts.begin();
  if (best != facts.end())
    return region(best->relation, referring_expression(scene_, best->landmark));
  const auto* everywhere = vocabulary().main_surroundings();
  if (!scene_.is_thing(id) || everywhere == nullptr)
    return std::nullopt;
  return region(everywhere->regions.front(), definite(everywhere->noun));
}

// -- yes or no

Response Responder::yes_or_no(Truth truth) {
  if (truth == Truth::unknown)
    return answer(i_do_not_know());
  return answer(marker(truth == Truth::yes ? "yes" : "no"));
}

Response Responder::to_question_yn() {
  const auto* restriction = dependent(form_, root(), "Cop-Restr");
  const auto* scope = dependent(form_, root(), "Cop-Scope");
  // "The red balls, right?" says nothing of them.
  if (root().sort == "existence" && feature(root(), "Fragment") == "true")
    if (const auto& subject = need(root(), "Subject"); is_definite_phrase(subject))
      throw Uninterpretable{Uninterpretable::Reason::word, subject.proposition};
  // "Is it red or is it blue?"
  if (root().sort == "conjunction" && root().proposition == "or")
    return choice_of_clauses();
  // "Is it red or blue?"
  if (root().sort == "ascription" && restriction != nullptr && scope != nullptr &&
      scope->sort == "conjunction" && scope->proposition == "or" && is_definite(*restriction) &&
      !is_plural(*restriction))
    return choice(*restriction, *scope);
  // "Isn't it red?" asks whether it is; "it is not red, right?", whether it is not.
  const bool is_negative = is_negated(root());
  const bool is_literal = feature(root(), "Literal") == "true";
  auto truth = evaluation_.clause(is_negative && !is_literal ? affirmed(root()) : root());
  if (truth == Truth::no && !is_negative &&
      evaluation_.clause_with_wide_sides(root()) == Truth::yes)
    return partly();
  if (truth == Truth::unknown) {
    // What vision has no word for may be there, but it is not seen.
    const auto* subject =
      root().sort == "existence" ? dependent(form_, root(), "Subject") : nullptr;
    if (subject != nullptr && subject->sort == "thing" && !is_pronoun(*subject) &&
        !vocabulary().is_perceptible(subject->proposition))
      return answer(nothing_like(*subject), i_do_not_see(indefinite(subject->proposition)));
    return yes_or_no(truth);
  }
  if (root().sort != "ascription" || restriction == nullptr || scope == nullptr ||
      !is_definite(*restriction) || is_plural(*restriction) || restriction->sort != "thing" ||
      !feature(*restriction, "Focus").empty())
    return yes_or_no(truth);
  auto things = evaluation_.meant(*restriction);
  if (truth == Truth::yes && things.size() == 1 && !is_sure(things.front(), *scope))
    return answer(unsure(ascribe(pronoun("it"), part_of(form_, scope->name))), marker("yes"));
  if (truth == Truth::no && things.size() == 1 && vocabulary().kind_of_quality(scope->sort) &&
      !is_negated(*scope) &&
      !scene_.words(things.front(), *vocabulary().kind_of_quality(scope->sort)).empty())
    return answer(denied(things.front(), *scope));
  if (is_negative)
    return answer(with_marker(truth == Truth::yes ? "yes" : "no",
                              ascribe(pronoun("it"), part_of(form_, scope->name),
                                      (truth == Truth::yes) != is_literal)),
                  marker(truth == Truth::yes ? "yes" : "no"));
  return yes_or_no(truth);
}

/// "Is the ball left of the cube?", where it is rather behind it: "Partly. It is behind the cube."
/// "Is anything behind the cube?": what there is.
Response Responder::partly() {
  const auto* subject = dependent(form_, root(), "Cop-Restr");
  const auto* scope = dependent(form_, root(), "Cop-Scope");
  const auto* anchor = scope == nullptr ? nullptr : dependent(form_, *scope, "Anchor");
  const auto* asked = root().sort == "existence" ? dependent(form_, root(), "Subject") : subject;
  if (asked != nullptr && !is_definite_phrase(*asked))
    return list(evaluation_.answers(root(), *asked).certain);
  if (subject == nullptr || anchor == nullptr || !is_definite_phrase(*subject) ||
      !is_definite_phrase(*anchor) || is_plural(*subject) || is_plural(*anchor))
    return yes_or_no(Truth::yes);
  Response result{RhetoricalRelation::answer, {}, {}, {}};
  result.sentences.push_back({marker("partly")});
  const auto landmarks = evaluation_.meant(*anchor);
  for (const auto& id : evaluation_.meant(*subject))
    for (const auto& fact : scene_.spatial_facts(id))
      if (result.sentences.size() == 1 && fact.relation != "near" &&
          std::ranges::find(landmarks, fact.landmark) != landmarks.end())
        result.sentences.push_back({ascribe(
          pronoun("it"), region(fact.relation, referring_expression(scene_, fact.landmark)))});
  return result;
}

/// Whether what a scope says of a thing is certain.
bool Responder::is_sure(const std::string& id, const Nominal& scope) const {
  auto kind = scope.sort == "thing" ? FeatureKind::shape : vocabulary().kind_of_quality(scope.sort);
  return !kind || scene_.is_sure(id, *kind);
}

/// Says which of them is so.
Response Responder::choice(const Nominal& subject, const Nominal& alternatives) {
  auto things = evaluation_.meant(subject);
  if (things.empty())
    return answer(i_do_not_know());
  auto& id = things.front();
  std::vector<const Nominal*> so;
  bool is_clear = true;
  for (const auto* rest = &alternatives; rest != nullptr;) {
    const bool is_last = rest->sort != "conjunction" || rest->proposition != "or";
    const auto& one = is_last ? *rest : need(*rest, "First");
    auto truth = evaluation_.is(id, one, &subject);
    is_clear = is_clear && truth != Truth::unknown;
    if (truth == Truth::yes)
      so.push_back(&one);
    rest = is_last ? nullptr : &need(*rest, "Next");
  }
  if (so.empty() && !is_clear)
    return answer(i_do_not_know());
  if (so.empty()) {
    const auto& first = need(alternatives, "First");
    // "Is it to the left or to the right of the ball?": where it is instead.
    const auto place = first.sort == "region" ? place_of(id) : std::nullopt;
    return place ? answer(ascribe(pronoun("it"), *place), marker("no"))
                 : answer(denied(id, first), marker("no"));
  }
  Response result{RhetoricalRelation::answer, {}, {}, {}};
  for (const auto* one : so) {
    auto sentence = ascribe(pronoun("it"), part_of(form_, one->name));
    if (!is_sure(id, *one))
      sentence = unsure(std::move(sentence));
    else if (feature(alternatives, "Coordination") == "either")
      sentence = with_marker("yes", std::move(sentence));
    result.sentences.push_back({std::move(sentence), marker("yes")});
  }
  return result;
}

/// Says which of two clauses is so.
Response Responder::choice_of_clauses() {
  Response result{RhetoricalRelation::answer, {}, {}, {}};
  bool is_clear = true;
  for (const auto* mode : {"First", "Next"}) {
    auto& one = need(root(), mode);
    const auto truth = evaluation_.clause(one);
    is_clear = is_clear && truth != Truth::unknown;
    if (truth != Truth::yes)
      continue;
    auto said = part_of(form_, one.name);
    for (auto& x : said.nominals)
      if (x.name == said.root) {
        std::erase_if(x.features, [](auto& y) { return y.name == "Mood"; });
        std::erase_if(x.relations, [](auto& y) { return y.mode == "Topic"; });
      }
    said = part_of(said, said.root);
    result.sentences.push_back({std::move(said), marker("yes")});
  }
  if (!result.sentences.empty())
    return result;
  return is_clear ? answer(marker("no")) : answer(i_do_not_know());
}

/// "No, it is blue", or "I think it is blue" if that is not certain.
LogicalForm Responder::denied(const std::string& id, const Nominal& scope) const {
  auto sentence = as_it_is(id, pronoun("it"), scope);
  return is_sure(id, scope) ? with_marker("no", std::move(sentence)) : unsure(std::move(sentence));
}

/// "It is blue", in the terms of what was said of it.
LogicalForm Responder::as_it_is(const std::string& id, const LogicalForm& what,
                                const Nominal& scope) const {
  auto kind = vocabulary().kind_of_quality(scope.sort);
  auto words = kind ? scene_.words(id, *kind) : std::vector<std::string>{};
  return ascribe(what, words.empty() || kind == FeatureKind::shape
                         ? indefinite_description(scene_, id)
                         : property(scope.sort, words.front()));
}

} // namespace castor::communication
