#include "castor/benchmarks/manipulation/table_tasks.hpp"

#include "castor/benchmarks/manipulation/table_relations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

namespace castor::manipulation {

namespace {

/// Of things from the arm: it takes low ones there.
constexpr double farthest = 0.38;

std::string noun(const RandomThing& x) {
  return "the " + x.colour + ' ' + (x.shape == "sphere" ? "ball" : x.shape);
}

bool is_sorted_already(const std::vector<RandomThing>& things) {
  const auto colours = colours_from_left(things);
  const double width = 2 * half_width / static_cast<double>(colours.size());
  return std::ranges::all_of(things, [&](const auto& x) {
    const auto strip = std::ranges::find(colours, x.colour) - colours.begin();
    return std::floor((x.x + half_width) / width) == static_cast<double>(strip);
  });
}

bool has_something_to_do(const TableTask& task) {
  const auto& a = task.things[0];
  const auto& b = task.things[1];
  switch (task.kind) {
    case TaskKind::put:
      return !is_at(task.relation, a, {a.x, a.y}, b, {b.x, b.y}, false);
    case TaskKind::sort:
      return colours_from_left(task.things).size() > 1 && !is_sorted_already(task.things);
    case TaskKind::clear:
      return std::ranges::any_of(task.things, [&](const auto& x) {
        return is_wholly_on(task.relation, x, {x.x, x.y});
      });
    default:
      return true;
  }
}

std::string sentence_of(const TableTask& task) {
  static const std::map<std::string, std::string> words{{"left", "to the left of"},
                                                        {"right", "to the right of"},
                                                        {"front", "in front of"},
                                                        {"back", "behind"},
                                                        {"near", "next to"}};
  const auto first = noun(task.things[0]);
  const auto second = noun(task.things[1]);
  switch (task.kind) {
    case TaskKind::put:
      return "Put " + first + ' ' + words.at(task.relation) + ' ' + second + '.';
    case TaskKind::take:
      return "Take " + first + '.';
    case TaskKind::sort:
      return "Sort the things by colour.";
    case TaskKind::clear:
      return "Clear the " + task.relation + " side of the table.";
    case TaskKind::swap:
      return "Swap " + first + " and " + second + '.';
  }
  return {};
}

} // namespace

TableTask random_table_task(std::uint64_t seed) {
  // Tables on which there is nothing to do are thrown away.
  for (std::uint64_t round = 0;; ++round) {
    std::mt19937_64 random(seed + round * 1'000'003);
    TableTask result;
    result.kind = static_cast<TaskKind>((seed + 4) % 5);
    auto colours = random_colours(random);
    const auto spots = random_spots(random, 3 + random() % 3, farthest);
    if (result.kind == TaskKind::sort)
      colours.resize(2 + random() % 2);
    for (std::size_t i = 0; i < spots.size(); ++i)
      result.things.push_back(random_thing(random, colours[i % colours.size()], spots[i]));
    // The arm does not reach the back of the table with all things.
    constexpr const char* relations[] = {"left", "right", "front", "back", "near"};
    result.relation = relations[random() % (result.kind == TaskKind::put ? 5 : 2)];
    result.sentence = sentence_of(result);
    if (has_something_to_do(result))
      return result;
  }
}

std::string what_is_wrong(const TableTask& task, const std::vector<TrueThing>& things) {
  const auto names = by_name(task);
  std::map<const RandomThing*, const TrueThing*> now;
  for (const auto& x : things)
    now[names.at(x.name)] = &x;
  const auto spot = [&](std::size_t i) {
    const auto& at = now.at(&task.things[i])->pose.position;
    return Spot{at.x, at.y};
  };
  for (std::size_t i = 0; i < task.things.size(); ++i) {
    const auto& support = now.at(&task.things[i])->support;
    const bool is_to_be_held = i == 0 && task.kind == TaskKind::take;
    if (support != (is_to_be_held ? "the gripper" : "the table"))
      return task.things[i].name() + " is on " + support;
  }
  const auto& a = task.things[0];
  const auto& b = task.things[1];
  switch (task.kind) {
    case TaskKind::put:
      if (!is_at(task.relation, a, spot(0), b, spot(1), false))
        return fmt::format("{} is not there, but at {:.3f} {:.3f}", a.name(), spot(0).x, spot(0).y);
      break;
    case TaskKind::take:
      break;
    case TaskKind::sort:
      for (std::size_t i = 0; i < task.things.size(); ++i)
        for (std::size_t j = 0; j < task.things.size(); ++j)
          for (std::size_t k = 0; k < task.things.size(); ++k)
            if (task.things[i].colour == task.things[k].colour &&
                task.things[i].colour != task.things[j].colour && spot(i).x < spot(j).x &&
                spot(j).x < spot(k).x)
              return task.things[j].name() + " is among others";
      break;
    case TaskKind::clear:
      for (std::size_t i = 0; i < task.things.size(); ++i) {
        const auto& x = task.things[i];
        if (is_wholly_on(task.relation, x, spot(i)) ||
            (is_wholly_on(task.relation, x, {x.x, x.y}) && on_side(task.relation, spot(i)) > 0))
          return fmt::format("{} is still there, at {:.3f} {:.3f}", x.name(), spot(i).x, spot(i).y);
      }
      break;
    case TaskKind::swap:
      if (distance(spot(0), {b.x, b.y}) > same_place || distance(spot(1), {a.x, a.y}) > same_place)
        return "they have not changed places";
      break;
  }
  return {};
}

} // namespace castor::manipulation
