#pragma once

#include "castor/wm/journal/journal.hpp"

#include <chrono>
#include <cstddef>
#include <filesystem>

namespace castor::benchmark {

/// How long writes are measured, and in which folder the files are.
struct JournalRun {
  std::chrono::duration<double> duration{2};
  std::filesystem::path folder;
};

/// Rows per second that SQLite itself writes, so many in each transaction, each of which is synced.
double sqlite_rate(const JournalRun& run, std::size_t bytes, std::size_t group);

/// Acknowledged overwrites per second of a working memory with a journal, by so many clients, each
/// with so many under way.
double journal_rate(const JournalRun& run, JournalMode mode, std::size_t bytes, int clients,
                    int under_way);

} // namespace castor::benchmark
