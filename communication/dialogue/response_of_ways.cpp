#include "castor/communication/dialogue/content.hpp"
#include "castor/communication/dialogue/descriptions.hpp"
#include "castor/communication/dialogue/referring_expression.hpp"
#include "castor/communication/dialogue/responder.hpp"
#include "castor/communication/parsing/english_words.hpp"
#include "castor/communication/parsing/hybrid_logic.hpp"

#include <algorithm>
#include <deque>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace castor::communication {

namespace {

Response say(std::string text) {
  return {RhetoricalRelation::answer, {}, std::move(text), {}};
}

/// "the living room".
std::string phrase_for(SceneKnowledge& scene, const std::string& room) {
  const auto form = referring_expression(scene, room);
  const auto* thing = find_nominal(form, form.root);
  if (thing == nullptr)
    return "a room";
  auto noun = thing->proposition;
  std::ranges::replace(noun, '_', ' ');
  if (is_definite(*thing))
    return "the " + noun;
  return (begins_with_vowel(noun) ? "an " : "a ") + noun;
}

/// From one room to the next that is near, by as few as there are: those between the first and the
/// goal, and the goal itself. Empty if there is no way, or it is there already.
std::vector<std::string> rooms_on_way(const SceneKnowledge& scene, const std::string& from,
                                      const std::string& to) {
  std::map<std::string, std::string> before{{from, {}}};
  std::deque<std::string> next{from};
  for (; !next.empty() && !before.contains(to); next.pop_front())
    for (auto& fact : scene.spatial_facts(next.front()))
      if (fact.relation == "near" && !scene.is_thing(fact.landmark) &&
          before.try_emplace(fact.landmark, next.front()).second)
        next.push_back(fact.landmark);
  std::vector<std::string> result;
  if (before.contains(to))
    for (auto at = to; at != from; at = before.at(at))
      result.insert(result.begin(), at);
  return result;
}

} // namespace

/// "How do I get to the kitchen?": through which rooms, from the one where the robot is.
Response Responder::way_to(const Nominal& phrase) {
  const auto goals = evaluation_.meant(phrase);
  if (goals.empty())
    throw Uninterpretable{Uninterpretable::Reason::nothing_like, phrase.name};
  std::vector<std::string> here;
  for (auto& self : scene_.addressee())
    here = scene_.surroundings(self);
  auto goal = goals.front();
  if (scene_.is_thing(goal)) {
    const auto around = scene_.surroundings(goal);
    goal = around.empty() ? std::string{} : around.front();
  }
  if (here.empty() || goal.empty())
    return answer(i_do_not_know());
  if (goal == here.front())
    return answer(ascribe(pronoun("it"), region("here")));
  const auto way = rooms_on_way(scene_, here.front(), goal);
  if (way.empty())
    return answer(i_do_not_know());
  if (way.size() == 1)
    return say("A way leads straight there from here.");
  std::string through;
  for (std::size_t i = 0; i + 1 < way.size(); ++i)
    through += (i == 0 ? "" : i + 2 == way.size() ? " and " : ", ") + phrase_for(scene_, way[i]);
  return say("Through " + through + '.');
}

} // namespace castor::communication
