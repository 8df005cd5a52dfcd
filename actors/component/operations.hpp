#pragma once

#include "castor/actors/component/pending.hpp"
#include "castor/actors/component/write_batch.hpp"
#include "castor/wm/entries/address.hpp"
#include "castor/wm/entries/change_event.hpp"
#include "castor/wm/entries/entry.hpp"
#include "castor/wm/entries/lease.hpp"
#include "castor/wm/filters/change_filter.hpp"
#include "castor/wm/store/type_query.hpp"
#include "castor/wm/values/value.hpp"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace castor {

/// Among the receivers of one event, those of higher priority are called first.
enum class Priority : std::uint8_t { low = 10, medium = 50, high = 90 };

/// Id of a change callback, for its removal.
using ReceiverId = std::uint32_t;

using ChangeCallback = std::function<void(const ChangeEvent&)>;

/// The operations of one component on working memories, without the types of entries:
/// SubarchitectureComponent adds those. All throw the exceptions of failure.hpp, and
/// ComponentStopped if the component is told to stop meanwhile.
class Operations {
public:
  virtual ~Operations() = default;

  virtual Pending<Version> write(Operation operation, const Address& address, Value value,
                                 std::optional<EntryLife> life) = 0;
  virtual Pending<std::vector<Version>> write(const WriteBatch& batch) = 0;
  virtual Pending<EntryPtr> read(const Address& address) = 0;
  /// The same without a message, where that is possible.
  virtual EntryPtr read_now(const Address& address) = 0;
  virtual Pending<std::vector<EntryPtr>> query(TypeQuery query) = 0;
  virtual Pending<bool> exists(const Address& address) = 0;
  virtual Pending<Version> version(const Address& address) = 0;

  // -- leases

  /// Waits for the timeout, by default the component's deadline.
  virtual void lock(const Address& address, LockLevel level,
                    std::optional<std::chrono::nanoseconds> timeout) = 0;
  /// False if another component has a lease.
  virtual bool try_lock(const Address& address, LockLevel level) = 0;
  /// Does nothing if the component has not locked the entry.
  virtual void unlock(const Address& address) = 0;

  /// Token of the component's last lease at the address; 0 if it has none.
  virtual LeaseToken lease(const Address& address) const = 0;
  /// Whether the component has that lease, as far as this process knows.
  virtual bool holds(const Address& address, LeaseToken token) const = 0;
  /// Undoes one lock of a lease. Does nothing if the token is that of another lease.
  virtual void release(const Address& address, LeaseToken token) = 0;
  /// The same without exceptions: failures are logged.
  virtual void release_quietly(const Address& address, LeaseToken token) = 0;

  /// The level of another component's lease, if there is one.
  virtual std::optional<LockLevel> level_of_others(const Address& address) = 0;

  // -- change events

  virtual ReceiverId add_receiver(const ChangeFilter& filter, ChangeCallback callback,
                                  Priority priority) = 0;
  virtual void remove_receiver(ReceiverId id) = 0;
  virtual std::size_t receiver_count() const = 0;
  /// Switches the delivery of change events off and on.
  virtual void receive_changes(bool on) = 0;
};

} // namespace castor
