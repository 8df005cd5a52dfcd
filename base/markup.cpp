#include "castor/base/markup.hpp"

#include "castor/base/text.hpp"

namespace castor {

namespace {

std::string_view entity_of(char c) {
  switch (c) {
    case '&':
      return "&amp;";
    case '<':
      return "&lt;";
    case '>':
      return "&gt;";
    case '"':
      return "&quot;";
    case '\'':
      return "&#39;";
    default:
      return {};
  }
}

} // namespace

std::string escaped(std::string_view text) {
  std::string result;
  for (;;) {
    const auto end = text.find('\n');
    for (char c : printable(text.substr(0, end)))
      if (auto entity = entity_of(c); !entity.empty())
        result += entity;
      else
        result += c;
    if (end == text.npos)
      return result;
    result += '\n';
    text.remove_prefix(end + 1);
  }
}

} // namespace castor
