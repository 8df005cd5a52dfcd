#include "castor/tests/tools/linearizability/fault.hpp"

#include <algorithm>
#include <cmath>

namespace castor::linearizability {

namespace {

constexpr std::size_t most_faults = 4;
constexpr std::size_t latest_ms = 150;
constexpr double shortest_ms = 5;
/// Long enough for connections to be given up and made again, and then for the next to be made and
/// used.
constexpr std::chrono::milliseconds until_turn{200};
constexpr std::chrono::milliseconds from_turn{250};

/// As often short as long.
std::chrono::milliseconds random_duration(std::mt19937_64& random,
                                          std::chrono::milliseconds longest) {
  std::uniform_real_distribution<> exponent{std::log(shortest_ms),
                                            std::log(double(longest.count()))};
  return std::chrono::milliseconds{std::lround(std::exp(exponent(random)))};
}

} // namespace

std::string to_string(FaultKind x) {
  switch (x) {
    case FaultKind::stop:
      return "stop";
    case FaultKind::kill:
      return "kill";
    case FaultKind::replace:
      return "replace";
    case FaultKind::cut:
      return "cut";
    case FaultKind::cut_one:
      return "cut_one";
    case FaultKind::freeze:
      return "freeze";
    case FaultKind::freeze_one:
      return "freeze_one";
    case FaultKind::freeze_there:
      return "freeze_there";
    case FaultKind::freeze_back:
      return "freeze_back";
    case FaultKind::delay:
      return "delay";
    case FaultKind::refuse:
      return "refuse";
  }
  return "?";
}

std::string to_string(const Fault& x) {
  return to_string(x.kind) + " of node " + std::to_string(x.node + 1) + " at " +
         std::to_string(x.at.count()) + " ms" +
         (lasts(x.kind) ? " for " + std::to_string(x.duration.count()) + " ms" : "");
}

std::chrono::milliseconds Fault::turn() const {
  return at + until_turn;
}

std::chrono::milliseconds Fault::end() const {
  if (!lasts(kind))
    return at;
  return (kind == FaultKind::delay ? turn() : at) + duration;
}

bool kills(FaultKind x) {
  return x == FaultKind::kill || x == FaultKind::replace;
}

bool lasts(FaultKind x) {
  return !kills(x) && x != FaultKind::cut && x != FaultKind::cut_one;
}

std::vector<Fault> random_faults(std::mt19937_64& random, std::size_t nodes,
                                 std::chrono::milliseconds longest) {
  std::vector<Fault> result;
  bool killed = false;
  for (auto count = 1 + random() % most_faults; count > 0; --count) {
    Fault x;
    x.kind = FaultKind(random() % fault_kinds);
    x.node = random() % nodes;
    x.at = std::chrono::milliseconds{random() % latest_ms};
    x.duration = random_duration(random, longest);
    if (x.kind == FaultKind::delay)
      x.duration = std::max(x.duration, from_turn);
    x.choice = random();
    if (!(kills(x.kind) && killed))
      result.push_back(x);
    killed = killed || kills(x.kind);
  }
  std::ranges::sort(result, {}, &Fault::at);
  return result;
}

} // namespace castor::linearizability
