#include "castor/planning/motivation/request_values.hpp"

#include "castor/base/text.hpp"

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

void add(MotiveValues& values, const std::string& role, const Nominal& thing,
         const communication::MoveReferents& referents) {
  if (!thing.proposition.empty())
    values[role] = lower_case(thing.proposition);
  for (const auto& x : referents.referents)
    if (x.nominal == thing.name && x.proxies.size() == 1)
      values[role + "-proxy"] = lower_case(x.proxies.front());
  for (const auto& x : referents.pronouns)
    if (x.nominal == thing.name && x.proxies.size() == 1)
      values[role + "-proxy"] = lower_case(x.proxies.front());
}

} // namespace

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
  return values;
}

} // namespace castor::planning
