#pragma once

#include "castor/wm/events/receipts.hpp"

#include <cstdint>
#include <deque>
#include <utility>
#include <vector>

namespace castor::test {

/// Both ends of a flow with receipts, and what is on its way between them, by the numbers of the
/// items. `Arrive` appends the numbers of what the flow lets go to a queue.
template <class Flow, class Number, class Arrive>
class FlowLine {
public:
  explicit FlowLine(std::uint32_t limit) : flow(limit), receipts(limit) {}

  /// The receiver takes one.
  void take() {
    taken.push_back(queue.front());
    queue.pop_front();
    if (auto count = receipts.take())
      acknowledgements.push_back(count);
  }

  /// The sender hears of what was taken.
  void acknowledge() {
    for (auto count : std::exchange(acknowledgements, {}))
      flow.acknowledge(count);
    while (auto next = flow.next())
      arrive_(*next, queue);
  }

  Flow flow;
  Receipts receipts;
  std::deque<Number> queue;
  std::vector<Number> taken;
  std::vector<std::uint32_t> acknowledgements;

protected:
  /// What the flow has let go at once, if anything.
  template <class Sent>
  void send(const Sent& sent) {
    if (sent)
      arrive_(*sent, queue);
  }

private:
  Arrive arrive_;
};

} // namespace castor::test
