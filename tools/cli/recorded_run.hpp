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

/// Facts about the run of a recording.
struct RunFacts {
  /// The .cast file, as named on the command line.
  std::string file;
  std::map<std::string, std::string> variables;
  std::string version;
  UnixTime begin{0};
  /// Nothing if the run was not stopped in order.
  std::optional<UnixTime> end;
  /// --until-quiet of the run; may be empty.
  std::string until_quiet;
};

/// The folder that `castor run --record` writes: the journals of all working memories, the values
/// pushed and returned by stand-alone components, the system as a .cast file without variables
/// (system.cast), and RunFacts (recording.json).
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

/// Summary of the values of a stand-alone component. Times are in seconds since 1970.
nlohmann::ordered_json to_json(const PushLogSummary& x);

/// The files of a folder with this extension, sorted. Throws std::runtime_error.
std::vector<std::filesystem::path> files_in(const std::filesystem::path& folder,
                                            const std::string& extension);

/// Contents of the files of a recording, by component.
struct RecordingContents {
  std::uint64_t entries = 0;
  std::uint64_t changes = 0;
  std::uint64_t bytes = 0;
  UnixTime first{0};
  UnixTime last{0};
  /// By subarchitecture: number of changes by each component.
  std::map<std::string, std::map<std::string, std::uint64_t>> changes_by;
  std::vector<PushLogSummary> pushes;

  /// Number of changes by a component in all subarchitectures.
  std::uint64_t changes_of(const std::string& component) const;
};

/// Reads all files. Throws JournalError.
RecordingContents contents_of(const std::vector<std::filesystem::path>& journals,
                              const std::vector<std::filesystem::path>& pushes);

/// "120 changes by segmentor, 8 by tracker; 40 pulls from camera": for messages.
std::string in_words(const RecordingContents& x);

} // namespace castor::cli
