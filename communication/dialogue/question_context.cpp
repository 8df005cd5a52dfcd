#include "castor/communication/dialogue/question_context.hpp"

#include "castor/communication/dialogue/clause_parts.hpp"
#include "castor/communication/dialogue/descriptions.hpp"
#include "castor/communication/dialogue/dialogue_move.hpp"
#include "castor/communication/dialogue/respond.hpp"
#include "castor/communication/parsing/hybrid_logic.hpp"

#include <algorithm>
#include <set>
#include <utility>

namespace castor::communication {

namespace {

bool is_question(const DialogueMove& x) {
  return x.type == DialogueMoveType::question_w || x.type == DialogueMoveType::question_yn;
}

/// Adds the nominals of another form, under names that the form does not have yet.
/// \returns the new name of the other form's root
std::string append(LogicalForm& form, const LogicalForm& other, Antecedents& antecedents,
                   const Antecedents& others) {
  std::string prefix = "n";
  auto is_taken = [&] {
    return std::ranges::any_of(form.nominals,
                               [&](auto& x) { return x.name.starts_with(prefix + '-'); });
  };
  while (is_taken())
    prefix += 'n';
  prefix += '-';
  for (auto x : other.nominals) {
    x.name = prefix + x.name;
    for (auto& relation : x.relations)
      relation.dependent = prefix + relation.dependent;
    form.nominals.push_back(std::move(x));
  }
  for (auto& [name, proxies] : others)
    antecedents.insert_or_assign(prefix + name, proxies);
  return prefix + other.root;
}

/// What was meant, once somebody has said "the red one" to "which ball do you mean?": it is the
/// ball that was spoken of, and red.
bool clarify(CompleteMove& question, const std::string& nominal, const LogicalForm& said,
             const Antecedents& antecedents) {
  const auto name = append(question.move.content, said, question.antecedents, antecedents);
  auto* asked = find_nominal(question.move.content, nominal);
  const auto* fragment = find_nominal(question.move.content, name);
  if (asked == nullptr || fragment == nullptr || fragment->sort != "thing")
    return false;
  // "This one."
  const std::string at{pointed_at};
  if (auto shown = question.antecedents.find(name + at); shown != question.antecedents.end()) {
    question.antecedents.insert_or_assign(nominal + at, shown->second);
    return true;
  }
  if (is_pronoun(*fragment))
    return false;
  // What "this" is has been said now.
  if (is_pronoun(*asked)) {
    asked->proposition = fragment->proposition == "one" ? "thing" : fragment->proposition;
    asked->features = fragment->features;
  } else if (!is_general_noun(fragment->proposition))
    asked->proposition = fragment->proposition;
  for (auto& relation : fragment->relations)
    asked->relations.push_back(relation);
  return true;
}

/// Puts a fragment in the place of what is like it in a question: a thing for the thing that it is
/// about, a colour for a colour, a place for a place.
class Substitution {
public:
  Substitution(LogicalForm& form, const Nominal& fragment) : form_(form), fragment_(fragment) {}

  /// \returns whether there is such a place
  bool run() {
    if (other_quality() || contrast())
      return true;
    for (const bool strictly : {true, false}) {
      is_strict_ = strictly;
      seen_.clear();
      visit(form_.root);
    }
    return replaced_;
  }

private:
  /// A definite phrase is rather about what a definite phrase was about.
  bool is_alike(const Nominal& x) const {
    if (fragment_.sort == "thing")
      return x.sort == "thing" && !is_the_table(x) &&
             (!is_strict_ || is_definite(x) == is_definite(fragment_));
    return x.sort == fragment_.sort && x.name != fragment_.name;
  }

  /// "The red one" is a thing of the kind that was spoken of.
  void inherit(const Nominal& from) {
    auto* fragment = find_nominal(form_, fragment_.name);
    if (fragment->proposition == "one" && !is_pronoun(from))
      fragment->proposition = from.proposition;
    // "How many balls are red? And how many are green?" is about as many.
    if (feature(*fragment, "Delimitation").empty() && is_plural(*fragment))
      for (auto& relation : from.relations)
        if (relation.mode == "Quantity" || relation.mode == "PartOf")
          fragment->relations.push_back(relation);
  }

