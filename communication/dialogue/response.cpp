#include "castor/communication/dialogue/response.hpp"

#include "castor/communication/dialogue/content.hpp"
#include "castor/communication/dialogue/descriptions.hpp"
#include "castor/communication/dialogue/referring_expression.hpp"
#include "castor/communication/parsing/hybrid_logic.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>
#include <utility>

namespace castor::communication {

namespace {

using binding::FeatureKind;
using binding::Truth;

/// Thrown where a question cannot be answered: this is to be said instead.
struct Objection {
  Response response;
};

Response say(RhetoricalRelation relation, LogicalForm content) {
  return {relation, {std::move(content)}, {}, {}};
}

bool is_negated(const Nominal& x) {
  return feature(x, "Polarity") == "neg";
}

bool is_plural(const Nominal& x) {
  return feature(x, "Number") == "pl";
}

/// Answers one move.
class Responder {
public:
  Responder(const DialogueMove& move, const Antecedents& antecedents, SceneKnowledge& scene)
    : form_(move.content), antecedents_(with_landmarks(move.content, antecedents, scene)),
      scene_(scene) {}

  Response to_question_w() {
    const auto* asked = dependent(form_, root(), "Wh-Restr");
    if (root().sort == "perception" && root().proposition == "see")
      return is_count(*asked) ? count(describe(*asked), *asked) : list(describe(*asked));
    if (root().sort == "existence")
      return count(describe(*asked), *asked);
    if (root().sort != "ascription")
      return not_understood(root().proposition);
    const auto* restriction = dependent(form_, root(), "Cop-Restr");
    const auto* scope = dependent(form_, root(), "Cop-Scope");
    if (restriction == nullptr || scope == nullptr)
      return not_understood("be");
    if (asked->sort == "region")
      return where(*restriction);
    if (asked->sort == "quality")
      return quality(asked->proposition, asked == restriction ? *scope : *restriction);
    // "What is the colour of the ball?"
    const auto* other = asked == restriction ? scope : restriction;
    if (asked->sort == "entity" && other->sort == "quality") {
      const auto* owner = dependent(form_, *other, "Owner");
      if (owner == nullptr)
        return not_understood(other->proposition);
      return other->proposition == "number" ? count(describe(*owner), *owner)
                                            : quality(other->proposition, *owner);
    }
    // "What is this?"
    if (asked == scope && restriction->sort == "thing")
      return what(*restriction);
    auto described = describe_as(*asked, *scope);
    if (is_count(*asked))
      return count(described, *asked, scope);
    return list(described);
  }

  Response to_question_yn() {
    if (root().sort == "conjunction")
      return not_understood(root().proposition);
    const auto* subject = dependent(form_, root(), "Subject");
    if (root().sort == "perception" && root().proposition == "see")
      subject = dependent(form_, root(), "Patient");
    if (subject != nullptr)
      return existence(*subject);
    const auto* restriction = dependent(form_, root(), "Cop-Restr");
    const auto* scope = dependent(form_, root(), "Cop-Scope");
    if (restriction == nullptr || scope == nullptr)
      return not_understood(root().proposition);
    if (scope->sort == "comparison" && restriction->sort == "quality")
      return compare_numbers(*restriction, *scope);
    if (scope->sort == "comparison" && restriction->sort == "conjunction")
      return compare_both(*restriction, *scope);
    return yes_or_no(*restriction, *scope);
  }

  Response to_assertion() {
    const auto* restriction = dependent(form_, root(), "Cop-Restr");
    const auto* scope = dependent(form_, root(), "Cop-Scope");
    if (root().sort == "existence") {
      if (const auto* subject = dependent(form_, root(), "Subject"))
        return candidates(describe(*subject)).possible.empty() != is_negated(root())
                 ? say(RhetoricalRelation::correction, nothing_like(*subject))
                 : accept();
      return accept();
    }
    if (root().sort != "ascription" || restriction == nullptr || scope == nullptr ||
        restriction->sort != "thing")
      return accept();
    if (is_negated(root()))
      return accept();
    auto meant = candidates(describe(*restriction)).best();
    auto fitting = candidates(describe_as(*restriction, *scope)).possible;
    if (!fitting.empty() || (is_deictic(*restriction) && meant.empty()))
      return accept();
    if (meant.size() == 1)
      return say(RhetoricalRelation::correction,
                 with_marker("no", as_it_is(meant.front(), *scope)));
    if (!is_pronoun(*restriction) && meant.empty())
      return say(RhetoricalRelation::correction, nothing_like(*restriction));
    return scope->sort == "thing" ? say(RhetoricalRelation::correction, nothing_like(*scope))
                                  : accept();
  }

