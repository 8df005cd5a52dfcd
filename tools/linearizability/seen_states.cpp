#include "castor/tools/linearizability/seen_states.hpp"

#include <algorithm>
#include <utility>

namespace castor::linearizability {

namespace {

/// Most histories need fewer; clearing more than that would cost more than searching.
constexpr std::size_t initial_slots = 256;

/// The mixing steps of MurmurHash64A (Appleby), a word at a time.
std::uint64_t hash_of(std::span<const std::uint64_t> key) {
  constexpr std::uint64_t factor = 0xc6a4a7935bd1e995;
  std::uint64_t result = key.size() * factor;
  for (auto word : key) {
    word *= factor;
    word ^= word >> 47;
    result = (result ^ word * factor) * factor;
  }
  result ^= result >> 47;
  result *= factor;
  return result ^ result >> 47;
}

} // namespace

void SeenStates::clear() {
  slots_.assign(initial_slots, {});
  size_ = 0;
  keys_.clear();
}

bool SeenStates::insert(std::span<const std::uint64_t> key) {
  if (size_ * 2 >= slots_.size())
    grow();
  auto hash = hash_of(key);
  auto at = hash & (slots_.size() - 1);
  for (; slots_[at].length != 0; at = (at + 1) & (slots_.size() - 1)) {
    auto& slot = slots_[at];
    if (slot.hash == hash &&
        std::ranges::equal(key, std::span{keys_}.subspan(slot.offset, slot.length)))
      return false;
  }
  slots_[at] = {hash, keys_.size(), key.size()};
  keys_.insert(keys_.end(), key.begin(), key.end());
  ++size_;
  return true;
}

void SeenStates::grow() {
  auto old = std::exchange(slots_, std::vector<Slot>(slots_.size() * 2));
  for (auto& slot : old) {
    if (slot.length == 0)
      continue;
    auto at = slot.hash & (slots_.size() - 1);
    while (slots_[at].length != 0)
      at = (at + 1) & (slots_.size() - 1);
    slots_[at] = slot;
  }
}

} // namespace castor::linearizability
