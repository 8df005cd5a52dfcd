#include "castor/wm/leases/deadlock_probe.hpp"

#include <algorithm>
#include <iterator>

namespace castor {

namespace {

/// A path this long is taken for no cycle worth the messages.
constexpr std::size_t longest_path = 256;

bool is_younger(const WaitEdge& a, const WaitEdge& b) {
  return a.since != b.since ? a.since > b.since : a.waiter->component > b.waiter->component;
}

} // namespace

ProbeVerdict receive_probe(DeadlockProbe& probe, const WaitEdge& own) {
  auto& path = probe.path;
  auto& first = path.front();
  bool back = *first.waiter == *own.waiter;
  if (back && first.number != own.number)
    return ProbeVerdict::drop;
  if (back && probe.round == 0) {
    // One component of a cycle is enough to break it, and all of them send probes.
    if (std::any_of(path.begin() + 1, path.end(),
                    [&](const WaitEdge& x) { return is_younger(x, own); }))
      return ProbeVerdict::drop;
    probe.round = path.size();
  } else if (back && path.size() == 2 * probe.round) {
    return std::equal(path.begin(), path.begin() + static_cast<std::ptrdiff_t>(probe.round),
                      path.begin() + static_cast<std::ptrdiff_t>(probe.round))
             ? ProbeVerdict::deadlock
             : ProbeVerdict::drop;
  } else if (!back && probe.round == 0 &&
             std::any_of(path.begin(), path.end(),
                         [&](const WaitEdge& x) { return *x.waiter == *own.waiter; })) {
    // A cycle that the sender only waits for: its members will find it.
    return ProbeVerdict::drop;
  }
  if (path.size() >= (probe.round == 0 ? longest_path : 2 * probe.round))
    return ProbeVerdict::drop;
  path.push_back(own);
  return ProbeVerdict::pass_on;
}

std::string cycle_of(const DeadlockProbe& probe) {
  std::string result;
  for (std::size_t i = 0; i < probe.round; ++i) {
    auto& edge = probe.path[i];
    auto& next = probe.path[(i + 1) % probe.round];
    result += (i == 0 ? "" : "; ") + to_string(*edge.waiter) + " " + edge.what +
              (edge.kind == WaitEdge::Kind::owner ? ", served by " : ", leased by ") +
              to_string(*next.waiter);
  }
  return result;
}

} // namespace castor
