#pragma once

#include "castor/actors/cast/description.hpp"
#include "castor/actors/system/system.hpp"
#include "castor/tools/cli/read_architecture.hpp"
#include "castor/tools/cli/recorded_run.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace CLI {
class App;
}

namespace castor::cli {

/// Command-line arguments for journals and recordings.
struct RecordArguments {
  std::filesystem::path folder;
  /// Limit of the recorded pushes and pulls in MB; nothing for the default.
  std::optional<std::uint64_t> limit;
  /// full, batched or off, for all working memories; empty for the modes in the file.
  std::string journal;
  std::string journal_folder;
};

/// Adds --record, --record-limit, --journal and --journal-dir to a command.
void add_record_arguments(CLI::App& command, RecordArguments& arguments);

/// Gives every working memory the journal chosen on the command line.
void apply_journal_arguments(const RecordArguments& arguments,
                             ArchitectureDescription& architecture);

/// A finished recording.
struct FinishedRecording {
  std::filesystem::path folder;
  RecordingContents contents;
  /// Limit of the recorded pushes and pulls in MB.
  std::uint64_t limit = 0;
  /// Whether other machines have recorded something, too.
  bool has_other_machines = false;
  /// Command line that replays it.
  std::string replay;
};

/// Summary of the recording and its replay command, as separate lines.
std::string in_words(const FinishedRecording& x);
nlohmann::ordered_json to_json(const FinishedRecording& x);

/// A recording in progress.
class RunRecording {
public:
  /// Prepares the folder and the options of the system. Throws std::runtime_error if the folder
  /// cannot be written or is not empty, and if a working memory has a journal of its own.
  RunRecording(const RecordArguments& arguments, const ArchitectureArguments& read_from,
               const std::string& until_quiet, ArchitectureDescription& architecture,
               SystemOptions& options, bool nodes_are_local);

  /// To be called after the system is destroyed.
  /// @param plugins for the replay command
  /// @param lasted time of the system at its end, which is simulated time if it has that
  FinishedRecording finish(const std::vector<std::string>& plugins, Timestamp lasted);

private:
  RecordingFolder folder_;
  RunFacts facts_;
  std::uint64_t limit_;
  /// Whether other machines record something, too.
  bool has_other_machines_ = false;
};

} // namespace castor::cli
