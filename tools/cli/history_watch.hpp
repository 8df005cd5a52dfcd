#pragma once

#include "castor/actors/cast/description.hpp"
#include "castor/actors/system/system.hpp"
#include "castor/tools/chaos/chaos_run.hpp"
#include "castor/tools/chaos/recorded_operations.hpp"
#include "castor/tools/chaos/temporary_folder.hpp"

#include <functional>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace castor::cli {

/// Records the operations of a system's components on its working memories, their results and the
/// change events, for a linearizability check. Keeps them in a folder that is removed by the
/// destructor.
class HistoryWatch {
public:
  /// @param clocks_jump whether clocks of working memories may jump, so that leases may end at any
  ///   time
  HistoryWatch(const ArchitectureDescription& architecture, bool clocks_jump);

  /// To be called before the system is made, after all other handlers of `on_down` are set.
  void watch(SystemOptions& options);

  /// To be called before the system starts.
  void look_at_beginning(System& system);

  /// Ignores operations that begin from now on.
  void end();

  /// For each working memory, one judgement of its operations and one of its change events, one of
  /// all commands that effectors obeyed, and one of all actions, with their names. To be called
  /// once the system has stopped. `begin` is called with each name before its check.
  std::vector<std::pair<std::string, faults::Judgement>>
  judge(const std::function<void(const std::string& name)>& begin) const;

private:
  faults::MemoryConditions conditions_of(const SubarchitectureDescription& x) const;

  const ArchitectureDescription architecture_;
  const bool clocks_jump_;
  const faults::TemporaryFolder folder_{"operations"};
  mutable std::mutex mutex_;
  std::map<std::string, std::vector<ChangeEventPtr>> told_;
  std::set<faults::Life> ended_;
  /// Subarchitectures whose working memories held entries at the start.
  std::set<std::string> had_entries_;
  linearizability::Tick until_ = linearizability::never - 1;
};

} // namespace castor::cli