  /// There is nobody yet who does what is asked for.
  Response to_directive() {
    for (const auto* thing : things_spoken_of(form_))
      if (is_definite(*thing) && !is_plural(*thing))
        the_one(*thing);
    return say(RhetoricalRelation::answer, i_cannot_do_that());
  }

private:
  const Nominal& root() const { return *find_nominal(form_, form_.root); }

  static bool is_count(const Nominal& x) {
    return std::any_of(x.relations.begin(), x.relations.end(),
                       [](auto& relation) { return relation.mode == "Quantity"; });
  }

  // -- what is described

  PhraseMeaning describe(const Nominal& phrase) {
    return checked(communication::describe(form_, phrase, antecedents_));
  }

  PhraseMeaning describe_as(const Nominal& phrase, const Nominal& scope) {
    return checked(communication::describe_as(form_, phrase, scope, antecedents_));
  }

  PhraseMeaning checked(PhraseMeaning meaning) const {
    if (!meaning.not_understood.empty())
      throw Objection{not_understood(meaning.not_understood.front())};
    return meaning;
  }

  Candidates candidates(const PhraseMeaning& meaning) {
    return scene_.candidates(form_, meaning, antecedents_);
  }

  /// The thing that is meant by a definite phrase.
  std::string the_one(const Nominal& phrase) {
    auto found = candidates(describe(phrase));
    if (!scene_.open_questions().empty())
      return {};
    if (found.certain.empty() && found.possible.size() != 1)
      throw Objection{say(RhetoricalRelation::correction, nothing_like(phrase))};
    if (found.certain.size() > 1) {
      auto question =
        say(RhetoricalRelation::clarification_question, which(part_of(form_, name_of(phrase))));
      question.asked_about = phrase.name;
      throw Objection{std::move(question)};
    }
    return found.best().front();
  }

  /// Pronouns are asked back about as things.
  std::string name_of(const Nominal& phrase) {
    if (is_pronoun(phrase))
      find(phrase.name).proposition = "thing";
    return phrase.name;
  }

  Nominal& find(const std::string& name) {
    return *std::find_if(form_.nominals.begin(), form_.nominals.end(),
                         [&name](auto& x) { return x.name == name; });
  }

  // -- replies

  static Response accept() { return say(RhetoricalRelation::acceptance, marker("ok")); }

  static Response not_understood(const std::string& word) {
    return {RhetoricalRelation::clarification_question,
            {},
            "I do not know what '" + word + "' means here.",
            {}};
  }

  static Response answer(LogicalForm content) {
    return say(RhetoricalRelation::answer, std::move(content));
  }

  static Response do_not_know() { return answer(i_do_not_know()); }

  static Response truth(Truth x) {
    return x == Truth::unknown ? do_not_know() : answer(marker(x == Truth::yes ? "yes" : "no"));
  }

  LogicalForm nothing_like(const Nominal& phrase) {
    return i_do_not_see(part_of(form_, name_of(phrase)));
  }

  /// "It is blue", in the terms of what was said of it.
  LogicalForm as_it_is(const std::string& id, const Nominal& scope) {
    auto kind = kind_of_quality(scope.sort);
    auto words = kind ? scene_.words(id, *kind) : std::vector<std::string>{};
    return ascribe(pronoun("it"), words.empty() || kind == FeatureKind::shape
                                    ? indefinite_description(scene_, id)
                                    : property(scope.sort, words.front()));
  }

  // -- questions

  Response quality(const std::string& name, const Nominal& of) {
    if (name == "name" || name == "kind")
      return what(of);
    auto kind = kind_of_quality(name);
    if (of.sort != "thing" || !kind)
      return not_understood(name);
    auto id = the_one(of);
    auto words = scene_.words(id, *kind);
    if (words.empty())
      return do_not_know();
    return answer(ascribe(pronoun("it"), kind == FeatureKind::shape
                                           ? indefinite(words.front())
                                           : property(name, words.front())));
  }

