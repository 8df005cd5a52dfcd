#include "castor/planning/motivation/table_goals.hpp"

#include "castor/planning/motivation/table_words.hpp"

namespace castor::planning {

std::vector<std::string> unasked_relations(std::string_view formula) {
  std::vector<std::string> result;
  const auto note = [&](std::string_view predicate, std::string_view relation) {
    if (formula.find('(' + std::string{predicate} + ' ') == std::string_view::npos)
      result.push_back("(unasked rel-" + std::string{relation} + ')');
  };
  note("in-part", "in");
  for (const auto& x : relation_words)
    if (x.relation != "in")
      note(x.predicate, x.relation);
  return result;
}

std::string explained(std::string_view action, std::string_view reason) {
  auto result = "I cannot " + std::string{action};
  if (!reason.empty())
    result += ": " + std::string{reason};
  return result.ends_with('.') ? result : result + '.';
}

} // namespace castor::planning
