#pragma once

#include <string>

#include <pwd.h>
#include <unistd.h>

namespace castor::test {

/// The source of what this user writes from outside of a system.
inline std::string operator_of_this_user() {
  return std::string{"operator:"} + getpwuid(geteuid())->pw_name;
}

} // namespace castor::test
