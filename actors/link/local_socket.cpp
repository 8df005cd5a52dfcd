#include "castor/actors/link/local_socket.hpp"

#include <pwd.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace castor {

namespace {

namespace fs = std::filesystem;

sockaddr_un address_of(const fs::path& path) {
  sockaddr_un result{};
  result.sun_family = AF_UNIX;
  path.string().copy(result.sun_path, longest_socket_path);
  return result;
}

bool is_too_long(const fs::path& path) {
  return path.string().size() > longest_socket_path;
}

/// Closes and throws std::runtime_error.
[[noreturn]] void give_up(int fd, const fs::path& path, int error) {
  if (fd >= 0)
    close(fd);
  throw std::runtime_error("cannot listen at " + path.string() + ": " + std::strerror(error));
}

/// Removes a socket that a process of this user left behind. Throws std::runtime_error if something
/// else is there.
void clear(const fs::path& path) {
  struct stat status {};
  if (lstat(path.c_str(), &status) != 0)
    return;
  if (!S_ISSOCK(status.st_mode) || status.st_uid != geteuid())
    throw std::runtime_error("cannot listen at " + path.string() +
                             ": something is there that is no socket of this user; remove it, or "
                             "take another path");
  if (!is_abandoned(path))
    throw std::runtime_error("cannot listen at " + path.string() +
                             ": another process listens there (`ss -lxp` shows which); end it, or "
                             "take another path");
  unlink(path.c_str());
}

} // namespace

bool LocalPeer::is_of_this_user() const {
  return user == geteuid();
}

std::string user_called(uid_t user) {
  std::array<char, 4096> buffer;
  passwd entry{};
  passwd* found = nullptr;
  auto number = std::to_string(user);
  if (getpwuid_r(user, &entry, buffer.data(), buffer.size(), &found) != 0 || !found)
    return "user " + number;
  return "user " + std::string{found->pw_name} + " (" + number + ')';
}

std::string to_string(const LocalPeer& x) {
  return "process " + std::to_string(x.process) + " of " + user_called(x.user);
}

std::optional<LocalPeer> local_peer(int socket) {
  int domain = 0;
  socklen_t size = sizeof(domain);
  if (getsockopt(socket, SOL_SOCKET, SO_DOMAIN, &domain, &size) != 0 || domain != AF_UNIX)
    return std::nullopt;
  ucred peer{};
  size = sizeof(peer);
  // Of a peer about which the kernel says nothing, nothing is believed.
  if (getsockopt(socket, SOL_SOCKET, SO_PEERCRED, &peer, &size) != 0)
    return LocalPeer{0, static_cast<uid_t>(-1)};
  return LocalPeer{peer.pid, peer.uid};
}

std::optional<fs::path> local_address(int socket) {
  sockaddr_un address{};
  socklen_t size = sizeof(address);
  if (getsockname(socket, reinterpret_cast<sockaddr*>(&address), &size) != 0 ||
      address.sun_family != AF_UNIX)
    return std::nullopt;
  return fs::path{std::string{address.sun_path, strnlen(address.sun_path, longest_socket_path)}};
}

int listen_at_path(const fs::path& path) {
  if (is_too_long(path))
    throw std::runtime_error(path.string() + " is too long for a socket: it may have " +
                             std::to_string(longest_socket_path) + " bytes; take a shorter path");
  clear(path);
  auto address = address_of(path);
  int fd = socket(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (fd < 0 || bind(fd, reinterpret_cast<sockaddr*>(&address), sizeof(address)) != 0)
    give_up(fd, path, errno);
  // Nobody can connect before it listens, so nobody comes in between.
  if (chmod(path.c_str(), 0600) != 0 || listen(fd, SOMAXCONN) != 0) {
    int error = errno;
    unlink(path.c_str());
    give_up(fd, path, error);
  }
  return fd;
}

int connect_to_path(const fs::path& path) {
  if (is_too_long(path)) {
    errno = ENAMETOOLONG;
    return -1;
  }
  int fd = socket(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (fd < 0)
    return -1;
  auto address = address_of(path);
  if (connect(fd, reinterpret_cast<sockaddr*>(&address), sizeof(address)) == 0)
    return fd;
  int error = errno;
  close(fd);
  errno = error;
  return -1;
}

bool is_abandoned(const fs::path& path) {
  struct stat status {};
  if (lstat(path.c_str(), &status) != 0 || !S_ISSOCK(status.st_mode))
    return false;
  int fd = connect_to_path(path);
  if (fd >= 0) {
    close(fd);
    return false;
  }
  return errno == ECONNREFUSED;
}

} // namespace castor
