#pragma once

#include <string>

namespace castor::cli {

/// A quoted string in the language of Graphviz.
inline std::string dot_string(const std::string& x) {
  std::string result = "\"";
  for (char c : x) {
    if (c == '"' || c == '\\')
      result += '\\';
    result += c;
  }
  return result + '"';
}

} // namespace castor::cli
