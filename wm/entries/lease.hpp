#pragma once

#include "castor/wm/entries/client.hpp"
#include "castor/wm/values/timestamp.hpp"

#include <cstdint>
#include <string_view>

namespace castor {

/// What the holder of a lease keeps others from doing to the entry: the paper's three levels.
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

/// Names one lease for ever: tokens of a working memory only rise. 0 is no lease.
using LeaseToken = std::uint64_t;

/// The right to an entry, for a time. It ends with its release, its expiry, the end of its holder,
/// or the deletion of the entry.
struct Lease {
  LeaseToken token = 0;
  LockLevel level = LockLevel::o;
  Timestamp expires{0};
};

} // namespace castor
