#pragma once

#include "castor/tools/cli/commands.hpp"

namespace castor::cli {

/// `castor journal export`
void add_journal_export(CLI::App& journal, Action& chosen);

} // namespace castor::cli
