#pragma once

#include "castor/tools/cli/command_tree.hpp"

#include <string>

namespace castor::cli {

/// Version and date in the footer of every manual page.
struct Edition {
  std::string version;
  /// As in 2026-11-22.
  std::string date;
};

/// "castor-journal-show" for {"castor", "journal", "show"}: its manual page is
/// castor-journal-show(1).
std::string man_page_name(const Command& command);

/// Manual page of a command in roff. `program` is the root of the tree that the command is part of.
/// Lines of the footer that begin with "Example" or "Exit status" make sections of their own.
std::string man_page(const Command& command, const Command& program, const Edition& edition);

} // namespace castor::cli
