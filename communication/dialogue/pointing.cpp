#include "castor/communication/dialogue/pointing.hpp"

#include "castor/communication/dialogue/descriptions.hpp"
#include "castor/communication/dialogue/evaluation.hpp"
#include "castor/communication/parsing/hybrid_logic.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace castor::communication {

namespace {

/// People who point do not tell apart what differs by less in its distance; metres.
constexpr double clear_difference = 0.005;

bool is_here(const Nominal& region) {
  return region.sort == "region" && (region.proposition == "here" || region.proposition == "there");
}

/// Distance of a thing from a place, metres.
struct Distance {
  std::string id;
  double to_edge = 0;
  double to_middle = 0;
};

std::optional<Distance> distance_from(const Place& place, const std::string& id,
                                      const SceneKnowledge& scene) {
  auto at = scene.place(id);
  if (!at)
    return std::nullopt;
  const double to_middle = std::hypot(at->x - place.x, at->y - place.y);
  auto body = scene.body(id);
  if (!body)
    return Distance{id, to_middle, to_middle};
  auto outside = [&](std::size_t axis, double x) {
    return std::max({body->low(axis) - x, x - body->high(axis), 0.0});
  };
  return Distance{id, std::hypot(outside(0, place.x), outside(1, place.y)), to_middle};
}

/// Those whose edges are within reach, the nearest first; of several that the place is in, that
/// whose middle is nearest.
std::vector<Distance> within_reach(const Place& place, const std::vector<std::string>& things,
                                   const SceneKnowledge& scene, double reach) {
  std::vector<Distance> result;
  for (auto& id : things)
    if (auto distance = distance_from(place, id, scene); distance && distance->to_edge <= reach)
      result.push_back(*std::move(distance));
  std::ranges::sort(result, [](auto& a, auto& b) {
    return std::tie(a.to_edge, a.to_middle, a.id) < std::tie(b.to_edge, b.to_middle, b.id);
  });
  return result;
}

bool are_equally_near(const Distance& a, const Distance& b) {
  return std::abs(a.to_edge - b.to_edge) < clear_difference &&
         std::abs(a.to_middle - b.to_middle) < clear_difference;
}

/// How many of the nearest are meant.
std::size_t number_meant(const LogicalForm& form, const Nominal& phrase,
                         const std::vector<Distance>& near) {
  if (const auto* quantity = dependent(form, phrase, "Quantity"))
    if (auto range = number_range(*quantity))
      return std::min(range->most, near.size());
  if (is_plural(phrase))
    return near.size();
  std::size_t result = std::min<std::size_t>(1, near.size());
  while (result > 0 && result < near.size() && are_equally_near(near.front(), near[result]))
    ++result;
  return result;
}

/// Finds what is meant by the phrases of one form.
class PointingResolution {
public:
  PointingResolution(const LogicalForm& form, const Place& place, const Antecedents& antecedents,
                     SceneKnowledge& scene, double reach)
    : form_(form), place_(place), known_(antecedents), scene_(scene), reach_(reach) {}

  Antecedents run() && {
    const auto* root = find_nominal(form_, form_.root);
    const auto* topic = root == nullptr ? nullptr : dependent(form_, *root, "Topic");
    // What a phrase means may depend on another: "this cube left of that one".
    for (int depth = 0; depth < 2; ++depth)
      for (auto& x : form_.nominals)
        if (is_here(x) && dependent(form_, x, "Anchor") == nullptr)
          note(x, within_reach(place_, scene_.things(), scene_, reach_));
        else if (is_shown(form_, x, scene_.vocabulary()) &&
                 (topic == nullptr || topic->name == x.name))
          resolve(x);
    return std::move(result_);
  }

private:
  void resolve(const Nominal& phrase) {
    known_.erase(phrase.name + std::string{pointed_at});
    auto candidates = is_pronoun(phrase) ? scene_.things() : described(phrase);
    auto near = within_reach(place_, candidates, scene_, reach_);
    near.resize(number_meant(form_, phrase, near));
    note(phrase, near);
  }

  std::vector<std::string> described(const Nominal& phrase) {
    try {
      return Evaluation{form_, known_, scene_}.described(phrase).possible;
    } catch (const Uninterpretable&) {
      return {};
    }
  }

  void note(const Nominal& x, const std::vector<Distance>& near) {
    std::vector<std::string> proxies;
    for (auto& thing : near)
      proxies.push_back(scene_.proxy_of(thing.id));
    const auto name = x.name + std::string{pointed_at};
    known_.insert_or_assign(name, proxies);
    result_.insert_or_assign(name, std::move(proxies));
  }

  const LogicalForm& form_;
  Place place_;
  Antecedents known_;
  SceneKnowledge& scene_;
  double reach_;
  Antecedents result_;
};

} // namespace

bool is_stale(const Pointing& pointing, const PointingUse& use,
              std::span<const MoveReferents> history, Timestamp now, const PointingLimits& limits) {
  if (pointing.held.value_or(false))
    return false;
  if (pointing.time && now > Timestamp{*pointing.time} + limits.age)
    return true;
  std::int32_t last_use = -1;
  std::size_t others = 0;
  auto is_same = [&](const MoveReferents& move) {
    return move.pointing && move.pointing->pointing == use.pointing &&
           move.pointing->version == use.version;
  };
  for (auto& move : history)
    if (is_same(move) && move.pointing->taken_up)
      last_use = std::max(last_use, move.turn);
  for (auto& move : history)
    others += is_same(move) && move.turn > last_use ? 1 : 0;
  return others >= limits.utterances;
}

bool is_shown(const LogicalForm& form, const Nominal& phrase, const Vocabulary& vocabulary) {
  if (phrase.sort != "thing" || vocabulary.surroundings(phrase) != nullptr)
    return false;
  if (is_deictic(phrase) || !feature(phrase, "Proximity").empty())
    return true;
  return feature(phrase, "Delimitation") == "unique" &&
         std::ranges::any_of(phrase.relations, [&form](auto& relation) {
           const auto* region = find_nominal(form, relation.dependent);
           return relation.mode == "Location" && region != nullptr && is_here(*region) &&
                  dependent(form, *region, "Anchor") == nullptr;
         });
}

Antecedents antecedents_by_pointing(const DialogueMove& move, const Place& place,
                                    const Antecedents& antecedents, SceneKnowledge& scene,
                                    double reach) {
  auto result = PointingResolution{move.content, place, antecedents, scene, reach}.run();
  for (auto& alternative : move.alternatives)
    result.merge(PointingResolution{alternative, place, antecedents, scene, reach}.run());
  return result;
}

std::optional<Place> place_of_text(std::string_view text) {
  Place result;
  const auto* const end = text.data() + text.size();
  const auto x = std::from_chars(text.data(), end, result.x);
  if (x.ec != std::errc{} || x.ptr == end || *x.ptr != ',')
    return std::nullopt;
  const auto y = std::from_chars(x.ptr + 1, end, result.y);
  if (y.ec != std::errc{} || y.ptr != end || !std::isfinite(result.x) || !std::isfinite(result.y))
    return std::nullopt;
  return result;
}

} // namespace castor::communication
