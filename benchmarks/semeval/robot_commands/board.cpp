#include "castor/benchmarks/semeval/robot_commands/board.hpp"

#include <algorithm>
#include <sstream>
#include <utility>

namespace castor::semeval {

namespace {

constexpr std::array<std::pair<char, const char*>, 8> colors = {{{'B', "blue"},
                                                                 {'C', "cyan"},
                                                                 {'X', "gray"},
                                                                 {'G', "green"},
                                                                 {'M', "magenta"},
                                                                 {'R', "red"},
                                                                 {'W', "white"},
                                                                 {'Y', "yellow"}}};

const char* color_of(char letter) {
  for (const auto& [known, name] : colors)
    if (known == letter)
      return name;
  return nullptr;
}

bool is_on_board(const BoardPosition& position) {
  return position.x >= 0 && position.x < board_size && position.y >= 0 && position.y < board_size &&
         position.z >= 0;
}

} // namespace

const Block* Board::at(const BoardPosition& position) const {
  const auto place = std::find_if(blocks.begin(), blocks.end(),
                                  [&](const Block& block) { return block.position == position; });
  return place == blocks.end() ? nullptr : &*place;
}

int Board::height(int x, int y) const {
  int height = 0;
  for (const auto& block : blocks)
    if (block.position.x == x && block.position.y == y)
      height = std::max(height, block.position.z + 1);
  return height;
}

std::optional<Board> parse_board(std::string_view text) {
  Board board;
  std::optional<BoardPosition> closed_gripper;
  std::istringstream lines{std::string(text)};
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    BoardPosition position;
    char letter = 0;
    int kind = 0;
    if (!(words >> position.x))
      continue;
    if (!(words >> position.y >> position.z >> letter) || !is_on_board(position))
      return std::nullopt;
    if (words >> kind) {
      const auto* color = color_of(letter);
      if (color == nullptr || (kind != 1 && kind != 2))
        return std::nullopt;
      board.blocks.push_back({kind == 1 ? "cube" : "prism", color, position});
    } else if (letter == 'C') {
      closed_gripper = position;
    } else if (letter != 'O') {
      return std::nullopt;
    }
  }
  if (closed_gripper)
    if (const auto* held = board.at(*closed_gripper)) {
      board.held = *held;
      board.blocks.erase(board.blocks.begin() + (held - board.blocks.data()));
    }
  return board;
}

} // namespace castor::semeval
