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

/// How many connections may be open that have not introduced themselves, and for how long.
struct AdmissionLimits {
  std::size_t all = 64;
  std::size_t per_address = 32;
  /// For one that has said nothing at all.
  std::chrono::milliseconds silent{1000};
  /// For any.
  std::chrono::milliseconds patience{3000};
};

/// Decides which connections are kept that have not introduced themselves: of those that a listener
/// has accepted, and whose peers could be anybody. Where there is no room for another one, the
/// oldest gives way that has said nothing, and strangers give way before those whose address is
/// known.
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

  /// Something came over a connection.
  void has_sent(Connection x);

  /// A connection was closed, or belongs to somebody else now.
  void remove(Connection x) { waiting_.erase(x); }

  /// Whoever connects from there has introduced itself as the protocol has it.
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
  /// The most recent ones first.
  std::deque<std::string> known_;
};

} // namespace castor
