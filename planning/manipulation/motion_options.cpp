#include "castor/planning/manipulation/motion_options.hpp"

#include <array>
#include <stdexcept>
#include <string>
#include <utility>

namespace castor::manipulation {

namespace {

constexpr std::array<std::pair<std::string_view, PlanningAlgorithm>, 3> algorithms{
  {{"rrt_connect", PlanningAlgorithm::rrt_connect},
   {"rrt_star", PlanningAlgorithm::rrt_star},
   {"bit_star", PlanningAlgorithm::bit_star}}};

} // namespace

PlanningAlgorithm planning_algorithm(std::string_view name) {
  std::string names;
  for (const auto& [known, algorithm] : algorithms) {
    if (known == name)
      return algorithm;
    names += (names.empty() ? "" : ", ") + std::string(known);
  }
  throw std::invalid_argument("\"" + std::string(name) + "\" is no planning algorithm; they are " +
                              names);
}

} // namespace castor::manipulation
