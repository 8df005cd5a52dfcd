#pragma once

#include "castor/benchmarks/semeval/robot_commands/board.hpp"
#include "castor/benchmarks/semeval/robot_commands/rcl_tree.hpp"
#include "castor/communication/parsing/lexicon.hpp"
#include "castor/communication/parsing/meaning.hpp"

#include <span>
#include <string>
#include <vector>

namespace castor::semeval {

/// A feature of a reading, for ranking: name and value.
struct CommandFeature {
  std::string name;
  double value = 1;
};

/// The derivation of a reading.
struct CommandDerivation {
  /// Words as parsed.
  std::span<const std::string> words;
  const communication::Meaning* meaning = nullptr;
};

/// Features of a reading: the meanings of its words, its attachments and, given a board, whether
/// its entities exist.
/// @param board null if it is not known
std::vector<CommandFeature> command_features(const CommandDerivation& derivation,
                                             const communication::Lexicon& lexicon,
                                             const RclTree& tree, const Board* board);

} // namespace castor::semeval
