#pragma once

#include <string>

namespace castor {

/// Name of a subarchitecture's working memory in the `.cast` language and for supervisors.
inline std::string working_memory_of(const std::string& subarchitecture) {
  return subarchitecture + "_wm";
}

} // namespace castor
