#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

namespace castor::faults {

/// A minimal sublist for which a predicate still holds: Zeller and Hildebrandt's ddmin
/// ("Simplifying and isolating failure-inducing input", 2002). The items keep their order. If the
/// search ends within `most_tries`, no single item of the result can be left out.
///
/// @param holds must be true for the whole list
/// @param most_tries limit of calls of `holds`, each of which may run a whole system
template <class T>
std::vector<T> minimise(std::vector<T> items,
                        const std::function<bool(const std::vector<T>&)>& holds,
                        std::size_t most_tries = SIZE_MAX) {
  std::size_t tries = 0;
  auto try_out = [&](const std::vector<T>& x) { return tries++ < most_tries && holds(x); };
  if (try_out({}))
    return {};
  // The items without the `i`th piece, or that piece alone.
  auto part = [&](std::size_t i, std::size_t pieces, bool without) {
    auto begin = items.size() * i / pieces;
    auto end = items.size() * (i + 1) / pieces;
    std::vector<T> result;
    for (std::size_t j = 0; j < items.size(); ++j)
      if ((j >= begin && j < end) != without)
        result.push_back(items[j]);
    return result;
  };
  auto reduce = [&](std::size_t pieces, bool without) {
    for (std::size_t i = 0; i < pieces && tries < most_tries; ++i) {
      if (auto smaller = part(i, pieces, without); try_out(smaller)) {
        items = std::move(smaller);
        return true;
      }
    }
    return false;
  };
  for (std::size_t pieces = 2; items.size() >= 2 && tries < most_tries;) {
    if (reduce(pieces, false))
      pieces = 2;
    else if (pieces > 2 && reduce(pieces, true))
      pieces = std::max<std::size_t>(pieces - 1, 2);
    else if (pieces < items.size())
      pieces = std::min(items.size(), 2 * pieces);
    else
      break;
  }
  return items;
}

} // namespace castor::faults
