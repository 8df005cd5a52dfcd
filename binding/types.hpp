#pragma once

#include "castor/actors/component/entry_pointer.hpp"
#include "castor/base/ontology.hpp"
#include "castor/wm/entries/address.hpp"
#include "castor/wm/values/reflect.hpp"

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

/// Entry types of the binding working memory: proxies, the subarchitectures' descriptions of
/// things, and unions, proxies of one thing bound together. See docs/binding.md.
namespace castor {

CASTOR_REFLECT(ConceptProperty, property, value)
CASTOR_REFLECT(ConceptStatement, name, is_a, defined_by, disjoint_with, is_partitioned, alike)

} // namespace castor

namespace castor::binding {

enum class FeatureKind {
  concept_name,
  name,
  relation_label,
  colour,
  shape,
  size,
  material,
  /// Position: x, y, z in `numbers`, metres; in `text` the name of their frame.
  location,
  /// Position as the viewer sees it: to the right, away and up from the origin in `numbers`,
  /// metres. Left out if the viewer looks along y, where it is the location.
  view_location,
  /// How large it is: width, depth, height in `numbers`, metres.
  extent,
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
  /// Interval in which it was pointed at: begin, and end if it is over; microseconds, in `numbers`.
  salience,
  /// "perceived", "desired", ...
  temporal_frame,
  group,
  singular,
  area_id,
  person_id,
  debug_string,
};

/// A statement about a thing, in terms shared by all subarchitectures. Immutable: a changed proxy
/// has other features.
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

/// A word that is not certain: its confidence in [0, 1] is in `numbers`, to one decimal place, so
/// that it seldom changes.
inline Feature uncertain_feature(FeatureKind kind, std::string text, double confidence) {
  return {kind, std::move(text), {std::round(confidence * 10) / 10}, {}, false};
}

/// "red" of "not red", and the other way round.
inline Feature negation_of(Feature x) {
  x.negated = !x.negated;
  return x;
}

/// Metres, in the frame of that name, such as "table" or "map". Locations in frames that nobody can
/// relate (geometry::Transform) are neither equal nor different.
inline Feature location_at(double x, double y, double z, std::string frame) {
  return {FeatureKind::location, std::move(frame), {x, y, z}, {}, false};
}

/// As the viewer sees it; metres.
inline Feature seen_at(double right, double away, double up) {
  return {FeatureKind::view_location, {}, {right, away, up}, {}, false};
}

/// Metres.
inline Feature extent_of(double width, double depth, double height) {
  return {FeatureKind::extent, {}, {width, depth, height}, {}, false};
}

/// Not to be bound to anything from that subarchitecture.
inline Feature not_from(std::string subarchitecture) {
  return negation_of(feature(FeatureKind::other_source_id, std::move(subarchitecture)));
}

/// The tether to the entry that the proxy stands for.
inline Feature tether_to(AnyEntryPointer data) {
  return {FeatureKind::source_data, {}, {}, std::move(data), false};
}

/// Microseconds since the system began.
inline Feature created_at(std::int64_t time) {
  return {FeatureKind::creation_time, {}, {static_cast<double>(time)}, {}, false};
}

/// Microseconds. Still salient if there is no end.
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

/// Label of the relation from a location to the thing at it.
inline constexpr const char* position_label = "pos";

/// Label of the relation from a thing to what it is in.
inline constexpr const char* containment_label = "in";

/// Labels of a relation's two ports: `from` is left of `to`.
inline constexpr const char* from_port = "from";
inline constexpr const char* to_port = "to";

/// One end of a relation. An out-port of the relation's proxy leads to another proxy; the same
/// record is an in-port of that proxy's union.
struct Port {
  /// Name of the end, such as "from" and "to".
  std::string label;
  /// The proxy that the port leads to.
  std::string proxy;
  /// The proxy of the relation.
  std::string owner;

  friend bool operator==(const Port&, const Port&) = default;
};

enum class ProxyState { fresh, updated, reprocessed, bound };

/// One subarchitecture's description of one thing. The entry's id is the proxy's.
struct BindingProxy {
  ProxyType type = ProxyType::basic;
  /// Subarchitecture that it comes from.
  std::string source;
  /// Proxies with a lower precedence are bound first, independent of their arrival: perception
  /// before references to it.
  std::int32_t precedence = 0;
  std::vector<Feature> features;
  /// Ends of a relation.
  std::vector<Port> out_ports;
  /// The thing need not exist.
  bool hypothetical = false;
  ProxyState state = ProxyState::fresh;
  /// Union of the proxy, set by the binder; empty before.
  std::string union_id;
  /// All members of that union, itself included.
  std::vector<std::string> proxy_ids;
  std::uint32_t updates = 0;
  std::uint32_t binding_count = 0;
};

/// All descriptions of one thing. The entry's id is derived from its first member's.
struct BindingUnion {
  ProxyType type = ProxyType::basic;
  /// In binding order.
  std::vector<std::string> proxy_ids;
  /// The subarchitectures of the members, in the same order.
  std::vector<std::string> sources;
  /// Features of all members, with repetitions.
  std::vector<Feature> features;
  std::vector<Port> out_ports;
  std::vector<Port> in_ports;
  std::uint32_t updates = 0;

