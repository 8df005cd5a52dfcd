#pragma once

#include "castor/base/ontology.hpp"
#include "castor/binding/features.hpp"
#include "castor/binding/ontology/shared_ontology.hpp"
#include "castor/binding/types.hpp"
#include "castor/mapping/geometry/frame_tree.hpp"

#include <memory>

namespace castor::binding {

struct ComparatorOptions {
  /// Metres. Locations at most `same_place` apart are the same, those at least `other_place` apart
  /// are not. In between it is unknown: sources differ in precision.
  double same_place = 0.05;
  double other_place = 0.10;
  /// Relates the frames of locations, at the newest time. Not owned; null relates none.
  const geometry::FrameTree* frames = nullptr;
  /// Says which concepts are kinds of which and which exclude each other, and which words may be
  /// said of one thing.
  std::shared_ptr<const Ontology> ontology = shared_ontology();
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
/// what it is a kind of, and is excluded by what the ontology excludes; of others the result is
/// unknown, and so it is of words that are alike. Temporal frames, source ids, groups and singulars
/// only exclude: different ones do, equal ones are no evidence. "Not red" excludes red, and agrees
/// with blue.
Truth compare(const Feature& a, const Feature& b, const ComparatorOptions& options = {});

/// Whether `a` is a proper superconcept of `b`: what is known to be a thing may be a ball, but need
/// not be one.
bool is_more_general(const Feature& a, const Feature& b, const ComparatorOptions& options = {});

} // namespace castor::binding
