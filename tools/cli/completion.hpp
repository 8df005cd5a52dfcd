#pragma once

#include "castor/tools/cli/command_tree.hpp"

#include <string>

/// Completion scripts of shells for the command lines of a program.
namespace castor::cli {

std::string bash_completion(const Command& program);
std::string zsh_completion(const Command& program);
std::string fish_completion(const Command& program);

/// The hidden command that prints names of running systems and of their parts for completion, one
/// on a line.
inline constexpr const char* completion_values = "completion-values";

} // namespace castor::cli
