#pragma once

#include "castor/wm/entries/address.hpp"
#include "castor/wm/values/timestamp.hpp"
#include "castor/wm/values/value.hpp"

#include <cstdint>
#include <memory>
#include <string>

namespace castor {

/// 0 when an entry is first added, incremented by every overwrite; deletion does not reset it.
using Version = std::uint64_t;

/// Lifetime rules of an entry, besides its addition and deletion.
struct EntryLife {
  /// The entry is deleted this long after its last write; 0 for never.
  Timestamp time_to_live{0};
  /// The entry is deleted when the component that added it ends.
  bool ephemeral = false;
  /// The addition fails if the id was ever used before, even by a deleted entry.
  bool only_once = false;
  /// Components of every subarchitecture may overwrite the entry, whatever the access rules say.
  bool writable_by_all = false;
};

/// What an entry is overwritten with when the component that left the will ends, for whatever
/// reason.
struct LastWill {
  /// Empty to withdraw an earlier will.
  Value value;
  /// Life of the entry from then on.
  EntryLife life;
};

/// An immutable snapshot of an entry.
struct Entry {
  Address address;
  Version version = 0;
  Value value;
  /// The component that added or last overwrote it.
  std::string writer;
  EntryLife life = {};

  const std::string& type_name() const { return value.type_name(); }
};

using EntryPtr = std::shared_ptr<const Entry>;

} // namespace castor
