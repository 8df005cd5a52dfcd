#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <list>
#include <mutex>
#include <thread>
#include <vector>

namespace castor::test {

/// Stands between processes: listens on a port of 127.0.0.1 and passes everything on to another,
/// until told to misbehave.
class Relay {
public:
  explicit Relay(std::uint16_t target);
  Relay(const Relay&) = delete;
  Relay& operator=(const Relay&) = delete;
  ~Relay();

  std::uint16_t port() const { return port_; }

  /// New connections lead to that port from now on.
  void lead_to(std::uint16_t target) { target_ = target; }

  /// How many were accepted so far.
  int connections() const { return connections_; }

  /// How many there are now.
  std::size_t open();

  /// Ends all connections; new ones are taken.
  void cut();

  /// Ends one of the connections, whichever `choice` falls on.
  void cut_one(std::size_t choice);

  /// Passes nothing on, while everybody believes to be connected.
  void freeze(bool on);

  enum class Way : std::uint8_t { there, back };

  /// Passes nothing on in one direction: from those who connect, or to them.
  void freeze(Way way, bool on);

  /// Passes nothing on over one of the present connections, until it ends or all are to go on.
  void freeze_one(std::size_t choice);

  /// Passes nothing on over the present connections, until all are to go on; only over new ones.
  void freeze_present();

  /// Ends all connections, and every new one as soon as it is made.
  void refuse(bool on);

  /// Ends all connections and takes no more.
  void stop();

private:
  /// What goes in one direction.
  struct Pipe {
    int from = -1;
    int to = -1;
    std::vector<char> waiting = {};
  };

  struct Connection {
    std::array<Pipe, 2> pipes;
    bool frozen = false;
    bool ended = false;
  };

  using Connections = std::list<Connection>;

  void run();
  void accept();
  void pass_on(Connection& connection, Pipe& pipe);
  static void close(Connection& connection);
  void close_all();
  Connections::iterator chosen(std::size_t choice);

  std::atomic<std::uint16_t> target_;
  std::uint16_t port_ = 0;
  int listener_ = -1;
  std::atomic<int> connections_{0};
  std::atomic<bool> over_{false};
  std::mutex mutex_;
  /// By direction.
  std::array<bool, 2> frozen_{};
  bool refuses_ = false;
  Connections open_;
  std::thread thread_;
};

} // namespace castor::test
