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

/// What a command line says of journals and recordings.
struct RecordArguments {
  std::filesystem::path folder;
  /// MB that the recorded pushes and pulls may take; nothing for the default.
  std::optional<std::uint64_t> limit;
  /// full, batched or off, for all working memories; empty for what the file says.
  std::string journal;
  std::string journal_folder;
};

/// Adds --record, --record-limit, --journal and --journal-dir to a command.
void add_record_arguments(CLI::App& command, RecordArguments& arguments);

/// Gives every working memory the journal that the command line asks for.
void apply_journal_arguments(const RecordArguments& arguments,
                             ArchitectureDescription& architecture);

/// A recording that has been made.
struct FinishedRecording {
  std::filesystem::path folder;
  RecordingContents contents;
  /// MB that recorded pushes and pulls may take.
  std::uint64_t limit = 0;
  /// Whether something was recorded on other machines, too.
  bool has_other_machines = false;
  /// A command line.
  std::string replay;
};

/// What was recorded and how it is replayed, on lines of their own.
std::string in_words(const FinishedRecording& x);
nlohmann::ordered_json to_json(const FinishedRecording& x);

/// A recording that is being made.
class RunRecording {
public:
  /// Prepares the folder and sets the system up. Throws std::runtime_error if the folder cannot be
  /// written or holds something else, and if a working memory has a journal of its own.
  RunRecording(const RecordArguments& arguments, const ArchitectureArguments& read_from,
               const std::string& until_quiet, ArchitectureDescription& architecture,
               SystemOptions& options, bool nodes_are_local);

  /// To be called when the system is no more; the recording is replayed with these plug-ins.
  FinishedRecording finish(const std::vector<std::string>& plugins);

private:
  RecordingFolder folder_;
  RunFacts facts_;
  std::uint64_t limit_;
  /// Whether something was recorded on other machines, too.
  bool has_other_machines_ = false;
};

} // namespace castor::cli