  Response what(const Nominal& thing) {
    return answer(ascribe(pronoun("it"), indefinite_description(scene_, the_one(thing))));
  }

  Response where(const Nominal& thing) {
    auto facts = scene_.spatial_facts(the_one(thing));
    auto it = pronoun("it");
    if (facts.empty())
      return answer(ascribe(it, region("on", definite("table"))));
    auto best =
      std::find_if(facts.begin(), facts.end(), [](auto& fact) { return fact.relation != "near"; });
    auto& fact = best == facts.end() ? facts.front() : *best;
    return answer(ascribe(it, region(fact.relation, referring_expression(scene_, fact.landmark))));
  }

  Response count(const PhraseMeaning& meaning, const Nominal& phrase,
                 const Nominal* scope = nullptr) {
    auto thing = part_of(form_, phrase.name);
    if (scope != nullptr && scope->sort == "region")
      thing = with(std::move(thing), "Location", part_of(form_, scope->name));
    return answer(exists(counted(candidates(meaning).certain.size(), std::move(thing))));
  }

  Response list(const PhraseMeaning& meaning) {
    auto found = candidates(meaning);
    auto& things = found.best();
    if (things.empty())
      return answer(exists(none_of(indefinite("thing"))));
    Response result{RhetoricalRelation::answer, {}, {}, {}};
    for (auto& id : things)
      result.contents.push_back(exists(indefinite_description(scene_, id)));
    return result;
  }

  Response existence(const Nominal& subject) {
    if (const auto* quantity = dependent(form_, subject, "Quantity")) {
      if (quantity->sort == "comparison")
        return compare_counts(subject, *quantity);
      auto found = candidates(describe(subject)).certain.size();
      return truth(counted(found, pronoun("it")).nominals.back().proposition ==
                       quantity->proposition
                     ? Truth::yes
                     : Truth::no);
    }
    auto found = candidates(describe(subject));
    auto exists_some = !found.certain.empty()    ? Truth::yes
                       : !found.possible.empty() ? Truth::unknown
                                                 : Truth::no;
    if (feature(subject, "Delimitation") == "none" && exists_some != Truth::unknown)
      exists_some = exists_some == Truth::yes ? Truth::no : Truth::yes;
    return truth(exists_some);
  }

  Response yes_or_no(const Nominal& restriction, const Nominal& scope) {
    if (restriction.sort != "thing")
      return not_understood(restriction.proposition);
    auto such = candidates(describe_as(restriction, scope));
    if (!is_definite(restriction) || is_plural(restriction))
      return all(candidates(describe(restriction)).best(), such);
    auto id = the_one(restriction);
    if (contains(such.certain, id))
      return truth(Truth::yes);
    if (contains(such.possible, id))
      return do_not_know();
    // What it is instead is worth telling.
    if (auto kind = kind_of_quality(scope.sort); kind && !scene_.words(id, *kind).empty())
      return answer(with_marker("no", as_it_is(id, scope)));
    return truth(Truth::no);
  }

  Response all(const std::vector<std::string>& things, const Candidates& such) {
    auto result = things.empty() ? Truth::no : Truth::yes;
    for (auto& id : things)
      if (!contains(such.possible, id))
        return truth(Truth::no);
      else if (!contains(such.certain, id))
        result = Truth::unknown;
    return truth(result);
  }

  Response compare(const std::string& how, std::size_t a, std::size_t b) {
    const bool is_so = how == "more" || how == "greater"    ? a > b
                       : how == "fewer" || how == "smaller" ? a < b
                                                            : a == b;
    return truth(is_so ? Truth::yes : Truth::no);
  }

