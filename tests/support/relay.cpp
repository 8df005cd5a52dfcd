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

void Relay::cut() {
  int before = cuts_++;
  // Done once the thread has seen it, so that whatever is sent next meets no old connection.
  while (cuts_ == before + 1 && !over_)
    std::this_thread::yield();
}

void Relay::stop() {
  over_ = true;
  if (thread_.joinable())
    thread_.join();
}

void Relay::run() {
  int done = 0;
  while (!over_) {
    if (int wanted = cuts_; wanted > done) {
      close_connections([](auto&, auto&) { return true; });
      cuts_ = done = wanted + 1;
    }
    std::vector<pollfd> sockets{{listener_, POLLIN, 0}};
    bool frozen = frozen_;
    for (auto& x : pipes_) {
      short events = frozen ? 0 : x.waiting.empty() ? POLLIN : POLLOUT;
      sockets.push_back({x.waiting.empty() ? x.from : x.to, events, 0});
    }
    poll(sockets.data(), sockets.size(), 2);
    if (!frozen) {
      std::size_t i = 1;
      for (auto& x : pipes_)
        if (sockets[i++].revents != 0)
          pass_on(x);
      close_connections([](auto& there, auto& back) { return there.ended || back.ended; });
    }
    if (sockets[0].revents != 0)
      accept();
  }
  close_connections([](auto&, auto&) { return true; });
  close(listener_);
}

void Relay::accept() {
  int near = accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK);
  if (near < 0)
    return;
  int far = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  auto address = loopback(target_);
  if (connect(far, reinterpret_cast<sockaddr*>(&address), sizeof(address)) != 0) {
    close(near);
    close(far);
    return;
  }
  int on = 1;
  for (int socket : {near, far})
    setsockopt(socket, IPPROTO_TCP, TCP_NODELAY, &on, sizeof(on));
  ++connections_;
  pipes_.push_back({near, far});
  pipes_.push_back({far, near});
}

void Relay::pass_on(Pipe& pipe) {
  if (pipe.waiting.empty()) {
    std::array<char, 65536> buffer;
    auto n = recv(pipe.from, buffer.data(), buffer.size(), MSG_DONTWAIT);
    if (n > 0)
      pipe.waiting.assign(buffer.begin(), buffer.begin() + n);
    else if (n == 0 || (errno != EAGAIN && errno != EINTR))
      pipe.ended = true;
    return;
  }
  auto n = send(pipe.to, pipe.waiting.data(), pipe.waiting.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
  if (n > 0)
    pipe.waiting.erase(pipe.waiting.begin(), pipe.waiting.begin() + n);
  else if (errno != EAGAIN && errno != EINTR)
    pipe.ended = true;
}

template <class F>
void Relay::close_connections(F which) {
  for (auto there = pipes_.begin(); there != pipes_.end();) {
    auto back = std::next(there);
    auto next = std::next(back);
    if (which(*there, *back)) {
      close(there->to);
      close(back->to);
      pipes_.erase(there, next);
    }
    there = next;
  }
}

} // namespace castor::test
