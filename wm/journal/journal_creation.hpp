#pragma once

#include <filesystem>
#include <string>

namespace castor {

/// Makes the folder of a journal, if it is not there. Throws std::filesystem::filesystem_error.
void make_journal_folder(const std::filesystem::path& file);

/// Makes a journal without entries. Under its own name it is there once it is whole, so a file that
/// is not was damaged. Throws JournalError and sqlite::Error.
void make_journal(const std::filesystem::path& file, const std::string& subarchitecture);

} // namespace castor
