#include "castor/wm/journal/journal_creation.hpp"

#include "castor/wm/journal/journal_error.hpp"
#include "castor/wm/journal/journal_tables.hpp"
#include "castor/wm/journal/sqlite.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <system_error>

namespace castor {

using namespace journal_tables;

namespace {

/// What a power cut would otherwise take back: that there is a file of that name.
void sync_directory(const std::filesystem::path& directory) {
  int descriptor = ::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0)
    return; // a file system that cannot do it
  fsync(descriptor);
  ::close(descriptor);
}

} // namespace

void make_journal_folder(const std::filesystem::path& file) {
  auto folder = file.parent_path();
  if (!folder.empty() && std::filesystem::create_directories(folder))
    sync_directory(folder.parent_path());
}

void make_journal(const std::filesystem::path& file, const std::string& subarchitecture) {
  auto unfinished = file;
  unfinished += ".new-" + std::to_string(getpid());
  std::filesystem::remove(unfinished);
  {
    sqlite::Database database{unfinished, sqlite::OpenMode::write};
    database.run(
      ("PRAGMA synchronous=FULL; PRAGMA application_id=" + std::to_string(application_id) +
       "; PRAGMA user_version=" + std::to_string(format_version))
        .c_str());
    sqlite::Transaction transaction{database};
    database.run(schema);
    Meta meta;
    meta.subarchitecture = subarchitecture;
    sqlite::Statement row{database,
                          "INSERT INTO meta VALUES (1, ?, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 1, ?)"};
    row.bind(meta.subarchitecture).bind(std::uint64_t{meta.checksum()}).run();
    transaction.commit();
  }
  // Unlike a renaming, this leaves alone what somebody else has put there meanwhile.
  std::error_code exists;
  std::filesystem::create_hard_link(unfinished, file, exists);
  std::filesystem::remove(unfinished);
  if (exists && !std::filesystem::exists(file))
    throw JournalError("it cannot be made: " + exists.message());
  sync_directory(file.parent_path());
}

} // namespace castor
