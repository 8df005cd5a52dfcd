#pragma once

#include "castor/planning/symbolic/task.hpp"

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace castor::planning {

/// Numbers for states, which are stored with as few bits as their variables need.
class StateRegistry {
public:
  explicit StateRegistry(const Task& task);

  /// Number of the state, and whether it is new.
  std::pair<std::uint32_t, bool> add(const State& state);

  void get(std::uint32_t number, State& state) const;

  std::size_t size() const { return count_; }
  std::size_t bytes() const {
    return words_.capacity() * sizeof(std::uint64_t) + slots_.capacity() * sizeof(std::uint32_t);
  }

private:
  struct Field {
    std::uint32_t word = 0;
    std::uint32_t shift = 0;
    std::uint64_t mask = 0;
  };

  std::uint64_t hash(const std::uint64_t* words) const;
  void grow();

  std::vector<Field> fields_;
  std::size_t words_per_state_ = 1;
  std::vector<std::uint64_t> words_;
  std::vector<std::uint64_t> packed_;
  /// Open addressing; number + 1, 0 for empty.
  std::vector<std::uint32_t> slots_;
  std::size_t count_ = 0;
};

} // namespace castor::planning
