#pragma once

#include "castor/planning/symbolic/limits.hpp"
#include "castor/planning/symbolic/task.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace castor::planning {

/// Something that is true at some time in every plan: a fact, or one of several.
struct Landmark {
  /// Indices of facts.
  std::vector<std::uint32_t> facts;
  bool is_goal = false;
  /// Landmarks that are true before this one is true for the first time, or better are.
  std::vector<std::uint32_t> before;
  /// Landmarks that this one is true directly before, for the first time: needed again until then.
  std::vector<std::uint32_t> directly_after;
};

/// Landmarks of the task without deletions (Keyder, Richter and Helmert 2010, for single facts),
/// one of several facts by their first achievers, and reasonable orders between them (Hoffmann,
/// Porteous and Sebastia 2004; Richter and Westphal 2010).
std::vector<Landmark> find_landmarks(const Task& task, LimitWatch& watch);

/// Number of landmarks that are still to be reached, or to be reached again.
class LandmarkCount {
public:
  LandmarkCount(const Task& task, std::vector<Landmark> landmarks);

  std::size_t size() const { return landmarks_.size(); }
  std::size_t words() const { return (landmarks_.size() + 63) / 64; }

  /// Sets the landmarks that are reached in the initial state.
  void begin(const State& state, std::uint64_t* reached) const;

  /// Adds those that are reached in a state, to those on the way to it.
  void progress(const State& state, std::uint64_t* reached) const;

  int evaluate(const State& state, const std::uint64_t* reached) const;

  /// Whether the operator reaches a landmark that nothing has to come before any more.
  bool is_preferred(const TaskOperator& op, const State& state, const std::uint64_t* reached) const;

private:
  bool is_true(const Landmark& landmark, const State& state) const;
  static bool has(const std::uint64_t* reached, std::size_t i) {
    return (reached[i / 64] >> (i % 64) & 1) != 0;
  }
  bool is_next(std::size_t landmark, const std::uint64_t* reached) const;

  const Task& task_;
  std::vector<Landmark> landmarks_;
  std::vector<Fact> facts_;
  /// Landmarks that a fact is one of.
  std::vector<std::vector<std::uint32_t>> of_fact_;
};

} // namespace castor::planning
