#include "castor/communication/dialogue/stacks.hpp"

#include "castor/communication/dialogue/descriptions.hpp"

#include <algorithm>
#include <cstddef>

namespace castor::communication {

bool is_tower(const Nominal& phrase) {
  return phrase.proposition == "tower" && !is_plural(phrase) && is_definite_phrase(phrase);
}

namespace {

bool is_on(SceneKnowledge& scene, const std::string& a, const std::string& b) {
  return a != b && scene.is_related("on", a, b) == Truth::yes;
}

} // namespace

std::vector<std::string> only_stack(SceneKnowledge& scene) {
  const auto& things = scene.things();
  std::vector<std::string> result;
  for (const auto& x : things) {
    const bool is_below =
      std::ranges::any_of(things, [&](const auto& y) { return is_on(scene, y, x); });
    if (!is_below || std::ranges::any_of(things, [&](const auto& y) { return is_on(scene, x, y); }))
      continue;
    if (!result.empty())
      return {};
    result.push_back(x);
  }
  for (std::size_t i = 0; i < result.size(); ++i)
    for (const auto& x : things)
      if (is_on(scene, x, result[i]) && std::ranges::find(result, x) == result.end())
        result.push_back(x);
  return result;
}

std::vector<std::string> without_carriers(SceneKnowledge& scene, std::vector<std::string> things) {
  if (!scene.knows_relation("on"))
    return things;
  auto result = things;
  const auto carries_another = [&](const std::string& x) {
    return std::ranges::any_of(scene.things(), [&](const auto& y) {
      return std::ranges::find(result, y) == result.end() && is_on(scene, y, x);
    });
  };
  // What carries a carrier is one as well.
  for (auto carrier = std::ranges::find_if(result, carries_another); carrier != result.end();
       carrier = std::ranges::find_if(result, carries_another))
    result.erase(carrier);
  return result.empty() ? things : result;
}

} // namespace castor::communication
