#pragma once

#include "castor/actors/cast/description.hpp"
#include "castor/actors/link/link.hpp"
#include "castor/actors/node/part_messages.hpp"
#include "castor/actors/node/placement.hpp"
#include "castor/actors/node/system_options.hpp"

#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace castor {

/// The processes that a system runs in, as its coordinator sees them: it connects with them, and
/// knows which of them are in reach. Its own has the number 0.
///
/// Safe to use from any thread.
class Processes {
public:
  /// Link state of a process, with the reason.
  struct State {
    ProcessDescription description;
    LinkState link = LinkState::down;
    std::string reason;
  };

  /// The options have to outlive it. `name` is the system's.
  /// `on_news` is called on the network's thread.
  Processes(caf::actor_system& system, const SystemOptions& options, std::string name,
            std::function<void(const LinkNews&)> on_news);
  /// With links made by `spawn`.
  Processes(caf::actor_system& system, const SystemOptions& options, std::string name,
            std::function<void(const LinkNews&)> on_news, LinkSpawn spawn);
  Processes(const Processes&) = delete;
  Processes& operator=(const Processes&) = delete;

  void set_own_agent(const caf::actor& agent);

  /// The name of the system.
  const std::string& name() const { return name_; }

  /// Null if the actor system has no network.
  const std::shared_ptr<Mesh>& mesh() const { return mesh_; }
  /// Those of the mesh.
  const std::shared_ptr<PartMessages>& messages() const { return messages_; }

  /// Begins to connect with those processes of the placement that are new to it.
  void open(const Placement& placement);

  /// The same, and waits until there are connections. Throws SystemError, with the lines of the
  /// architecture that need a process that was not reached in time; then the new processes are
  /// disconnected again, and count as lost ones without a name and a host.
  void connect(const ArchitectureDescription& architecture, const Placement& placement);

  /// Connects with another process at the address of a lost one, within the time after which a
  /// process is lost. Returns the number of the new one.
  ProcessNumber look_for_successor(ProcessNumber lost);

  std::size_t size() const;
  caf::actor agent(ProcessNumber x) const;
  State state(ProcessNumber x) const;
  bool is_up(ProcessNumber x) const { return state(x).link == LinkState::up; }
  /// When it was last found in reach; the clock's beginning if it never was.
  std::chrono::steady_clock::time_point last_up(ProcessNumber x) const;
  std::vector<ProcessDescription> descriptions() const;

  /// Stops logging changes of link states.
  void suppress_notifications();

  /// Sends a goodbye to all others, and waits until the links have ended.
  void close(const std::string& reason);

private:
  struct Process {
    ProcessDescription description;
    caf::actor agent;
    caf::actor link;
    LinkNews news{0, LinkState::down, "no answer yet", {}};
    /// Whether it was ever reached.
    bool joined = false;
    std::chrono::steady_clock::time_point last_up{};
  };

  void check_security(const ArchitectureDescription& architecture, const Placement& placement,
                      std::size_t first) const;
  /// Adds a process, and begins to connect with it.
  ProcessNumber open_link(const ProcessDescription& description);
  void await_connections(const ArchitectureDescription& architecture, const Placement& placement,
                         std::size_t first);
  void on_link_news(const LinkNews& news);
  bool interrupted() const { return options_.interrupted && options_.interrupted(); }

  caf::actor_system& system_;
  const SystemOptions& options_;
  const std::string name_;
  const std::function<void(const LinkNews&)> on_news_;
  const LinkSpawn spawn_;
  std::uint64_t incarnation_;
  const std::shared_ptr<PartMessages> messages_;
  std::shared_ptr<Mesh> mesh_;

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Process> processes_;
  bool silent_ = false;
};

} // namespace castor
