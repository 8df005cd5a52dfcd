#pragma once

#include "castor/actors/link/endpoint.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <sys/types.h>

struct sockaddr;

/// How processes of one user find each other's nodes without trusting TCP, where anybody on the
/// machine can be at either end: a node that listens at a TCP address listens at a Unix socket too,
/// which is named for the address and stands in a folder of its user alone.
namespace castor {

/// A Unix socket that stands for a TCP address.
struct NodeSocket {
  /// Listens; owned by the holder of this struct.
  int socket = -1;
  std::filesystem::path file;
};

/// Listens at the Unix socket beside a TCP socket that listens already. Throws std::runtime_error.
NodeSocket listen_beside(int tcp_socket);

/// Possible names of the Unix socket of a node at a TCP address: for the address itself, and for
/// all addresses of the machine.
std::vector<std::string> node_socket_names(const sockaddr& address);

/// A connection with the node of this user that listens at a loopback address; -1 if there is none.
int connect_to_own_node(const sockaddr& address);

/// User whose process listens at a TCP address of this machine; nothing if none does. `tcp` and
/// `tcp6` are the contents of /proc/net/tcp and /proc/net/tcp6.
std::optional<uid_t> listening_user(std::string_view tcp, std::string_view tcp6,
                                    const sockaddr& address);

/// Why there is no connection with a node of this user at an address, and what to do about it.
std::string why_no_own_node(const Endpoint& at, const sockaddr& address);

} // namespace castor
