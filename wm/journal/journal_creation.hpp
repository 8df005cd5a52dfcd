#pragma once

#include <filesystem>
#include <string>

namespace castor {

/// Creates the folder of a journal, if there is none. Throws std::filesystem::filesystem_error.
void make_journal_folder(const std::filesystem::path& file);

/// Creates a journal without entries. It gets its name when it is complete, so an incomplete file
/// of that name was damaged later. Throws JournalError and sqlite::Error.
void make_journal(const std::filesystem::path& file, const std::string& subarchitecture);

} // namespace castor
