#pragma once

#include "castor/benchmarks/manipulation/random_table.hpp"
#include "castor/planning/manipulation/types.hpp"

#include <cstddef>
#include <cstdint>
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

/// Why no plan was found by the true places of things; empty if there is one. Of several things to
/// be moved, the order is tried in which they are possible.
/// @param arm_file of the arm
std::string why_unsolvable(const TableTask& task, const std::string& arm_file);

} // namespace castor::manipulation
