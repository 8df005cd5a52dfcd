#include "castor/mapping/tour/tour_request.hpp"

#include "castor/mapping/tour/area_knowledge.hpp"

#include <algorithm>
#include <string_view>

namespace castor::mapping {

namespace {

using communication::DialogueMove;
using communication::DialogueMoveType;
using communication::LogicalForm;
using communication::Nominal;

const Nominal* find(const LogicalForm& form, std::string_view name) {
  const auto found = std::ranges::find(form.nominals, name, &Nominal::name);
  return found == form.nominals.end() ? nullptr : &*found;
}

const Nominal* dependent(const LogicalForm& form, const Nominal& of, std::string_view mode) {
  const auto found = std::ranges::find(of.relations, mode, &communication::NominalRelation::mode);
  return found == of.relations.end() ? nullptr : find(form, found->dependent);
}

bool has(const Nominal& x, std::string_view feature, std::string_view value) {
  return std::ranges::any_of(
    x.features, [&](auto& known) { return known.name == feature && known.value == value; });
}

bool is_denied(const Nominal& x) {
  return has(x, "Polarity", "neg") || has(x, "Denied", "true");
}

/// "living_room" is one word of the lexicon.
std::optional<std::string> name_of(const Nominal* thing) {
  if (thing == nullptr || thing->sort != "thing" || thing->proposition.empty() ||
      is_denied(*thing) || has(*thing, "Number", "pl") || !thing->relations.empty())
    return std::nullopt;
  return label_of_concept(thing->proposition);
}

/// "To the kitchen".
const Nominal* anchor_of(const LogicalForm& form, const Nominal* place, std::string_view sort,
                         std::string_view relation) {
  if (place == nullptr || place->sort != sort || place->proposition != relation)
    return nullptr;
  return dependent(form, *place, "Anchor");
}

std::optional<TourRequest> directive(const LogicalForm& form, const Nominal& root) {
  if (root.sort != "action" || is_denied(root))
    return std::nullopt;
  if (root.proposition == "stop" && dependent(form, root, "Patient") == nullptr)
    return TourRequest{TourWish::stop, {}};
  if (root.proposition == "follow") {
    const auto* whom = dependent(form, root, "Patient");
    if (whom != nullptr && whom->sort == "person" && whom->proposition == "i")
      return TourRequest{TourWish::follow, {}};
  }
  if (root.proposition == "go") {
    const auto* destination = dependent(form, root, "Destination");
    if (const auto place = name_of(anchor_of(form, destination, "place", "to")))
      return TourRequest{TourWish::go, *place};
  }
  return std::nullopt;
}

} // namespace

std::optional<TourRequest> tour_request(const DialogueMove& move) {
  const auto& form = move.content;
  const auto* root = find(form, form.root);
  if (root == nullptr || move.type != DialogueMoveType::action_directive)
    return std::nullopt;
  return directive(form, *root);
}

std::string reply_to(const std::optional<TourRequest>& request, bool is_known) {
  if (!request)
    return "I can not do that.";
  switch (request->wish) {
    case TourWish::go:
      return is_known ? "I go to the " + request->place + "."
                      : "I do not know where the " + request->place + " is.";
    case TourWish::follow:
      return "I follow you.";
    case TourWish::stop:
      return "I stop.";
  }
  return {};
}

} // namespace castor::mapping
