#include "castor/benchmarks/semeval/corpus.hpp"

#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>

namespace castor::semeval {

namespace {

/// A layout has five configurations, and eight scenes: of moves from the first to each other one,
/// and back.
constexpr int scenes_per_layout = 8;

std::ifstream open(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in)
    throw std::runtime_error("cannot read " + file.string());
  return in;
}

[[noreturn]] void fail(const std::filesystem::path& file, int line, const std::string& message) {
  throw std::runtime_error(file.string() + ":" + std::to_string(line) + ": " + message);
}

/// By layout and configuration, both counted from 1.
std::map<std::pair<int, int>, Board> read_boards(const std::filesystem::path& file) {
  auto in = open(file);
  std::map<std::pair<int, int>, Board> boards;
  std::string block;
  int number = 0;
  const auto end_block = [&] {
    std::istringstream head(block);
    std::pair<int, int> key;
    if (!(head >> key.first >> key.second))
      return;
    const auto board = parse_board(block.substr(block.find('\n') + 1));
    if (!board)
      fail(file, number, "the layout before this line is none");
    boards[key] = *board;
    block.clear();
  };
  for (std::string line; std::getline(in, line);) {
    ++number;
    if (line.find_first_not_of(" \t\r") == std::string::npos)
      end_block();
    else
      block += line + "\n";
  }
  end_block();
  return boards;
}

std::map<std::string, RclTree> read_trees(const std::filesystem::path& file) {
  auto in = open(file);
  std::map<std::string, RclTree> trees;
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    const auto first = line.find('\t');
    const auto second = line.find('\t', first + 1);
    if (second == std::string::npos)
      continue;
    try {
      trees[line.substr(0, first)] = parse_rcl(line.substr(second + 1));
    } catch (const RclError& error) {
      fail(file, number, error.what());
    }
  }
  return trees;
}

} // namespace

std::vector<Command> read_corpus(const std::filesystem::path& folder) {
  const auto boards = read_boards(folder / "configuration.txt");
  auto trees = read_trees(folder / "annotation.txt");
  const auto file = folder / "commands.txt";
  auto in = open(file);
  std::vector<Command> commands;
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    std::istringstream words(line);
    Command command;
    int scene = 0;
    if (!(words >> command.id >> scene) || scene < 1)
      continue;
    std::getline(words >> std::ws, command.text);
    command.layout = (scene - 1) / scenes_per_layout + 1;
    const int move = (scene - 1) % scenes_per_layout;
    const int configuration = move % 2 == 0 ? 1 : move / 2 + 2;
    const auto board = boards.find({command.layout, configuration});
    const auto tree = trees.find(command.id);
    if (board == boards.end())
      fail(file, number, "there is no layout of scene " + std::to_string(scene));
    if (tree == trees.end())
      fail(file, number, "command " + command.id + " has no annotation");
    command.board = board->second;
    command.tree = std::move(tree->second);
    commands.push_back(std::move(command));
  }
  return commands;
}

} // namespace castor::semeval
