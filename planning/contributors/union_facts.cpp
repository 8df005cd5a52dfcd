#include "castor/planning/contributors/union_facts.hpp"

#include "castor/base/text.hpp"
#include "castor/planning/continual/object_name.hpp"

#include <algorithm>
#include <iterator>
#include <set>
#include <stdexcept>
#include <utility>

namespace castor::planning {

namespace {

using binding::FeatureKind;
using binding::KnownUnion;

bool has(const KnownUnion& x, FeatureKind kind) {
  return std::ranges::any_of(x.features, [kind](const binding::Feature& feature) {
    return feature.kind == kind && !feature.negated;
  });
}

class Facts {
public:
  Facts(const binding::ReferenceReply& bound, const UnionFactTerms& terms)
    : bound_(bound), terms_(terms) {
    // nop
  }

  StateReply tell() {
    for (const auto& x : bound_.relations)
      if (x.label == binding::position_label) {
        places_.insert(x.from);
        things_at_.insert_or_assign(x.from, x.to);
      }
    for (const auto& x : bound_.unions)
      if (!has(x, FeatureKind::relation_label) &&
          (places_.contains(x.id) || has(x, FeatureKind::concept_name)))
        tell(x);
    for (std::int64_t i = 1; i <= terms_.free_places; ++i)
      add_object("free-place-" + std::to_string(i), terms_.place_type);
    for (const auto& x : bound_.relations)
      tell(x);
    result_.facts.assign(facts_.begin(), facts_.end());
    return std::move(result_);
  }

private:
  void add_object(const std::string& name, const std::string& type) {
    const StateObject x{name, type};
    if (std::ranges::find(result_.objects, x) == result_.objects.end())
      result_.objects.push_back(x);
  }

  void tell(const KnownUnion& x) {
    const auto name = object_name(x.proxy);
    names_[x.id] = name;
    add_object(name, places_.contains(x.id) ? terms_.place_type : terms_.thing_type);
    for (const auto& feature : x.features)
      for (const auto& rule : terms_.words)
        if (feature.kind == rule.kind && is_known(feature)) {
          const auto word = word_name(feature.text);
          add_object(word, rule.type);
          facts_.insert("(" + rule.predicate + " " + name + " " + word + ")");
        }
    for (const auto& rule : terms_.unknown)
      if (has(x, rule.first) && std::ranges::none_of(x.features, [&](const auto& feature) {
            return feature.kind == rule.first && is_known(feature);
          }))
        facts_.insert("(" + rule.second + " " + name + ")");
  }

  static bool is_known(const binding::Feature& x) {
    return !x.negated && !x.text.empty() && x.text != "unknown";
  }

  void tell(const binding::UnionRelation& x) {
    const auto from = names_.find(x.from);
    const auto to = names_.find(x.to);
    if (from == names_.end() || to == names_.end())
      return;
    if (x.label == binding::position_label) {
      facts_.insert("(= (" + terms_.position + " " + to->second + ") " + from->second + ")");
    } else if (const auto predicate = terms_.relations.find(x.label);
               predicate != terms_.relations.end()) {
      facts_.insert("(" + predicate->second + " " + from->second + " " + landmark(x.to) + ")");
    }
  }

  /// The thing at that place, if it is one and something is there.
  const std::string& landmark(const std::string& id) const {
    const auto thing = things_at_.find(id);
    const auto name = thing == things_at_.end() ? names_.end() : names_.find(thing->second);
    return name == names_.end() ? names_.at(id) : name->second;
  }

  const binding::ReferenceReply& bound_;
  const UnionFactTerms& terms_;
  /// Unions that something is at.
  std::set<std::string> places_;
  /// By place.
  std::map<std::string, std::string> things_at_;
  /// By union.
  std::map<std::string, std::string> names_;
  std::set<std::string> facts_;
  StateReply result_;
};

} // namespace

FeatureKind feature_named(const std::string& name) {
  const auto& kinds = reflection_of<FeatureKind>().enumerators;
  const auto kind = std::ranges::find_if(
    kinds, [&](const auto& x) { return x.first == (name == "concept" ? "concept_name" : name); });
  if (kind == std::end(kinds))
    throw std::invalid_argument("there is no feature " + in_quotes(name) +
                                ": write concept, colour, shape, size, material or name");
  return kind->second;
}

WordFacts word_facts(const std::string& rule) {
  const auto equals = rule.find('=');
  const auto colon = rule.find(':', equals == std::string::npos ? 0 : equals);
  if (equals == std::string::npos || colon == std::string::npos || colon == equals + 1 ||
      colon + 1 == rule.size())
    throw std::invalid_argument("the words " + in_quotes(rule) +
                                " are not understood: write FEATURE=PREDICATE:TYPE, such as "
                                "colour=has-colour:colour");
  WordFacts result;
  result.kind = feature_named(rule.substr(0, equals));
  result.predicate = lower_case(rule.substr(equals + 1, colon - equals - 1));
  result.type = lower_case(rule.substr(colon + 1));
  return result;
}

StateReply facts_of(const binding::ReferenceReply& bound, const UnionFactTerms& terms) {
  return Facts(bound, terms).tell();
}

} // namespace castor::planning
