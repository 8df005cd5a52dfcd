#include "castor/tools/cli/history_watch.hpp"

#include "castor/actors/node/working_memory_class.hpp"
#include "castor/tools/chaos/recorded_actions.hpp"
#include "castor/tools/chaos/recorded_commands.hpp"

#include <algorithm>
#include <chrono>
#include <memory>

namespace castor::cli {

HistoryWatch::HistoryWatch(const ArchitectureDescription& architecture, bool clocks_jump)
  : architecture_(architecture), clocks_jump_(clocks_jump) {
  // nop
}

void HistoryWatch::watch(SystemOptions& options) {
  options.operations = folder_.path();
  options.on_change = [this](const ChangeEvent& x) {
    std::lock_guard guard{mutex_};
    told_[x.address.subarchitecture].push_back(std::make_shared<const ChangeEvent>(x));
  };
  options.on_down = [this, next = std::move(options.on_down)](const ComponentDown& x) {
    {
      std::lock_guard guard{mutex_};
      ended_.emplace(x.component, x.incarnation);
    }
    if (next)
      next(x);
  };
}

void HistoryWatch::look_at_beginning(System& system) {
  for (auto& x : architecture_.subarchitectures)
    if (!system.entries(x.name).empty())
      had_entries_.insert(x.name);
}

void HistoryWatch::end() {
  std::lock_guard guard{mutex_};
  auto now = std::chrono::steady_clock::now().time_since_epoch();
  until_ = static_cast<linearizability::Tick>(
    std::chrono::duration_cast<std::chrono::nanoseconds>(now).count());
}

faults::MemoryConditions HistoryWatch::conditions_of(const SubarchitectureDescription& x) const {
  const WorkingMemoryClass options{x.working_memory};
  faults::MemoryConditions result;
  result.subarchitecture = x.name;
  result.went_down =
    std::ranges::any_of(ended_, [&](auto& life) { return life.first == x.working_memory.name; });
  if (!clocks_jump_ && !result.went_down)
    result.lease = options.lease.get();
  auto journal = options.journal.get();
  result.durable =
    journal == JournalMode::full && options.journal_failure.get() == JournalFailure::stop;
  if (had_entries_.count(x.name) > 0)
    result.unknown = "it held entries of an earlier run in the beginning";
  else if (result.went_down && journal != JournalMode::off && !result.durable)
    result.unknown = "its journal may lose the last of what was acknowledged";
  return result;
}

std::vector<std::pair<std::string, faults::Judgement>>
HistoryWatch::judge(const std::function<void(const std::string& name)>& begin) const {
  std::vector<std::pair<std::string, faults::Judgement>> result;
  auto add = [&](const std::string& name, auto&& judgement) {
    begin(name);
    result.emplace_back(name, judgement());
  };
  const auto recording = faults::read_operations(folder_.path());
  std::lock_guard guard{mutex_};
  for (auto& x : architecture_.subarchitectures) {
    auto conditions = conditions_of(x);
    add("operations on " + x.name,
        [&] { return faults::judge_operations(recording, conditions, ended_, until_); });
    add("changes in " + x.name, [&] {
      auto told = told_.find(x.name);
      static const std::vector<ChangeEventPtr> nothing;
      return faults::judge_events(recording, conditions,
                                  told == told_.end() ? nothing : told->second);
    });
  }
  const auto commands = faults::read_commands(folder_.path());
  if (!commands.empty())
    add("commands with valid tokens", [&] { return faults::judge_commands(commands, recording); });
  const auto actions = faults::read_actions(folder_.path());
  if (!actions.empty())
    add("no action twice", [&] { return faults::judge_actions(actions); });
  return result;
}

} // namespace castor::cli
