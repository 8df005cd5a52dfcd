#pragma once

#include <nlohmann/json.hpp>

#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

/// Parsing of requests from the socket of a running system (docs/introspection.md): pure functions
/// of bytes.
namespace castor {

/// Bytes of a request, at most.
inline constexpr std::size_t longest_request = std::size_t{1} << 20;

/// Objects and lists within one another in a request, at most.
inline constexpr int deepest_request = 64;

/// The input is not a request; `what()` is the answer.
class BadRequest : public std::runtime_error {
public:
  using runtime_error::runtime_error;
};

/// Cuts what arrives, in pieces of any size, into lines.
class RequestLines {
public:
  /// The lines that are complete now, without their ends. Throws BadRequest once a line is longer
  /// than `longest_request`: the rest of the input cannot be used then.
  std::vector<std::string> take(std::string_view arrived);

private:
  std::string begun_;
};

/// Reads a request. Throws BadRequest if it is not one JSON object in UTF-8, or nested too deeply.
nlohmann::ordered_json parse_request(const std::string& line);

} // namespace castor
