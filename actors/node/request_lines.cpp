#include "castor/actors/node/request_lines.hpp"

#include <algorithm>
#include <utility>

namespace castor {

namespace {

using Json = nlohmann::ordered_json;

/// Whether they are well-formed UTF-8 (Unicode, table 3-7).
bool is_utf8(std::string_view x) {
  auto byte = [&](std::size_t i) { return static_cast<unsigned char>(x[i]); };
  for (std::size_t i = 0; i < x.size();) {
    auto first = byte(i);
    std::size_t more = first < 0x80                    ? 0
                       : first >= 0xc2 && first < 0xe0 ? 1
                       : first >= 0xe0 && first < 0xf0 ? 2
                       : first >= 0xf0 && first < 0xf5 ? 3
                                                       : x.size();
    if (more > x.size() - i - 1)
      return false;
    for (std::size_t k = 1; k <= more; ++k)
      if ((byte(i + k) & 0xc0) != 0x80)
        return false;
    // Too long, a surrogate, or beyond U+10FFFF.
    if (more >= 2) {
      auto second = byte(i + 1);
      if ((first == 0xe0 && second < 0xa0) || (first == 0xed && second >= 0xa0) ||
          (first == 0xf0 && second < 0x90) || (first == 0xf4 && second >= 0x90))
        return false;
    }
    i += more + 1;
  }
  return true;
}

/// Of brackets outside of strings.
int depth_of(std::string_view x) {
  int depth = 0;
  int deepest = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < x.size(); ++i) {
    auto c = x[i];
    if (c == '"')
      in_string = !in_string;
    else if (in_string && c == '\\')
      ++i;
    else if (!in_string && (c == '{' || c == '['))
      deepest = std::max(deepest, ++depth);
    else if (!in_string && (c == '}' || c == ']'))
      --depth;
  }
  return deepest;
}

} // namespace

std::vector<std::string> RequestLines::take(std::string_view arrived) {
  std::vector<std::string> result;
  for (auto end = arrived.find('\n'); end != arrived.npos; end = arrived.find('\n')) {
    begun_ += arrived.substr(0, end);
    if (begun_.size() > longest_request)
      break;
    result.push_back(std::exchange(begun_, {}));
    arrived.remove_prefix(end + 1);
  }
  if (begun_.size() + arrived.size() > longest_request)
    throw BadRequest("the request is longer than " + std::to_string(longest_request) +
                     " bytes; one request is one line");
  begun_ += arrived;
  return result;
}

Json parse_request(const std::string& line) {
  if (!is_utf8(line))
    throw BadRequest("the request cannot be read: it is not UTF-8");
  if (depth_of(line) > deepest_request)
    throw BadRequest("the request cannot be read: more than " + std::to_string(deepest_request) +
                     " objects and lists within one another");
  Json result;
  try {
    result = Json::parse(line);
  } catch (const Json::exception& e) {
    throw BadRequest(std::string{"the request cannot be read: "} + e.what());
  }
  if (!result.is_object())
    throw BadRequest("the request cannot be read: it is no JSON object, such as {\"do\": \"ps\"}");
  return result;
}

} // namespace castor
