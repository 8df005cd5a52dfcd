#include "castor/tests/planning/motivation/pretended_table.hpp"

#include "castor/planning/tabletop/goal_text.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace castor::planning::test {

namespace {

using spatial::GroundPoint;
using spatial::PlaceWanted;

constexpr const char* relations[] = {"left", "right", "front", "back", "near", "away"};

std::string predicate(const std::string& relation) {
  const std::map<std::string, std::string> names{
    {"left", "wp-left-of"}, {"right", "wp-right-of"}, {"front", "wp-front-of"},
    {"back", "wp-back-of"}, {"near", "wp-near"},      {"away", "wp-away-from"}};
  return names.at(relation);
}

bool is_part_of_table(const std::string& part) {
  return part != "elsewhere" && part != "aside" && part != "there" && part != "at-hand";
}

} // namespace

PretendedTable::PretendedTable(const std::vector<PretendedThing>& things) {
  for (const auto& x : things) {
    things_.push_back({x, "at-" + x.name, {}, {}});
    waypoints_["at-" + x.name] = x.place;
  }
}

std::size_t PretendedTable::index(const std::string& name) const {
  for (std::size_t i = 0; i < things_.size(); ++i)
    if (things_[i].what.name == name)
      return i;
  throw std::out_of_range(name);
}

GroundPoint PretendedTable::place(const std::string& thing) const {
  return things_.at(index(thing)).what.place;
}

/// Those that are not on the table are far away.
std::vector<spatial::TableObject> PretendedTable::objects() const {
  std::vector<spatial::TableObject> result;
  for (const auto& x : things_) {
    const auto place = x.is_on_table() ? x.what.place : GroundPoint{0.9, 0.9};
    result.push_back({place, x.what.side / 2, x.what.shape != "sphere"});
  }
  return result;
}

spatial::TablePlaces PretendedTable::places() const {
  return spatial::TablePlaces{objects(), {0, -0.62}};
}

std::unique_ptr<communication::test::TableScene> PretendedTable::scene() const {
  using binding::feature;
  using binding::FeatureKind;
  auto result = std::make_unique<communication::test::TableScene>();
  const auto table = places();
  for (const auto& x : things_)
    result->put(x.what.name,
                {feature(FeatureKind::colour, x.what.colour),
                 feature(FeatureKind::shape, x.what.shape),
                 feature(FeatureKind::size, x.what.side > 0.06 ? "large" : "small"),
                 binding::extent_of(x.what.side, x.what.side, x.what.side)},
                x.what.place.x, x.what.place.y);
  for (std::size_t i = 0; i < things_.size(); ++i)
    for (std::size_t j = 0; j < things_.size(); ++j)
      for (const auto* relation : {"left", "right", "front", "back", "near"})
        if (i != j && table.holds({relation, {j}}, i))
          result->relate(relation, things_[i].what.name, things_[j].what.name);
  return result;
}

std::vector<TableThing> PretendedTable::things(const std::vector<std::string>& parts) const {
  std::vector<TableThing> result;
  const auto table = places();
  for (std::size_t i = 0; i < things_.size(); ++i) {
    const auto& x = things_[i];
    TableThing thing{x.what.name,
                     x.what.name,
                     x.waypoint,
                     "the " + x.what.colour + ' ' + x.what.shape,
                     x.what.place.x,
                     {{"colour", x.what.colour},
                      {"shape", x.what.shape},
                      {"size", x.what.side > 0.06 ? "large" : "small"}},
                     {},
                     x.waypoint_before,
                     x.waypoint == "hand"};
    for (const auto& part : parts)
      if (x.is_on_table() && table.holds({part, {}}, i))
        thing.parts.push_back(part);
    thing.y = x.what.place.y;
    thing.radius = x.what.side / 2;
    thing.height = x.what.side;
    if (x.on)
      thing.on = things_[*x.on].what.name;
    result.push_back(std::move(thing));
  }
  return result;
}

TableGoal PretendedTable::begin(TableGoal goal) {
  for (auto& x : goal.spots) {
    const auto name = "spot-" + std::to_string(++spots_);
    waypoints_[name] = {x.x, x.y};
    const auto end = x.name + ')';
    for (auto at = goal.formula.find(end); at != std::string::npos; at = goal.formula.find(end, at))
      goal.formula.replace(at, x.name.size(), name);
    x.name = name;
  }
  return goal;
}

/// Whether nothing stands in the way there, but what the goal moves.
bool PretendedTable::is_free(const std::string& waypoint, const TableGoal& goal) const {
  const auto at = waypoints_.at(waypoint);
  return std::ranges::none_of(things_, [&](const auto& x) {
    const auto wanted = waypoint_wanted(goal.formula, x.what.name);
    const bool leaves = !wanted.empty() && wanted != x.waypoint;
    return x.is_on_table() && x.waypoint != waypoint && !leaves &&
           std::hypot(x.what.place.x - at.x, x.what.place.y - at.y) < 0.09;
  });
}

/// What the goal moves has to leave before another is put nearly where it is.
bool PretendedTable::has_to_wait(const Thing& x, const Thing& other, const TableGoal& goal) const {
  const std::string wanted{waypoint_wanted(goal.formula, x.what.name)};
  const auto leaves_for = waypoint_wanted(goal.formula, other.what.name);
  return x.what.name != other.what.name && wanted != x.waypoint && !leaves_for.empty() &&
         leaves_for != other.waypoint && wanted != other.waypoint && waypoints_.contains(wanted) &&
         spatial::distance(waypoints_.at(wanted), other.what.place) <
           (x.what.side + other.what.side) / 2 + 0.02;
}

