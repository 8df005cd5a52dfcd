#pragma once

#include "castor/actors/component/operations.hpp"
#include "castor/actors/runtime/change_receivers.hpp"
#include "castor/actors/runtime/component_context.hpp"
#include "castor/actors/runtime/inbox.hpp"
#include "castor/actors/runtime/open_operations.hpp"
#include "castor/actors/runtime/operations_client.hpp"
#include "castor/actors/runtime/seen_versions.hpp"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace castor {

struct WriteRequest;

/// The operations of a component: turns them into requests, and keeps the versions it has seen, its
/// leases and its filters.
class ComponentOperations final : public Operations {
public:
  struct Parts {
    ComponentContext& context;
    OperationsClient& client;
    Inbox& inbox;
    ChangeReceivers& receivers;
    /// Most change events that may wait for the component.
    std::uint32_t queue_limit;
    /// Whether the component waits for results. Otherwise its operations are in `open` until these
    /// were called back.
    bool waits;
    OpenOperations& open;
  };

  explicit ComponentOperations(const Parts& parts) : parts_(parts) {}

  Pending<Version> write(Operation operation, const Address& address, Value value,
                         std::optional<EntryLife> life) override;
  Pending<std::vector<Version>> write(const WriteBatch& batch) override;
  Pending<EntryPtr> read(const Address& address) override;
  EntryPtr read_now(const Address& address) override;
  Pending<std::vector<EntryPtr>> query(TypeQuery query) override;
  Pending<bool> exists(const Address& address) override;
  Pending<Version> version(const Address& address) override;

  void lock(const Address& address, LockLevel level,
            std::optional<std::chrono::nanoseconds> timeout) override;
  bool try_lock(const Address& address, LockLevel level) override;
  void unlock(const Address& address) override;
  LeaseToken lease(const Address& address) const override;
  bool holds(const Address& address, LeaseToken token) const override;
  void release(const Address& address, LeaseToken token) override;
  void release_quietly(const Address& address, LeaseToken token) override;
  std::optional<LockLevel> level_of_others(const Address& address) override;

  ReceiverId add_receiver(const ChangeFilter& filter, ChangeCallback callback,
                          Priority priority) override;
  void remove_receiver(ReceiverId id) override;
  std::size_t receiver_count() const override;
  void receive_changes(bool on) override;

  /// Has all events sent to the component, which filters for itself; only conditions on the content
  /// are left to working memories. To be called before there are filters.
  void receive_broadcasts();

  /// Calls `f` as soon as an event that matches the filter arrives, possibly inside an operation of
  /// the component: only for the runtime's own bookkeeping.
  void add_listener(const ChangeFilter& filter, ChangeCallback f);

private:
  WriteRequest write_request(Operation operation, const Address& address, Value value,
                             std::optional<EntryLife> life) const;
  /// The operation of that request, whose outcome `finish` takes. `what` is "read", say.
  template <class T>
  Pending<T> pending(std::uint64_t id, const char* what, const Address& address,
                     std::function<T()> finish);
  /// The operation that nobody takes the result of.
  OpenOperations::OpenPtr open(std::uint64_t id, const char* what, const Address& address,
                               std::function<void()> finish);
  void note_read(const Entry& entry);
  /// Updates the seen version and the leases after a write.
  void remember_write(Operation operation, const Address& address, Version version);
  /// Registers the filter under the next id; returns at once if the component does not wait.
  FilterId subscribe(const ChangeFilter& filter, EventStream stream);

  Parts parts_;
  SeenVersions seen_;
  FilterId last_filter_ = 0;
};

} // namespace castor
