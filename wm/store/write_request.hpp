#pragma once

#include "castor/wm/entries/address.hpp"
#include "castor/wm/entries/change_event.hpp"
#include "castor/wm/entries/client.hpp"
#include "castor/wm/entries/entry.hpp"
#include "castor/wm/entries/lease.hpp"
#include "castor/wm/values/value.hpp"

#include <optional>

namespace castor {

/// A request to change an entry.
struct WriteRequest {
  Operation operation = Operation::add;
  Address address;
  /// The new value; none for a deletion.
  Value value;
  /// Version of the entry that the client last saw, for an overwrite or deletion; or nothing.
  std::optional<Version> last_seen;
  ClientPtr client;
  /// Token of the lease that the client believes it holds on the entry; 0 for none.
  LeaseToken token = 0;
  /// Nothing for an overwrite that keeps the life of the entry. The owner of the entry is kept in
  /// any case.
  std::optional<EntryLife> life = {};
  /// `last_seen` is the version expected from an earlier write of the client that has not been
  /// answered yet. If that write has failed and another client wrote this version, the request
  /// fails.
  bool expected = false;
  /// Nothing for an overwrite that keeps the entry's will. Each will replaces the one before,
  /// whoever left that.
  std::optional<LastWill> last_will = {};
};

} // namespace castor
