#pragma once

#include "castor/actors/cast/description.hpp"

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

/// Journal faults injected from outside of the system that writes the journal.
namespace castor::faults {

/// Journal files of an architecture by subarchitecture; relative paths are resolved against the
/// current folder.
std::map<std::string, std::filesystem::path>
journals_of(const ArchitectureDescription& architecture);

/// Renames the files of a journal within their folder and returns the new name. Throws
/// std::runtime_error if there is no journal, or it cannot be moved.
std::filesystem::path remove_journal(const std::filesystem::path& journal);

/// Result of an attempt by another system to open a journal.
struct JournalClaim {
  enum class Kind : std::uint8_t {
    /// Refused, for `reason`.
    refused,
    /// Granted, although the system that writes the journal had it locked.
    taken,
    /// No process had the journal open at that time, so no refusal was due; it was not touched.
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
