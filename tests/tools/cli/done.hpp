#pragma once

#include "castor/wm/values/reflect.hpp"

#include <string>

namespace castor::test {

/// A component has seen what it was to see.
struct Done {
  std::string who;
};
CASTOR_REFLECT(Done, who)

} // namespace castor::test
