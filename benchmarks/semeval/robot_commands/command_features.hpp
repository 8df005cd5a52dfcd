#pragma once

#include "castor/benchmarks/semeval/robot_commands/board.hpp"
#include "castor/benchmarks/semeval/robot_commands/rcl_tree.hpp"
#include "castor/communication/parsing/lexicon.hpp"
#include "castor/communication/parsing/meaning.hpp"

#include <span>
#include <string>
#include <vector>

namespace castor::semeval {

/// A reason to prefer a reading or not, by name: how much of it there is.
struct CommandFeature {
  std::string name;
  double value = 1;
};

/// How a command was read.
struct CommandDerivation {
  /// As the parser heard them.
  std::span<const std::string> words;
  const communication::Meaning* meaning = nullptr;
};

/// What speaks for and against a reading: which words stand for what, what is attached where and,
/// given a board, whether the entities are there.
/// @param board null if it is not known
std::vector<CommandFeature> command_features(const CommandDerivation& derivation,
                                             const communication::Lexicon& lexicon,
                                             const RclTree& tree, const Board* board);

} // namespace castor::semeval
