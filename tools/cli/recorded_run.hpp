#pragma once

#include "castor/actors/cast/description.hpp"
#include "castor/actors/runtime/push_log.hpp"
#include "castor/wm/journal/journal_reader.hpp"

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace castor::cli {

/// What a recording says of the run that it was made of.
struct RunFacts {
  /// The .cast file, as it was named.
  std::string file;
  std::map<std::string, std::string> variables;
  std::string version;
  UnixTime begin{0};
  /// Nothing if the run did not come to an end in order.
  std::optional<UnixTime> end;
  /// --until-quiet of the run; may be empty.
  std::string until_quiet;
};

/// The folder that `castor run --record` writes: the journals of all working memories, what
/// stand-alone components handed out, the system as a .cast file without variables (system.cast),
/// and RunFacts (recording.json).
class RecordingFolder {
public:
  explicit RecordingFolder(std::filesystem::path folder) : folder_(std::move(folder)) {}

  static bool is_one(const std::filesystem::path& folder);

  const std::filesystem::path& path() const { return folder_; }
  std::filesystem::path system_file() const { return folder_ / "system.cast"; }

  /// Both throw std::runtime_error.
  RunFacts facts() const;
  void write(const RunFacts& x) const;

private:
  std::filesystem::path facts_file() const { return folder_ / "recording.json"; }

  std::filesystem::path folder_;
};

/// What a stand-alone component handed out. Times are in seconds since 1970.
nlohmann::ordered_json to_json(const PushLogSummary& x);

/// The files of a folder whose names end so, sorted. Throws std::runtime_error.
std::vector<std::filesystem::path> files_in(const std::filesystem::path& folder,
                                            const std::string& extension);

/// What files of a recording hold, and who it comes from.
struct RecordingContents {
  std::uint64_t entries = 0;
  std::uint64_t changes = 0;
  std::uint64_t bytes = 0;
  UnixTime first{0};
  UnixTime last{0};
  /// By subarchitecture: how many changes each component made.
  std::map<std::string, std::map<std::string, std::uint64_t>> changes_by;
  std::vector<PushLogSummary> pushes;

  /// Of a component, wherever it wrote.
  std::uint64_t changes_of(const std::string& component) const;
};

/// Reads all of it. Throws JournalError.
RecordingContents contents_of(const std::vector<std::filesystem::path>& journals,
                              const std::vector<std::filesystem::path>& pushes);

/// "120 changes by segmentor, 8 by tracker; 40 pulls from camera": for messages.
std::string in_words(const RecordingContents& x);

} // namespace castor::cli
