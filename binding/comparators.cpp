#include "castor/binding/comparators.hpp"

#include "castor/mapping/geometry/poses.hpp"

#include <optional>
#include <utility>

namespace castor::binding {

namespace {

using enum FeatureKind;

constexpr KindSet words = bit(concept_name) | bit(name) | bit(relation_label) | bit(colour) |
                          bit(shape) | bit(size) | bit(material) | bit(area_id) | bit(person_id);

geometry::Point3 point_of(const Feature& location) {
  return {location.numbers[0], location.numbers[1], location.numbers[2]};
}

/// The location in that frame; nothing if nobody knows how its own frame lies in that.
std::optional<geometry::Point3> point_in(const std::string& frame, const Feature& location,
                                         const geometry::FrameTree* frames) {
  const auto point = point_of(location);
  if (location.text == frame)
    return frame.empty() ? std::nullopt : std::optional{point};
  const auto pose = frames ? frames->find_pose(location.text, frame) : std::nullopt;
  return pose ? std::optional{geometry::transform(*pose, point)} : std::nullopt;
}

Truth compare_places(const Feature& a, const Feature& b, const ComparatorOptions& options) {
  if (a.numbers.size() != 3 || b.numbers.size() != 3)
    return Truth::unknown;
  const auto other = point_in(a.text, b, options.frames);
  if (!other)
    return Truth::unknown;
  const double apart = geometry::distance(point_of(a), *other);
  if (apart <= options.same_place)
    return Truth::yes;
  return apart >= options.other_place ? Truth::no : Truth::unknown;
}

Truth compare_concepts(const std::string& a, const std::string& b, const Ontology& ontology) {
  if (ontology.is_kind_of(a, b) || ontology.is_kind_of(b, a))
    return Truth::yes;
  return ontology.excludes(a, b) ? Truth::no : Truth::unknown;
}

Truth compare_words(const Feature& a, const Feature& b, const ComparatorOptions& options) {
  const auto says_nothing = [](const std::string& text) {
    return text.empty() || text == "unknown";
  };
  if (says_nothing(a.text) || says_nothing(b.text))
    return Truth::unknown;
  if (a.kind == concept_name)
    return compare_concepts(a.text, b.text, *options.ontology);
  if (a.text == b.text)
    return Truth::yes;
  return options.ontology->are_alike(a.text, b.text) ? Truth::unknown : Truth::no;
}

bool are(FeatureKind a, FeatureKind b, FeatureKind one, FeatureKind other) {
  return (a == one && b == other) || (a == other && b == one);
}

/// Both hold.
Truth compare_statements(const Feature& a, const Feature& b, const ComparatorOptions& options) {
  if (a.kind == location && b.kind == location)
    return compare_places(a, b, options);
  if (a.kind == b.kind && (words & bit(a.kind)) != 0)
    return compare_words(a, b, options);
  if (are(a.kind, b.kind, this_proxy_id, existing_proxy_id))
    return a.text == b.text ? Truth::yes : Truth::unknown;
  if (a.kind == temporal_frame && b.kind == temporal_frame)
    return a.text == b.text ? Truth::unknown : Truth::no;
  if (are(a.kind, b.kind, group, singular))
    return Truth::no;
  return Truth::unknown;
}

/// A concept may be narrower than what is denied: what is no ball may well be a thing.
Truth compare_concept_with_denied(const Feature& stated, const Feature& denied,
                                  const ComparatorOptions& options) {
  if (options.ontology->is_kind_of(stated.text, denied.text))
    return Truth::no;
  return options.ontology->excludes(stated.text, denied.text) ? Truth::yes : Truth::unknown;
}

} // namespace

bool is_evidence(FeatureKind a, FeatureKind b) {
  return (a == b && ((words | bit(location)) & bit(a)) != 0) ||
         are(a, b, this_proxy_id, existing_proxy_id);
}

bool may_compare(FeatureKind a, FeatureKind b) {
  return is_evidence(a, b) || (a == temporal_frame && b == temporal_frame) ||
         are(a, b, source_id, other_source_id) || are(a, b, group, singular);
}

Truth compare(const Feature& a, const Feature& b, const ComparatorOptions& options) {
  if (!a.negated && !b.negated)
    return compare_statements(a, b, options);
  if (a.negated && b.negated)
    return Truth::unknown;
  const Feature& stated = a.negated ? b : a;
  const Feature& denied = a.negated ? a : b;
  if (are(a.kind, b.kind, source_id, other_source_id))
    return a.text == b.text ? Truth::no : Truth::unknown;
  if (are(a.kind, b.kind, this_proxy_id, existing_proxy_id))
    return a.text == b.text ? Truth::no : Truth::unknown;
  if (a.kind == temporal_frame && b.kind == temporal_frame)
    return a.text == b.text ? Truth::no : Truth::unknown;
  Feature affirmed = denied;
  affirmed.negated = false;
  const Truth base = compare_statements(stated, affirmed, options);
  if (base == Truth::unknown || !is_evidence(a.kind, b.kind))
    return Truth::unknown;
  if (a.kind == concept_name)
    return compare_concept_with_denied(stated, denied, options);
  return base == Truth::yes ? Truth::no : Truth::yes;
}

bool is_more_general(const Feature& a, const Feature& b, const ComparatorOptions& options) {
  return a.kind == concept_name && b.kind == concept_name && !a.negated && !b.negated &&
         a.text != b.text && options.ontology->is_kind_of(b.text, a.text);
}

} // namespace castor::binding
