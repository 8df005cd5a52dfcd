#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace castor::semeval {

/// Number of rows and of columns of a board.
inline constexpr int board_size = 8;

/// A position in cells: x grows towards the robot ("front"), y to its left, z upwards.
struct BoardPosition {
  int x = 0;
  int y = 0;
  int z = 0;

  friend bool operator==(const BoardPosition&, const BoardPosition&) = default;
};

/// A block on the board, or in the gripper.
struct Block {
  /// As in RCL: cube or prism.
  std::string type;
  std::string color;
  BoardPosition position;
};

/// The blocks world of SemEval-2014 task 6: blocks on a board, and a robot's gripper above it.
struct Board {
  std::vector<Block> blocks;
  /// The block that the gripper holds; it is none of `blocks`.
  std::optional<Block> held;

  const Block* at(const BoardPosition& position) const;

  /// Number of blocks stacked there.
  int height(int x, int y) const;
};

/// Parses one layout, lines such as "3 3 0 B 1" (x, y, z, colour, 1 for a cube and 2 for a prism)
/// and "6 5 4 O" (the gripper, open, or C if it holds what is there); nothing if there is any other
/// line.
std::optional<Board> parse_board(std::string_view text);

} // namespace castor::semeval
