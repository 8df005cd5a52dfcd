#pragma once

#include "castor/benchmarks/semeval/robot_commands/command_features.hpp"
#include "castor/benchmarks/semeval/robot_commands/rcl_tree.hpp"
#include "castor/communication/parsing/parser.hpp"

#include <memory>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace castor::semeval {

/// Weights of features, with and without a board.
struct CommandWeights {
  std::unordered_map<std::string, double> with_board;
  std::unordered_map<std::string, double> without_board;
};

/// Reads weights: lines of a name, a weight without and one with a board, separated by blanks; `#`
/// begins a comment.
/// \throws std::runtime_error that names the line
CommandWeights parse_command_weights(std::string_view text);

/// As parse_command_weights() reads them; by name.
std::string to_string(const CommandWeights& weights);

/// One way to understand a command.
struct CommandReading {
  RclTree tree;
  /// Higher is likelier.
  double score = 0;
};

/// A reading before it is scored.
struct CommandCandidate {
  RclTree tree;
  std::vector<CommandFeature> features;
};

/// Translates commands to move blocks into trees of the Robot Commands Language: parses them,
/// compares the readings with the board, and ranks them by learned weights. Not thread-safe.
class CommandInterpreter {
public:
  CommandInterpreter(std::shared_ptr<const communication::Lexicon> lexicon, CommandWeights weights);

  /// The readings, the likeliest first; empty if the command is not understood.
  /// @param board null if it is not known
  std::vector<CommandReading> interpret(std::string_view command, const Board* board);

  /// All readings with their features, for learning weights.
  std::vector<CommandCandidate> candidates(std::string_view command, const Board* board);

private:
  std::vector<CommandCandidate> candidates(const communication::IncrementalParse& parse,
                                           const Board* board) const;

  communication::Parser parser_;
  CommandWeights weights_;
};

/// The interpreter learned from the training commands of SemEval-2014 task 6, which is built into
/// the program.
CommandInterpreter robot_command_interpreter();

/// The lexicon of commands: its built-in families, and these words.
/// @param words as in robot_commands_words.ccg
std::shared_ptr<const communication::Lexicon> robot_command_lexicon(std::string_view words);

} // namespace castor::semeval