  friend bool operator==(const BindingUnion&, const BindingUnion&) = default;
};

/// How well a proxy fits into a union, or stays alone (NIL).
struct BindingScore {
  bool comparable = false;
  bool mismatch = false;
  std::uint32_t matches = 0;
  bool relation_mismatch = false;
  std::uint32_t relation_matches = 0;
  std::uint32_t sticky = 0;
  /// Microseconds between the salience intervals of proxy and union; 0 if they overlap.
  double salience_gap = 1e13;

  friend bool operator==(const BindingScore&, const BindingScore&) = default;
};

/// Score of a proxy with a union. An empty union id stands for NIL, a union of its own.
struct ProxyUnionScore {
  std::string proxy;
  std::string union_id;
  BindingScore score;

  friend bool operator==(const ProxyUnionScore&, const ProxyUnionScore&) = default;
};

/// From the scorer to the judge: the scores of a proxy with NIL and with every union that its
/// features do not rule out.
struct ProxyUnionScores {
  std::string proxy;
  std::vector<ProxyUnionScore> scores;

  friend bool operator==(const ProxyUnionScores&, const ProxyUnionScores&) = default;
};

/// From the judge: the unions with the best score, the preferred one first. Empty for NIL.
struct BestUnionsForProxy {
  std::string proxy;
  std::vector<std::string> unions;

  friend bool operator==(const BestUnionsForProxy&, const BestUnionsForProxy&) = default;
};

/// The id of the one BinderStatus.
inline constexpr const char* binder_status = "binder-status";

/// Status of the binder. Monitors and the binder hold a lease of this entry while they change
/// proxies or unions.
struct BinderStatus {
  /// Whether every proxy is in the best of its unions, according to the current judgements.
  bool stable = true;
  std::uint64_t proxies = 0;
  std::uint64_t unions = 0;

  friend bool operator==(const BinderStatus&, const BinderStatus&) = default;
};

/// Whether two features can be true of one thing.
enum class Truth { unknown, yes, no };

/// A comparison requested from a competent subarchitecture, and its answer. Also used as the
/// request of calls.
struct FeatureComparison {
  Feature proxy_feature;
  Feature union_feature;
  Truth equivalent = Truth::unknown;
  bool answered = false;
};

/// How far an internal comparator's answer is trusted if there is an external comparator.
enum class Trust {
  /// The external comparator is not asked.
  completely,
  /// The internal answer counts until the external one arrives.
  until_validated,
  /// The internal answer is ignored.
  not_at_all,
};

/// Declares that a subarchitecture can compare these kinds of features.
struct FeatureComparisonCompetence {
  std::string subarchitecture;
  FeatureKind proxy_kind = FeatureKind::concept_name;
  FeatureKind union_kind = FeatureKind::concept_name;
  Trust trust_yes = Trust::completely;
  Trust trust_no = Trust::until_validated;
  Trust trust_unknown = Trust::not_at_all;
};

/// What somebody states of concepts, by which they are compared: the contents of ontology files, or
/// what a subarchitecture adds at run time. Every entry on binding's working memory counts.
struct ConceptStatements {
  /// Where they come from, for messages.
  std::string source;
  std::vector<ConceptStatement> statements;

  friend bool operator==(const ConceptStatements&, const ConceptStatements&) = default;
};

/// Declares, on binding's working memory, that a subarchitecture knows what there is of a kind: it
/// tells binding of that by proxies.
struct KnowledgeCompetence {
  std::string subarchitecture;
  /// A concept, such as "room".
  std::string kind;
  /// Whether the subarchitecture is called with a KnowledgeRequest whenever somebody asks for the
  /// kind; else its proxies are always all it knows.
  bool answers_calls = false;
  /// Whether the subarchitecture takes note of what people call things of the kind: it is called
  /// with a ToldName then, and binding is not told of it.
  bool learns_names = false;

