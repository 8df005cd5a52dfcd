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

/// How the actors of a part are made.
struct PartSpawn {
  /// As working memories and components are.
  PartSpawn();

  std::function<WorkingMemoryActor(caf::actor_system&, WorkingMemoryOptions)> working_memory;
  std::function<caf::actor(caf::actor_system&, ShellParts)> component;
  /// Takes up the journal of a subarchitecture. Throws JournalError.
  std::function<OpenedJournal(const JournalOptions&, const std::string&)> journal = open_journal;
  /// Why there cannot be threads for so many components; null if they have none.
  std::function<std::string(std::size_t components)> why_no_threads;
};

/// What one process contributes to a system: the working memories and components that the plan
/// gives it. Its actors are there once a plan was applied; `join` lets them know those of the other
/// parts.
///
/// To be used by one thread at a time, and destroyed before the actor system.
class SystemPart {
public:
  SystemPart(caf::actor_system& system, ProcessNumber self, PartSpawn spawn = {})
    : system_(system), self_(self), spawn_(std::move(spawn)) {}
  SystemPart(const SystemPart&) = delete;
  SystemPart& operator=(const SystemPart&) = delete;
  /// Ends all its actors. Components that do not come back from their own code stay.
  ~SystemPart();

  /// Makes what the plan gives to this process and what is not there yet, and ends what it does not
  /// give to it any more. Returns what stands in the way; if anything does, nothing is made or
  /// ended.
  std::vector<Diagnostic> apply(const PartPlan& plan);

  /// Makes a component anew that the last plan gave to this process; its predecessor ends, if it
  /// has not. It knows its neighbours.
  void restart(const std::string& component, std::uint64_t incarnation);

  /// By the names of the components.
  std::map<std::string, caf::strong_actor_ptr> actors() const;

  /// What the working memories of the last plan take, wherever they are: the largest value by
  /// subarchitecture, in bytes.
  const std::map<std::string, std::size_t>& largest_values() const { return largest_values_; }

  /// Something that runs here.
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

  /// Those whose working memories are not among these.
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

  void begin(const PartPlan& plan);
  /// Ends what is not `wanted`, or is to live another life.
  void end_others(const std::map<std::string, std::uint64_t>& wanted);
  void spawn_working_memory(const PartPlan& plan, const ComponentDescription& x,
                            std::uint64_t incarnation, std::shared_ptr<OpenedJournal> journal);
  void spawn_component(const ComponentDescription& x, std::uint64_t incarnation);
  /// Each component needs one.
  void check_threads(const std::vector<const ComponentDescription*>& missing,
                     std::vector<Diagnostic>& problems) const;
  void list_working_memories();
  void spawn_keeper();

  caf::actor_system& system_;
  const ProcessNumber self_;
  const PartSpawn spawn_;
  ArchitectureDescription architecture_;
  std::map<std::string, std::size_t> largest_values_;
  std::set<std::string> temporary_;
  bool open_access_ = false;
  caf::actor supervisor_;
  /// Who is told by components that the system is to end, and who watches tasks; null for nobody.
  /// Kept here, since `services_` must not keep them.
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
