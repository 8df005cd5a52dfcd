#pragma once

#include "castor/actors/cast/description.hpp"
#include "castor/tools/cli/recorded_run.hpp"

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace castor::cli {

/// Source of a replay: journals, or the folder of a recording.
struct ReplaySource {
  std::optional<RecordingFolder> folder;
  /// Facts of that folder.
  RunFacts facts;
  std::vector<std::filesystem::path> journals;
  std::vector<std::filesystem::path> pushes;
  RecordingContents contents;
  UnixTime begin{0};
  UnixTime end{0};

  double seconds() const { return std::chrono::duration<double>(end - begin).count(); }
};

/// Adds PLACE... to a command: the arguments of `find_replay_source`.
void add_places_argument(CLI::App& command, std::vector<std::string>& places);

/// Finds the journals and recordings in these files and folders. Throws std::runtime_error.
ReplaySource find_replay_source(const std::vector<std::string>& places);

/// The components with these names: each is a component, or a subarchitecture for all of its
/// components. Throws std::runtime_error, with the nearest known name, if a name is neither in the
/// recording nor in one of the architectures.
std::set<std::string>
components_named(const std::vector<std::string>& names, const RecordingContents& contents,
                 const std::vector<const ArchitectureDescription*>& architectures);

/// Changes the architecture for a replay in this process: removes the replayed components and all
/// journals, and replaces stand-alone components that are recorded or to be replayed by players of
/// their recordings, if there are any. Removes recordings without such a player from `pushes`.
void prepare_for_replay(ArchitectureDescription& architecture,
                        const std::set<std::string>& replayed,
                        std::vector<std::filesystem::path>& pushes);

} // namespace castor::cli
