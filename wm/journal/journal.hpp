#pragma once

#include "castor/wm/journal/journal_error.hpp"
#include "castor/wm/journal/journal_file.hpp"
#include "castor/wm/journal/journal_options.hpp"

#include <string>

/// The journal of a working memory: its entries and changes on disk, from which it is restored when
/// it starts again.
namespace castor {

/// Opens the journal for writing, or creates it, and takes it over from an earlier writer of the
/// same system. Throws JournalError if this fails or another system writes it; with `go_on_without`
/// a damaged file is moved aside instead, and the result may have no file.
OpenedJournal open_journal(const JournalOptions& options, const std::string& subarchitecture);

} // namespace castor
