#pragma once

#include "castor/actors/component/entry_pointer.hpp"
#include "castor/wm/entries/address.hpp"
#include "castor/wm/values/reflect.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

/// Entry types of the binding working memory: what subarchitectures say of the things that they
/// know about, and what binding makes of it. docs/binding.md has the whole picture.
namespace castor::binding {

enum class FeatureKind {
  concept_name,
  name,
  relation_label,
  colour,
  shape,
  size,
  material,
  /// Where it is: x, y, z in `numbers`, metres.
  location,
  /// The subarchitecture that it comes from.
  source_id,
  /// Negated: not to be bound to anything from that subarchitecture.
  other_source_id,
  /// The tether: the entry that the proxy stands for, in `data`.
  source_data,
  this_proxy_id,
  /// To be bound to that proxy.
  existing_proxy_id,
  /// Microseconds since the system began, in `numbers`.
  creation_time,
  /// While it was pointed at: begin, and end if it is over; microseconds, in `numbers`.
  salience,
  /// "perceived", "desired", ...
  temporal_frame,
  group,
  singular,
  area_id,
  person_id,
  debug_string,
};

/// What can be said of a thing, in words that all subarchitectures know. Immutable: a proxy changes
/// by having other features.
struct Feature {
  FeatureKind kind = FeatureKind::debug_string;
  std::string text;
  std::vector<double> numbers;
  AnyEntryPointer data;
  /// As in "not red".
  bool negated = false;

  friend bool operator==(const Feature&, const Feature&) = default;
};

/// A kind whose value is a word: concept, colour, ...
inline Feature feature(FeatureKind kind, std::string text) {
  return {kind, std::move(text), {}, {}, false};
}

/// "red" of "not red", and the other way round.
inline Feature negation_of(Feature x) {
  x.negated = !x.negated;
  return x;
}

/// Metres.
inline Feature location_at(double x, double y, double z) {
  return {FeatureKind::location, {}, {x, y, z}, {}, false};
}

/// Not to be bound to anything from that subarchitecture.
inline Feature not_from(std::string subarchitecture) {
  return negation_of(feature(FeatureKind::other_source_id, std::move(subarchitecture)));
}

/// The tether to what the proxy stands for.
inline Feature tether_to(AnyEntryPointer data) {
  return {FeatureKind::source_data, {}, {}, std::move(data), false};
}

/// Microseconds since the system began.
inline Feature created_at(std::int64_t time) {
  return {FeatureKind::creation_time, {}, {static_cast<double>(time)}, {}, false};
}

/// Still salient if there is no end.
inline Feature salient_from(std::int64_t begin, std::optional<std::int64_t> end = std::nullopt) {
  Feature result{FeatureKind::salience, {}, {static_cast<double>(begin)}, {}, false};
  if (end)
    result.numbers.push_back(static_cast<double>(*end));
  return result;
}

enum class ProxyType { basic, group, relation };

/// Temporal frames.
inline constexpr const char* perceived_frame = "perceived";
inline constexpr const char* desired_frame = "desired";

/// The label of the relation from a location to what is there.
inline constexpr const char* position_label = "pos";

/// The names of a relation's two ends: `from` is left of `to`.
inline constexpr const char* from_port = "from";
inline constexpr const char* to_port = "to";

/// One end of a relation. In the relation's proxy (out-port) it says to whom it leads; the same
/// record stands among the in-ports of that one's union.
struct Port {
  /// The end's name, such as "from" and "to".
  std::string label;
  /// Who is there.
  std::string proxy;
  /// The proxy of the relation.
  std::string owner;

  friend bool operator==(const Port&, const Port&) = default;
};

enum class ProxyState { fresh, updated, reprocessed, bound };

/// What one subarchitecture says of one thing. The entry's id is the proxy's.
struct BindingProxy {
  ProxyType type = ProxyType::basic;
  /// The subarchitecture that it comes from.
  std::string source;
  /// Proxies with a lower precedence are bound first, whenever they came: perception before what
  /// refers to it.
  std::int32_t precedence = 0;
  std::vector<Feature> features;
  /// Of a relation.
  std::vector<Port> out_ports;
  /// Stands for something that need not exist.
  bool hypothetical = false;
  ProxyState state = ProxyState::fresh;
  /// What the binder made of it; empty before.
  std::string union_id;
  /// All members of that union, itself included.
  std::vector<std::string> proxy_ids;
  std::uint32_t updates = 0;
  std::uint32_t binding_count = 0;
};

/// One thing: all that is said of it. The entry's id follows from its first member's.
struct BindingUnion {
  ProxyType type = ProxyType::basic;
  /// In the order of binding.
  std::vector<std::string> proxy_ids;
  /// The subarchitectures of the members, in the same order.
  std::vector<std::string> sources;
  /// Those of all members: what several say stands there several times.
  std::vector<Feature> features;
  std::vector<Port> out_ports;
  std::vector<Port> in_ports;
  std::uint32_t updates = 0;

