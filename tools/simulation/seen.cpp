#include "castor/tools/simulation/seen.hpp"

namespace castor::linearizability {

Content content_of(const Entry& entry) {
  return Content(entry.value.as<Stamp>()->number);
}

} // namespace castor::linearizability
