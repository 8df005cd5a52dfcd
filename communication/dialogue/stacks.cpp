#include "castor/communication/dialogue/stacks.hpp"

#include "castor/communication/dialogue/descriptions.hpp"

#include <algorithm>
#include <cstddef>

namespace castor::communication {

bool is_tower(const Nominal& phrase) {
  return phrase.proposition == "tower" && !is_plural(phrase) && is_definite_phrase(phrase);
}

std::vector<std::string> only_stack(SceneKnowledge& scene) {
  const auto& things = scene.things();
  const auto is_on = [&](const std::string& a, const std::string& b) {
    return a != b && scene.is_related("on", a, b) == Truth::yes;
  };
  std::vector<std::string> result;
  for (const auto& x : things) {
    const bool is_below = std::ranges::any_of(things, [&](const auto& y) { return is_on(y, x); });
    if (!is_below || std::ranges::any_of(things, [&](const auto& y) { return is_on(x, y); }))
      continue;
    if (!result.empty())
      return {};
    result.push_back(x);
  }
  for (std::size_t i = 0; i < result.size(); ++i)
    for (const auto& x : things)
      if (is_on(x, result[i]) && std::ranges::find(result, x) == result.end())
        result.push_back(x);
  return result;
}

} // namespace castor::communication
