#include "castor/tests/support/relay.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <iterator>
#include <stdexcept>

namespace castor::test {

namespace {

sockaddr_in loopback(std::uint16_t port) {
  sockaddr_in result{};
  result.sin_family = AF_INET;
  result.sin_port = htons(port);
  result.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  return result;
}

} // namespace

Relay::Relay(std::uint16_t target)
  : target_(target), listener_(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0)) {
  auto address = loopback(0);
  socklen_t size = sizeof(address);
  if (bind(listener_, reinterpret_cast<sockaddr*>(&address), size) != 0 ||
      listen(listener_, SOMAXCONN) != 0 ||
      getsockname(listener_, reinterpret_cast<sockaddr*>(&address), &size) != 0)
    throw std::runtime_error("the relay cannot listen");
  port_ = ntohs(address.sin_port);
  thread_ = std::thread{[this] { run(); }};
}

Relay::~Relay() {
  stop();
}

std::size_t Relay::open() {
  std::lock_guard guard{mutex_};
  return open_.size();
}

void Relay::cut() {
  std::lock_guard guard{mutex_};
  close_all();
}

void Relay::cut_one(std::size_t choice) {
  std::lock_guard guard{mutex_};
  if (auto i = chosen(choice); i != open_.end()) {
    close(*i);
    open_.erase(i);
  }
}

void Relay::freeze(bool on) {
  std::lock_guard guard{mutex_};
  frozen_ = {on, on};
  if (!on)
    for (auto& x : open_)
      x.frozen = false;
}

void Relay::freeze(Way way, bool on) {
  std::lock_guard guard{mutex_};
  frozen_[static_cast<std::size_t>(way)] = on;
}

void Relay::freeze_one(std::size_t choice) {
  std::lock_guard guard{mutex_};
  if (auto i = chosen(choice); i != open_.end())
    i->frozen = true;
}

void Relay::freeze_present() {
  std::lock_guard guard{mutex_};
  frozen_ = {};
  for (auto& x : open_)
    x.frozen = true;
}

void Relay::refuse(bool on) {
  std::lock_guard guard{mutex_};
  refuses_ = on;
  if (on)
    close_all();
}

void Relay::stop() {
  over_ = true;
  if (thread_.joinable())
    thread_.join();
}

void Relay::run() {
  std::vector<pollfd> sockets;
  while (!over_) {
    sockets.assign({{listener_, POLLIN, 0}});
    {
      std::lock_guard guard{mutex_};
      for (auto& x : open_)
        for (std::size_t way = 0; way < x.pipes.size(); ++way)
          if (auto& pipe = x.pipes[way]; !x.frozen && !frozen_[way])
            sockets.push_back(pipe.waiting.empty() ? pollfd{pipe.from, POLLIN, 0}
                                                   : pollfd{pipe.to, POLLOUT, 0});
    }
    // What is told meanwhile is seen soon.
    poll(sockets.data(), sockets.size(), 2);
    std::lock_guard guard{mutex_};
    for (auto i = open_.begin(); i != open_.end();) {
      for (std::size_t way = 0; way < i->pipes.size(); ++way)
        if (!i->frozen && !frozen_[way])
          pass_on(*i, i->pipes[way]);
      if (i->ended)
        close(*i);
      i = i->ended ? open_.erase(i) : std::next(i);
    }
    if (sockets[0].revents != 0)
      accept();
  }
  std::lock_guard guard{mutex_};
  close_all();
  ::close(listener_);
}

void Relay::accept() {
  int near = accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK);
  if (near < 0)
    return;
  int far = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  auto address = loopback(target_);
  if (refuses_ || connect(far, reinterpret_cast<sockaddr*>(&address), sizeof(address)) != 0) {
    ::close(near);
    ::close(far);
    return;
  }
  int on = 1;
  for (int socket : {near, far})
    setsockopt(socket, IPPROTO_TCP, TCP_NODELAY, &on, sizeof(on));
  ++connections_;
  open_.push_back({{Pipe{near, far}, Pipe{far, near}}});
}

void Relay::pass_on(Connection& connection, Pipe& pipe) {
  auto failed = [] { return errno != EAGAIN && errno != EINTR; };
  if (pipe.waiting.empty()) {
    std::array<char, 65536> buffer;
    auto n = recv(pipe.from, buffer.data(), buffer.size(), MSG_DONTWAIT);
    if (n > 0)
      pipe.waiting.assign(buffer.begin(), buffer.begin() + n);
    else if (n == 0 || failed())
      connection.ended = true;
  }
  if (pipe.waiting.empty())
    return;
  auto n = send(pipe.to, pipe.waiting.data(), pipe.waiting.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
  if (n > 0)
    pipe.waiting.erase(pipe.waiting.begin(), pipe.waiting.begin() + n);
  else if (failed())
    connection.ended = true;
}

void Relay::close(Connection& connection) {
  for (auto& x : connection.pipes)
    ::close(x.to);
}

void Relay::close_all() {
  for (auto& x : open_)
    close(x);
  open_.clear();
}

Relay::Connections::iterator Relay::chosen(std::size_t choice) {
  if (open_.empty())
    return open_.end();
  return std::next(open_.begin(), static_cast<std::ptrdiff_t>(choice % open_.size()));
}

} // namespace castor::test
