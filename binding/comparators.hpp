#pragma once

#include "castor/binding/features.hpp"
#include "castor/binding/types.hpp"
#include "castor/mapping/geometry/frame_tree.hpp"

#include <map>
#include <set>
#include <string>
#include <utility>

namespace castor::binding {

struct ComparatorOptions {
  /// Metres. Locations at most `same_place` apart are the same, those at least `other_place` apart
  /// are not. In between it is unknown: sources differ in precision.
  double same_place = 0.05;
  double other_place = 0.10;
  /// Relates the frames of locations, at the newest time. Not owned; null relates none.
  const geometry::FrameTree* frames = nullptr;
  /// The most general concept of objects.
  std::string top_concept = "thing";
  /// Concepts and their superconcepts. A concept that is not listed is a kind of the top concept;
  /// an empty text means no superconcept, as for a room.
  std::map<std::string, std::string> is_a = {
    {"location", ""}, {"place", ""}, {"room", ""}, {"area", ""}, {"person", ""}};
  /// Shapes that one thing may show from different sides, or that say more or less of it: whether
  /// they agree is unknown.
  std::set<std::pair<std::string, std::string>> alike = {
    {"cube", "square"},      {"cube", "rectangle"}, {"cylinder", "circle"},
    {"square", "rectangle"}, {"sphere", "circle"},  {"cylinder", "rectangle"},
    {"round", "sphere"},     {"round", "circle"}};
};

/// Whether agreeing features of these kinds are evidence for binding, not only able to exclude each
/// other.
bool is_evidence(FeatureKind a, FeatureKind b);

/// Whether the comparison of features of these kinds can have a result other than unknown.
bool may_compare(FeatureKind a, FeatureKind b);

/// Whether both can be true of one thing: yes if they agree, no if they exclude each other.
/// Symmetric.
///
/// Locations are compared in one frame. If their frames cannot be related, the result is unknown.
/// Words are compared as text; "unknown" and empty ones make no statement. A concept agrees with
/// its superconcepts. For shapes that look alike the result is unknown. Temporal frames, source
/// ids, groups and singulars only exclude: different ones do, equal ones are no evidence. "Not red"
/// excludes red, and agrees with blue.
Truth compare(const Feature& a, const Feature& b, const ComparatorOptions& options = {});

/// Whether `a` is a proper superconcept of `b`: what is known to be a thing may be a ball, but need
/// not be one.
bool is_more_general(const Feature& a, const Feature& b, const ComparatorOptions& options = {});

} // namespace castor::binding
