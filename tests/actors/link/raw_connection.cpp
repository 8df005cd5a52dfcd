#include "castor/tests/actors/link/raw_connection.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <filesystem>
#include <iterator>
#include <optional>
#include <stdexcept>

namespace castor::test {

namespace {

using Clock = std::chrono::steady_clock;

/// What comes next; empty at the end, nothing if there is none by then.
std::optional<std::string> receive_until(int socket, Clock::time_point until) {
  auto left = std::chrono::ceil<std::chrono::milliseconds>(until - Clock::now()).count();
  pollfd x{socket, POLLIN, 0};
  if (left <= 0 || poll(&x, 1, static_cast<int>(left)) <= 0)
    return std::nullopt;
  std::array<char, 4096> buffer;
  auto n = recv(socket, buffer.data(), buffer.size(), 0);
  return std::string(buffer.data(), n > 0 ? static_cast<std::size_t>(n) : 0);
}

} // namespace

RawConnection::RawConnection(std::uint16_t port)
  : socket_(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (socket_ < 0 || connect(socket_, reinterpret_cast<sockaddr*>(&address), sizeof(address)) != 0)
    throw std::runtime_error{"no connection to port " + std::to_string(port)};
}

RawConnection::~RawConnection() {
  if (socket_ >= 0)
    close(socket_);
}

void RawConnection::send(std::string_view bytes) const {
  while (!bytes.empty()) {
    auto n = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    // The peer has had enough.
    if (n <= 0)
      return;
    bytes.remove_prefix(static_cast<std::size_t>(n));
  }
}

std::string RawConnection::receive_some() const {
  return receive_until(socket_, Clock::now() + std::chrono::seconds{10}).value_or("");
}

std::string RawConnection::receive_all() const {
  std::string result;
  auto until = Clock::now() + std::chrono::seconds{10};
  for (;;) {
    auto x = receive_until(socket_, until);
    if (!x || x->empty())
      return result;
    result += *x;
  }
}

bool RawConnection::is_ended_by_peer() const {
  auto until = Clock::now() + std::chrono::seconds{10};
  for (;;) {
    auto x = receive_until(socket_, until);
    if (!x)
      return false;
    if (x->empty())
      return true;
  }
}

void RawConnection::reset() {
  linger x{1, 0};
  setsockopt(socket_, SOL_SOCKET, SO_LINGER, &x, sizeof(x));
  close(socket_);
  socket_ = -1;
}

std::size_t open_descriptors() {
  return static_cast<std::size_t>(std::distance(
    std::filesystem::directory_iterator{"/proc/self/fd"}, std::filesystem::directory_iterator{}));
}

} // namespace castor::test
