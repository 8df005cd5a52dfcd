#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include <sys/types.h>

/// Unix stream sockets, over which processes on one machine talk to each other: the kernel tells
/// each side which user the other one belongs to.
namespace castor {

/// How many bytes the path of a socket may have.
inline constexpr std::size_t longest_socket_path = 107;

/// The process at the other end of a Unix socket, as it was when the connection was made.
struct LocalPeer {
  pid_t process = 0;
  uid_t user = 0;

  bool is_of_this_user() const;
};

/// "process 4711 of user nobody (65534)"
std::string to_string(const LocalPeer& x);

/// "user nobody (65534)"
std::string user_called(uid_t user);

/// Nothing for sockets of other kinds. For a listening process it is the one that called listen().
std::optional<LocalPeer> local_peer(int socket);

/// The path at which a Unix socket was made; nothing for sockets of other kinds.
std::optional<std::filesystem::path> local_address(int socket);

/// A socket that listens, which nobody but the owner may connect with. A socket that a process of
/// this user left behind there is replaced. Throws std::runtime_error, which says why and what to
/// do.
int listen_at_path(const std::filesystem::path& path);

/// A connected socket, non-blocking; or -1, with errno set: EAGAIN if the listener is too busy now.
int connect_to_path(const std::filesystem::path& path);

/// Whether there is a socket at which nobody listens any more.
bool is_abandoned(const std::filesystem::path& path);

} // namespace castor
