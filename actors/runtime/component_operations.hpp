#pragma once

#include "castor/actors/component/operations.hpp"
#include "castor/actors/runtime/seen_versions.hpp"

#include <chrono>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

namespace castor {

class ComponentShell;
struct WriteRequest;

/// The operations of a component: sends them to the own working memory, and remembers what the
/// component has seen and locked.
class ComponentOperations final : public Operations {
public:
  explicit ComponentOperations(ComponentShell& shell) : shell_(shell) {}

  Pending<Version> write(Operation operation, const Address& address, Value value,
                         std::optional<EntryLife> life) override;
  std::vector<Version> write(const WriteBatch& batch) override;
  Pending<EntryPtr> read(const Address& address) override;
  std::vector<EntryPtr> query(TypeQuery query) override;
  bool exists(const Address& address) override;
  Version version(const Address& address) override;

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

private:
  WriteRequest write_request(Operation operation, const Address& address, Value value,
                             std::optional<EntryLife> life) const;
  /// What the component remembers of a write that was made.
  void note_write(Operation operation, const Address& address, Version version);

  ComponentShell& shell_;
  SeenVersions seen_;
};

} // namespace castor
