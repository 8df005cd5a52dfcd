#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace castor {

/// Limits on open connections that have not introduced themselves.
struct AdmissionLimits {
  std::size_t all = 64;
  std::size_t per_address = 32;
  /// Time for a connection that has sent nothing.
  std::chrono::milliseconds silent{1000};
  /// Time for any connection.
  std::chrono::milliseconds patience{3000};
};

/// Decides which accepted connections are kept that have not introduced themselves, and whose peers
/// could be anybody. When a limit is reached, silent connections are closed first, those from
/// unknown addresses before those from known ones, and the oldest first.
///
/// Pure: it gets the time, and returns what to close.
class Admission {
public:
  using Time = std::chrono::steady_clock::time_point;
  using Connection = std::int64_t;

  explicit Admission(AdmissionLimits limits = {}) : limits_(limits) {}

  /// A connection was accepted. Returns the one that has to be closed because of it, which may be
  /// the new one; nothing if there is room.
  std::optional<Connection> admit(Connection x, const std::string& address, Time now);

  /// Bytes arrived over a connection.
  void has_sent(Connection x);

  /// A connection was closed or handed over.
  void remove(Connection x) { waiting_.erase(x); }

  /// A peer at this address has introduced itself correctly: the address is known from now on.
  void remember(const std::string& address);

  /// Connections whose time is over.
  std::vector<Connection> late(Time now) const;

  std::size_t size() const { return waiting_.size(); }

private:
  struct Waiting {
    std::string address;
    Time since;
    bool is_silent = true;
  };

  bool is_known(const std::string& address) const;

  AdmissionLimits limits_;
  std::map<Connection, Waiting> waiting_;
  /// Known addresses, the most recent first.
  std::deque<std::string> known_;
};

} // namespace castor
