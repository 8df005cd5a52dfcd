#include "castor/base/markup.hpp"

#include "castor/base/text.hpp"

namespace castor {

std::string escaped(std::string_view text) {
  std::string result;
  for (char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      case '\'':
        result += "&#39;";
        break;
      case '\n':
        result += '\n';
        break;
      default:
        result += printable({&c, 1});
    }
  }
  return result;
}

} // namespace castor