std::string PretendedTable::problem(const TableGoal& goal) const {
  const auto table = places();
  std::ostringstream out;
  out << "(define (problem table) (:domain playmate) (:agent arm)\n(:objects arm - agent";
  for (const auto& x : things_)
    out << ' ' << x.what.name << " - thing";
  for (const auto& [name, place] : waypoints_)
    out << ' ' << name << " - waypoint";
  for (std::size_t i = 0; i < goal.new_places; ++i)
    out << " new-" << moves_ << '-' << i << " - waypoint";
  for (const auto& part : goal.parts)
    out << ' ' << part << " - part";
  out << ")\n(:init";
  for (const auto& [name, place] : waypoints_)
    if (is_free(name, goal))
      out << " (used " << name << ')';
  for (const auto& x : things_)
    for (const auto& other : things_)
      if (has_to_wait(x, other, goal) && !has_to_wait(other, x, goal))
        out << " (in-way " << other.what.name << ' ' << x.what.name << ')';
  for (std::size_t i = 0; i < things_.size(); ++i) {
    const auto& x = things_[i];
    out << "\n(= (pos " << x.what.name << ") " << x.waypoint << ')';
    if (x.what.shape == "sphere")
      out << " (no-flat-top " << x.what.name << ')';
    if (!x.is_on_table())
      continue;
    if (x.on)
      out << " (wp-on " << x.waypoint << ' ' << things_[*x.on].what.name << ')';
    for (const auto& part : goal.parts)
      if (is_part_of_table(part) && table.holds({part, {}}, i))
        out << " (wp-in " << x.waypoint << ' ' << part << ')';
    for (std::size_t j = 0; j < things_.size(); ++j) {
      if (j == i || !things_[j].is_on_table())
        continue;
      for (const auto* relation : relations)
        if (table.holds({relation, {j}}, i))
          out << " (" << predicate(relation) << ' ' << x.waypoint << ' ' << things_[j].what.name
              << ')';
      for (std::size_t k = 0; k < things_.size(); ++k)
        if (k != i && k != j && things_[k].is_on_table() && table.holds({"between", {j, k}}, i))
          out << " (wp-between " << x.waypoint << ' ' << things_[j].what.name << ' '
              << things_[k].what.name << ')';
    }
  }
  for (const auto& [name, place] : waypoints_)
    if (goal.formula.find(' ' + name + ')') == std::string::npos)
      out << " (unwanted " << name << ')';
  for (const auto& fact : unasked_relations(goal.formula))
    out << ' ' << fact;
  out << ")\n(:goal " << goal.formula << "))";
  return out.str();
}

void PretendedTable::choose(const std::string& waypoint, const std::string& relation,
                            std::vector<std::size_t> landmarks) {
  chosen_[waypoint].push_back({relation, std::move(landmarks)});
}

std::string PretendedTable::move(std::size_t thing, const std::string& to) {
  auto& x = things_[thing];
  GroundPoint place;
  x.on.reset();
  if (const auto chosen = chosen_.find(to); chosen != chosen_.end()) {
    const auto found = places().find(thing, chosen->second);
    if (found.targets.empty())
      return found.reason;
    place = found.targets.front().position;
    x.on = found.on;
    chosen_.erase(chosen);
  } else
    place = waypoints_.at(to);
  x.waypoint_before = x.waypoint;
  x.waypoint = to;
  x.what.place = place;
  waypoints_[to] = place;
  return {};
}

std::string PretendedTable::execute(const std::string& step) {
  std::istringstream in{step};
  std::vector<std::string> words;
  for (std::string word; in >> word;)
    words.push_back(word);
  const auto& action = words.at(0);
  constexpr const char* choosing = "reposition-";
  if (action == "reposition-in")
    choose(words.at(2), words.at(3), {});
  else if (action == "reposition-free")
    choose(words.at(2), "elsewhere", {});
  else if (action == "reposition-on")
    choose(words.at(2), "on", {index(words.at(3))});
  else if (action == "reposition-between")
    choose(words.at(2), "between", {index(words.at(3)), index(words.at(4))});
  else if (action.starts_with(choosing))
    choose(words.at(2), action.substr(std::string{choosing}.size()), {index(words.at(3))});
  else {
    const auto thing = index(words.at(2));
    if (action == "move")
      if (auto problem = move(thing, words.at(3)); !problem.empty())
        return problem;
    ++moves_;
    if (action == "move")
      return {};
    if (action == "push")
      return {};
    auto& x = things_[thing];
    x.waypoint_before = x.waypoint;
    x.waypoint = "hand";
    x.on.reset();
  }
  return {};
}

bool PretendedTable::has_collision() const {
  for (std::size_t i = 0; i < things_.size(); ++i)
    for (std::size_t j = i + 1; j < things_.size(); ++j) {
      const auto& a = things_[i];
      const auto& b = things_[j];
      const bool is_apart =
        std::hypot(a.what.place.x - b.what.place.x, a.what.place.y - b.what.place.y) >=
        (a.what.side + b.what.side) / 2 - 1e-9;
      if (a.is_on_table() && b.is_on_table() && a.on != j && b.on != i && !is_apart)
        return true;
    }
  return false;
}

} // namespace castor::planning::test
