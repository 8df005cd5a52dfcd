#pragma once

#include "castor/wm/address.hpp"
#include "castor/wm/value.hpp"

#include <cstdint>
#include <memory>
#include <string>

namespace castor {

/// 0 when an entry is first added, one more with every overwrite; deletion does not reset it.
using Version = std::uint64_t;

/// An entry as it stood at one moment; never changes afterwards.
struct Entry {
  Address address;
  Version version = 0;
  Value value;
  /// The component that added or last overwrote it.
  std::string writer;

  const std::string& type_name() const { return value.type_name(); }
};

using EntryPtr = std::shared_ptr<const Entry>;

} // namespace castor
