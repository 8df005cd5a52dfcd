#pragma once

#include "castor/benchmarks/manipulation/random_table.hpp"
#include "castor/planning/manipulation/types.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

/// What people ask to do with the things of a random table, and whether it is so then.
namespace castor::manipulation {

enum class TaskKind { put, take, sort, clear, swap };

inline constexpr const char* task_kinds[] = {"put", "take", "sort", "clear", "swap"};

struct TableTask {
  TaskKind kind = TaskKind::put;
  std::vector<RandomThing> things;
  /// Said to the robot. It is about the first thing, of `put` and `swap` also about the second.
  std::string sentence;
  /// left, right, front, back or near of `put`, left or right of `clear`.
  std::string relation;
};

/// Of each kind one in five seeds. There is something to do in any case.
TableTask random_table_task(std::uint64_t seed);

/// Why it is not so by the true places of things, in the table's frame; empty if it is so.
std::string what_is_wrong(const TableTask& task, const std::vector<TrueThing>& things);

/// A joint that does not move any more.
struct StillJoint {
  /// Of those that move, from the base on.
  std::size_t index = 0;
  /// Radians.
  double at = 0;
};

/// Why no plan was found by the true places of things, neither from the table as it was nor as it
/// is now; empty if there is one. Of several things to be moved, the order is tried in which they
/// are possible, of two that change places both orders, with up to 20 places between. One thing
/// that is in the way is moved before, if the task is about it, too.
/// @param arm_file of the arm
/// @param still no plan needs this joint
/// @param now true places; empty, or if not all stand on the table: does not count
std::string why_unsolvable(const TableTask& task, const std::string& arm_file,
                           const std::optional<StillJoint>& still = {},
                           const std::vector<TrueThing>& now = {});

} // namespace castor::manipulation
