#include "castor/actors/system/request_lines.hpp"

#include "castor/base/text.hpp"

#include <algorithm>
#include <utility>

namespace castor {

namespace {

using Json = nlohmann::ordered_json;

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
