#include "castor/mapping/tour/tour_request.hpp"

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
  auto result = thing->proposition;
  std::ranges::replace(result, '_', ' ');
  return result;
}

/// "This", "that", "this room"; "it" may be anything that was spoken of.
bool is_here(const Nominal& x) {
  const bool is_shown = x.proposition == "this" || x.proposition == "that";
  return x.sort == "thing" &&
         (is_shown || (x.proposition == "room" && has(x, "Proximity", "proximal")));
}

/// "In the kitchen", "to the kitchen".
const Nominal* anchor_of(const LogicalForm& form, const Nominal* place, std::string_view sort,
                         std::string_view relation) {
  if (place == nullptr || place->sort != sort || place->proposition != relation)
    return nullptr;
  return dependent(form, *place, "Anchor");
}

std::optional<std::string> place_named(const LogicalForm& form, const Nominal& root) {
  if (root.sort != "ascription" || is_denied(root))
    return std::nullopt;
  const auto* subject = dependent(form, root, "Cop-Restr");
  const auto* said = dependent(form, root, "Cop-Scope");
  if (subject == nullptr || said == nullptr)
    return std::nullopt;
  if (is_here(*subject))
    return name_of(said);
  const bool is_one_of_us =
    subject->sort == "person" && (subject->proposition == "we" || subject->proposition == "you");
  return is_one_of_us ? name_of(anchor_of(form, said, "region", "in")) : std::nullopt;
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
  if (root == nullptr)
    return std::nullopt;
  if (move.type == DialogueMoveType::action_directive)
    return directive(form, *root);
  if (move.type == DialogueMoveType::assertion)
    if (auto place = place_named(form, *root))
      return TourRequest{TourWish::name_place, *std::move(place)};
  return std::nullopt;
}

std::string reply_to(const std::optional<TourRequest>& request, bool is_known) {
  if (!request)
    return "I can not do that.";
  switch (request->wish) {
    case TourWish::name_place:
      break;
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
