#include "castor/communication/dialogue/scene_knowledge.hpp"

#include "castor/communication/parsing/hybrid_logic.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

namespace castor::communication {

namespace {

using binding::FeatureKind;

std::optional<std::vector<double>> location_of(const binding::KnownUnion* x) {
  if (x == nullptr)
    return std::nullopt;
  for (auto& feature : x->features)
    if (feature.kind == FeatureKind::location && feature.numbers.size() == 3)
      return feature.numbers;
  return std::nullopt;
}

bool share_a_word(const std::vector<std::string>& a, const std::vector<std::string>& b) {
  return std::find_first_of(a.begin(), a.end(), b.begin(), b.end()) != a.end();
}

/// Finds landmarks, those first that others are described by.
class LandmarkFinder {
public:
  LandmarkFinder(const LogicalForm& form, Antecedents antecedents, SceneKnowledge& scene)
    : form_(form), antecedents_(std::move(antecedents)), scene_(scene) {}

  void visit(const std::string& name, bool is_landmark) {
    const auto* nominal = find_nominal(form_, name);
    if (nominal == nullptr || !seen_.insert(name).second)
      return;
    for (auto& [mode, dependent] : nominal->relations)
      visit(dependent, mode == "Anchor" || mode == "Than");
    if (is_landmark && nominal->sort == "thing" && is_definite(*nominal) &&
        feature(*nominal, "Number") != "pl" && !antecedents_.contains(name))
      look_for(*nominal);
  }

  Antecedents result() && { return std::move(antecedents_); }

private:
  void look_for(const Nominal& landmark) {
    auto meaning = describe(form_, landmark, antecedents_);
    if (!meaning.not_understood.empty())
      return;
    auto found = scene_.candidates(form_, meaning, antecedents_).best();
    if (found.size() == 1)
      antecedents_.emplace(landmark.name, scene_.proxy_of(found.front()));
  }

  const LogicalForm& form_;
  Antecedents antecedents_;
  SceneKnowledge& scene_;
  std::set<std::string> seen_;
};

} // namespace

Antecedents with_landmarks(const LogicalForm& form, Antecedents antecedents,
                           SceneKnowledge& scene) {
  LandmarkFinder finder{form, std::move(antecedents), scene};
  finder.visit(form.root, false);
  return std::move(finder).result();
}

Candidates SceneKnowledge::candidates(const LogicalForm& form, const PhraseMeaning& meaning,
                                      const Antecedents& antecedents) {
  Candidates result;
  const auto* referents = referents_of(meaning.description);
  if (referents == nullptr)
    return result;
  for (auto& x : *referents) {
    // A place may be anything, as far as anybody says.
    if (std::find(things_.begin(), things_.end(), x.unions.front()) == things_.end())
      continue;
    result.possible.push_back(x.unions.front());
    if (x.unknown == 0)
      result.certain.push_back(x.unions.front());
  }
  for (auto& [kind, name] : meaning.shared) {
    const auto* other = find_nominal(form, name);
    if (other == nullptr)
      continue;
    auto others = candidates(form, describe(form, *other, antecedents), antecedents).best();
    const auto differs = [&, wanted = kind](const std::string& id) {
      return std::none_of(others.begin(), others.end(), [&](auto& one) {
        return one != id && share_a_word(words(id, wanted), words(one, wanted));
      });
    };
    std::erase_if(result.certain, differs);
    std::erase_if(result.possible, differs);
  }
  return result;
}

const std::vector<binding::Referents>*
SceneKnowledge::referents_of(const binding::Description& description) {
  for (auto& [asked, referents] : known_)
    if (asked == description)
      return &referents;
  if (std::find(open_questions_.begin(), open_questions_.end(), description) ==
      open_questions_.end())
    open_questions_.push_back(description);
  return nullptr;
}

void SceneKnowledge::learn(std::span<const binding::Description> asked,
                           binding::ReferenceReply reply) {
  for (std::size_t i = 0; i < asked.size() && i < reply.referents.size(); ++i)
    known_.emplace_back(asked[i], std::move(reply.referents[i].readings));
  open_questions_.clear();
  scene_ = std::move(reply);
  things_.clear();
  for (auto& x : scene_.unions)
    if (!words(x.id, FeatureKind::concept_name).empty())
      things_.push_back(x.id);
}

const binding::KnownUnion* SceneKnowledge::find(const std::string& union_id) const {
  auto found = std::find_if(scene_.unions.begin(), scene_.unions.end(),
                            [&union_id](auto& x) { return x.id == union_id; });
  return found == scene_.unions.end() ? nullptr : &*found;
}

std::string SceneKnowledge::proxy_of(const std::string& union_id) const {
  const auto* x = find(union_id);
  return x == nullptr ? std::string{} : x->proxy;
}

std::vector<std::string> SceneKnowledge::words(const std::string& union_id,
                                               FeatureKind kind) const {
  std::vector<std::string> result;
  const auto* x = find(union_id);
  if (x == nullptr)
    return result;
  for (auto& feature : x->features)
    if (feature.kind == kind && !feature.negated && !feature.text.empty() &&
        feature.text != "unknown" &&
        std::find(result.begin(), result.end(), feature.text) == result.end())
      result.push_back(feature.text);
  return result;
}

std::vector<SpatialFact> SceneKnowledge::spatial_facts(const std::string& union_id) const {
  std::map<std::string, std::string> thing_at;
  std::vector<std::string> places;
  for (auto& x : scene_.relations)
    if (x.label == binding::position_label) {
      thing_at.emplace(x.from, x.to);
      if (x.to == union_id)
        places.push_back(x.from);
    }
  std::vector<SpatialFact> result;
  for (auto& x : scene_.relations) {
    auto landmark = thing_at.find(x.to);
    if (x.label == binding::position_label || landmark == thing_at.end() ||
        std::find(places.begin(), places.end(), x.from) == places.end())
      continue;
    SpatialFact fact{x.label, landmark->second};
    auto here = location_of(find(x.from));
    auto there = location_of(find(x.to));
    if (here && there)
      fact.distance = std::hypot((*here)[0] - (*there)[0], (*here)[1] - (*there)[1]);
    result.push_back(std::move(fact));
  }
  std::stable_sort(result.begin(), result.end(),
                   [](auto& a, auto& b) { return a.distance < b.distance; });
  return result;
}

} // namespace castor::communication
