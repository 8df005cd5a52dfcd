#pragma once

#include "castor/wm/entries/address.hpp"
#include "castor/wm/entries/change_event.hpp"
#include "castor/wm/entries/client.hpp"
#include "castor/wm/entries/entry.hpp"
#include "castor/wm/entries/lease.hpp"
#include "castor/wm/values/value.hpp"

#include <optional>

namespace castor {

/// A wish to change an entry.
struct WriteRequest {
  Operation operation = Operation::add;
  Address address;
  /// Not for a deletion.
  Value value;
  /// The version that the client has seen of what it overwrites, or means to delete; or nothing.
  std::optional<Version> last_seen;
  ClientPtr client;
  /// Of the lease that the client believes to hold on the entry; 0 for none.
  LeaseToken token = 0;
  /// For an overwrite, nothing: as it was; whose end ends the entry stays as it was in any case.
  std::optional<EntryLife> life = {};
  /// The client counts on having written the version last seen itself, by a write that it has not
  /// been answered yet: should that have failed, somebody else's version of this number will not
  /// do.
  bool expected = false;
};

} // namespace castor
