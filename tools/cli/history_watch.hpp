#pragma once

#include "castor/actors/cast/description.hpp"
#include "castor/actors/system/system.hpp"
#include "castor/tools/chaos/chaos_run.hpp"
#include "castor/tools/chaos/recorded_operations.hpp"

#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace castor::cli {

/// What the components of a system asked of its working memories, what they were answered and what
/// was told of it; kept in a folder of its own, which goes with this object.
class HistoryWatch {
public:
  /// @param clocks_jump so that leases may end at any time
  HistoryWatch(const ArchitectureDescription& architecture, bool clocks_jump);
  HistoryWatch(const HistoryWatch&) = delete;
  HistoryWatch& operator=(const HistoryWatch&) = delete;
  ~HistoryWatch();

  /// To be called before the system is made, after all else that is called when something is down.
  void watch(SystemOptions& options);

  /// To be called before the system starts.
  void look_at_beginning(System& system);

  /// What is asked from now on does not count.
  void end();

  /// One judgement each of the operations on a working memory, and of what was told of it, with
  /// their names. To be called once the system has stopped. `begin` is called with each name
  /// before.
  std::vector<std::pair<std::string, faults::Judgement>>
  judge(const std::function<void(const std::string& name)>& begin) const;

private:
  faults::MemoryConditions conditions_of(const SubarchitectureDescription& x) const;

  const ArchitectureDescription architecture_;
  const bool clocks_jump_;
  std::filesystem::path folder_;
  mutable std::mutex mutex_;
  std::map<std::string, std::vector<ChangeEventPtr>> told_;
  std::set<faults::Life> ended_;
  /// Subarchitectures whose working memories held entries in the beginning.
  std::set<std::string> had_entries_;
  linearizability::Tick until_ = linearizability::never - 1;
};

} // namespace castor::cli
