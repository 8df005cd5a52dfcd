#include "castor/communication/dialogue/directive_places.hpp"

#include "castor/communication/dialogue/evaluation.hpp"
#include "castor/communication/parsing/hybrid_logic.hpp"
#include "castor/communication/parsing/numerals.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <string_view>
#include <utility>

namespace castor::communication {

namespace {

using Reason = Uninterpretable::Reason;
using Words = std::map<std::string_view, std::string_view>;

/// Places of which no landmark is said.
const Words parts{{"left", "left"},
                  {"right", "right"},
                  {"front", "front"},
                  {"back", "back"},
                  {"forward", "front"},
                  {"left-side", "left"},
                  {"right-side", "right"},
                  {"front-side", "front"},
                  {"back-side", "back"},
                  {"left-edge", "left-edge"},
                  {"right-edge", "right-edge"},
                  {"front-edge", "front-edge"},
                  {"back-edge", "back-edge"},
                  {"top", "back"},
                  {"bottom", "front"},
                  {"front-left-corner", "front-left-corner"},
                  {"front-right-corner", "front-right-corner"},
                  {"back-left-corner", "back-left-corner"},
                  {"back-right-corner", "back-right-corner"},
                  {"corner", "corner"},
                  {"edge", "edge"},
                  {"border", "edge"},
                  {"centre", "centre"},
                  {"middle", "centre"},
                  {"elsewhere", "elsewhere"},
                  {"away", "elsewhere"},
                  {"aside", "aside"},
                  {"here", "at-hand"},
                  {"roomiest", "roomiest"},
                  {"on-top", "on-top"},
                  {"opposite-corner", "opposite-corner"},
                  {"each-corner", "each-corner"},
                  {"opposite-side", "opposite-side"},
                  {"there", "there"},
                  {"table", "table"},
                  {"some-way", "some-way"}};

/// Relations to landmarks, besides those that binding has.
const Words relations{{"on", "on"},
                      {"above", "on"},
                      {"between", "between"},
                      {"among", "between"},
                      {"in", "in"},
                      {"at", "near"},
                      {"to", "near"},
                      {"away", "away"},
                      {"from", "away"},
                      {"far", "away"},
                      {"under", "under"},
                      {"directly-left", "left"},
                      {"directly-right", "right"},
                      {"directly-front", "front"},
                      {"directly-back", "back"},
                      {"touching", "near"},
                      {"midway", "midway"},
                      {"equidistant", "equidistant"},
                      {"in-line", "in-line"},
                      {"level", "level"},
                      {"level-across", "level-across"},
                      {"other-side", "other-side"},
                      {"closer", "closer"},
                      {"farther", "farther"},
                      {"both-sides", "both-sides"},
                      {"place-of", "where"},
                      {"place-before-of", "where-before"}};

std::string part(std::string_view word) {
  const auto found = parts.find(word);
  if (found == parts.end())
    throw Uninterpretable{Reason::word, std::string{word}};
  return std::string{found->second};
}

/// "Near the left side" is at its edge.
std::string part_by(std::string_view region, std::string_view word) {
  const auto result = part(word);
  const bool is_side =
    result == "left" || result == "right" || result == "front" || result == "back";
  return is_side && (region == "near" || region == "next_to") ? result + "-edge" : result;
}

std::string relation(const std::string& word, const Vocabulary& vocabulary) {
  if (const auto known = relations.find(word); known != relations.end())
    return std::string{known->second};
  if (const auto label = vocabulary.relation_of(word))
    return *label;
  throw Uninterpretable{Reason::word, word};
}

/// "Ten centimetres to the left"; 0 if nothing is said.
double metres_of(const Nominal& region) {
  return metres_of_centimetres(feature(region, "Centimetres"));
}

/// "Front" and "left" without landmarks are a corner.
std::vector<PlacePhrase> with_corner(std::vector<PlacePhrase> places) {
  if (places.size() != 2 || places[0].landmark != nullptr || places[1].landmark != nullptr)
    return places;
  const auto corner = parts.find(places[0].relation + '-' + places[1].relation + "-corner");
  if (corner == parts.end())
    return places;
  return {{std::string{corner->second}, nullptr}};
}

bool is_middle(const Nominal* x) {
  const auto known = x == nullptr ? parts.end() : parts.find(x->proposition);
  return known != parts.end() && known->second == "centre";
}

/// "In the middle of the front edge", "at the front edge in the middle": the edge; null if it is
/// something else.
const Nominal* side_in_middle_of(const LogicalForm& form, const Nominal& destination,
                                 const Nominal& anchor) {
  if (is_middle(&destination))
    return &anchor;
  if (is_middle(&anchor)) {
    const auto* owner = dependent(form, anchor, "Owner");
    return owner != nullptr && owner->sort == "place" ? owner : nullptr;
  }
  const auto* where = dependent(form, anchor, "Location");
  if (where == nullptr)
    return nullptr;
  const auto* middle = dependent(form, *where, "Anchor");
  return is_middle(middle == nullptr ? where : middle) ? &anchor : nullptr;
}

/// The side of something else than what everything is on: "the left side of the box".
PlacePhrase side_of(const Nominal& owner, const std::string& side) {
  constexpr std::array<std::string_view, 4> sides{"left", "right", "front", "back"};
  for (const auto x : sides)
    if (side == x || side == std::string{x} + "-edge")
      return {std::string{x}, &owner};
  return {"near", &owner};
}

} // namespace

PlacePhrase part_named(const LogicalForm& form, const Nominal& x, const Vocabulary& vocabulary) {
  if (vocabulary.surroundings(x) != nullptr)
    return {"table", nullptr};
  if (x.sort != "place")
    throw Uninterpretable{Reason::word, x.proposition};
  const auto* owner = dependent(form, x, "Owner");
  if (owner == nullptr || vocabulary.surroundings(*owner) != nullptr)
    return {part(x.proposition), nullptr};
  if (x.proposition == "top")
    return {"on", owner};
  return side_of(*owner, part(x.proposition));
}

std::optional<std::string_view> opposite_of(std::string_view side) {
  // Opposites follow each other.
  constexpr std::array<std::string_view, 4> sides{"left", "right", "front", "back"};
  const auto known = std::ranges::find(sides, side);
  if (known == sides.end())
    return std::nullopt;
  return sides[static_cast<std::size_t>(known - sides.begin()) ^ 1U];
}

std::string part_away_from(std::string_view part) {
  return std::string{opposite_of(part).value_or(part == "centre" ? "elsewhere" : "centre")};
}

std::vector<PlacePhrase> places_named(const LogicalForm& form, const Nominal& destination,
                                      const Vocabulary& vocabulary) {
  if (destination.sort == "conjunction") {
    // "Left or right of the ball" leaves the choice: the first one will do.
    std::vector<PlacePhrase> result;
    for (const auto* mode : {"First", "Next"}) {
      const auto* x = dependent(form, destination, mode);
      if (x == nullptr)
        throw Uninterpretable{Reason::word, destination.proposition};
      for (auto& place : places_named(form, *x, vocabulary))
        result.push_back(std::move(place));
      if (destination.proposition == "or")
        break;
    }
    return with_corner(std::move(result));
  }
  if (is_negated(destination))
    throw Uninterpretable{Reason::word, destination.proposition};
  const auto* anchor = dependent(form, destination, "Anchor");
  // "A bit further left."
  if (const auto degree = feature(destination, "Degree"); !degree.empty() && anchor == nullptr) {
    const auto side = destination.proposition.substr(destination.proposition.find('-'));
    return {{(degree == "small" ? "slightly" : "further") + side, nullptr, metres_of(destination)}};
  }
  // "A bit closer to the ball."
  if (const auto degree = feature(destination, "Degree");
      !degree.empty() && anchor != nullptr && anchor->sort == "thing") {
    constexpr double little = 0.04;
    const auto metres = metres_of(destination);
    return {{relation(destination.proposition, vocabulary), anchor,
             metres == 0 && degree == "small" ? little : metres}};
  }
  if (anchor == nullptr)
    return {{part(destination.proposition), nullptr}};
  // "Towards me": who speaks sits in front.
  if (anchor->sort == "person")
    return {{"front", nullptr}};
  if (anchor->sort == "place") {
    if (const auto* side = side_in_middle_of(form, destination, *anchor))
      return {part_named(form, *side, vocabulary), {"centre", nullptr}};
    auto result = part_named(form, *anchor, vocabulary);
    if (result.landmark == nullptr)
      result.relation = part_by(destination.proposition, anchor->proposition);
    result.distance = metres_of(destination);
    // "Away from the right side", unless it is said how far.
    if (result.landmark == nullptr && result.distance <= 0 && destination.proposition == "from")
      result.relation = part_away_from(result.relation);
    // "10 cm from the middle" may be anywhere around it.
    const bool is_towards = destination.proposition == "closer" || destination.proposition == "to";
    if (result.relation == "centre" && result.distance > 0 && !is_towards)
      throw Uninterpretable{Reason::word, destination.proposition};
    return {result};
  }
  if (const auto* everywhere = vocabulary.surroundings(*anchor)) {
    const auto found = parts.find(destination.proposition);
    // Not under the table.
    if (found == parts.end() && destination.proposition != "to" &&
        !everywhere->is_said_by(destination.proposition))
      throw Uninterpretable{Reason::word, destination.proposition};
    return {{found == parts.end() ? "table" : std::string{found->second}, nullptr}};
  }
  return {{relation(destination.proposition, vocabulary), anchor, metres_of(destination)}};
}

} // namespace castor::communication
