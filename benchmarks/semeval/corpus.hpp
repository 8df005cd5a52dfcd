#pragma once

#include "castor/benchmarks/semeval/robot_commands/board.hpp"
#include "castor/benchmarks/semeval/robot_commands/rcl_tree.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace castor::semeval {

/// A command of SemEval-2014 task 6, its annotation, and the board at that time.
struct Command {
  std::string id;
  std::string text;
  RclTree tree;
  Board board;
  /// Layout of its scene: eight scenes share the same blocks.
  int layout = 0;
};

/// Reads commands.txt, annotation.txt and configuration.txt of a folder.
/// \throws std::runtime_error that names the file and the line
std::vector<Command> read_corpus(const std::filesystem::path& folder);

} // namespace castor::semeval