  friend bool operator==(const KnowledgeCompetence&, const KnowledgeCompetence&) = default;
};

/// Request of a call to who is competent: what there is of a kind now.
struct KnowledgeRequest {
  std::string kind;
};

/// Request of a call to who learns names: somebody calls what is here so.
struct ToldName {
  /// A concept, such as "kitchen".
  std::string name;
};

/// What becomes of a name.
struct ToldNameReply {
  /// Said in reply.
  std::string words;
};

/// Several unions fit a proxy equally well; it was bound to the first of them.
struct Ambiguity {
  std::string proxy;
  std::vector<std::string> unions;
  /// Kinds of features that some of the unions have and the proxy lacks.
  std::vector<FeatureKind> missing_in_proxy;
  /// Kinds of features that the proxy has and some of the unions lack.
  std::vector<FeatureKind> missing_in_unions;

  friend bool operator==(const Ambiguity&, const Ambiguity&) = default;
};

/// From a monitor: a request to delete this proxy.
struct BindingProxyDeletionTask {
  std::string proxy;
};

/// A tombstone of a deleted proxy, so that references to it can be removed.
struct DeletedBindingProxy {
  std::string proxy;
  std::string source;
  std::string union_id;
};

/// Description of a thing that is assumed to be known already.
struct DescribedThing {
  std::vector<Feature> features;

  friend bool operator==(const DescribedThing&, const DescribedThing&) = default;
};

/// Relation between two described things, by their indices: `from` is `label` of `to`.
struct DescribedRelation {
  std::string label;
  std::uint32_t from = 0;
  std::uint32_t to = 0;

  friend bool operator==(const DescribedRelation&, const DescribedRelation&) = default;
};

/// "the red thing left of the ball": two things, one relation. The first thing is the one to be
/// found.
struct Description {
  std::vector<DescribedThing> things;
  std::vector<DescribedRelation> relations;

  friend bool operator==(const Description&, const Description&) = default;
};

/// One reading of a description: the unions that it may refer to.
struct Referents {
  /// One for each described thing, all different.
  std::vector<std::string> unions;
  /// Number of described features that are neither confirmed nor denied; 0 if the reading is
  /// certain.
  std::uint32_t unknown = 0;

  friend bool operator==(const Referents&, const Referents&) = default;
};

/// A relation between two unions, from a relation proxy.
struct UnionRelation {
  std::string label;
  std::string from;
  std::string to;

  friend auto operator<=>(const UnionRelation&, const UnionRelation&) = default;
};

/// Request of a call: the unions that each description may refer to. Only perceived things are
/// considered.
struct ReferenceRequest {
  std::vector<Description> descriptions;
  /// Concepts that the descriptions are about: who is competent for one of them, and answers calls,
  /// is asked what there is.
  std::vector<std::string> kinds = {};
  /// Version of the ontology that the caller knows, from an earlier reply.
  std::uint64_t known_ontology = 0;
};

/// A union and its features.
struct KnownUnion {
  std::string id;
  /// The member by which to refer to the union in the long term.
  std::string proxy;
  std::vector<Feature> features;
};

/// Readings of one description.
struct DescriptionReferents {
  std::vector<Referents> readings;
};

struct ReferenceReply {
  /// For each description the unions that it may refer to, the most certain first, each with the
  /// most certain of its readings. No relation or feature of them is denied.
  std::vector<DescriptionReferents> referents;
  /// All perceived things, and the relations between them.
  std::vector<KnownUnion> unions;
  std::vector<UnionRelation> relations;
  /// Who knows what there is of which kinds, whatever was asked.
  std::vector<KnowledgeCompetence> competences = {};
  /// By which binding compares concepts, if the caller does not know this version.
  std::optional<ConceptStatements> ontology = {};
  std::uint64_t ontology_version = 0;
};

/// What there is of a kind, from who is competent. A thing or the end of a relation whose id is
/// that of a proxy is what that proxy stands for.
struct KnowledgeReply {
  std::vector<KnownUnion> things;
  std::vector<UnionRelation> relations;
};

CASTOR_REFLECT_ENUM(FeatureKind, concept_name, name, relation_label, colour, shape, size, material,
                    location, view_location, extent, source_id, other_source_id, source_data,
                    this_proxy_id, existing_proxy_id, creation_time, salience, temporal_frame,
                    group, singular, area_id, person_id, debug_string)
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
CASTOR_REFLECT(ReferenceRequest, descriptions, kinds, known_ontology)
CASTOR_REFLECT(KnownUnion, id, proxy, features)
CASTOR_REFLECT(DescriptionReferents, readings)
CASTOR_REFLECT(ConceptStatements, source, statements)
CASTOR_REFLECT(KnowledgeCompetence, subarchitecture, kind, answers_calls, learns_names)
CASTOR_REFLECT(KnowledgeRequest, kind)
CASTOR_REFLECT(ToldName, name)
CASTOR_REFLECT(ToldNameReply, words)
CASTOR_REFLECT(ReferenceReply, referents, unions, relations, competences, ontology,
               ontology_version)
CASTOR_REFLECT(KnowledgeReply, things, relations)

} // namespace castor::binding
