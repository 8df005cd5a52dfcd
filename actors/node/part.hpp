#pragma once

#include "castor/actors/node/part_protocol.hpp"
#include "castor/actors/runtime/neighbours.hpp"
#include "castor/actors/runtime/services.hpp"
#include "castor/wm/journal/journal.hpp"

#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace castor {

struct ShellParts;
struct WorkingMemoryOptions;

/// Functions that make the actors of a part.
struct PartSpawn {
  /// Makes real working memories and components.
  PartSpawn();

  std::function<WorkingMemoryActor(caf::actor_system&, WorkingMemoryOptions)> working_memory;
  std::function<caf::actor(caf::actor_system&, ShellParts)> component;
  /// Opens the journal of a subarchitecture. Throws JournalError.
  std::function<OpenedJournal(const JournalOptions&, const std::string&)> journal = open_journal;
  /// Why there cannot be threads for so many components, or empty; null if components have no
  /// threads.
  std::function<std::string(std::size_t components)> why_no_threads;
};

/// What one process contributes to a system: the working memories and components that the plan
/// gives it. Its actors exist once a plan was applied; `join` introduces them to those of the other
/// parts.
///
/// To be used by one thread at a time, and destroyed before the actor system.
class SystemPart {
public:
  /// `clock` is null if the clock is the real one.
  SystemPart(caf::actor_system& system, ProcessNumber self, PartSpawn spawn = {},
             std::shared_ptr<SimulatedClock> clock = nullptr)
    : system_(system), self_(self), spawn_(std::move(spawn)) {
    services_->pool =
      std::make_shared<ComponentPool>(system, clock ? clock->shared_activity() : nullptr);
    services_->clock = std::move(clock);
  }
  SystemPart(const SystemPart&) = delete;
  SystemPart& operator=(const SystemPart&) = delete;
  /// Ends all its actors. Components that do not return from their own code stay.
  ~SystemPart();

  /// Makes the actors that the plan places in this process and that do not exist yet, and ends
  /// those that it does not place here any more. Returns the problems; if there are any, nothing is
  /// made or ended.
  /// @param arrived when the plan did: classes are loaded before the part begins, which may take
  /// long, and the clocks of all parts have to show the same
  std::vector<Diagnostic> apply(const PartPlan& plan,
                                std::chrono::steady_clock::time_point arrived);

  /// Makes a component anew that the last plan placed in this process; its predecessor is ended, if
  /// it has not ended. The new one knows its neighbours.
  void restart(const std::string& component, std::uint64_t incarnation);

  /// By the names of the components.
  std::map<std::string, caf::strong_actor_ptr> actors() const;

  /// Largest value that each working memory of the last plan takes, in any process; in bytes, by
  /// subarchitecture.
  const std::map<std::string, std::size_t>& largest_values() const { return largest_values_; }

  /// A component or working memory that runs here.
  struct Resident {
    std::string name;
    std::uint64_t incarnation = 1;
    caf::strong_actor_ptr actor;
    /// Null for a working memory.
    std::shared_ptr<const ComponentRecord> record;
  };
  std::vector<Resident> residents() const;

  /// Of all parts' actors, the working memories by subarchitecture.
  std::map<std::string, caf::strong_actor_ptr>
  subarchitectures(const std::map<std::string, caf::strong_actor_ptr>& actors) const;

  /// The other subarchitectures, whose working memories are not among these.
  std::set<std::string>
  absent(const std::map<std::string, caf::strong_actor_ptr>& working_memories) const;

  /// Subarchitectures whose components may write to that one, "*" for all.
  std::set<std::string> writers(const std::string& subarchitecture) const;

  /// Introduces the actors of all parts to the components, before any new one configures itself;
  /// the working memories are told by Peers.
  void join(const std::map<std::string, caf::strong_actor_ptr>& actors);

  std::map<std::string, WorkingMemoryActor> working_memories() const;

  /// The components, in the order of the file.
  std::vector<ComponentStatus> components() const;

private:
  struct Running {
    caf::actor actor;
    std::shared_ptr<ComponentRecord> record;
    bool is_task_manager = false;
  };

  struct WorkingMemory {
    WorkingMemoryActor actor;
    std::uint64_t incarnation = 1;
  };

  void begin(const PartPlan& plan, std::chrono::steady_clock::time_point arrived);
  /// Ends the actors that are not `wanted`, or are wanted in another incarnation.
  void end_others(const std::map<std::string, std::uint64_t>& wanted);
  void spawn_working_memory(const PartPlan& plan, const ComponentDescription& x,
                            std::uint64_t incarnation, std::shared_ptr<OpenedJournal> journal);
  void spawn_component(const ComponentDescription& x, std::uint64_t incarnation);
  /// Checks that there can be a thread for each component.
  void check_threads(const std::vector<const ComponentDescription*>& missing,
                     std::vector<Diagnostic>& problems) const;
  void list_working_memories();
  bool is_one_at_a_time() const {
    return services_->clock && services_->clock->activity().is_one_at_a_time();
  }
  void spawn_keeper();

  caf::actor_system& system_;
  const ProcessNumber self_;
  const PartSpawn spawn_;
  ArchitectureDescription architecture_;
  std::map<std::string, std::size_t> largest_values_;
  std::set<std::string> temporary_;
  bool open_access_ = false;
  caf::actor supervisor_;
  /// Receivers of EndSystem and of TaskEvent, or null. Kept here, since `services_` must not keep
  /// actors alive.
  caf::actor coordinator_;
  caf::actor task_observer_;
  /// Components' threads may use it after the part is gone.
  std::shared_ptr<ComponentServices> services_ = std::make_shared<ComponentServices>();
  /// By subarchitecture.
  std::map<std::string, WorkingMemory> working_memories_;
  std::vector<Running> running_;
  /// Null before `join`.
  NeighboursPtr neighbours_;
  caf::actor keeper_;
};

} // namespace castor
