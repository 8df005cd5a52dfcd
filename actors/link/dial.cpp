#include "castor/actors/link/dial.hpp"

#include "castor/actors/link/local_socket.hpp"
#include "castor/actors/link/node_socket.hpp"

#include <arpa/inet.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <utility>

namespace castor {

namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

using Addresses = std::unique_ptr<addrinfo, void (*)(addrinfo*)>;

/// Throws std::runtime_error.
Addresses resolve(const Endpoint& x, int flags) {
  addrinfo hints{};
  hints.ai_family = AF_UNSPEC;
  hints.ai_socktype = SOCK_STREAM;
  hints.ai_flags = flags | AI_NUMERICSERV;
  addrinfo* found = nullptr;
  auto port = std::to_string(x.port);
  if (int error =
        getaddrinfo(x.host.empty() ? nullptr : x.host.c_str(), port.c_str(), &hints, &found))
    throw std::runtime_error("no address for " + x.host + ": " + gai_strerror(error));
  return {found, freeaddrinfo};
}

/// Closes the socket unless it is released.
class Socket {
public:
  explicit Socket(const addrinfo& x)
    : fd_(::socket(x.ai_family, x.ai_socktype | SOCK_NONBLOCK | SOCK_CLOEXEC, x.ai_protocol)) {}
  Socket(const Socket&) = delete;
  Socket& operator=(const Socket&) = delete;
  ~Socket() {
    if (fd_ >= 0)
      close(fd_);
  }

  int get() const { return fd_; }
  int release() { return std::exchange(fd_, -1); }

private:
  int fd_;
};

void configure(int fd) {
  int on = 1;
  setsockopt(fd, IPPROTO_TCP, TCP_NODELAY, &on, sizeof(on));
  // What waits in the kernel cannot be overtaken by what is short and urgent.
  int unsent = 128 * 1024;
  setsockopt(fd, IPPROTO_TCP, TCP_NOTSENT_LOWAT, &unsent, sizeof(unsent));
}

/// 0, or the error that connecting ended with.
int finish_connecting(int fd, Clock::time_point until, const std::function<bool()>& cancelled) {
  while (Clock::now() < until && !cancelled()) {
    pollfd x{fd, POLLOUT, 0};
    if (poll(&x, 1, 50) <= 0)
      continue;
    int error = 0;
    socklen_t size = sizeof(error);
    getsockopt(fd, SOL_SOCKET, SO_ERROR, &error, &size);
    return error;
  }
  return ETIMEDOUT;
}

/// How often a listener that is too busy is tried again.
constexpr std::chrono::milliseconds busy_pause{20};

std::variant<int, std::string> dial_path(const std::string& path, Clock::time_point until,
                                         const std::function<bool()>& cancelled) {
  int fd = -1;
  while ((fd = connect_to_path(path)) < 0) {
    if (errno != EAGAIN)
      return std::string{std::strerror(errno)};
    if (Clock::now() > until || cancelled())
      return std::string{"it took too long"};
    poll(nullptr, 0, static_cast<int>(busy_pause.count()));
  }
  auto peer = local_peer(fd);
  if (peer && peer->is_of_this_user())
    return fd;
  close(fd);
  return "the socket belongs to " + (peer ? to_string(*peer) : "an unknown process") +
         ", not to you";
}

bool is_loopback(const sockaddr& x) {
  if (x.sa_family == AF_INET)
    return ntohl(reinterpret_cast<const sockaddr_in&>(x).sin_addr.s_addr) >> 24 == 127;
  return x.sa_family == AF_INET6 &&
         IN6_IS_ADDR_LOOPBACK(&reinterpret_cast<const sockaddr_in6&>(x).sin6_addr);
}

/// Why there is no connection with another machine.
constexpr const char* not_proved = "the peer cannot be identified: start the nodes and the system "
                                   "with --tls DIR (scripts/make-certs "
                                   "makes certificates), or all with --insecure";

} // namespace

