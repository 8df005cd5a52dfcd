// Feeds arbitrary bytes to what takes the requests of those who look on: however they are cut, they
// are the same lines; each of them is a request or a BadRequest, whose text can be said in JSON.

#include "castor/actors/system/request_lines.hpp"
#include "castor/tests/support/fuzzing.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace {

using namespace castor;
using test::require;

std::vector<std::string> cut(std::string_view input, std::size_t size) {
  RequestLines lines;
  std::vector<std::string> result;
  while (!input.empty()) {
    auto piece = input.substr(0, size);
    input.remove_prefix(piece.size());
    for (auto& line : lines.take(piece))
      result.push_back(std::move(line));
  }
  return result;
}

} // namespace

// NOLINTNEXTLINE(readability-identifier-naming): the name is libFuzzer's
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string_view input{reinterpret_cast<const char*>(data), size};
  auto lines = cut(input, std::max<std::size_t>(size, 1));
  require(lines == cut(input, 1));
  require(lines == cut(input, 7));
  for (auto& line : lines) {
    try {
      auto request = parse_request(line);
      require(request.is_object());
      // What is in it can be said again.
      require(parse_request(request.dump()).is_object());
    } catch (const BadRequest& e) {
      nlohmann::ordered_json{{"error", e.what()}}.dump(
        -1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
    }
  }
  return 0;
}
