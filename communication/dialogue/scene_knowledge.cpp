#include "castor/communication/dialogue/scene_knowledge.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

namespace castor::communication {

namespace {

using binding::Feature;
using binding::FeatureKind;
using binding::KnownUnion;
using binding::UnionRelation;

constexpr std::size_t axes = 3;

std::optional<std::vector<double>> numbers_of(const binding::KnownUnion* x, FeatureKind kind) {
  if (x != nullptr)
    for (auto& feature : x->features)
      if (feature.kind == kind && !feature.negated && feature.numbers.size() == axes)
        return feature.numbers;
  return std::nullopt;
}

} // namespace

Truth SceneKnowledge::has(const std::string& id, const Feature& x) {
  const auto known = std::ranges::find(known_, x, &KnownFeature::feature);
  if (known == known_.end()) {
    ask({{{{x}}}, {}});
    return Truth::unknown;
  }
  const auto found = known->truth.find(id);
  return found == known->truth.end() ? Truth::no : found->second;
}

void SceneKnowledge::ask(const binding::Description& description) {
  if (std::find(open_questions_.begin(), open_questions_.end(), description) ==
      open_questions_.end())
    open_questions_.push_back(description);
}

Truth SceneKnowledge::is_related(const std::string& relation, const std::string& from,
                                 const std::string& to) {
  if (!has_learned_)
    return Truth::unknown;
  return truth_of(std::ranges::binary_search(relations_, UnionRelation{relation, from, to}));
}

bool SceneKnowledge::knows_relation(const std::string& relation) const {
  const auto first = std::ranges::lower_bound(relations_, relation, {}, &UnionRelation::label);
  return first != relations_.end() && first->label == relation;
}

const std::vector<std::string>& SceneKnowledge::things() {
  if (!has_learned_)
    ask({{{{feature(FeatureKind::concept_name, vocabulary_->general_concept())}}}, {}});
  return things_;
}

const std::vector<std::string>& SceneKnowledge::candidates(const std::string& noun) {
  if (vocabulary_->is_of_general_kind(noun))
    return things();
  if (!ask_for_kind(vocabulary_->concept_of(noun)))
    return all_;
  return vocabulary_->is_of_other_kind(noun) ? others_ : all_;
}

/// \returns whether the answer is known
bool SceneKnowledge::ask_for_kind(const std::string& name) {
  auto place = std::ranges::find(kinds_, name);
  if (place == kinds_.end())
    place = kinds_.insert(kinds_.end(), name);
  const bool is_known =
    has_learned_ && static_cast<std::size_t>(place - kinds_.begin()) < kinds_asked_;
  if (!is_known)
    ask({{{{feature(FeatureKind::concept_name, name)}}}, {}});
  return is_known;
}

bool SceneKnowledge::is_kind_known(const std::string& noun) const {
  const auto& ontology = vocabulary_->ontology();
  const auto& name =
    vocabulary_->is_general(noun) ? vocabulary_->general_concept() : vocabulary_->concept_of(noun);
  const bool is_competent = std::ranges::any_of(scene_.competences, [&](auto& x) {
    return ontology.is_kind_of(name, x.kind) || ontology.is_kind_of(x.kind, name);
  });
  // What the ontology does not know may be a name for anything.
  return is_competent || !ontology.knows(name) || std::ranges::any_of(all_, [&](auto& id) {
           return std::ranges::any_of(words(id, FeatureKind::concept_name), [&](auto& known) {
             return ontology.is_kind_of(known, name) || ontology.is_kind_of(name, known);
           });
         });
}

std::string SceneKnowledge::learner_of(const std::string& noun) {
  things();
  const auto& name = vocabulary_->concept_of(noun);
  const auto found = std::ranges::find_if(scene_.competences, [&](auto& x) {
    return x.learns_names && name != x.kind && vocabulary_->ontology().is_kind_of(name, x.kind);
  });
  return found == scene_.competences.end() ? std::string{} : found->subarchitecture;
}

std::vector<std::string> SceneKnowledge::addressee() {
  const auto& name = vocabulary_->addressee();
  std::vector<std::string> result;
  if (name.empty() || !ask_for_kind(name))
    return result;
  for (auto& id : others_) {
    const auto known = words(id, FeatureKind::concept_name);
    if (std::ranges::find(known, name) != known.end())
      result.push_back(id);
  }
  return result;
}

std::vector<std::string> SceneKnowledge::surroundings(const std::string& union_id) const {
  std::vector<std::string> result;
  for (auto& x : relations_)
    if (x.label == binding::containment_label && x.from == union_id && !is_thing(x.to))
      result.push_back(x.to);
  return result;
}

void SceneKnowledge::learn(std::span<const binding::Description> asked,
                           binding::ReferenceReply reply) {
  // Who was not asked before may tell of individuals that earlier answers say nothing of.
  if (kinds_asked_ < kinds_.size() &&
      std::ranges::any_of(reply.competences, &binding::KnowledgeCompetence::answers_calls))
    known_.clear();
  kinds_asked_ = kinds_.size();
  if (reply.ontology)
    take_ontology(*reply.ontology);
  for (std::size_t i = 0; i < asked.size() && i < reply.referents.size(); ++i) {
    auto& learned = known_.emplace_back();
    learned.feature = asked[i].things.front().features.front();
    for (auto& found : reply.referents[i].readings)
      learned.truth.emplace(found.unions.front(), found.unknown == 0 ? Truth::yes : Truth::unknown);
  }
  open_questions_.clear();
  const bool has_new_relations =
    !has_learned_ || reply.ontology || reply.relations != scene_.relations;
  scene_ = std::move(reply);
  if (!std::ranges::is_sorted(scene_.unions, {}, &KnownUnion::id))
    std::ranges::sort(scene_.unions, {}, &KnownUnion::id);
  has_learned_ = true;
  const auto things_before = std::exchange(things_, {});
  sort_individuals();
  if (has_new_relations || things_ != things_before)
    relate_things();
}

void SceneKnowledge::take_ontology(const binding::ConceptStatements& stated) {
  vocabulary_ = std::make_shared<const Vocabulary>(
    vocabulary_->lexicon(), std::make_shared<const Ontology>(stated.statements));
  scene_.ontology.reset();
}

void SceneKnowledge::sort_individuals() {
  const auto& ontology = vocabulary_->ontology();
  const auto& general = vocabulary_->general_concept();
  things_.clear();
  others_.clear();
  std::vector<std::string> unknown;
  for (auto& x : scene_.unions) {
    bool is_individual = false;
    bool is_general = false;
    bool is_other = false;
    for (auto& feature : x.features) {
      if (feature.kind != FeatureKind::concept_name || feature.negated || feature.text.empty() ||
          feature.text == "unknown")
        continue;
      is_individual = true;
      is_general = is_general || ontology.is_kind_of(feature.text, general);
      is_other = is_other || ontology.excludes(feature.text, general);
    }
    if (is_individual)
      (is_other ? others_ : is_general ? things_ : unknown).push_back(x.id);
  }
  all_ = things_;
  all_.insert(all_.end(), others_.begin(), others_.end());
  all_.insert(all_.end(), unknown.begin(), unknown.end());
}

/// Things are related by the places where they are, or themselves.
void SceneKnowledge::relate_things() {
  locations_.clear();
  std::unordered_map<std::string_view, std::string_view> thing_at;
  for (auto& x : scene_.relations)
    if (x.label == binding::position_label) {
      locations_[x.to].push_back(x.from);
      thing_at.emplace(x.from, x.to);
    }
  relations_.clear();
  auto thing = [&thing_at](const std::string& id) {
    auto at = thing_at.find(id);
    return at == thing_at.end() ? id : std::string{at->second};
  };
  for (auto& x : scene_.relations)
    if (x.label != binding::position_label)
      relations_.push_back({x.label, thing(x.from), thing(x.to)});
  std::ranges::sort(relations_);
  const auto repeated = std::ranges::unique(relations_);
  relations_.erase(repeated.begin(), repeated.end());
  contents_.clear();
  containers_.clear();
  for (auto& x : relations_)
    if (x.label == binding::containment_label && is_thing(x.to)) {
      contents_[x.to].push_back(x.from);
      containers_[x.from].push_back(x.to);
    }
}

const binding::KnownUnion* SceneKnowledge::find(const std::string& union_id) const {
  const auto found = std::ranges::lower_bound(scene_.unions, union_id, {}, &KnownUnion::id);
  return found == scene_.unions.end() || found->id != union_id ? nullptr : &*found;
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

bool SceneKnowledge::is_sure(const std::string& union_id, FeatureKind kind) const {
  const auto* x = find(union_id);
  return x == nullptr || std::ranges::none_of(x->features, [kind](auto& feature) {
           return feature.kind == kind && !feature.negated && !feature.numbers.empty();
         });
}

std::optional<Place> SceneKnowledge::place(const std::string& union_id) const {
  return place_by(union_id, FeatureKind::location);
}

std::optional<Place> SceneKnowledge::place_in_view(const std::string& union_id) const {
  auto result = place_by(union_id, FeatureKind::view_location);
  return result ? result : place(union_id);
}

std::optional<Place> SceneKnowledge::place_by(const std::string& union_id, FeatureKind kind) const {
  auto at = locations_.find(union_id);
  if (at == locations_.end())
    return std::nullopt;
  for (auto& location : at->second)
    if (auto numbers = numbers_of(find(location), kind))
      return Place{(*numbers)[0], (*numbers)[1]};
  return std::nullopt;
}

std::optional<double> SceneKnowledge::extent(const std::string& union_id) const {
  auto numbers = numbers_of(find(union_id), FeatureKind::extent);
  return numbers ? std::optional{std::ranges::max(*numbers)} : std::nullopt;
}

std::optional<double> SceneKnowledge::width(const std::string& union_id) const {
  auto numbers = numbers_of(find(union_id), FeatureKind::extent);
  return numbers ? std::optional{std::max((*numbers)[0], (*numbers)[1])} : std::nullopt;
}

std::optional<double> SceneKnowledge::height(const std::string& union_id) const {
  auto numbers = numbers_of(find(union_id), FeatureKind::extent);
  return numbers ? std::optional{numbers->back()} : std::nullopt;
}

std::optional<Body> SceneKnowledge::body(const std::string& union_id) const {
  auto size = numbers_of(find(union_id), FeatureKind::extent);
  auto at = locations_.find(union_id);
  if (!size || at == locations_.end())
    return std::nullopt;
  for (auto& location : at->second)
    if (auto centre = numbers_of(find(location), FeatureKind::location))
      return Body{{(*centre)[0], (*centre)[1], (*centre)[2]}, {(*size)[0], (*size)[1], (*size)[2]}};
  return std::nullopt;
}

const std::vector<std::string>& SceneKnowledge::contents(const std::string& union_id) const {
  static const std::vector<std::string> nothing;
  auto found = contents_.find(union_id);
  return found == contents_.end() ? nothing : found->second;
}

const std::vector<std::string>& SceneKnowledge::containers(const std::string& union_id) const {
  static const std::vector<std::string> nothing;
  auto found = containers_.find(union_id);
  return found == containers_.end() ? nothing : found->second;
}

namespace {

/// How far something that is dx to the right of a landmark and dy behind it is in a direction.
double length_along(std::string_view relation, double dx, double dy) {
  if (relation == "left" || relation == "right")
    return relation == "left" ? -dx : dx;
  if (relation == "front" || relation == "back")
    return relation == "front" ? -dy : dy;
  return 0;
}

} // namespace

bool SceneKnowledge::is_toward(std::string_view side, const std::string& from,
                               const std::string& to) const {
  constexpr double least_share = 0.342; // the cosine of 70 degrees
  const auto here = place_in_view(from);
  const auto there = place_in_view(to);
  if (!here || !there)
    return false;
  const double dx = here->x - there->x;
  const double dy = here->y - there->y;
  const double along = length_along(side, dx, dy);
  return along > 0 && along >= least_share * std::hypot(dx, dy);
}

std::vector<SpatialFact> SceneKnowledge::spatial_facts(const std::string& union_id) const {
  std::vector<SpatialFact> result;
  for (auto& x : relations_) {
    if (x.from != union_id)
      continue;
    SpatialFact fact{x.label, x.to};
    auto here = place(x.from);
    auto there = place(x.to);
    if (here && there)
      fact.distance = std::hypot(here->x - there->x, here->y - there->y);
    result.push_back(std::move(fact));
  }
  const auto here = place_in_view(union_id);
  const auto along = [&](const SpatialFact& x) {
    const auto there = place_in_view(x.landmark);
    return here && there ? length_along(x.relation, here->x - there->x, here->y - there->y) : 0;
  };
  std::ranges::stable_sort(result, [&](const SpatialFact& a, const SpatialFact& b) {
    return a.distance != b.distance ? a.distance < b.distance : along(a) > along(b);
  });
  return result;
}

} // namespace castor::communication