std::variant<int, std::string> dial(const Endpoint& to, PeerTrust trust,
                                    std::chrono::milliseconds patience,
                                    const std::function<bool()>& cancelled) {
  auto until = Clock::now() + patience;
  if (is_socket_path(to.host))
    return dial_path(to.host, until, cancelled);
  std::string problem;
  try {
    auto addresses = resolve(to, AI_ADDRCONFIG);
    for (auto* x = addresses.get(); x && Clock::now() < until && !cancelled(); x = x->ai_next) {
      bool is_local = is_loopback(*x->ai_addr);
      if (int own =
            is_local && trust != PeerTrust::certified ? connect_to_own_node(*x->ai_addr) : -1;
          own >= 0)
        return own;
      if (trust == PeerTrust::same_user) {
        problem = is_local ? why_no_own_node(to, *x->ai_addr) : not_proved;
        continue;
      }
      Socket socket{*x};
      int error = socket.get() < 0                                        ? errno
                  : connect(socket.get(), x->ai_addr, x->ai_addrlen) == 0 ? 0
                                                                          : errno;
      if (error == EINPROGRESS)
        error = finish_connecting(socket.get(), until, cancelled);
      if (error == 0) {
        configure(socket.get());
        return socket.release();
      }
      problem = std::strerror(error);
    }
  } catch (const std::runtime_error& e) {
    problem = e.what();
  }
  return problem.empty() ? std::string{"it took too long"} : problem;
}

namespace {

std::string why_not_listening(const Endpoint& at, int error) {
  auto text = "cannot listen at " + to_string(at) + ": ";
  auto any = to_string(Endpoint{at.host, 0});
  if (error == EADDRINUSE)
    return text + "another process listens there, such as a node that runs already (`ss -ltnp` " +
           "shows which); end it, or take another port: --listen " + any +
           " takes any that is free";
  if (error == EADDRNOTAVAIL)
    return text + "the address is not one of this machine; `ip address` shows those that are";
  if (error == EACCES)
    return text + "ports below 1024 are for root; take another one, or " + any +
           " for any that is free";
  return text + std::strerror(error);
}

} // namespace

int listen_at(const Endpoint& at) {
  if (is_socket_path(at.host))
    return listen_at_path(at.host);
  auto addresses = resolve(at, AI_PASSIVE);
  Socket socket{*addresses};
  int on = 1;
  if (socket.get() < 0 ||
      setsockopt(socket.get(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof(on)) != 0 ||
      bind(socket.get(), addresses->ai_addr, addresses->ai_addrlen) != 0 ||
      listen(socket.get(), SOMAXCONN) != 0)
    throw std::runtime_error(why_not_listening(at, errno));
  // Sockets that are accepted inherit it.
  configure(socket.get());
  return socket.release();
}

std::uint16_t port_of(int socket) {
  sockaddr_storage address{};
  socklen_t size = sizeof(address);
  getsockname(socket, reinterpret_cast<sockaddr*>(&address), &size);
  return address.ss_family == AF_INET6 ? ntohs(reinterpret_cast<sockaddr_in6*>(&address)->sin6_port)
                                       : ntohs(reinterpret_cast<sockaddr_in*>(&address)->sin_port);
}

std::string why_unknown(const std::string& host) {
  if (is_socket_path(host))
    return {};
  try {
    resolve({host, 0}, 0);
    return {};
  } catch (const std::runtime_error& e) {
    return e.what();
  }
}

bool is_loopback(const std::string& host) {
  if (is_socket_path(host))
    return true;
  try {
    auto addresses = resolve({host, 0}, AI_PASSIVE);
    for (auto* x = addresses.get(); x; x = x->ai_next)
      if (!is_loopback(*x->ai_addr))
        return false;
    return true;
  } catch (const std::runtime_error&) {
    return false;
  }
}

} // namespace castor
