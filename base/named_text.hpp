#pragma once

#include <string>

namespace castor {

/// Contents of a file, with the name by which findings refer to it.
struct NamedText {
  std::string name;
  std::string text;
};

} // namespace castor
