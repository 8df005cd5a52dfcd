#pragma once

#include "castor/wm/journal/journal_error.hpp"
#include "castor/wm/journal/journal_file.hpp"
#include "castor/wm/journal/journal_options.hpp"

#include <string>

/// What a working memory has on disk, so that it comes back with its entries after its end.
namespace castor {

/// Opens the journal for writing, or makes it, and takes it away from whoever of the same system
/// writes it. Throws JournalError if that cannot be, or another system writes it; with
/// `go_on_without` a file that is not sound is moved aside, and the result may have no file.
OpenedJournal open_journal(const JournalOptions& options, const std::string& subarchitecture);

} // namespace castor