  /// "Are there more cubes than balls?"
  Response compare_counts(const Nominal& subject, const Nominal& quantity) {
    const auto* other = dependent(form_, quantity, "Than");
    // "An equal number of cubes and balls".
    if (other == nullptr && subject.sort == "conjunction") {
      const auto* first = dependent(form_, subject, "First");
      const auto* next = dependent(form_, subject, "Next");
      if (first == nullptr || next == nullptr)
        return not_understood(quantity.proposition);
      return compare(quantity.proposition, number_of(*first), number_of(*next));
    }
    if (other == nullptr)
      return not_understood(quantity.proposition);
    return compare(quantity.proposition, number_of(subject), number_of(*other));
  }

  std::size_t number_of(const Nominal& things) {
    return candidates(describe(things)).certain.size();
  }

  /// "Is the number of balls greater than the number of cubes?"
  Response compare_numbers(const Nominal& restriction, const Nominal& scope) {
    const auto* than = dependent(form_, scope, "Than");
    const auto* a = dependent(form_, restriction, "Owner");
    const auto* b = than == nullptr ? nullptr : dependent(form_, *than, "Owner");
    if (a == nullptr || b == nullptr || restriction.proposition != "number")
      return not_understood(scope.proposition);
    return compare(scope.proposition, number_of(*a), number_of(*b));
  }

  /// "Do the cube and the ball have the same colour?"
  Response compare_both(const Nominal& things, const Nominal& scope) {
    const auto* first = dependent(form_, things, "First");
    const auto* next = dependent(form_, things, "Next");
    const auto* of = dependent(form_, scope, "Quality");
    if (first == nullptr || next == nullptr || of == nullptr || first->sort != "thing" ||
        next->sort != "thing" || scope.proposition != "same")
      return not_understood(scope.proposition);
    auto kind = kind_of_quality(of->proposition);
    if (!kind)
      return do_not_know();
    auto a = scene_.words(the_one(*first), *kind);
    auto b = scene_.words(the_one(*next), *kind);
    if (a.empty() || b.empty())
      return do_not_know();
    return truth(std::find_first_of(a.begin(), a.end(), b.begin(), b.end()) != a.end() ? Truth::yes
                                                                                       : Truth::no);
  }

  static bool contains(const std::vector<std::string>& all, const std::string& one) {
    return std::find(all.begin(), all.end(), one) != all.end();
  }

  LogicalForm form_;
  const Antecedents antecedents_;
  SceneKnowledge& scene_;
};

} // namespace

DialogueMove clarified(DialogueMove move, const std::string& nominal, const LogicalForm& fragment) {
  const std::string prefix = "clarified-";
  auto asked = std::find_if(move.content.nominals.begin(), move.content.nominals.end(),
                            [&nominal](auto& x) { return x.name == nominal; });
  const auto* said = find_nominal(fragment, fragment.root);
  if (asked == move.content.nominals.end() || said == nullptr)
    return move;
  // "The red one" is about what was asked about; "the ball" says that it is a ball.
  if (said->proposition != "one" && said->proposition != "thing")
    asked->proposition = said->proposition;
  for (auto& relation : said->relations)
    asked->relations.push_back({relation.mode, prefix + relation.dependent});
  for (auto x : fragment.nominals) {
    x.name = prefix + x.name;
    for (auto& relation : x.relations)
      relation.dependent = prefix + relation.dependent;
    move.content.nominals.push_back(std::move(x));
  }
  return move;
}

Response respond(const DialogueMove& move, const Antecedents& antecedents, SceneKnowledge& scene) {
  if (!move.problem.empty())
    return {RhetoricalRelation::clarification_question, {}, move.problem, {}};
  Responder responder{move, antecedents, scene};
  try {
    switch (move.type) {
      case DialogueMoveType::question_w:
        return responder.to_question_w();
      case DialogueMoveType::question_yn:
        return responder.to_question_yn();
      case DialogueMoveType::assertion:
        return responder.to_assertion();
      case DialogueMoveType::action_directive:
        return responder.to_directive();
      case DialogueMoveType::opening:
        return say(RhetoricalRelation::greeting, greeting("hello"));
      case DialogueMoveType::closing:
        return say(RhetoricalRelation::greeting, closing("bye"));
      case DialogueMoveType::none:
        return {RhetoricalRelation::clarification_question, {}, "What about it?", {}};
      default:
        return {};
    }
  } catch (Objection& objection) {
    return std::move(objection.response);
  }
}

} // namespace castor::communication
