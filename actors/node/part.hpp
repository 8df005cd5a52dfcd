#pragma once

#include "castor/actors/component/services.hpp"
#include "castor/actors/node/part_protocol.hpp"

#include <chrono>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace castor {

/// What one process contributes to a system: the working memories and components that the plan
/// gives it. Its actors are there once it is made; `join` lets them know those of the other parts.
///
/// To be used by one thread at a time, and destroyed before the actor system.
class SystemPart {
public:
  /// Does nothing but find `problems` if there are any.
  SystemPart(caf::actor_system& system, const PartPlan& plan, ProcessNumber self);
  SystemPart(const SystemPart&) = delete;
  SystemPart& operator=(const SystemPart&) = delete;
  /// Ends all its actors. Components that do not come back from their own code stay.
  ~SystemPart();

  const std::vector<cast::Diagnostic>& problems() const { return problems_; }

  /// By the names of the components.
  std::map<std::string, caf::strong_actor_ptr> actors() const;

  /// Of all parts' actors, the working memories by subarchitecture.
  std::map<std::string, caf::strong_actor_ptr>
  subarchitectures(const std::map<std::string, caf::strong_actor_ptr>& actors) const;

  /// Introduces the actors of all parts to the components, before any of them configures itself;
  /// the working memories are told by Peers.
  void join(const std::map<std::string, caf::strong_actor_ptr>& actors);

  const std::map<std::string, WorkingMemoryActor>& working_memories() const {
    return working_memories_;
  }

  /// The components, in the order of the file.
  std::vector<ComponentStatus> components() const;

private:
  struct Running {
    caf::actor actor;
    std::shared_ptr<ComponentRecord> record;
    bool is_task_manager = false;
  };

  void spawn_working_memory(const PartPlan& plan, const SubarchitectureDescription& x);
  void spawn_component(const ComponentDescription& x);

  caf::actor_system& system_;
  const ArchitectureDescription architecture_;
  std::vector<cast::Diagnostic> problems_;
  /// Components' threads may use it after the part is gone.
  std::shared_ptr<ComponentServices> services_ = std::make_shared<ComponentServices>();
  std::map<std::string, WorkingMemoryActor> working_memories_;
  std::vector<Running> running_;
  caf::actor keeper_;
};

} // namespace castor
