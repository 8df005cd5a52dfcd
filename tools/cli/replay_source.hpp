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

/// What is to be replayed: journals, or the folder of a recording.
struct ReplaySource {
  std::optional<RecordingFolder> folder;
  /// Of that folder.
  RunFacts facts;
  std::vector<std::filesystem::path> journals;
  std::vector<std::filesystem::path> pushes;
  RecordingContents contents;
  UnixTime begin{0};
  UnixTime end{0};

  double seconds() const { return std::chrono::duration<double>(end - begin).count(); }
};

/// Adds PLACE... to a command: where `find_replay_source` looks.
void add_places_argument(CLI::App& command, std::vector<std::string>& places);

/// Finds what lies at these places, files or folders. Throws std::runtime_error.
ReplaySource find_replay_source(const std::vector<std::string>& places);

/// The components that names stand for: each is a component, or a subarchitecture for all of its
/// components. Throws std::runtime_error, with the nearest known name, if neither the recording nor
/// one of the architectures knows one.
std::set<std::string>
components_named(const std::vector<std::string>& names, const RecordingContents& contents,
                 const std::vector<const ArchitectureDescription*>& architectures);

/// Makes the architecture one that the recording is replayed into, in this process: without these
/// components, without journals, and with stand-ins for recorded stand-alone components. Of
/// `pushes`, those without a stand-in are removed.
void prepare_for_replay(ArchitectureDescription& architecture,
                        const std::set<std::string>& replayed,
                        std::vector<std::filesystem::path>& pushes);

} // namespace castor::cli
