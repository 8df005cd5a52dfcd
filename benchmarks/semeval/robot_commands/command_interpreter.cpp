#include "castor/benchmarks/semeval/robot_commands/command_interpreter.hpp"

#include "castor/benchmarks/semeval/robot_commands/command_trees.hpp"
#include "castor/benchmarks/semeval/robot_commands/command_words.hpp"
#include "castor/communication/parsing/lexicon_reader.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <sstream>
#include <stdexcept>

namespace castor::semeval {

std::string_view robot_commands_text();
std::string_view robot_commands_words_text();
std::string_view robot_commands_weights_text();

namespace {

/// Commands are more ambiguous than other utterances, because every chain of relations is.
communication::ParserOptions parser_options() {
  communication::ParserOptions options;
  options.chart.edges_per_span = 16;
  options.chart.meanings_per_edge = 48;
  options.readings = 128;
  return options;
}

double score(const std::vector<CommandFeature>& features,
             const std::unordered_map<std::string, double>& weights) {
  double sum = 0;
  for (const auto& feature : features)
    if (const auto known = weights.find(feature.name); known != weights.end())
      sum += known->second * feature.value;
  return sum;
}

/// Of a word that is left out because the command makes no sense with it.
constexpr double skipping_weight = -5;

/// The smallest weight that is worth a line.
constexpr double negligible = 0.02;

} // namespace

CommandWeights parse_command_weights(std::string_view text) {
  CommandWeights weights;
  std::istringstream lines{std::string(text)};
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    std::istringstream words(line);
    std::string name;
    double without_board = 0;
    double with_board = 0;
    if (!(words >> name) || name == "#")
      continue;
    if (!(words >> without_board >> with_board))
      throw std::runtime_error("line " + std::to_string(number) +
                               " of the weights has no two numbers after \"" + name + "\"");
    weights.without_board[name] = without_board;
    weights.with_board[name] = with_board;
  }
  return weights;
}

std::string to_string(const CommandWeights& weights) {
  std::map<std::string, std::pair<double, double>> sorted;
  for (const auto& [name, weight] : weights.without_board)
    sorted[name].first = weight;
  for (const auto& [name, weight] : weights.with_board)
    sorted[name].second = weight;
  std::string text;
  for (const auto& [name, weight] : sorted) {
    if (std::abs(weight.first) < negligible && std::abs(weight.second) < negligible)
      continue;
    char numbers[64];
    std::snprintf(numbers, sizeof numbers, " %.2f %.2f\n", weight.first, weight.second);
    text += name + numbers;
  }
  return text;
}

CommandInterpreter::CommandInterpreter(std::shared_ptr<const communication::Lexicon> lexicon,
                                       CommandWeights weights)
  : parser_(std::move(lexicon), parser_options()), weights_(std::move(weights)) {
  // nop
}

std::vector<CommandCandidate> CommandInterpreter::candidates(std::string_view command,
                                                             const Board* board) {
  auto limits = parser_.options().chart;
  const auto words = corrected(command_tokens(command), parser_.lexicon());
  const auto parse = [&] {
    communication::IncrementalParse parsed(parser_, limits);
    for (const auto& word : words)
      parsed.add(word);
    parsed.finish();
    return candidates(parsed, board);
  };
  auto found = parse();
  if (!found.empty())
    return found;
  limits.skipping_weight = skipping_weight;
  return parse();
}

std::vector<CommandCandidate>
CommandInterpreter::candidates(const communication::IncrementalParse& parse,
                               const Board* board) const {
  std::vector<CommandCandidate> found;
  for (const auto* meaning : parse.meanings()) {
    const auto form = logical_form(
      *meaning, [&parse](communication::Symbol symbol) { return parse.chart().text(symbol); });
    for (auto& tree : command_trees(form)) {
      auto features =
        command_features({parse.chart().words(), meaning}, parser_.lexicon(), tree, board);
      found.push_back({std::move(tree), std::move(features)});
    }
  }
  return found;
}

std::vector<CommandReading> CommandInterpreter::interpret(std::string_view command,
                                                          const Board* board) {
  std::map<std::string, CommandReading> readings;
  const auto& weights = board == nullptr ? weights_.without_board : weights_.with_board;
  for (auto& candidate : candidates(command, board)) {
    const double value = score(candidate.features, weights);
    const auto [place, is_new] =
      readings.try_emplace(to_string(candidate.tree), CommandReading{candidate.tree, value});
    if (!is_new)
      place->second.score = std::max(place->second.score, value);
  }
  std::vector<CommandReading> sorted;
  for (auto& [text, reading] : readings)
    sorted.push_back(std::move(reading));
  std::stable_sort(
    sorted.begin(), sorted.end(),
    [](const CommandReading& a, const CommandReading& b) { return a.score > b.score; });
  return sorted;
}

std::shared_ptr<const communication::Lexicon> robot_command_lexicon(std::string_view words) {
  auto read = communication::read_lexicon(
    std::string(robot_commands_text()) + "\n" + std::string(words), "robot_commands.ccg");
  if (!read.problems.empty())
    throw std::runtime_error(render(read.problems.front()));
  return read.lexicon;
}

CommandInterpreter robot_command_interpreter() {
  return {robot_command_lexicon(robot_commands_words_text()),
          parse_command_weights(robot_commands_weights_text())};
}

} // namespace castor::semeval
