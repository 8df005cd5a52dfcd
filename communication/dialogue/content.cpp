#include "castor/communication/dialogue/content.hpp"

#include <algorithm>

namespace castor::communication {

namespace {

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

LogicalForm with(LogicalForm thing, const std::string& mode, const LogicalForm& dependent) {
  attach(thing, mode, dependent);
  return thing;
}

LogicalForm ascribe(const LogicalForm& what, const LogicalForm& scope, bool is_so) {
  auto form = single("ascription", "be");
  root_of(form).features.push_back({"Mood", "ind"});
  if (!is_so)
    root_of(form).features.push_back({"Polarity", "neg"});
  attach(form, "Cop-Restr", what);
  attach(form, "Cop-Scope", scope);
  return form;
}

LogicalForm exists(const LogicalForm& what) {
  auto form = single("existence", "be");
  root_of(form).features.push_back({"Mood", "ind"});
  attach(form, "Subject", what);
  return form;
}

LogicalForm with_marker(const std::string& word, LogicalForm form) {
  attach(form, "Marker", marker(word));
  return form;
}

LogicalForm which(LogicalForm what) {
  auto& described = root_of(what);
  std::erase_if(described.features,
                [](const NominalFeature& feature) { return feature.name == "Delimitation"; });
  described.features.push_back({"Specifier", "which"});
  auto form = single("perception", "mean");
  root_of(form).features.push_back({"Mood", "int"});
  attach(form, "Wh-Restr", what);
  const auto asked_for = root_of(form).relations.back().dependent;
  attach(form, "Actor", single("person", "you"));
  root_of(form).relations.push_back({"Patient", asked_for});
  return form;
}

LogicalForm unknown_word(const std::string& word) {
  auto form = single("perception", "know");
  root_of(form).features = {{"Mood", "ind"}, {"Polarity", "neg"}};
  attach(form, "Actor", single("person", "i"));
  attach(form, "Patient", with(definite("word"), "Name", single("name", word)));
  return form;
}

} // namespace castor::communication