  friend bool operator==(const BindingUnion&, const BindingUnion&) = default;
};

/// How well a proxy fits into a union, or to stay alone.
struct BindingScore {
  bool comparable = false;
  bool mismatch = false;
  std::uint32_t matches = 0;
  bool relation_mismatch = false;
  std::uint32_t relation_matches = 0;
  std::uint32_t sticky = 0;
  /// Microseconds between what is salient here and there; 0 where they overlap.
  double salience_gap = 1e13;

  friend bool operator==(const BindingScore&, const BindingScore&) = default;
};

/// An empty union id is for NIL: a union of its own.
struct ProxyUnionScore {
  std::string proxy;
  std::string union_id;
  BindingScore score;

  friend bool operator==(const ProxyUnionScore&, const ProxyUnionScore&) = default;
};

/// From the scorer to the judge: how well a proxy fits into NIL, and into every union that its
/// features do not rule out.
struct ProxyUnionScores {
  std::string proxy;
  std::vector<ProxyUnionScore> scores;

  friend bool operator==(const ProxyUnionScores&, const ProxyUnionScores&) = default;
};

/// From the judge: the unions that fit equally well and better than all others, the one to take
/// first. Empty for NIL.
struct BestUnionsForProxy {
  std::string proxy;
  std::vector<std::string> unions;

  friend bool operator==(const BestUnionsForProxy&, const BestUnionsForProxy&) = default;
};

/// The id of the one BinderStatus.
inline constexpr const char* binder_status = "binder-status";

/// Whoever changes proxies or unions holds a lease of this entry meanwhile: monitors, and the
/// binder.
struct BinderStatus {
  /// Every proxy is in the best of its unions, as far as that is known.
  bool stable = true;
  std::uint64_t proxies = 0;
  std::uint64_t unions = 0;

  friend bool operator==(const BinderStatus&, const BinderStatus&) = default;
};

/// Whether two features speak of the same thing.
enum class Truth { unknown, yes, no };

/// A question that a competent subarchitecture is to answer, and the answer; a request of calls,
/// too.
struct FeatureComparison {
  Feature proxy_feature;
  Feature union_feature;
  Truth equivalent = Truth::unknown;
  bool answered = false;
};

/// What becomes of an internal comparator's answer where there is an external one.
enum class Trust {
  /// Nobody else is asked.
  completely,
  /// It counts until the other has answered.
  until_validated,
  /// It never counts.
  not_at_all,
};

/// A subarchitecture says that it can compare these kinds of features.
struct FeatureComparisonCompetence {
  std::string subarchitecture;
  FeatureKind proxy_kind = FeatureKind::concept_name;
  FeatureKind union_kind = FeatureKind::concept_name;
  Trust trust_yes = Trust::completely;
  Trust trust_no = Trust::until_validated;
  Trust trust_unknown = Trust::not_at_all;
};

/// Several unions fit a proxy equally well; it was bound to the first of them.
struct Ambiguity {
  std::string proxy;
  std::vector<std::string> unions;
  /// What some of the unions say of themselves and the proxy does not.
  std::vector<FeatureKind> missing_in_proxy;
  /// What the proxy says and some of the unions do not.
  std::vector<FeatureKind> missing_in_unions;

  friend bool operator==(const Ambiguity&, const Ambiguity&) = default;
};

/// From a monitor: this proxy is to be deleted.
struct BindingProxyDeletionTask {
  std::string proxy;
};

/// A tombstone: the proxy is gone, and what leads to it may be cleared away.
struct DeletedBindingProxy {
  std::string proxy;
  std::string source;
  std::string union_id;
};

/// What somebody says of a thing that is meant to be known already.
struct DescribedThing {
  std::vector<Feature> features;

  friend bool operator==(const DescribedThing&, const DescribedThing&) = default;
};

/// Two described things, by their numbers: `from` is `label` of `to`.
struct DescribedRelation {
  std::string label;
  std::uint32_t from = 0;
  std::uint32_t to = 0;

