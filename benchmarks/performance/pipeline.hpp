#pragma once

#include <cstddef>
#include <deque>
#include <utility>

namespace castor::benchmark {

/// Begins an operation with each of `xs`, so that at most `in_flight` of them are unfinished, and
/// finishes them in their order.
template <class Range, class Begin, class Finish>
void pipelined(Range& xs, std::size_t in_flight, Begin&& begin, Finish&& finish) {
  std::deque<decltype(begin(*xs.begin()))> pending;
  auto finish_first = [&] {
    finish(pending.front());
    pending.pop_front();
  };
  for (auto& x : xs) {
    if (pending.size() == in_flight)
      finish_first();
    pending.push_back(begin(x));
  }
  while (!pending.empty())
    finish_first();
}

} // namespace castor::benchmark
