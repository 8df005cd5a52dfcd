#include "castor/communication/dialogue/content.hpp"

#include "castor/communication/parsing/hybrid_logic.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <utility>
#include <vector>

namespace castor::communication {

namespace {

constexpr std::array number_words{"zero", "one",   "two",   "three", "four", "five",
                                  "six",  "seven", "eight", "nine",  "ten"};

constexpr std::array rank_words{"first", "second", "third", "fourth", "fifth"};

Nominal& root_of(LogicalForm& form) {
  return *std::find_if(form.nominals.begin(), form.nominals.end(),
                       [&form](const Nominal& nominal) { return nominal.name == form.root; });
}

/// Makes the root of `part` a dependent of the form's root. The nominals of the part get names that
/// the form does not have yet.
void attach(LogicalForm& form, const std::string& mode, const LogicalForm& part) {
  const auto prefix = "c" + std::to_string(form.nominals.size()) + "-";
  root_of(form).relations.push_back({mode, prefix + part.root});
  for (auto nominal : part.nominals) {
    nominal.name = prefix + nominal.name;
    for (auto& relation : nominal.relations)
      relation.dependent = prefix + relation.dependent;
    form.nominals.push_back(std::move(nominal));
  }
}

LogicalForm single(const std::string& sort, const std::string& proposition) {
  return {"x", {{"x", sort, proposition, {}, {}}}, 0};
}

/// Without what says how many, and which.
LogicalForm without_determiner(LogicalForm form) {
  auto& root = root_of(form);
  std::erase_if(root.features, [](const NominalFeature& x) {
    return x.name == "Number" || x.name == "Delimitation" || x.name == "Specifier" ||
           x.name == "Proximity" || x.name == "Focus" || x.name == "Coordination" ||
           x.name == "Polarity";
  });
  std::erase_if(root.relations, [](const NominalRelation& x) { return x.mode == "Quantity"; });
  return part_of(form, form.root);
}

/// Described by a place at most.
bool without_attributes(const LogicalForm& thing) {
  const auto* root = find_nominal(thing, thing.root);
  return std::ranges::all_of(root->relations, [](auto& x) { return x.mode == "Location"; });
}

LogicalForm perception(const std::string& verb) {
  auto form = single("perception", verb);
  attach(form, "Actor", single("person", "i"));
  return form;
}

} // namespace

LogicalForm marker(const std::string& word) {
  return single("marker", word);
}

LogicalForm pronoun(const std::string& word) {
  auto form = single("thing", word);
  const bool is_plural = word == "they" || word == "these" || word == "those";
  root_of(form).features.push_back({"Number", is_plural ? "pl" : "sg"});
  return form;
}

LogicalForm property(const std::string& sort, const std::string& value) {
  return single(sort, value);
}

LogicalForm region(const std::string& place) {
  return single("region", place);
}

LogicalForm region(const std::vector<std::string>& places) {
  auto form = region(places.front());
  for (std::size_t i = 1; i < places.size(); ++i) {
    auto both = single("conjunction", "and");
    attach(both, "First", form);
    attach(both, "Next", region(places[i]));
    form = std::move(both);
  }
  return form;
}

LogicalForm region(const std::string& relation, const LogicalForm& anchor) {
  auto form = single("region", relation);
  attach(form, "Anchor", anchor);
  return form;
}

LogicalForm definite(const std::string& noun) {
  auto form = single("thing", noun);
  root_of(form).features = {{"Number", "sg"}, {"Delimitation", "unique"}};
  return form;
}

LogicalForm indefinite(const std::string& noun) {
  auto form = single("thing", noun);
  root_of(form).features = {{"Number", "sg"}, {"Delimitation", "existential"}};
  return form;
}

LogicalForm plural(const std::string& noun) {
  auto form = single("thing", noun);
  root_of(form).features = {{"Number", "pl"}};
  return form;
}

std::string number_word(std::size_t number) {
  return number < number_words.size() ? number_words[number] : "many";
}

std::optional<std::size_t> number_of_word(std::string_view word) {
  const auto found = std::ranges::find(number_words, word);
  if (found == number_words.end())
    return std::nullopt;
  return static_cast<std::size_t>(found - number_words.begin());
}

std::string rank_word(std::size_t rank) {
  return rank > 0 && rank <= rank_words.size() ? rank_words[rank - 1] : "";
}

std::optional<std::size_t> rank_of_word(std::string_view word) {
  const auto found = std::ranges::find(rank_words, word);
  if (found == rank_words.end())
    return std::nullopt;
  return static_cast<std::size_t>(found - rank_words.begin()) + 1;
}

LogicalForm counted(std::size_t count, LogicalForm thing) {
  auto form = without_determiner(std::move(thing));
  root_of(form).features.push_back({"Number", count == 1 ? "sg" : "pl"});
  if (count == 0)
    root_of(form).features.push_back({"Delimitation", "none"});
  else
    attach(form, "Quantity", single("number", number_word(count)));
  return form;
}

LogicalForm counted(const Count& count, LogicalForm thing) {
  auto form = counted(count.certain, std::move(thing));
  if (count.possible > count.certain)
    for (auto& nominal : form.nominals)
      if (nominal.sort == "number")
        nominal.features.push_back({"Bound", "at_least"});
  return form;
}

LogicalForm none_of(LogicalForm thing) {
  auto form = without_determiner(std::move(thing));
  root_of(form).features.push_back({"Number", "sg"});
  root_of(form).features.push_back({"Delimitation", "none"});
  return form;
}

LogicalForm with(LogicalForm thing, const std::string& mode, const LogicalForm& dependent) {
  attach(thing, mode, dependent);
  return thing;
}

LogicalForm ascribe(const LogicalForm& what, const LogicalForm& scope, bool is_so) {
  auto form = single("ascription", "be");
  if (!is_so)
    root_of(form).features.push_back({"Polarity", "neg"});
  attach(form, "Cop-Restr", what);
  attach(form, "Cop-Scope", scope);
  return form;
}

LogicalForm possess(const LogicalForm& what, const LogicalForm& scope) {
  auto form = ascribe(what, scope);
  root_of(form).proposition = "have";
  return form;
}

LogicalForm exists(const LogicalForm& what) {
  auto form = single("existence", "be");
  attach(form, "Subject", what);
  return form;
}

LogicalForm listed(std::vector<LogicalForm> things) {
  auto result = std::move(things.back());
  for (things.pop_back(); !things.empty(); things.pop_back()) {
    auto longer = single("conjunction", "and");
    attach(longer, "First", things.back());
    attach(longer, "Next", result);
    result = std::move(longer);
  }
  return result;
}

LogicalForm all_of_them(std::size_t number) {
  auto result = pronoun("they");
  if (number == 2)
    attach(result, "Quantity", single("number", "two"));
  return result;
}

LogicalForm with_marker(const std::string& word, LogicalForm form) {
  attach(form, "Marker", marker(word));
  return form;
}

LogicalForm unsure(LogicalForm form) {
  root_of(form).features.push_back({"Certainty", "low"});
  return form;
}

LogicalForm which(LogicalForm what) {
  what = without_determiner(std::move(what));
  root_of(what).features.push_back({"Number", "sg"});
  root_of(what).features.push_back({"Specifier", "which"});
  auto form = single("perception", "mean");
  root_of(form).features.push_back({"Mood", "int"});
  attach(form, "Wh-Restr", what);
  const auto asked_for = root_of(form).relations.back().dependent;
  attach(form, "Actor", single("person", "you"));
  root_of(form).relations.push_back({"Patient", asked_for});
  return form;
}

LogicalForm part_of(const LogicalForm& form, const std::string& nominal) {
  LogicalForm result;
  result.root = nominal;
  std::vector<std::string> waiting{nominal};
  std::set<std::string> seen{nominal};
  while (!waiting.empty()) {
    const auto* next = find_nominal(form, waiting.back());
    waiting.pop_back();
    if (next == nullptr)
      continue;
    result.nominals.push_back(*next);
    for (auto& relation : next->relations)
      if (seen.insert(relation.dependent).second)
        waiting.push_back(relation.dependent);
  }
  return result;
}

LogicalForm i_do_not_see(const LogicalForm& what) {
  auto thing = without_determiner(what);
  root_of(thing).features.push_back({"Number", "sg"});
  // "I do not see anything left of the box."
  const bool is_anything = root_of(thing).proposition == "thing" && without_attributes(thing);
  root_of(thing).features.push_back({"Delimitation", is_anything ? "any" : "existential"});
  auto form = perception("see");
  root_of(form).features.push_back({"Polarity", "neg"});
  attach(form, "Patient", thing);
  return form;
}

LogicalForm i_do_not_know() {
  auto form = perception("know");
  root_of(form).features.push_back({"Polarity", "neg"});
  return form;
}

LogicalForm i_know_nothing_of(const std::string& noun) {
  auto form = single("ignorance", "know");
  attach(form, "About", plural(noun));
  return form;
}

LogicalForm myself() {
  return single("person", "i");
}

LogicalForm participant(const Nominal& phrase) {
  if (phrase.proposition == "you")
    return myself();
  return single("person", phrase.proposition == "i" ? "you" : phrase.proposition);
}

LogicalForm i_cannot_do_that() {
  auto form = perception("do");
  root_of(form).features.push_back({"Polarity", "neg"});
  root_of(form).features.push_back({"Modality", "can"});
  attach(form, "Patient", pronoun("that"));
  return form;
}

LogicalForm greeting(const std::string& word) {
  return single("greeting", word);
}

LogicalForm closing(const std::string& word) {
  return single("closing", word);
}

LogicalForm unknown_word(const std::string& word) {
  auto form = single("perception", "know");
  root_of(form).features = {{"Polarity", "neg"}};
  attach(form, "Actor", single("person", "i"));
  attach(form, "Patient", with(definite("word"), "Name", single("name", word)));
  return form;
}

} // namespace castor::communication
