#include "castor/actors/link/node_socket.hpp"

#include "castor/actors/link/local_socket.hpp"
#include "castor/actors/link/private_folder.hpp"
#include "castor/base/text.hpp"

#include <fmt/core.h>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <fstream>
#include <iterator>

namespace castor {

namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

constexpr const char* extension = ".node";

Endpoint endpoint_of(const sockaddr& address) {
  std::array<char, INET6_ADDRSTRLEN> text{};
  if (address.sa_family == AF_INET6) {
    auto& x = reinterpret_cast<const sockaddr_in6&>(address);
    inet_ntop(AF_INET6, &x.sin6_addr, text.data(), text.size());
    return {text.data(), ntohs(x.sin6_port)};
  }
  auto& x = reinterpret_cast<const sockaddr_in&>(address);
  inet_ntop(AF_INET, &x.sin_addr, text.data(), text.size());
  return {text.data(), ntohs(x.sin_port)};
}

std::string name_for(const Endpoint& at) {
  return to_string(at) + extension;
}

/// As /proc/net/tcp and /proc/net/tcp6 write it: the words of the address as this machine has them.
std::string in_kernel_form(const sockaddr& address) {
  std::string result;
  std::array<std::uint32_t, 4> words{};
  if (address.sa_family == AF_INET6) {
    auto& x = reinterpret_cast<const sockaddr_in6&>(address);
    std::memcpy(words.data(), &x.sin6_addr, sizeof(x.sin6_addr));
    for (auto word : words)
      result += fmt::format("{:08X}", word);
    return result + fmt::format(":{:04X}", ntohs(x.sin6_port));
  }
  auto& x = reinterpret_cast<const sockaddr_in&>(address);
  return fmt::format("{:08X}:{:04X}", x.sin_addr.s_addr, ntohs(x.sin_port));
}

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> result;
  for (auto word = take_word(line); !word.empty(); word = take_word(line))
    result.push_back(word);
  return result;
}

/// The user of the socket that listens at an address, in the form of the kernel's table.
std::optional<uid_t> listening_at(std::string_view table, std::string_view address) {
  constexpr std::size_t local = 1, state = 3, user = 7;
  while (!table.empty()) {
    auto end = std::min(table.find('\n'), table.size());
    auto words = words_of(table.substr(0, end));
    table.remove_prefix(std::min(end + 1, table.size()));
    if (words.size() <= user || words[local] != address || words[state] != "0A")
      continue;
    uid_t result = 0;
    auto& text = words[user];
    if (std::from_chars(text.data(), text.data() + text.size(), result).ec == std::errc{})
      return result;
  }
  return std::nullopt;
}

std::string text_of(const char* file) {
  std::ifstream in{file};
  return {std::istreambuf_iterator<char>{in}, {}};
}

} // namespace

NodeSocket listen_beside(int tcp_socket) {
  sockaddr_storage address{};
  socklen_t size = sizeof(address);
  getsockname(tcp_socket, reinterpret_cast<sockaddr*>(&address), &size);
  auto folder = nodes_folder();
  sweep(folder);
  const FolderLock lock{folder, 2s};
  auto file = folder / name_for(endpoint_of(reinterpret_cast<sockaddr&>(address)));
  return {listen_at_path(file), file};
}

std::vector<std::string> node_socket_names(const sockaddr& address) {
  auto at = endpoint_of(address);
  std::vector<std::string> result{name_for(at)};
  if (address.sa_family == AF_INET)
    result.push_back(name_for({"0.0.0.0", at.port}));
  result.push_back(name_for({"::", at.port}));
  return result;
}

int connect_to_own_node(const sockaddr& address) {
  for (auto& folder : private_folders())
    for (auto& name : node_socket_names(address)) {
      int result = connect_to_path(folder / name);
      if (result >= 0)
        return result;
    }
  return -1;
}

std::optional<uid_t> listening_user(std::string_view tcp, std::string_view tcp6,
                                    const sockaddr& address) {
  bool is_v6 = address.sa_family == AF_INET6;
  auto exact = in_kernel_form(address);
  auto port = exact.substr(exact.find(':'));
  if (auto found = listening_at(is_v6 ? tcp6 : tcp, exact))
    return found;
  if (!is_v6)
    if (auto found = listening_at(tcp, std::string(8, '0') + port))
      return found;
  // A socket for all IPv6 addresses takes those of IPv4 as well.
  return listening_at(tcp6, std::string(32, '0') + port);
}

std::string why_no_own_node(const Endpoint& at, const sockaddr& address) {
  auto user = listening_user(text_of("/proc/net/tcp"), text_of("/proc/net/tcp6"), address);
  if (!user)
    return std::strerror(ECONNREFUSED);
  if (*user != geteuid())
    return "the listener at " + to_string(at) + " belongs to " + user_called(*user) +
           ", not to you: take another port, or start the node and the system with --tls DIR "
           "(scripts/make-certs makes certificates), or, if every user of this machine may be "
           "trusted, both with --insecure";
  return "the listener at " + to_string(at) +
         " is yours, but no node for systems of its own user alone: a node with --tls needs --tls "
         "here, too; a tunnel, or a node with a /tmp of its own, needs --insecure on both sides";
}

} // namespace castor
