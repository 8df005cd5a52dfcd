#pragma once

#include "castor/wm/entries/address.hpp"
#include "castor/wm/values/timestamp.hpp"
#include "castor/wm/values/value.hpp"

#include <cstdint>
#include <memory>
#include <string>

namespace castor {

/// 0 when an entry is first added, one more with every overwrite; deletion does not reset it.
using Version = std::uint64_t;

/// How an entry comes and goes besides its addition and deletion.
struct EntryLife {
  /// It is forgotten so long after it was last written; 0 for never.
  Timestamp time_to_live{0};
  /// It goes when the component that added it goes.
  bool ephemeral = false;
  /// It is not added if there was an entry of its id before, even if that was deleted since.
  bool only_once = false;
};

/// An entry as it stood at one moment; never changes afterwards.
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
