#include "castor/planning/tabletop/goal_text.hpp"

#include "castor/perception/spatial/table_parts.hpp"

#include <set>

namespace castor::planning {

bool contains_word(std::string_view text, std::string_view word) {
  constexpr std::string_view ends = " ()";
  for (auto at = text.find(word); at != std::string_view::npos; at = text.find(word, at + 1)) {
    const auto end = at + word.size();
    if ((at == 0 || ends.find(text[at - 1]) != std::string_view::npos) &&
        (end == text.size() || ends.find(text[end]) != std::string_view::npos))
      return true;
  }
  return false;
}

bool is_subject(std::string_view goal, std::string_view thing) {
  for (auto open = goal.find('('); open != std::string_view::npos;
       open = goal.find('(', open + 1)) {
    const auto begin = goal.find_first_of(" ()", open + 1);
    if (begin == std::string_view::npos || goal[begin] != ' ')
      continue;
    if (goal.substr(begin + 1, goal.find_first_of(" ()", begin + 1) - begin - 1) == thing)
      return true;
  }
  return false;
}

std::string_view waypoint_wanted(std::string_view goal, std::string_view thing) {
  const auto head = "(= (pos " + std::string{thing} + ") ";
  const auto at = goal.find(head);
  if (at == std::string_view::npos)
    return {};
  const auto begin = at + head.size();
  return goal.substr(begin, goal.find(')', begin) - begin);
}

bool is_seen_part(std::string_view relation) {
  return relation != "at-hand" && spatial::is_part_of_table(relation);
}

std::vector<std::string> parts_in(std::string_view goal) {
  constexpr std::string_view head = "(in-part ";
  std::set<std::string> result;
  for (auto at = goal.find(head); at != std::string_view::npos; at = goal.find(head, at + 1)) {
    const auto begin = goal.find(' ', at + head.size());
    const auto end = goal.find(')', at);
    if (begin == std::string_view::npos || end == std::string_view::npos || begin > end)
      continue;
    auto part = std::string{goal.substr(begin + 1, end - begin - 1)};
    if (is_seen_part(part))
      result.insert(std::move(part));
  }
  return {result.begin(), result.end()};
}

} // namespace castor::planning
