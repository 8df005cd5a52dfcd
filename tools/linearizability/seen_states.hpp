#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace castor::linearizability {

/// A set of short sequences of numbers. Keeps its memory when it is cleared.
class SeenStates {
public:
  SeenStates() { clear(); }

  void clear();

  /// False if the key was already in the set.
  bool insert(std::span<const std::uint64_t> key);

private:
  struct Slot {
    std::uint64_t hash = 0;
    /// Position of the key in `keys_`.
    std::size_t offset = 0;
    /// 0 in an empty slot: there is no empty key.
    std::size_t length = 0;
  };

  void grow();

  /// Open addressing, a power of two.
  std::vector<Slot> slots_;
  std::size_t size_ = 0;
  std::vector<std::uint64_t> keys_;
};

} // namespace castor::linearizability
