#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "castor/benchmarks/clevr/evaluation.hpp"

namespace castor::clevr {

/// From how many CLEVR units on something is to the side of something else; the corpus's own.
inline constexpr double relation_margin = 0.2;

/// A decision that the scene graph does not agree with.
struct RelationMistake {
  const Scene* scene = nullptr;
  std::size_t target = 0;
  std::size_t landmark = 0;
  std::string word;
  /// How far the target was seen to be to that side, and is; CLEVR's units.
  double seen = 0;
  double is = 0;
};

/// What was said of ordered pairs of objects, by the word.
struct RelationSummary {
  /// Objects that were found, and pairs of them within their scene.
  std::size_t objects = 0;
  std::size_t pairs = 0;
  std::map<std::string, Tally> words;
  Tally all;
  /// Of those relations that hold in the scene graph, which were said; of those said, which hold.
  Tally recall;
  Tally precision;
  std::vector<RelationMistake> mistakes;
};

/// Says of all ordered pairs of found objects whether one is left of, right of, in front of and
/// behind the other, from where the outlines in the image put them on the ground and from the
/// camera alone, and compares it with the scene graph.
///
/// \param camera what the outlines were measured with (metres), and whose directions count.
RelationSummary judge_relations(const std::vector<Outcome>& outcomes, const vision::Camera& camera);

} // namespace castor::clevr
