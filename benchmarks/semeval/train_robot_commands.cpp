// Learns what the library knows of robot commands from the training commands of SemEval-2014 task
// 6:
//
//   build/release/benchmarks/semeval/train_robot_commands
//
// writes benchmarks/semeval/robot_commands/robot_commands_words.ccg and robot_commands.weights.

#include "castor/benchmarks/semeval/corpus.hpp"
#include "castor/benchmarks/semeval/lexicon_training.hpp"
#include "castor/benchmarks/semeval/weight_training.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <fstream>

int main(int argc, char** argv) {
  using namespace castor;
  CLI::App app{"Learns the lexicon and the weights of robot commands"};
  std::string train_folder = "../shared/data/semeval2014_t6/train_data";
  std::string output = "benchmarks/semeval/robot_commands";
  app.add_option("--train", train_folder, "Folder of the training commands");
  app.add_option("--output", output, "Folder of the lexicon");
  CLI11_PARSE(app, argc, argv);
  try {
    const auto corpus = semeval::read_corpus(train_folder);
    std::vector<const semeval::Command*> commands;
    for (const auto& command : corpus)
      commands.push_back(&command);
    const auto words = semeval::learn_words(commands);
    const auto weights = semeval::learn_weights(semeval::robot_command_lexicon(words), commands);
    const std::string origin = "# Written by train_robot_commands (benchmarks/semeval).\n";
    std::ofstream(output + "/robot_commands_words.ccg") << origin << words;
    std::ofstream(output + "/robot_commands.weights")
      << origin << "# Name, weight if the board is not known, weight if it is.\n"
      << to_string(weights);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}