  friend bool operator==(const DescribedRelation&, const DescribedRelation&) = default;
};

/// "the red thing left of the ball": two things, one relation. The first thing is the one that is
/// asked for.
struct Description {
  std::vector<DescribedThing> things;
  std::vector<DescribedRelation> relations;

  friend bool operator==(const Description&, const Description&) = default;
};

/// Which unions a description may be about.
struct Referents {
  /// One for each described thing, none twice.
  std::vector<std::string> unions;
  /// How many of the features described are neither confirmed nor denied; 0 if it is certain.
  std::uint32_t unknown = 0;

  friend bool operator==(const Referents&, const Referents&) = default;
};

/// A relation between two unions, as some relation proxy says.
struct UnionRelation {
  std::string label;
  std::string from;
  std::string to;

  friend auto operator<=>(const UnionRelation&, const UnionRelation&) = default;
};

/// A call: which unions may each description be about? Only what is perceived counts.
struct ReferenceRequest {
  std::vector<Description> descriptions;
};

/// What is known of a union.
struct KnownUnion {
  std::string id;
  /// Of its members, the one that everybody can keep hold of it by.
  std::string proxy;
  std::vector<Feature> features;
};

/// Of one description.
struct DescriptionReferents {
  std::vector<Referents> readings;
};

struct ReferenceReply {
  /// For each description the unions that it may be about, the most certain first, each with the
  /// most certain of its readings. No relation or feature of them is denied.
  std::vector<DescriptionReferents> referents;
  /// Everything that is perceived, and how it lies to each other.
  std::vector<KnownUnion> unions;
  std::vector<UnionRelation> relations;
};

CASTOR_REFLECT_ENUM(FeatureKind, concept_name, name, relation_label, colour, shape, size, material,
                    location, source_id, other_source_id, source_data, this_proxy_id,
                    existing_proxy_id, creation_time, salience, temporal_frame, group, singular,
                    area_id, person_id, debug_string)
CASTOR_REFLECT(Feature, kind, text, numbers, data, negated)
CASTOR_REFLECT_ENUM(ProxyType, basic, group, relation)
CASTOR_REFLECT(Port, label, proxy, owner)
CASTOR_REFLECT_ENUM(ProxyState, fresh, updated, reprocessed, bound)
CASTOR_REFLECT(BindingProxy, type, source, precedence, features, out_ports, hypothetical, state,
               union_id, proxy_ids, updates, binding_count)
CASTOR_REFLECT(BindingUnion, type, proxy_ids, sources, features, out_ports, in_ports, updates)
CASTOR_REFLECT(BindingScore, comparable, mismatch, matches, relation_mismatch, relation_matches,
               sticky, salience_gap)
CASTOR_REFLECT(ProxyUnionScore, proxy, union_id, score)
CASTOR_REFLECT(ProxyUnionScores, proxy, scores)
CASTOR_REFLECT(BestUnionsForProxy, proxy, unions)
CASTOR_REFLECT(BinderStatus, stable, proxies, unions)
CASTOR_REFLECT_ENUM(Truth, unknown, yes, no)
CASTOR_REFLECT(FeatureComparison, proxy_feature, union_feature, equivalent, answered)
CASTOR_REFLECT_ENUM(Trust, completely, until_validated, not_at_all)
CASTOR_REFLECT(FeatureComparisonCompetence, subarchitecture, proxy_kind, union_kind, trust_yes,
               trust_no, trust_unknown)
CASTOR_REFLECT(Ambiguity, proxy, unions, missing_in_proxy, missing_in_unions)
CASTOR_REFLECT(BindingProxyDeletionTask, proxy)
CASTOR_REFLECT(DeletedBindingProxy, proxy, source, union_id)
CASTOR_REFLECT(DescribedThing, features)
CASTOR_REFLECT(DescribedRelation, label, from, to)
CASTOR_REFLECT(Description, things, relations)
CASTOR_REFLECT(Referents, unions, unknown)
CASTOR_REFLECT(UnionRelation, label, from, to)
CASTOR_REFLECT(ReferenceRequest, descriptions)
CASTOR_REFLECT(KnownUnion, id, proxy, features)
CASTOR_REFLECT(DescriptionReferents, readings)
CASTOR_REFLECT(ReferenceReply, referents, unions, relations)

} // namespace castor::binding
