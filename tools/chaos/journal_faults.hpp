#pragma once

#include "castor/actors/cast/description.hpp"

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

/// Faults of journals from outside of the system that writes them.
namespace castor::faults {

/// The files of the journals that an architecture asks for, by subarchitecture, as processes that
/// were started in the present folder find them.
std::map<std::string, std::filesystem::path>
journals_of(const ArchitectureDescription& architecture);

/// Moves the files of a journal to others beside it, whose name is returned. Throws
/// std::runtime_error if there is none, or it cannot be moved.
std::filesystem::path remove_journal(const std::filesystem::path& journal);

/// What another system was told that opened a journal.
struct JournalClaim {
  enum class Kind : std::uint8_t {
    /// It was refused, by this reason.
    refused,
    /// It was given the journal although the system that writes it had it locked.
    taken,
    /// Nobody wrote it just then, so that nobody had to refuse it; it was left alone.
    free,
  };

  Kind kind = Kind::free;
  std::string reason = {};
};

/// Opens a journal as another system would, and closes it again if it is not refused. Throws
/// JournalError if that cannot be tried.
JournalClaim claim_journal(const std::filesystem::path& journal,
                           const std::string& subarchitecture);

} // namespace castor::faults