  /// "The colour of the cube? And the size?"
  bool other_quality() {
    auto* root = find_nominal(form_, form_.root);
    if (root == nullptr || root->sort != "quality" || fragment_.sort != "quality" ||
        !fragment_.relations.empty())
      return false;
    root->proposition = fragment_.proposition;
    return true;
  }

  /// "How many things are white? And brown ones?" asks how many are brown, "how many things are
  /// balls? And cubes?" how many are cubes: what a fragment excludes is not said of it.
  /// \returns whether it is like that
  bool contrast() {
    const auto* root = find_nominal(form_, form_.root);
    const auto* about = root == nullptr ? nullptr : dependent(form_, *root, "Cop-Restr");
    const auto* scope = root == nullptr ? nullptr : dependent(form_, *root, "Cop-Scope");
    if (about == nullptr || scope == nullptr || about->sort != "thing" ||
        fragment_.sort != "thing" || !is_plural(fragment_) ||
        (is_definite(fragment_) && dependent(form_, *root, "Wh-Restr") != about))
      return false;
    if (scope->sort == "thing") {
      if (!is_general_noun(about->proposition) || is_general_noun(scope->proposition) ||
          is_general_noun(fragment_.proposition) || is_definite(*scope) || is_definite(fragment_))
        return false;
      replace(scope->name);
      return true;
    }
    const auto of_kind = std::ranges::find_if(fragment_.relations, [&](auto& relation) {
      const auto* value = find_nominal(form_, relation.dependent);
      return value != nullptr && value->sort == scope->sort && is_value(*value);
    });
    if (of_kind == fragment_.relations.end() || !is_value(*scope))
      return false;
    const auto subject = about->name;
    const auto value = of_kind->dependent;
    auto& asked = *find_nominal(form_, subject);
    if (!is_general_noun(fragment_.proposition))
      asked.proposition = fragment_.proposition;
    for (auto& relation : fragment_.relations)
      if (relation.dependent != value)
        asked.relations.push_back(relation);
    const auto old = scope->name;
    for (auto& relation : find_nominal(form_, form_.root)->relations)
      if (relation.dependent == old)
        relation.dependent = value;
    return true;
  }

  static bool is_value(const Nominal& x) {
    return x.sort == "colour" || x.sort == "size" || x.sort == "shape" || x.sort == "material";
  }

  /// "What is behind the ball? And left of it?" is about the ball.
  void keep_anchor(const Nominal& old) {
    const auto* anchor = dependent(form_, old, "Anchor");
    for (auto& relation : find_nominal(form_, fragment_.name)->relations) {
      const auto* pronoun = find_nominal(form_, relation.dependent);
      if (anchor != nullptr && relation.mode == "Anchor" && pronoun != nullptr &&
          is_pronoun(*pronoun))
        relation.dependent = anchor->name;
    }
  }

  void visit(const std::string& name) {
    const auto* x = find_nominal(form_, name);
    if (x == nullptr || !seen_.insert(name).second || replaced_)
      return;
    for (std::size_t i = 0; i < x->relations.size() && !replaced_; ++i) {
      x = find_nominal(form_, name);
      const auto dependent = x->relations[i].dependent;
      const auto* to = find_nominal(form_, dependent);
      if (to != nullptr && dependent != fragment_.name && is_alike(*to)) {
        const Nominal old = *to;
        inherit(old);
        keep_anchor(old);
        replace(dependent);
        replaced_ = true;
      } else
        visit(dependent);
    }
  }

  void replace(const std::string& name) {
    for (auto& x : form_.nominals)
      if (x.name != fragment_.name)
        for (auto& relation : x.relations)
          if (relation.dependent == name)
            relation.dependent = fragment_.name;
  }

