#pragma once

#include "castor/tools/cli/commands.hpp"

namespace castor::cli {

/// Adds `replay` to the commands of `castor journal`.
void add_journal_replay(CLI::App& journal, Action& chosen);

} // namespace castor::cli
