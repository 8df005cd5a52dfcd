#pragma once

#include "castor/actors/link/actor_name.hpp"
#include "castor/actors/link/link_port.hpp"
#include "castor/actors/link/wire.hpp"
#include "castor/base/caf.hpp"

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace castor {

/// The actor names that one process of a system knows: those of its own actors that other processes
/// may know, and those of remote actors, for which it has representatives; and the types that other
/// processes have introduced. Safe to use from any thread.
class ActorNames : public WireNames, public std::enable_shared_from_this<ActorNames> {
public:
  ActorNames(caf::actor_system& system, ProcessNumber self) : system_(system), self_(self) {}

  /// Registers an actor of this process under a well-known number.
  void set(WellKnownActor number, const caf::strong_actor_ptr& who);

  ActorName name_of(const caf::strong_actor_ptr& x) override;
  caf::strong_actor_ptr actor_of(ActorName name) override;
  TypeDescriptorPtr type_of(std::uint64_t hash) override;
  void add_type(TypeDescriptorPtr type);

  /// The link that leads to a process.
  void add_port(std::shared_ptr<LinkPort> port);
  /// Null if there is none.
  std::shared_ptr<LinkPort> port(ProcessNumber process) const;

  /// Ends the representative of a remote actor that has ended.
  void end_of_remote(ActorName name);

  /// The process is lost. Removes the names of its actors; returns their representatives, which are
  /// to end.
  std::vector<caf::strong_actor_ptr> remove_process(ProcessNumber process);

  /// Removes all names of local actors; returns the other processes.
  std::vector<ProcessNumber> close();

private:
  struct Process {
    std::shared_ptr<LinkPort> port;
    std::unordered_map<std::uint32_t, caf::strong_actor_ptr> representatives;
    std::unordered_set<std::uint32_t> ended;
  };

  void watch(const caf::strong_actor_ptr& who, ActorName name);
  void end_of_local(ActorName name);

  caf::actor_system& system_;
  const ProcessNumber self_;

  mutable std::mutex mutex_;
  bool closed_ = false;
  std::uint32_t last_number_ = last_well_known_number;
  std::unordered_map<caf::actor_id, std::uint32_t> numbers_;
  std::unordered_map<std::uint32_t, caf::strong_actor_ptr> locals_;
  std::map<ProcessNumber, Process> processes_;
  std::unordered_map<std::uint64_t, TypeDescriptorPtr> types_;
};

} // namespace castor
