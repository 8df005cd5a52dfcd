#include "castor/planning/motivation/request_values.hpp"

#include "castor/base/text.hpp"
#include "castor/planning/continual/object_name.hpp"

#include <algorithm>
#include <string_view>

namespace castor::planning {

namespace {

using communication::LogicalForm;
using communication::Nominal;

const Nominal* find(const LogicalForm& form, std::string_view name) {
  const auto found = std::ranges::find(form.nominals, name, &Nominal::name);
  return found == form.nominals.end() ? nullptr : &*found;
}

const Nominal* dependent(const LogicalForm& form, const Nominal& nominal, std::string_view mode) {
  for (const auto& x : nominal.relations)
    if (x.mode == mode)
      return find(form, x.dependent);
  return nullptr;
}

/// What a question or a statement is about; null if that is nothing, or several things.
const communication::DiscourseReferent* subject_of(const communication::MoveReferents& referents) {
  if (referents.referents.empty() || referents.referents.front().is_plural)
    return nullptr;
  return &referents.referents.front();
}

void add(MotiveValues& values, const std::string& role, const Nominal& thing,
         const communication::MoveReferents& referents) {
  if (!thing.proposition.empty())
    values[role] = word_name(thing.proposition);
  for (const auto& x : referents.referents)
    if (x.nominal == thing.name && x.proxies.size() == 1)
      values[role + "-proxy"] = object_name(x.proxies.front());
  for (const auto& x : referents.pronouns)
    if (x.nominal == thing.name && x.proxies.size() == 1)
      values[role + "-proxy"] = object_name(x.proxies.front());
}

} // namespace

std::string occasion_of(const communication::DialogueMove& move,
                        const communication::MoveReferents& referents) {
  using communication::DialogueMoveType;
  if (move.type == DialogueMoveType::action_directive)
    return move.action;
  const auto* subject = subject_of(referents);
  if (subject == nullptr)
    return {};
  const bool is_question =
    move.type == DialogueMoveType::question_w || move.type == DialogueMoveType::question_yn;
  if (is_question && subject->proxies.empty())
    return "question";
  return move.type == DialogueMoveType::assertion && subject->proxies.size() == 1 ? "statement"
                                                                                  : "";
}

MotiveValues values_of_request(const communication::DialogueMove& move,
                               const communication::MoveReferents& referents,
                               const std::string& speaker, const std::string& text) {
  MotiveValues values{{"speaker", speaker}, {"text", text}};
  const auto& form = move.content;
  const auto* root = find(form, form.root);
  if (!root)
    return values;
  if (const auto* patient = dependent(form, *root, "Patient"))
    add(values, "patient", *patient, referents);
  if (const auto* destination = dependent(form, *root, "Destination")) {
    const auto* anchor = dependent(form, *destination, "Anchor");
    if (anchor)
      values["relation"] = lower_case(destination->proposition);
    add(values, "destination", anchor ? *anchor : *destination, referents);
  }
  const auto* subject = subject_of(referents);
  if (subject != nullptr && move.type != communication::DialogueMoveType::action_directive)
    if (const auto* thing = find(form, subject->nominal))
      add(values, "patient", *thing, referents);
  return values;
}

} // namespace castor::planning
