#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <list>
#include <thread>
#include <vector>

namespace castor::test {

/// Stands between two processes: listens on a port of 127.0.0.1 and passes everything on to
/// another, until told to misbehave.
class Relay {
public:
  explicit Relay(std::uint16_t target);
  Relay(const Relay&) = delete;
  Relay& operator=(const Relay&) = delete;
  ~Relay();

  std::uint16_t port() const { return port_; }

  /// How many were accepted so far.
  int connections() const { return connections_; }

  /// Ends all connections; new ones are taken.
  void cut();

  /// Passes nothing on, while everybody believes to be connected.
  void freeze(bool on) { frozen_ = on; }

  /// Ends all connections and takes no more.
  void stop();

private:
  struct Pipe {
    int from;
    int to;
    std::vector<char> waiting = {};
    bool ended = false;
  };

  void run();
  void accept();
  void pass_on(Pipe& pipe);
  /// Of which this is said, given the pipes there and back.
  template <class F>
  void close_connections(F which);

  const std::uint16_t target_;
  std::uint16_t port_ = 0;
  int listener_ = -1;
  std::atomic<int> connections_{0};
  std::atomic<bool> frozen_{false};
  std::atomic<bool> over_{false};
  std::atomic<int> cuts_{0};
  /// Two for each connection.
  std::list<Pipe> pipes_;
  std::thread thread_;
};

} // namespace castor::test
