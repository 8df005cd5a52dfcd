#include "castor/communication/dialogue/clause_parts.hpp"

#include "castor/communication/dialogue/content.hpp"
#include "castor/communication/dialogue/descriptions.hpp"
#include "castor/communication/parsing/hybrid_logic.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <utility>

namespace castor::communication {

namespace {

void erase_relation(Nominal& x, std::string_view mode) {
  std::erase_if(x.relations, [mode](auto& relation) { return relation.mode == mode; });
}

void erase_feature(Nominal& x, std::string_view name) {
  std::erase_if(x.features, [name](auto& feature) { return feature.name == name; });
}

bool is_thing(const Nominal* x) {
  return x != nullptr && (x->sort == "thing" || x->sort == "entity");
}

/// The thing that a clause asks for, or else what it is about.
const Nominal* topic_of(const LogicalForm& form, const Nominal& clause) {
  for (const auto* mode : {"Wh-Restr", "Subject", "Cop-Restr", "Patient"})
    if (const auto* x = dependent(form, clause, mode); is_thing(x))
      return x;
  return nullptr;
}

/// Whether things or some of them are named, rather than qualities.
bool are_things(const LogicalForm& form, const Nominal& x) {
  if (x.sort != "conjunction")
    return x.sort == "thing";
  const auto* first = dependent(form, x, "First");
  return first != nullptr && are_things(form, *first);
}

/// Adds what is said of a nominal to what is said of another.
void merge(LogicalForm& form, const std::string& from, const std::string& to) {
  const auto added = find_nominal(form, from)->relations;
  for (auto& relation : added)
    find_nominal(form, to)->relations.push_back(relation);
  for (auto& x : form.nominals)
    for (auto& relation : x.relations)
      if (relation.dependent == from)
        relation.dependent = to;
  std::erase_if(form.nominals, [&from](auto& x) { return x.name == from; });
}

void place_relative_clause(LogicalForm& form) {
  const auto* root = find_nominal(form, form.root);
  const auto* said = dependent(form, *root, "Extraposed");
  const auto* topic = said == nullptr ? nullptr : topic_of(form, *root);
  if (topic == nullptr || is_pronoun(*topic))
    return;
  const auto from = said->name;
  const auto to = topic->name;
  erase_relation(*find_nominal(form, form.root), "Extraposed");
  merge(form, from, to);
}

/// "Which ball is the small one, the left or the right?" is no list of three.
void set_alternatives_apart(LogicalForm& form) {
  auto* root = find_nominal(form, form.root);
  const auto* asked = dependent(form, *root, "Wh-Restr");
  const auto* scope = dependent(form, *root, "Cop-Scope");
  if (root->sort != "ascription" || !is_thing(asked) || scope == nullptr ||
      dependent(form, *root, "Cop-Restr") != asked || scope->proposition != "list")
    return;
  const auto* said = dependent(form, *scope, "First");
  const auto* others = dependent(form, *scope, "Next");
  if (said == nullptr || others == nullptr || said->sort != "thing" || others->proposition != "or")
    return;
  erase_relation(*root, "Cop-Scope");
  root->relations.push_back({"Cop-Scope", said->name});
  root->relations.push_back({"Alternatives", others->name});
}

/// "The cube, is it red or is it blue?": both are about the cube.
void lift_topic(LogicalForm& form) {
  auto* root = find_nominal(form, form.root);
  const auto* first = root->sort == "conjunction" ? dependent(form, *root, "First") : nullptr;
  const auto* topic = first == nullptr ? nullptr : dependent(form, *first, "Topic");
  if (topic == nullptr || dependent(form, *root, "Topic") != nullptr)
    return;
  const auto name = topic->name;
  erase_relation(*find_nominal(form, first->name), "Topic");
  root->relations.push_back({"Topic", name});
}

void place_alternatives(LogicalForm& form) {
  auto* root = find_nominal(form, form.root);
  const auto* alternatives = dependent(form, *root, "Alternatives");
  const auto* asked = dependent(form, *root, "Wh-Restr");
  if (alternatives == nullptr || asked == nullptr)
    return;
  const auto name = alternatives->name;
  // What colour something is does not depend on those that are named.
  const bool is_choice = is_thing(asked) && are_things(form, *alternatives);
  erase_relation(*root, "Alternatives");
  if (is_choice) {
    auto& chosen = *find_nominal(form, asked->name);
    erase_relation(chosen, "PartOf");
    chosen.relations.push_back({"PartOf", name});
  }
}

/// "The ball is not red but green": it is not red, and it is green.
void place_contrast(LogicalForm& form) {
  for (auto& x : form.nominals) {
    if (feature(x, "Contrast").empty())
      continue;
    erase_feature(x, "Contrast");
    for (auto& clause : form.nominals) {
      const auto* first = dependent(form, x, "First");
      if (dependent(form, clause, "Cop-Scope") != &x || !is_negated(clause) || first == nullptr)
        continue;
      erase_feature(clause, "Polarity");
      find_nominal(form, first->name)->features.push_back({"Polarity", "neg"});
    }
  }
}

/// "What is the biggest thing apart from the disc?": the biggest of the others.
const Nominal* selected_topic(const LogicalForm& form, const Nominal& root) {
  for (const auto* mode : {"Cop-Restr", "Cop-Scope"})
    if (const auto* x = dependent(form, root, mode);
        x != nullptr && x->sort == "thing" && dependent(form, *x, "Selection") != nullptr)
      return x;
  return nullptr;
}

/// "Except for the ball, is anything red?" is about the other things.
void place_exception(LogicalForm& form) {
  const auto* root = find_nominal(form, form.root);
  const auto* excepted = dependent(form, *root, "Except");
  const auto* topic = excepted == nullptr ? nullptr : topic_of(form, *root);
  const auto* selected = excepted == nullptr ? nullptr : selected_topic(form, *root);
  const bool is_asked_for = topic != nullptr && dependent(form, *root, "Wh-Restr") != nullptr;
  if (selected != nullptr)
    topic = selected;
  else if (topic == nullptr || is_asked_for || is_definite(*topic))
    return;
  const auto name = excepted->name;
  const auto to = topic->name;
  erase_relation(*find_nominal(form, form.root), "Except");
  find_nominal(form, to)->relations.push_back({"Except", name});
}

/// "What is that, on the left?": the thing on the left; "how many balls are there, on the left?"
void place_afterthought(LogicalForm& form) {
  auto* root = find_nominal(form, form.root);
  const auto* said = dependent(form, *root, "Afterthought");
  if (said == nullptr)
    return;
  const auto from = said->name;
  const auto is_meant = [](const Nominal& x) { return is_pronoun(x) && !is_plural(x); };
  const bool has_pronoun = std::ranges::any_of(form.nominals, is_meant);
  const auto* topic = topic_of(form, *root);
  if (!has_pronoun && (topic == nullptr || topic->sort != "thing" || is_pronoun(*topic)))
    return;
  erase_relation(*root, "Afterthought");
  if (has_pronoun)
    root->relations.push_back({"Topic", from});
  else
    merge(form, from, std::string{topic->name});
}

/// "There is no ball, is there?", "nothing is red, is it?" ask whether there is one, or any is.
void affirm_opposite(LogicalForm& form) {
  auto* root = find_nominal(form, form.root);
  if (feature(*root, "Opposite").empty())
    return;
  erase_feature(*root, "Opposite");
  const auto* topic = topic_of(form, *root);
  const auto delimited = topic == nullptr ? std::string_view{} : feature(*topic, "Delimitation");
  if (delimited != "none" && delimited != "neither")
    return;
  auto& any = *find_nominal(form, topic->name);
  erase_feature(any, "Delimitation");
  any.features.push_back({"Delimitation", "any"});
}

/// "A cube, a ball or a disc" is any of them: the word before the last one is meant before all.
void join_lists(LogicalForm& form) {
  for (std::size_t rest = form.nominals.size(); rest > 0; --rest)
    for (auto& x : form.nominals) {
      const auto* next = x.proposition == "list" ? dependent(form, x, "Next") : nullptr;
      if (next != nullptr && next->sort == "conjunction" && next->proposition != "list")
        x.proposition = next->proposition;
    }
}

/// "Which of those is the smaller one?": the smaller one of those.
void restrict_selection(LogicalForm& form) {
  const auto* root = find_nominal(form, form.root);
  const auto* asked = dependent(form, *root, "Wh-Restr");
  const auto* whole = asked == nullptr ? nullptr : dependent(form, *asked, "PartOf");
  const auto* scope = dependent(form, *root, "Cop-Scope");
  if (whole == nullptr || scope == nullptr || scope == asked || scope->proposition != "one" ||
      dependent(form, *scope, "Selection") == nullptr ||
      dependent(form, *scope, "PartOf") != nullptr)
    return;
  const auto name = whole->name;
  find_nominal(form, scope->name)->relations.push_back({"PartOf", name});
}

/// "Of the cubes, which is the largest?": which of the cubes.
void choose_from_topic(LogicalForm& form) {
  auto* root = find_nominal(form, form.root);
  const auto* topic = dependent(form, *root, "Topic");
  const auto* asked = dependent(form, *root, "Wh-Restr");
  if (topic == nullptr || asked == nullptr || asked->sort != "thing" ||
      asked->proposition != "one" || dependent(form, *asked, "PartOf") != nullptr ||
      (!is_plural(*topic) && topic->sort == "thing"))
    return;
  const auto name = topic->name;
  erase_relation(*root, "Topic");
  find_nominal(form, asked->name)->relations.push_back({"PartOf", name});
}

/// "Of those, give me the ball": the ball of those.
void choose_among(LogicalForm& form) {
  auto* root = find_nominal(form, form.root);
  const auto* topic = dependent(form, *root, "Among");
  const auto* action = root->sort == "conjunction" ? dependent(form, *root, "First") : root;
  const auto* patient = action == nullptr ? nullptr : dependent(form, *action, "Patient");
  if (action == nullptr || action->sort != "action" || topic == nullptr || patient == nullptr ||
      is_pronoun(*patient) || patient->sort != "thing" ||
      dependent(form, *patient, "PartOf") != nullptr)
    return;
  const auto name = topic->name;
  erase_relation(*root, "Among");
  find_nominal(form, patient->name)->relations.push_back({"PartOf", name});
}

/// "Which red ball is the big one?": the big one of the red balls.
void restrict_to_asked(LogicalForm& form) {
  const auto* root = find_nominal(form, form.root);
  const auto* asked = dependent(form, *root, "Wh-Restr");
  const auto* scope = dependent(form, *root, "Cop-Scope");
  if (root->sort != "ascription" || root->proposition != "be" || asked == nullptr ||
      scope == nullptr || scope == asked || asked->sort != "thing" ||
      dependent(form, *root, "Cop-Restr") != asked || scope->sort != "thing" ||
      scope->proposition != "one" || !is_definite(*scope) || is_plural(*scope) ||
      scope->relations.empty() || asked->proposition == "one")
    return;
  const auto like = *asked;
  auto& one = *find_nominal(form, scope->name);
  one.proposition = like.proposition;
  for (auto& relation : like.relations)
    if (relation.mode != "PartOf" && relation.mode != "Quantity" && relation.mode != "Selection")
      one.relations.push_back(relation);
}

/// "What is it?", "where is it?", "what colour is it?" of a nominal, by the word that asks.
LogicalForm question_about(const LogicalForm& form, const std::string& name,
                           const std::string& word) {
  LogicalForm question{"ellipsis", {}, 0};
  const bool asks_which = word == "which";
  const auto* sort = asks_which ? "entity" : word == "where" ? "region" : "quality";
  question.nominals.push_back({"asked", sort, asks_which ? "what" : word, {}, {}});
  question.nominals.push_back(
    {"ellipsis",
     "ascription",
     "be",
     {{"Mood", "int"}},
     {{"Wh-Restr", "asked"}, {"Cop-Restr", name}, {"Cop-Scope", "asked"}}});
  for (auto& x : part_of(form, name).nominals)
    question.nominals.push_back(x);
  return question;
}

/// "The bigger ball, which one?": which is the bigger ball?
void complete_by_topic(LogicalForm& form) {
  const auto* root = find_nominal(form, form.root);
  const auto* topic = dependent(form, *root, "Topic");
  if (topic == nullptr || !is_elliptical(form) || root->proposition == "so")
    return;
  const auto word = root->proposition;
  if (word != "which" && word != "where" && word != "colour" && word != "size" && word != "shape")
    return;
  form = question_about(form, std::string{topic->name}, word);
}

/// "I count one ball, how many do you count?" is about balls.
void inherit_from_preface(LogicalForm& form, const Nominal& preface) {
  const auto* topic = topic_of(form, preface);
  const auto* asked = dependent(form, *find_nominal(form, form.root), "Wh-Restr");
  if (topic == nullptr || asked == nullptr || asked->proposition != "one" ||
      dependent(form, *asked, "PartOf") != nullptr || is_pronoun(*topic))
    return;
  const auto like = *topic;
  auto& one = *find_nominal(form, asked->name);
  one.proposition = like.proposition;
  for (auto& relation : like.relations)
    if (relation.mode != "Quantity")
      one.relations.push_back(relation);
}

void complete_by_preface(LogicalForm& form) {
  const auto* preface = dependent(form, *find_nominal(form, form.root), "Preface");
  if (preface == nullptr)
    return;
  if (!is_elliptical(form)) {
    inherit_from_preface(form, *preface);
    return;
  }
  const auto name = preface->name;
  if (auto whole = completed(form, part_of(form, name)))
    form = std::move(*whole);
}

/// "Which are?" and "which are not?" ask for those of which what was said is so, or is not.
constexpr std::string_view so = "-so";
constexpr std::string_view not_so = "-not";

/// \returns whether the form says something of something
bool set_polarity(LogicalForm& form, bool is_positive) {
  auto& root = *find_nominal(form, form.root);
  const auto* scope = dependent(form, root, "Cop-Scope");
  if (root.sort != "ascription" || scope == nullptr)
    return false;
  erase_feature(root, "Polarity");
  erase_feature(*find_nominal(form, scope->name), "Polarity");
  if (!is_positive)
    root.features.push_back({"Polarity", "neg"});
  return true;
}

/// Puts some of those in the place of what a clause is about.
const Nominal& one_of(LogicalForm& form, const std::string& all) {
  const std::string name = "one-of-" + all;
  for (auto& relation : find_nominal(form, form.root)->relations)
    if (relation.dependent == all)
      relation.dependent = name;
  form.nominals.push_back({name, "thing", "one", {{"Number", "pl"}}, {{"PartOf", all}}});
  return form.nominals.back();
}

/// "Is the ball red? Is the cube?" asks of the cube whether it is so.
std::optional<LogicalForm> so_of(const LogicalForm& elliptical, const Nominal& said,
                                 LogicalForm before) {
  const auto* root = find_nominal(before, before.root);
  const auto* subject = dependent(before, *root, "Cop-Restr");
  const auto* scope = dependent(before, *root, "Cop-Scope");
  const auto* asked = dependent(before, *root, "Wh-Restr");
  const auto* other = dependent(elliptical, said, "Subject");
  if (subject == nullptr || scope == nullptr || other == nullptr || asked == scope)
    return std::nullopt;
  const bool is_same = is_pronoun(*other);
  if (is_same && (asked != nullptr || is_plural(*other) != is_plural(*subject)))
    return std::nullopt;
  const auto name = is_same ? subject->name : std::string{said_now} + other->name;
  set_polarity(before, true);
  auto& clause = *find_nominal(before, before.root);
  for (const auto* what : {"Literal", "Denied", "Certainty", "Mood"})
    erase_feature(clause, what);
  clause.features.push_back({"Mood", "int"});
  erase_relation(clause, "Wh-Restr");
  erase_relation(clause, "Cop-Restr");
  clause.relations.push_back({"Cop-Restr", name});
  if (is_same)
    return before;
  // What was said of another thing before has the same names.
  before.nominals = part_of(before, before.root).nominals;
  std::erase_if(before.nominals, [](auto& x) { return x.name.starts_with(said_now); });
  for (auto x : part_of(elliptical, other->name).nominals) {
    x.name.insert(0, said_now);
    for (auto& relation : x.relations)
      relation.dependent.insert(0, said_now);
    before.nominals.push_back(std::move(x));
  }
  return before;
}

/// "What is the leftmost thing? And what comes next?" asks for the second one.
std::optional<LogicalForm> next_in_order(LogicalForm before) {
  for (auto& x : before.nominals) {
    if (x.sort != "selection")
      continue;
    const auto* rank = dependent(before, x, "Rank");
    const auto current = rank == nullptr ? 1 : rank_of_word(rank->proposition).value_or(0);
    const auto word = current == 0 ? std::string{} : rank_word(current + 1);
    if (word.empty())
      return std::nullopt;
    const auto name = "next-rank-" + word;
    erase_relation(x, "Rank");
    x.relations.push_back({"Rank", name});
    before.nominals.push_back({name, "number", word, {}, {}});
    return before;
  }
  return std::nullopt;
}

/// "Not the ball, the disc", "the disc, not the ball": the disc.
void leave_out_denied(LogicalForm& form) {
  const auto* root = find_nominal(form, form.root);
  if (root->sort != "conjunction" || root->proposition == "or" || root->proposition == "nor")
    return;
  const auto* first = dependent(form, *root, "First");
  const auto* next = dependent(form, *root, "Next");
  if (first == nullptr || next == nullptr || first->sort != "thing" || next->sort != "thing" ||
      is_negated(*first) == is_negated(*next))
    return;
  form = part_of(form, is_negated(*first) ? next->name : first->name);
}

} // namespace

std::vector<LogicalForm> questions_in(const LogicalForm& form) {
  const auto* root = find_nominal(form, form.root);
  if (root == nullptr || root->sort != "conjunction" || feature(*root, "Mood") != "int")
    return {};
  const auto* first = dependent(form, *root, "First");
  const auto* next = dependent(form, *root, "Next");
  const auto asks_for_something = [&](const Nominal* x) {
    return x != nullptr && dependent(form, *x, "Wh-Restr") != nullptr;
  };
  if (first == nullptr || next == nullptr ||
      (!asks_for_something(first) && !asks_for_something(next)))
    return {};
  auto second = form;
  find_nominal(second, next->name)->relations.push_back({"Preface", first->name});
  return {part_of(form, first->name), part_of(second, next->name)};
}

bool is_elliptical(const LogicalForm& form) {
  const auto* root = find_nominal(form, form.root);
  return root != nullptr && root->sort == "ellipsis";
}

LogicalForm reunited(LogicalForm form) {
  if (find_nominal(form, form.root) == nullptr)
    return form;
  set_alternatives_apart(form);
  join_lists(form);
  lift_topic(form);
  leave_out_denied(form);
  place_relative_clause(form);
  place_alternatives(form);
  place_exception(form);
  place_contrast(form);
  complete_by_preface(form);
  complete_by_topic(form);
  choose_from_topic(form);
  choose_among(form);
  restrict_selection(form);
  restrict_to_asked(form);
  affirm_opposite(form);
  place_afterthought(form);
  return form;
}

std::optional<LogicalForm> completed(const LogicalForm& elliptical, LogicalForm before) {
  const auto& said = *find_nominal(elliptical, elliptical.root);
  auto word = said.proposition;
  auto* root = find_nominal(before, before.root);
  if (root == nullptr || (root->sort != "existence" && root->sort != "ascription"))
    return std::nullopt;
  if (word == "so")
    return so_of(elliptical, said, std::move(before));
  if (word == "next")
    return next_in_order(std::move(before));
  // "How many are red? And how many are not?"
  for (const auto end : {so, not_so})
    if (word.ends_with(end)) {
      if (!set_polarity(before, end == so))
        return std::nullopt;
      word.erase(word.size() - end.size());
    }
  const auto* topic = topic_of(before, *root);
  if (topic == nullptr)
    return std::nullopt;
  const bool asks_which = word == "which" || word == "how-many";
  // "Are they both blue? Which one isn't?"
  if (is_pronoun(*topic)) {
    if (!asks_which || !is_plural(*topic))
      return std::nullopt;
    topic = &one_of(before, topic->name);
    root = find_nominal(before, before.root);
  }
  const auto name = topic->name;
  const bool is_about_known = is_definite(*topic);
  if (asks_which && is_about_known && !is_plural(*topic))
    return std::nullopt;
  auto& asked = *find_nominal(before, name);
  for (const auto* what : {"Delimitation", "Focus", "Polarity"})
    erase_feature(asked, what);
  erase_relation(asked, "Quantity");
  if (!asks_which) {
    asked.features.push_back({"Delimitation", "unique"});
    return question_about(before, name, word);
  }
  for (const auto* what : {"Literal", "Denied", "Certainty", "Mood"})
    erase_feature(*root, what);
  root->features.push_back({"Mood", "int"});
  erase_relation(*root, "Wh-Restr");
  root->relations.push_back({"Wh-Restr", name});
  if (word == "how-many") {
    asked.relations.push_back({"Quantity", "how-many"});
    erase_feature(asked, "Number");
    asked.features.push_back({"Number", "pl"});
    before.nominals.push_back({"how-many", "number", "how-many", {}, {}});
  }
  return before;
}

} // namespace castor::communication
