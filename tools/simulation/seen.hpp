#pragma once

#include "castor/tools/chaos/answers.hpp"
#include "castor/wm/entries/entry.hpp"

#include <cstdint>

namespace castor::linearizability {

/// Content of the entries.
struct Stamp {
  std::int64_t number = 0;
};
CASTOR_REFLECT(Stamp, number)

Content content_of(const Entry& entry);

} // namespace castor::linearizability
