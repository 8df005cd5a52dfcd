#pragma once

#include "castor/wm/journal_reader.hpp"

#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

namespace castor {

/// One write of a recording.
struct RecordedWrite {
  UnixTime time{0};
  std::string subarchitecture;
  /// The component that made it.
  std::string source;
  std::vector<JournalRecord> changes;
};

/// The journals of a system's working memories, as one recording: what some components have
/// written.
class Recording {
public:
  /// Without `sources`: what all have. Throws JournalError.
  Recording(const std::vector<std::filesystem::path>& files, std::set<std::string> sources);

  /// The next write, of whichever journal; nothing after the last.
  std::optional<RecordedWrite> next();

private:
  struct Track {
    std::unique_ptr<JournalReader> reader;
    std::string subarchitecture;
    /// Of the entries that it begins with, those not yet told.
    std::vector<RecordedWrite> first;
    std::optional<JournalRecord> ahead;
    std::optional<RecordedWrite> write;
    /// Who wrote what is there.
    std::unordered_map<std::string, std::string> writers;
  };

  bool is_wanted(const std::string& source) const {
    return sources_.empty() || sources_.count(source) > 0;
  }
  void fetch(Track& track);
  /// The change becomes part of the write, if it is to be made again.
  void take(Track& track, JournalRecord record, RecordedWrite& into);

  std::set<std::string> sources_;
  std::vector<Track> tracks_;
};

} // namespace castor
