#include "castor/communication/dialogue/small_talk.hpp"

#include "castor/communication/dialogue/descriptions.hpp"
#include "castor/communication/parsing/hybrid_logic.hpp"

namespace castor::communication {

namespace {

/// Properties of a thing by which it is told from others.
bool is_telling(const Nominal& property) {
  return property.sort == "colour" || property.sort == "shape";
}

} // namespace

std::string small_talk_topic(const LogicalForm& form) {
  const auto* root = find_nominal(form, form.root);
  if (root == nullptr)
    return {};
  const auto asked = feature(*root, "Asks");
  return asked.empty() ? root->proposition : std::string{asked};
}

bool asks_about_no_thing(const LogicalForm& form) {
  const auto* root = find_nominal(form, form.root);
  return root != nullptr && !feature(*root, "Asks").empty() &&
         dependent(form, *root, "Patient") == nullptr;
}

std::string things_asked_about(const LogicalForm& form, const Vocabulary& vocabulary) {
  const auto* root = find_nominal(form, form.root);
  const auto* thing = root == nullptr ? nullptr : dependent(form, *root, "Patient");
  if (thing == nullptr || thing->sort != "thing" || is_pronoun(*thing))
    return {};
  std::string result;
  for (const auto& relation : thing->relations)
    if (const auto* property = find_nominal(form, relation.dependent);
        property != nullptr && is_telling(*property))
      result += property->proposition + ' ';
  if (vocabulary.is_general(thing->proposition) || thing->proposition == "one")
    return result;
  result += thing->proposition;
  for (const auto& x : vocabulary.definition(thing->proposition))
    if (!x.text.empty())
      result += '|' + x.text;
  return result;
}

std::string small_talk(const LogicalForm& form, const WordMeanings& meanings) {
  const auto reply = meanings.replies.find(small_talk_topic(form));
  return reply == meanings.replies.end() ? "I do not know what to say to that." : reply->second;
}

} // namespace castor::communication
