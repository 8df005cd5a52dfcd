#include "castor/communication/dialogue/question_context.hpp"

#include "castor/communication/dialogue/clause_parts.hpp"
#include "castor/communication/dialogue/content.hpp"
#include "castor/communication/dialogue/descriptions.hpp"
#include "castor/communication/dialogue/dialogue_move.hpp"
#include "castor/communication/dialogue/directive.hpp"
#include "castor/communication/dialogue/proposals.hpp"
#include "castor/communication/dialogue/respond.hpp"
#include "castor/communication/parsing/hybrid_logic.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>
#include <vector>

namespace castor::communication {

namespace {

/// "There is a ball on the table. Which one?" asks of no other table.
bool is_about_surroundings(const LogicalForm& form, const Vocabulary& vocabulary) {
  const auto* root = find_nominal(form, form.root);
  const auto* topic =
    root == nullptr ? nullptr
                    : dependent(form, *root, root->sort == "existence" ? "Subject" : "Cop-Restr");
  return topic != nullptr && vocabulary.surroundings(*topic) != nullptr;
}

bool is_question(const DialogueMove& x) {
  return x.type == DialogueMoveType::question_w || x.type == DialogueMoveType::question_yn;
}

/// "The red ball is left of the disc, and the blue one is behind it": what the first clause is
/// about, if the second is about `one`; else null.
const Nominal* parallel_subject(const LogicalForm& form, const Nominal& one) {
  const auto* root = find_nominal(form, form.root);
  const auto* next = root->sort == "conjunction" ? dependent(form, *root, "Next") : nullptr;
  const auto* first = next == nullptr ? nullptr : dependent(form, *root, "First");
  const auto* subject = first == nullptr ? nullptr : dependent(form, *first, "Cop-Restr");
  const bool is_parallel = subject != nullptr && dependent(form, *next, "Cop-Restr") == &one &&
                           subject->sort == "thing" && !is_pronoun(*subject) &&
                           subject->proposition != "one";
  return is_parallel ? subject : nullptr;
}

/// "How many large and how many small things are there?": the noun of the second question for what
/// the first asks for; else empty.
std::string noun_asked_next(const LogicalForm& form, const Nominal& one) {
  const auto* root = find_nominal(form, form.root);
  const auto* first = root->sort == "conjunction" ? dependent(form, *root, "First") : nullptr;
  const auto* next = first == nullptr ? nullptr : dependent(form, *root, "Next");
  if (next == nullptr || dependent(form, *first, "Wh-Restr") != &one)
    return {};
  const auto* asked = dependent(form, *next, "Wh-Restr");
  return asked == nullptr || asked->sort != "thing" ? std::string{} : asked->proposition;
}

/// The last thing that is called by a noun before a nominal; null if there is none.
const Nominal* named_before(const LogicalForm& form, const Nominal& one,
                            const Vocabulary& vocabulary) {
  if (const auto* subject = parallel_subject(form, one))
    return subject;
  const Nominal* last = nullptr;
  for (auto& x : form.nominals)
    if (x.sort == "thing" && !is_pronoun(x) && x.proposition != "one" &&
        vocabulary.surroundings(x) == nullptr && place_of_word(x) < place_of_word(one) &&
        (last == nullptr || place_of_word(*last) < place_of_word(x)))
      last = &x;
  return last;
}

/// "Which is the largest thing?" says itself what it asks for.
bool is_identified(const LogicalForm& form, const Nominal& clause, const Nominal& x) {
  const auto* subject = dependent(form, clause, "Cop-Restr");
  const auto* scope = dependent(form, clause, "Cop-Scope");
  const auto* asked = dependent(form, clause, "Wh-Restr");
  if (asked != &x || subject == nullptr || scope == nullptr)
    return false;
  const auto& other = subject == &x ? *scope : *subject;
  return other.sort == "thing" && other.proposition != "one";
}

bool is_about_any(const LogicalForm& fragment) {
  const auto* root = find_nominal(fragment, fragment.root);
  return root != nullptr && root->sort == "thing" && feature(*root, "Delimitation") == "any";
}

/// "The biggest thing" tells itself which one it is.
bool is_selected(const LogicalForm& fragment) {
  const auto* root = find_nominal(fragment, fragment.root);
  return root != nullptr && root->sort == "thing" &&
         dependent(fragment, *root, "Selection") != nullptr;
}

/// Whether a fragment was said as a question, which is not noted any more then.
bool take_said_as_question(LogicalForm& fragment) {
  auto* root = find_nominal(fragment, fragment.root);
  return root != nullptr &&
         std::erase_if(root->features, [](auto& x) { return x.name == said_as_question; }) > 0;
}

bool is_opposite(const std::string& a, const std::string& b) {
  constexpr std::array<std::array<std::string_view, 2>, 2> opposites{
    {{"left", "right"}, {"front", "back"}}};
  return std::ranges::any_of(
    opposites, [&](auto& x) { return (a == x[0] && b == x[1]) || (a == x[1] && b == x[0]); });
}

/// Whether it is the request to do the same with something else: "and the cube on the right".
bool is_same_again(const LogicalForm& form) {
  const auto* root = find_nominal(form, form.root);
  return root != nullptr && root->sort == "action" && root->proposition == "same";
}

bool is_place(const LogicalForm& fragment) {
  const auto* root = find_nominal(fragment, fragment.root);
  return root != nullptr && (root->sort == "region" || root->sort == "place");
}

/// "Leave the balls alone and put the others at the back. Now the balls as well": what goes on is
/// not what was forbidden.
LogicalForm without_prohibitions(LogicalForm form) {
  bool is_changed = false;
  const auto is_prohibition = [](const Nominal* x) {
    return x != nullptr && x->sort == "action" && forbids(*x);
  };
  for (const auto* root = find_nominal(form, form.root);
       root != nullptr && root->sort == "conjunction"; root = find_nominal(form, form.root)) {
    const auto* first = dependent(form, *root, "First");
    const auto* next = dependent(form, *root, "Next");
    if (first == nullptr || next == nullptr || is_prohibition(first) == is_prohibition(next))
      break;
    form = part_of(form, is_prohibition(first) ? next->name : first->name);
    is_changed = true;
  }
  if (auto* root = find_nominal(form, form.root); is_changed && root != nullptr)
    root->features.push_back({"Allows", "true"});
  return form;
}

/// A fragment completes a request of which only a part was understood. "Where shall I put it?" "On
/// the left": then all is.
void take_into_proposal(DialogueMove& request, const LogicalForm& fragment) {
  if (!request.partial)
    return;
  if (request.partial->lacks_place && is_place(fragment))
    request.partial.reset();
  else
    request.partial->words.clear();
}

/// The region that a clause that asks for things says they are in, or where a request says that
/// something is to be put; null if there is none.
const Nominal* asked_region(const LogicalForm& form) {
  const auto* root = find_nominal(form, form.root);
  if (root != nullptr && root->sort == "action") {
    const auto* destination = dependent(form, *root, "Destination");
    return destination != nullptr && dependent(form, *destination, "Anchor") != nullptr
             ? destination
             : nullptr;
  }
  const auto* asked = root == nullptr ? nullptr : dependent(form, *root, "Wh-Restr");
  const auto* scope = root == nullptr ? nullptr : dependent(form, *root, "Cop-Scope");
  if (asked == nullptr || (asked->sort != "thing" && asked->sort != "entity"))
    return nullptr;
  const auto* region =
    scope != nullptr && scope->sort == "region" ? scope : dependent(form, *asked, "Location");
  return region != nullptr && dependent(form, *region, "Anchor") != nullptr ? region : nullptr;
}

} // namespace

/// "What is in front of the cube? And what is behind it?": behind the cube.
void QuestionContext::keep_landmark(CompleteMove& move) const {
  const bool is_after_request =
    question_ && question_->move.type == DialogueMoveType::action_directive;
  const auto& last = is_after_request ? question_ : clause_;
  const auto* before = last ? asked_region(last->move.content) : nullptr;
  const auto* now = asked_region(move.move.content);
  if (before == nullptr || now == nullptr || !is_opposite(before->proposition, now->proposition))
    return;
  const auto* landmark = dependent(last->move.content, *before, "Anchor");
  const auto* pronoun = dependent(move.move.content, *now, "Anchor");
  if (pronoun->proposition != "it" || landmark->sort != "thing" || !is_definite(*landmark) ||
      is_plural(*landmark) || vocabulary_->surroundings(*landmark) != nullptr)
    return;
  const auto from = pronoun->name;
  const auto name = append(move.move.content, part_of(last->move.content, landmark->name),
                           move.antecedents, last->antecedents);
  for (auto& x : move.move.content.nominals)
    for (auto& relation : x.relations)
      if (relation.dependent == from)
        relation.dependent = name;
}

namespace {

/// A place that may be a marker as well is one.
void take_as_marker(DialogueMove& move) {
  const auto has_root = [](const LogicalForm& form, std::string_view sort) {
    const auto* root = find_nominal(form, form.root);
    return root != nullptr && root->sort == sort;
  };
  const auto marker = std::ranges::find_if(
    move.alternatives, [&](const LogicalForm& x) { return has_root(x, "marker"); });
  if (!has_root(move.content, "place") || marker == move.alternatives.end() ||
      is_correction(move.content))
    return;
  move.content = *marker;
  move.type = dialogue_move_type(move.content);
  move.alternatives.clear();
}

} // namespace

/// "The red one" is a red thing of the kind that was spoken of, in the same sentence or before.
void QuestionContext::replace_one(LogicalForm& form) const {
  const auto* root = find_nominal(form, form.root);
  if (root == nullptr || root->sort == "thing")
    return;
  for (auto& x : form.nominals) {
    if (x.sort != "thing" || x.proposition != "one" || is_anaphoric(x, *vocabulary_) ||
        is_counted_group(form, x) || dependent(form, x, "PartOf") != nullptr)
      continue;
    const auto* before = named_before(form, x, *vocabulary_);
    const auto noun = before == nullptr ? std::string{} : before->proposition;
    // "Is the cube larger than the others?": there is one cube; "are the cubes larger than the
    // others?": those are all cubes.
    const bool is_unique = before != nullptr && is_definite(*before) && before->relations.empty() &&
                           is_plural(x) && is_about_others(form, x);
    if (vocabulary_->is_general(noun) || is_unique)
      continue;
    if (noun.empty())
      if (const auto next = noun_asked_next(form, x); !next.empty()) {
        x.proposition = next;
        continue;
      }
    const auto& kind = !noun.empty() || is_identified(form, *root, x) ? noun : noun_;
    if (kind.empty())
      continue;
    if (root->sort == "action" || root->sort == "conjunction" || is_definite(x))
      x.features.push_back({"Called", "one"});
    x.proposition = kind;
  }
}

/// "Do the same with the cube" is about the cube what the request before was about another thing.
DialogueMove QuestionContext::with_what_is_the_same(DialogueMove move) const {
  const auto* root = find_nominal(move.content, move.content.root);
  if (!question_ || root == nullptr || !is_same_again(move.content) ||
      dependent(move.content, *root, "Destination") != nullptr)
    return move;
  if (const auto* patient = dependent(move.content, *root, "Patient")) {
    const auto name = patient->name;
    move.content = part_of(move.content, name);
    move.alternatives.clear();
    move.type = DialogueMoveType::none;
  }
  return move;
}

/// "Is anything behind the cube? Put the ball there. Is anything else over there?": where the
/// question or request before has something.
void QuestionContext::resolve_there(CompleteMove& move) const {
  const auto& form = move.move.content;
  const auto there = std::ranges::find_if(form.nominals, [&](const Nominal& x) {
    return x.sort == "region" && x.proposition == "there" &&
           dependent(form, x, "Anchor") == nullptr;
  });
  if (!question_ || there == form.nominals.end())
    return;
  const auto& before = question_->move.content;
  const auto place = std::ranges::find_if(before.nominals, [](const Nominal& x) {
    return x.sort == "region" && x.proposition != "there" && x.proposition != "here" &&
           x.proposition != "where" && x.proposition != "what" && !is_negated(x);
  });
  if (place == before.nominals.end())
    return;
  const auto from = there->name;
  const auto name = append(move.move.content, part_of(before, place->name), move.antecedents,
                           question_->antecedents);
  for (auto& x : move.move.content.nominals)
    for (auto& relation : x.relations)
      if (relation.dependent == from)
        relation.dependent = name;
}

/// "The red cube. The left edge.": it goes there. Nothing if what is said now is no place.
std::optional<CompleteMove> QuestionContext::put_topic(const CompleteMove& place) const {
  const auto* where = find_nominal(place.move.content, place.move.content.root);
  if (!topic_ || where == nullptr || (where->sort != "region" && where->sort != "place"))
    return std::nullopt;
  auto result = place;
  auto& form = result.move.content;
  auto destination = form.root;
  const auto thing = append(form, topic_->move.content, result.antecedents, topic_->antecedents);
  if (find_nominal(form, destination)->sort == "place") {
    form.nominals.push_back({"where", "region", "at", {}, {{"Anchor", destination}}});
    destination = "where";
  }
  form.nominals.push_back({"order",
                           "action",
                           "put",
                           {{"Mood", "imp"}},
                           {{"Patient", thing}, {"Destination", destination}}});
  form.root = "order";
  result.move.alternatives.clear();
  result.move.type = DialogueMoveType::action_directive;
  return result;
}

/// "A bit more", "too far away, bring it closer": of what was asked for before. Nothing if there is
/// no more of it.
std::optional<CompleteMove> QuestionContext::once_more(const DialogueMove& move) const {
  if (!question_ || question_->move.type != DialogueMoveType::action_directive)
    return std::nullopt;
  const auto* said = find_nominal(move.content, move.content.root);
  if (const auto* last = dependent(move.content, *said, "Next"))
    said = last;
  auto repetition =
    repeated(question_->move.content, feature(*said, "More"), feature(*said, "Unit") != "none");
  if (!repetition)
    return std::nullopt;
  auto again = *question_;
  again.move.turn = move.turn;
  if (again.move.partial)
    again.move.partial->words.clear();
  again.move.content = std::move(*repetition);
  again.move.alternatives.clear();
  return again;
}

/// "The blue one", "on the left", "either of them" to "which ball do you mean?".
std::optional<CompleteMove> QuestionContext::clarified(const DialogueMove& move,
                                                       const Antecedents& antecedents) const {
  // "Right" is a side, too.
  const bool may_answer =
    move.type == DialogueMoveType::none || move.type == DialogueMoveType::accept;
  if (!unclear_ || !move.problem.empty() || !may_answer)
    return std::nullopt;
  std::vector<const LogicalForm*> fragments{&move.content};
  for (const auto& x : move.alternatives)
    fragments.push_back(&x);
  std::optional<CompleteMove> result;
  for (const auto* said : fragments) {
    const auto* root = find_nominal(*said, said->root);
    if (root == nullptr || dialogue_move_type(*said) != DialogueMoveType::none ||
        root->proposition == "robot")
      continue;
    auto told = *unclear_;
    if (!clarify(told, asked_about_, *said, antecedents, *vocabulary_))
      continue;
    take_into_proposal(told.move, *said);
    if (!result) {
      result = std::move(told);
      result->move.alternatives.clear();
    } else
      result->move.alternatives.push_back(std::move(told.move.content));
  }
  return result;
}

void QuestionContext::rename(const RenamedThings& renamed) {
  for (auto* move : {&question_, &clause_, &unclear_, &topic_, &proposed_, &possible_})
    if (*move)
      communication::rename((*move)->antecedents, renamed);
}

CompleteMove QuestionContext::complete(const DialogueMove& said,
                                       const Antecedents& antecedents) const {
  const bool agrees_to_proposal = proposed_ && is_agreement(said);
  const bool asks_for_possible = possible_ && says_to_go_ahead(said);
  if (said.problem.empty() && (agrees_to_proposal || asks_for_possible)) {
    auto agreed = agrees_to_proposal ? *proposed_ : *possible_;
    agreed.move.turn = said.turn;
    agreed.move.partial.reset();
    return agreed;
  }
  if (proposed_ && said.problem.empty() && is_refusal(said))
    return {as_refusal_of_proposal(said), antecedents};
  auto move = with_what_is_the_same(said);
  if (asks_for_more(move.content)) {
    auto again = once_more(move);
    return again ? std::move(*again) : CompleteMove{move, antecedents};
  }
  // "A bit further away": from what it was put next to.
  for (const auto& alternative : move.alternatives)
    if (asks_for_more(alternative)) {
      auto other = move;
      other.content = alternative;
      if (auto again = once_more(other))
        return *again;
    }
  const bool is_question = take_said_as_question(move.content);
  for (auto& alternative : move.alternatives)
    take_said_as_question(alternative);
  // "Right. Take the cube.": a side only if that was asked for, or a thing was named before.
  if (!is_question && !unclear_ && !topic_ && !proposed_)
    take_as_marker(move);
  CompleteMove result{move, antecedents};
  replace_one(result.move.content);
  for (auto& alternative : result.move.alternatives)
    replace_one(alternative);
  keep_landmark(result);
  resolve_there(result);
  if (clause_ && is_elliptical(move.content) &&
      !is_about_surroundings(clause_->move.content, *vocabulary_))
    if (auto whole = completed(move.content, clause_->move.content)) {
      result.move.content = std::move(*whole);
      result.move.alternatives.clear();
      result.move.type = dialogue_move_type(result.move.content);
      result.antecedents = clause_->antecedents;
      for (auto& [name, proxies] : antecedents)
        result.antecedents.insert_or_assign(std::string{said_now} + name, proxies);
      return result;
    }
  if (question_ && question_->move.type == DialogueMoveType::action_directive &&
      move.type == DialogueMoveType::none)
    for (const auto& alternative : move.alternatives)
      if (is_same_again(alternative)) {
        CompleteMove again{move, antecedents};
        again.move.content = alternative;
        again.move.alternatives.clear();
        again.move.type = DialogueMoveType::action_directive;
        replace_one(again.move.content);
        keep_landmark(again);
        return again;
      }
  if (auto told = clarified(move, antecedents))
    return *told;
  if (move.type != DialogueMoveType::none || !move.problem.empty() || move.content.nominals.empty())
    return result;
  // "Do you, robot?" names who is spoken to, and asks nothing of another thing.
  if (const auto* root = find_nominal(move.content, move.content.root);
      root == nullptr || root->proposition == "robot")
    return result;
  if (auto order = put_topic(result))
    return *order;
  // "The red cube on the green one", where nothing else was asked.
  if (!question_ || question_->move.type == DialogueMoveType::action_directive)
    if (const auto order = std::ranges::find_if(move.alternatives, is_verbless);
        order != move.alternatives.end() && !is_question) {
      CompleteMove ordered{move, antecedents};
      ordered.move.content = *order;
      ordered.move.alternatives.clear();
      ordered.move.type = DialogueMoveType::action_directive;
      replace_one(ordered.move.content);
      return ordered;
    }
  if (clause_ && clause_->move.type == DialogueMoveType::assertion)
    if (auto statement = *clause_; correct_number(statement, move.content, antecedents))
      return statement;
  if (question_ && !is_about_any(move.content)) {
    auto question = *question_;
    if (substitute(question, move.content, antecedents, *vocabulary_)) {
      take_into_proposal(question.move, move.content);
      for (auto& alternative : move.alternatives)
        if (auto other = *question_; substitute(other, alternative, antecedents, *vocabulary_))
          question.move.alternatives.push_back(std::move(other.move.content));
      return question;
    }
  }
  // "Biggest thing?"
  if (is_selected(move.content)) {
    const auto subject = result.move.content.root;
    auto& selected = *find_nominal(result.move.content, subject);
    if (feature(selected, "Delimitation").empty())
      selected.features.push_back({"Delimitation", "unique"});
    result.move.content.root = "existence";
    result.move.content.nominals.push_back({"existence",
                                            "existence",
                                            "be",
                                            {{"Mood", "int"}},
                                            {{"Wh-Restr", subject}, {"Subject", subject}}});
    result.move.type = DialogueMoveType::question_w;
    return result;
  }
  // "Anything left of the ball?", "red things?"
  if (is_about_any(move.content) || is_question) {
    const auto subject = result.move.content.root;
    result.move.content.root = "existence";
    result.move.content.nominals.push_back(
      {"existence", "existence", "be", {{"Mood", "int"}}, {{"Subject", subject}}});
    result.move.type = DialogueMoveType::question_yn;
  }
  return result;
}

void QuestionContext::note(const CompleteMove& complete, const Response& response) {
  CompleteMove move{reading_of(complete.move, response.reading), complete.antecedents};
  move.move.content = without_correction(std::move(move.move.content));
  unclear_.reset();
  topic_.reset();
  if (const auto* named = find_nominal(move.move.content, move.move.content.root);
      named != nullptr && move.move.type == DialogueMoveType::none && move.move.problem.empty() &&
      named->sort == "thing" && is_definite(*named) && !is_pronoun(*named))
    topic_ = move;
  proposed_.reset();
  if (response.proposes)
    proposed_ = move;
  const bool is_ability = asks_for_ability(move.move.content);
  if (is_ability || is_question(move.move) || asks_to_act(move.move))
    possible_.reset();
  if (is_ability && !response.proposes) {
    possible_ = move;
    possible_->move.content = as_request(std::move(possible_->move.content));
    possible_->move.type = DialogueMoveType::action_directive;
    possible_->move.alternatives.clear();
  }
  if (!response.asked_about.empty()) {
    unclear_ = move;
    asked_about_ = response.asked_about;
  }
  const auto& form = move.move.content;
  const auto* root = find_nominal(form, form.root);
  const auto* asked = root == nullptr ? nullptr : dependent(form, *root, "Wh-Restr");
  // "How many things are white? How many brown ones?" is about things.
  if (asked != nullptr && asked->sort == "thing" && asked->proposition != "one" &&
      vocabulary_->is_general(asked->proposition))
    noun_.clear();
  else
    for (const auto* thing : things_spoken_of(form, *vocabulary_))
      if (!is_pronoun(*thing) && !vocabulary_->is_general(thing->proposition)) {
        noun_ = thing->proposition;
        break;
      }
  if (is_elliptical(move.move.content))
    return;
  // "Put the red ball on the box. And the blue one."
  const bool is_request = move.move.type == DialogueMoveType::action_directive &&
                          is_handling(form, vocabulary_->meanings());
  if (is_question(move.move) || is_request) {
    question_ = move;
    question_->move.content = without_prohibitions(std::move(question_->move.content));
  }
  if (is_question(move.move) || move.move.type == DialogueMoveType::assertion)
    clause_ = move;
  if (!move.move.problem.empty()) {
    question_.reset();
    clause_.reset();
  }
}

} // namespace castor::communication
