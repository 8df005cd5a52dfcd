#pragma once

#include "castor/tools/cli/command_tree.hpp"

#include <string>

/// Scripts that teach a shell to complete the command lines of a program.
namespace castor::cli {

std::string bash_completion(const Command& program);
std::string zsh_completion(const Command& program);
std::string fish_completion(const Command& program);

/// The hidden command that prints what can be completed only while systems run, one name on a line.
inline constexpr const char* completion_values = "completion-values";

} // namespace castor::cli
