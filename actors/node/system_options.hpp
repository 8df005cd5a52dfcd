#pragma once

#include "castor/actors/component/health.hpp"
#include "castor/actors/component/stop_patience.hpp"
#include "castor/actors/component/task_event.hpp"
#include "castor/actors/link/link.hpp"
#include "castor/actors/node/clock_options.hpp"
#include "castor/base/diagnostic.hpp"
#include "castor/wm/entries/change_event.hpp"
#include "castor/wm/entries/entry.hpp"
#include "castor/wm/filters/change_filter.hpp"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace castor {

/// A system that cannot be run as described: `what()` says why, with places in the file.
class SystemError : public std::runtime_error {
public:
  explicit SystemError(std::vector<Diagnostic> diagnostics);

  const std::vector<Diagnostic>& diagnostics() const { return diagnostics_; }

private:
  std::vector<Diagnostic> diagnostics_;
};

struct SystemOptions {
  /// Every subarchitecture may write to every other, as in the original CAST.
  bool open_access = false;

  /// Every change event is sent to every working memory, subscribed or not: the original's early
  /// scheme, for comparison.
  bool broadcast = false;

  /// The real clock, or simulated time.
  ClockOptions clock;

  /// Components that fail are started again, as the architecture says. Otherwise each stays down,
  /// and the others go on without it.
  bool restarts = true;

  /// Addresses of nodes, by the hosts that the architecture names; other hosts are read as HOST or
  /// HOST:PORT.
  std::map<std::string, Endpoint> nodes;

  /// With credentials, connections with nodes are encrypted and names are proved.
  std::optional<Credentials> credentials;

  /// Connect with nodes on other machines without credentials.
  bool insecure = false;

  /// The socket at which people and programs of the same user find the running system
  /// (local_endpoint.hpp); empty for none.
  std::filesystem::path endpoint;

  /// How long nodes may take to be reached, before the system is given up.
  std::chrono::milliseconds connect_patience{5'000};

  /// How long processes may take to make their parts of the system, for which they may have to load
  /// libraries.
  std::chrono::milliseconds part_patience{15'000};

  /// How long processes may take to answer a question.
  std::chrono::milliseconds answer_patience{2000};

  /// Folder, on each machine, in which every process logs the operations of its components on
  /// working memories and their outcomes (operation_log.hpp), and the endpoint those of operators;
  /// empty for none.
  std::filesystem::path operations;

  /// Folder, on each machine, in which every process records the values that its stand-alone
  /// components hand out (push_log.hpp); empty for none. Above the limit, in bytes, the oldest
  /// values are dropped.
  std::filesystem::path pushes;
  std::uint64_t pushes_limit = std::uint64_t{1} << 30;

  /// Options of the links to nodes.
  LinkOptions link;

  /// How long a component that does not say so itself (`--shutdown`) may take to stop before it is
  /// given up.
  std::chrono::milliseconds stop_patience = standard_stop_patience;

  /// Called with every change in every working memory, one at a time, those of one working memory
  /// in their order; not on any component's thread.
  std::function<void(const ChangeEvent&)> on_change;

  /// Called like `on_change`, and with the entry as it was read after the change: it may be newer,
  /// and is null if it was gone by then.
  std::function<void(const ChangeEvent&, const EntryPtr&)> on_entry;

  /// Called like `on_change`, with the changes that match one of these filters, and with the index
  /// of the filter. Filters without a subarchitecture are for all of them.
  std::vector<ChangeFilter> watched;
  std::function<void(std::size_t filter, const ChangeEvent&)> on_watched;

  /// Called with every event of every proposed task, those of one task manager in their order;
  /// never at the same time as `on_change`.
  std::function<void(const TaskEvent&)> on_task;

  /// Called when a component or a working memory has gone down, and when it is back. Called by one
  /// thread at a time; must not block it.
  std::function<void(const ComponentDown&)> on_down;
  std::function<void(const ComponentUp&)> on_up;

  /// Called when an injected fault with a number (`FaultTicket`) takes effect; on a thread of its
  /// own, with news of one fault at a time.
  std::function<void(std::uint64_t fault)> on_fault_happened;

  /// Kills the process of a host that is a child of this process, as those of isolated components
  /// and local nodes are, if it was started before `started_before`: not a successor. False if
  /// there is none. The owner of this function has to start the process again. Called from any
  /// thread.
  std::function<bool(const std::string& host, std::chrono::steady_clock::time_point started_before)>
    kill_child;

  /// Polled during lengthy work; true makes the system give up waiting.
  std::function<bool()> interrupted;
};

} // namespace castor
