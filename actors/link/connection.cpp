#include "castor/actors/link/connection.hpp"

#include "castor/actors/link/send_later.hpp"

#include <caf/io/abstract_broker.hpp>
#include <caf/io/network/acceptor_impl.hpp>
#include <caf/io/network/default_multiplexer.hpp>
#include <caf/io/network/interfaces.hpp>
#include <caf/io/network/scribe_impl.hpp>

#include <fcntl.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <utility>

namespace castor {

namespace {

using namespace std::chrono_literals;
namespace network = caf::io::network;

/// How long an acceptor rests at the limit of descriptors.
constexpr std::chrono::milliseconds rest_of_acceptor = 100ms;
/// How many are turned away between two rests.
constexpr std::size_t turned_away_at_once = 64;
/// How long the kernel keeps what a peer does not acknowledge, after the connection was closed, in
/// milliseconds.
constexpr int unacknowledged_after_close = 2000;

/// An active socket holds what it serves, and lets go of it when the loop tells that it is removed.
/// If it is activated and removed in one round of the loop, the loop sees neither, and tells
/// nothing. What is posted runs in the next round.
template <class Servant, class Socket>
void settle_later(Servant* servant, Socket& socket, const bool& wanted) {
  socket.backend().post([keep = caf::intrusive_ptr<Servant>{servant}, &socket, &wanted] {
    if ((socket.eventbf() & POLLIN) != 0)
      return;
    socket.removed_from_loop(network::operation::read);
    if (wanted)
      socket.activate(keep.get());
  });
}

class Connection : public network::scribe_impl {
public:
  using scribe_impl::scribe_impl;

  void add_to_loop() override {
    reads_ = true;
    scribe_impl::add_to_loop();
  }

  void remove_from_loop() override {
    reads_ = false;
    scribe_impl::remove_from_loop();
    settle_later(this, stream_, reads_);
  }

  void graceful_shutdown() override {
    setsockopt(stream_.fd(), IPPROTO_TCP, TCP_USER_TIMEOUT, &unacknowledged_after_close,
               sizeof(unacknowledged_after_close));
    scribe_impl::graceful_shutdown();
  }

private:
  bool reads_ = true;
};

network::default_multiplexer& multiplexer_of(caf::io::abstract_broker& broker) {
  return dynamic_cast<network::default_multiplexer&>(broker.backend());
}

caf::intrusive_ptr<Connection> make_connection(network::default_multiplexer& multiplexer,
                                               int socket) {
  int on = 1;
  setsockopt(socket, SOL_SOCKET, SO_KEEPALIVE, &on, sizeof(on));
  return caf::make_counted<Connection>(multiplexer, socket);
}

/// Accepts connections, and knows what to do without descriptors. What CAF calls a policy.
class Accepting {
public:
  explicit Accepting(AcceptorParts parts) : parts_(std::move(parts)) { keep_reserve(); }
  Accepting(const Accepting&) = delete;
  Accepting& operator=(const Accepting&) = delete;
  ~Accepting() { release_reserve(); }

  bool try_accept(network::native_socket& result, network::native_socket listener) {
    result = accept_one(listener);
    if (result >= 0)
      return true;
    int error = errno;
    if (error == EMFILE || error == ENFILE || error == ENOBUFS || error == ENOMEM) {
      DescriptorShortage shortage{turn_away(listener), std::strerror(error)};
      if (parts_.on_shortage)
        parts_.on_shortage(shortage);
    }
    return false;
  }

private:
  static int accept_one(int listener) {
    return accept4(listener, nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
  }

  std::size_t turn_away(int listener) {
    std::size_t result = 0;
    for (; result < turned_away_at_once; ++result) {
      release_reserve();
      int socket = accept_one(listener);
      if (socket < 0)
        break;
      say_farewell(socket);
      close(socket);
      keep_reserve();
    }
    keep_reserve();
    return result;
  }

  void say_farewell(int socket) const {
    if (parts_.farewell.empty())
      return;
    // What is not read before a socket is closed makes the kernel withdraw what was written.
    std::array<char, 4096> said;
    while (recv(socket, said.data(), said.size(), 0) > 0)
      continue;
    [[maybe_unused]] auto written =
      ::send(socket, parts_.farewell.data(), parts_.farewell.size(), MSG_NOSIGNAL);
    shutdown(socket, SHUT_WR);
  }

  void keep_reserve() {
    if (reserve_ < 0)
      reserve_ = open("/dev/null", O_RDONLY | O_CLOEXEC);
  }

  void release_reserve() {
    if (reserve_ >= 0)
      close(std::exchange(reserve_, -1));
  }

  AcceptorParts parts_;
  int reserve_ = -1;
};

/// The listening socket in the network's loop, and what becomes of its connections.
class Acceptor : public caf::io::doorman {
public:
  Acceptor(network::default_multiplexer& multiplexer, AcceptorParts parts)
    : doorman(network::accept_hdl_from_socket(parts.socket)),
      socket_(multiplexer, parts.socket, with_rest(std::move(parts))) {}

  bool new_connection() override {
    auto& multiplexer = socket_.backend();
    auto connection = make_connection(multiplexer, socket_.accepted_socket());
    if (detached())
      return false;
    auto handle = connection->hdl();
    parent()->add_scribe(std::move(connection));
    return doorman::new_connection(&multiplexer, handle);
  }

  void graceful_shutdown() override {
    socket_.graceful_shutdown();
    detach(&socket_.backend(), false);
  }

  void launch() override { socket_.start(this); }

  std::string addr() const override {
    auto x = network::local_addr_of_fd(socket_.fd());
    return x ? *x : std::string{};
  }

  std::uint16_t port() const override {
    auto x = network::local_port_of_fd(socket_.fd());
    return x ? *x : std::uint16_t{0};
  }

  void add_to_loop() override {
    accepts_ = true;
    socket_.activate(this);
  }

  void remove_from_loop() override {
    accepts_ = false;
    socket_.passivate();
    settle_later(this, socket_, accepts_);
  }

private:
  AcceptorParts with_rest(AcceptorParts parts) {
    parts.on_shortage = [this, tell = std::move(parts.on_shortage)](const DescriptorShortage& x) {
      if (tell)
        tell(x);
      rest();
    };
    return parts;
  }

  void rest() {
    if (detached())
      return;
    halt();
    send_later(parent(), rest_of_acceptor, ResumeAccepting{hdl()});
  }

  network::acceptor_impl<Accepting> socket_;
  bool accepts_ = true;
};

} // namespace

caf::io::connection_handle add_connection(caf::io::abstract_broker& to, int socket) {
  auto connection = make_connection(multiplexer_of(to), socket);
  auto handle = connection->hdl();
  to.add_scribe(std::move(connection));
  return handle;
}

caf::io::accept_handle add_acceptor(caf::io::abstract_broker& to, AcceptorParts parts) {
  auto acceptor = caf::make_counted<Acceptor>(multiplexer_of(to), std::move(parts));
  auto handle = acceptor->hdl();
  to.add_doorman(std::move(acceptor));
  return handle;
}

} // namespace castor
