#pragma once

#include "castor/wm/entries/client.hpp"
#include "castor/wm/values/timestamp.hpp"

#include <cstdint>
#include <string_view>

namespace castor {

/// Operations on the entry that a lease forbids to others: the paper's three levels.
enum class LockLevel : std::uint8_t {
  /// Overwriting.
  o,
  /// Overwriting and deleting.
  od,
  /// Overwriting, deleting and reading: readers wait.
  odr,
};

/// "O", "OD" or "ODR".
std::string_view to_string(LockLevel x);

/// Unique number of a lease; increases within a working memory. 0 for no lease.
using LeaseToken = std::uint64_t;

/// Exclusive access to an entry for a limited time. It ends with its release, its expiry, the end
/// of its holder, or the deletion of the entry.
struct Lease {
  LeaseToken token = 0;
  LockLevel level = LockLevel::o;
  Timestamp expires{0};
};

} // namespace castor