  LogicalForm& form_;
  const Nominal fragment_;
  std::set<std::string> seen_;
  bool is_strict_ = true;
  bool replaced_ = false;
};

/// The last thing that is called by a noun before a nominal; null if there is none.
const Nominal* named_before(const LogicalForm& form, const Nominal& one) {
  const Nominal* last = nullptr;
  for (auto& x : form.nominals)
    if (x.sort == "thing" && !is_pronoun(x) && x.proposition != "one" && !is_the_table(x) &&
        place_of_word(x) < place_of_word(one) &&
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

bool substitute(CompleteMove& question, const LogicalForm& said, const Antecedents& antecedents) {
  auto& form = question.move.content;
  const auto name = append(form, said, question.antecedents, antecedents);
  const auto* fragment = find_nominal(form, name);
  return fragment != nullptr && Substitution{form, *fragment}.run();
}

} // namespace

/// "The red one" is a red thing of the kind that was spoken of, in the same sentence or before.
void QuestionContext::replace_one(LogicalForm& form) const {
  const auto* root = find_nominal(form, form.root);
  if (root == nullptr || root->sort == "thing")
    return;
  for (auto& x : form.nominals) {
    if (x.sort != "thing" || x.proposition != "one" || is_anaphoric(x) ||
        dependent(form, x, "PartOf") != nullptr)
      continue;
    const auto* before = named_before(form, x);
    const auto noun = before == nullptr ? std::string{} : before->proposition;
    // "Is the cube larger than the others?": there is one cube.
    const bool is_unique = before != nullptr && is_definite(*before) && !is_plural(*before) &&
                           before->relations.empty() && is_plural(x) && is_about_others(form, x);
    if (is_general_noun(noun) || is_unique)
      continue;
    if (!noun.empty())
      x.proposition = noun;
    else if (!noun_.empty() && !is_identified(form, *root, x))
      x.proposition = noun_;
  }
}

CompleteMove QuestionContext::complete(const DialogueMove& said,
                                       const Antecedents& antecedents) const {
  auto move = said;
  const bool is_question = take_said_as_question(move.content);
  for (auto& alternative : move.alternatives)
    take_said_as_question(alternative);
  CompleteMove result{move, antecedents};
  replace_one(result.move.content);
  for (auto& alternative : result.move.alternatives)
    replace_one(alternative);
  if (clause_ && is_elliptical(move.content))
    if (auto whole = completed(move.content, clause_->move.content)) {
      result.move.content = std::move(*whole);
      result.move.alternatives.clear();
      result.move.type = dialogue_move_type(result.move.content);
      result.antecedents = clause_->antecedents;
      for (auto& [name, proxies] : antecedents)
        result.antecedents.insert_or_assign(std::string{said_now} + name, proxies);
      return result;
    }
  if (move.type != DialogueMoveType::none || !move.problem.empty() || move.content.nominals.empty())
    return result;
  if (unclear_) {
    auto clarified = *unclear_;
    if (clarify(clarified, asked_about_, move.content, antecedents))
      return clarified;
  }
  if (question_) {
    auto question = *question_;
    if (!is_about_any(move.content) && substitute(question, move.content, antecedents))
      return question;
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

CompleteMove completed_after(const CompleteMove& before, const DialogueMove& move,
                             const Antecedents& antecedents, SceneKnowledge& scene) {
  QuestionContext context;
  context.note(before, respond(before.move, before.antecedents, scene));
  return context.complete(move, antecedents);
}

void QuestionContext::note(const CompleteMove& complete, const Response& response) {
  const CompleteMove move{reading_of(complete.move, response.reading), complete.antecedents};
  unclear_.reset();
  if (!response.asked_about.empty()) {
    unclear_ = move;
    asked_about_ = response.asked_about;
  }
  const auto& form = move.move.content;
  const auto* root = find_nominal(form, form.root);
  const auto* asked = root == nullptr ? nullptr : dependent(form, *root, "Wh-Restr");
  // "How many things are white? How many brown ones?" is about things.
  if (asked != nullptr && asked->sort == "thing" && asked->proposition != "one" &&
      is_general_noun(asked->proposition))
    noun_.clear();
  else
    for (const auto* thing : things_spoken_of(form))
      if (!is_pronoun(*thing) && !is_general_noun(thing->proposition)) {
        noun_ = thing->proposition;
        break;
      }
  if (is_elliptical(move.move.content))
    return;
  if (is_question(move.move))
    question_ = move;
  if (is_question(move.move) || move.move.type == DialogueMoveType::assertion)
    clause_ = move;
  if (!move.move.problem.empty()) {
    question_.reset();
    clause_.reset();
  }
}

} // namespace castor::communication
