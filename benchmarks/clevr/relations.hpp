#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "castor/benchmarks/clevr/evaluation.hpp"

namespace castor::clevr {

/// Minimum distance for a relation, CLEVR units; that of the corpus.
inline constexpr double relation_margin = 0.2;

/// A relation that differs from the scene graph.
struct RelationMistake {
  const Scene* scene = nullptr;
  std::size_t target = 0;
  std::size_t landmark = 0;
  std::string word;
  /// Measured and true distance of the target to that side; CLEVR's units.
  double seen = 0;
  double is = 0;
};

/// Results for ordered pairs of objects, by the word.
struct RelationSummary {
  /// Objects that were found, and pairs of them within their scene.
  std::size_t objects = 0;
  std::size_t pairs = 0;
  std::map<std::string, Tally> words;
  Tally all;
  /// Relations of the scene graph that were found, and found relations that are in the scene graph.
  Tally recall;
  Tally precision;
  std::vector<RelationMistake> mistakes;
};

/// Decides for all ordered pairs of found objects whether one is left of, right of, in front of and
/// behind the other, from the ground positions of their outlines in the image and from the camera
/// alone, and compares this with the scene graph.
///
/// \param camera camera for the ground positions (metres) and the directions.
RelationSummary judge_relations(const std::vector<Outcome>& outcomes,
                                const geometry::Camera& camera);

} // namespace castor::clevr
