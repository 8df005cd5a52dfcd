#pragma once

#include <string>

namespace castor {

/// What the `.cast` language, and supervisors, call the working memory of a subarchitecture.
inline std::string working_memory_of(const std::string& subarchitecture) {
  return subarchitecture + "_wm";
}

} // namespace castor
