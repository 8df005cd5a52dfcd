#include "castor/actors/link/endpoint.hpp"

#include <charconv>
#include <stdexcept>

namespace castor {

namespace {

const std::string socket_prefix{"unix:"};

} // namespace

std::string to_string(const Endpoint& x) {
  if (is_socket_path(x.host))
    return socket_prefix + x.host;
  auto host = x.host.find(':') == std::string::npos ? x.host : '[' + x.host + ']';
  return host + ':' + std::to_string(x.port);
}

Endpoint parse_endpoint(const std::string& text, std::uint16_t default_port) {
  if (text.starts_with(socket_prefix)) {
    auto path = text.substr(socket_prefix.size());
    if (!is_socket_path(path))
      throw std::invalid_argument("write unix:/PATH, with the whole path of a socket, not " + text);
    return {path, 0};
  }
  Endpoint result{text, default_port};
  auto colon = text.rfind(':');
  bool bracketed = text.starts_with('[');
  auto end = bracketed ? text.find(']') : std::string::npos;
  if (bracketed && end == std::string::npos)
    throw std::invalid_argument("the bracket in " + text + " is not closed");
  // More than one colon without brackets is an IPv6 address.
  if (bracketed ? end + 1 < text.size() : colon != std::string::npos && text.find(':') == colon) {
    auto begin = text.data() + colon + 1;
    auto [rest, error] = std::from_chars(begin, text.data() + text.size(), result.port);
    if ((bracketed && colon != end + 1) || error != std::errc{} ||
        rest != text.data() + text.size())
      throw std::invalid_argument("write HOST:PORT, with a port of at most 65535, not " + text);
    result.host = text.substr(0, colon);
  }
  if (bracketed)
    result.host = text.substr(1, end - 1);
  return result;
}

} // namespace castor
