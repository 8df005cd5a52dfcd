#pragma once

#include <cmath>
#include <string>
#include <string_view>
#include <utility>

/// Places of requests about things on a table: predicates of configs/domains/playmate.pddl, and
/// how they are said.
namespace castor::planning {

/// Predicates for relations, and how they are said.
struct RelationWords {
  std::string_view relation;
  std::string_view predicate;
  std::string_view words;
};

inline constexpr RelationWords relation_words[] = {{"left", "left-of", "to the left of"},
                                                   {"right", "right-of", "to the right of"},
                                                   {"front", "front-of", "in front of"},
                                                   {"back", "back-of", "behind"},
                                                   {"near", "near", "next to"},
                                                   {"away", "away-from", "away from"},
                                                   {"on", "on", "on"},
                                                   {"in", "on", "in"},
                                                   {"between", "between", "between"}};

inline constexpr std::pair<std::string_view, std::string_view> part_words[] = {
  {"left", "on the left"},
  {"right", "on the right"},
  {"front", "at the front"},
  {"back", "at the back"},
  {"left-edge", "at the left edge"},
  {"right-edge", "at the right edge"},
  {"front-edge", "at the front edge"},
  {"back-edge", "at the back edge"},
  {"edge", "at the edge"},
  {"corner", "in a corner"},
  {"front-left-corner", "in the front left corner"},
  {"front-right-corner", "in the front right corner"},
  {"back-left-corner", "in the back left corner"},
  {"back-right-corner", "in the back right corner"},
  {"front-left", "at the front left"},
  {"front-right", "at the front right"},
  {"back-left", "at the back left"},
  {"back-right", "at the back right"},
  {"centre", "in the middle"},
  {"left-middle", "on the left in the middle"},
  {"right-middle", "on the right in the middle"},
  {"front-middle", "at the front in the middle"},
  {"back-middle", "at the back in the middle"},
  {"left-edge-middle", "in the middle of the left edge"},
  {"right-edge-middle", "in the middle of the right edge"},
  {"front-edge-middle", "in the middle of the front edge"},
  {"back-edge-middle", "in the middle of the back edge"},
  {"table", "on the table"},
  {"elsewhere", "somewhere else"},
  {"aside", "aside"},
  {"at-hand", "near you"}};

/// How several things stand.
inline constexpr std::pair<std::string_view, std::string_view> arrangement_words[] = {
  {"in-row", "in a row"},         {"in-row-as-named", "in a row"},
  {"in-two-rows", "in two rows"}, {"in-column", "one behind the other"},
  {"in-ring", "in a circle"},     {"apart", "farther apart"}};

/// How far things go that are put further to a side, metres.
struct Shift {
  std::string_view relation;
  double x;
  double y;
  std::string_view words;
};

/// All ways that a thing goes from where it is, and their words.
struct Shifted {
  double x = 0;
  double y = 0;
  std::string words;
};

inline constexpr double further = 0.08;
inline constexpr double slightly = 0.04;

inline constexpr Shift shifts[] = {{"further-left", -further, 0, "further left"},
                                   {"further-right", further, 0, "further right"},
                                   {"further-front", 0, -further, "further to the front"},
                                   {"further-back", 0, further, "further back"},
                                   {"slightly-left", -slightly, 0, "a little to the left"},
                                   {"slightly-right", slightly, 0, "a little to the right"},
                                   {"slightly-front", 0, -slightly, "a little to the front"},
                                   {"slightly-back", 0, slightly, "a little to the back"}};

/// Where what is cleared away from a part goes.
inline constexpr std::pair<std::string_view, std::string_view> opposites[] = {
  {"left", "right"},      {"right", "left"},      {"front", "back"},      {"back", "front"},
  {"centre", "edge"},     {"left-edge", "right"}, {"right-edge", "left"}, {"front-edge", "back"},
  {"back-edge", "front"}, {"edge", "centre"}};

/// The value of a key, or nothing.
template <class Table>
std::string_view words_for(const Table& table, std::string_view key) {
  for (const auto& [name, value] : table)
    if (name == key)
      return value;
  return {};
}

/// To half a centimetre: "5.5 centimetres".
inline std::string fine_centimetres(double metres) {
  const auto halves = std::lround(200 * metres);
  return std::to_string(halves / 2) + (halves % 2 == 0 ? "" : ".5") + " centimetres";
}

} // namespace castor::planning
