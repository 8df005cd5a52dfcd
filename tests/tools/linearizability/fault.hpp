#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace castor::linearizability {

/// What may happen to a node and to the connections that others made to it.
enum class FaultKind : std::uint8_t {
  /// The process is stopped, and goes on later.
  stop,
  /// The process is killed.
  kill,
  /// The process is killed, and another started in its place.
  replace,
  /// All connections end, and are made again.
  cut,
  cut_one,
  /// All connections hang, new ones too.
  freeze,
  /// One connection hangs, until it is given up.
  freeze_one,
  /// What is said to the node, or by it, does not arrive.
  freeze_there,
  freeze_back,
  /// All connections hang, and for some time new ones too; in the end what was said over them
  /// arrives.
  delay,
  /// There is no connection, and none can be made.
  refuse,
};

inline constexpr std::size_t fault_kinds = 11;

struct Fault {
  FaultKind kind = FaultKind::stop;
  std::size_t node = 0;
  std::chrono::milliseconds at{0};
  /// Of those that last.
  std::chrono::milliseconds duration{0};
  /// Of several connections, which.
  std::size_t choice = 0;

  std::chrono::milliseconds end() const;
  /// Of a delay: when new connections do not hang any more.
  std::chrono::milliseconds turn() const;
};

std::string to_string(FaultKind x);
/// "stop of node 2 at 15 ms for 200 ms".
std::string to_string(const Fault& x);

bool kills(FaultKind x);
bool lasts(FaultKind x);

/// Up to four, at most one of which kills, in the order of their beginning.
std::vector<Fault> random_faults(std::mt19937_64& random, std::size_t nodes,
                                 std::chrono::milliseconds longest);

} // namespace castor::linearizability
