// How many commands of SemEval-2014 task 6 are understood: whole trees that equal the annotated
// ones, with the board known and without.

#include "castor/benchmarks/semeval/corpus.hpp"
#include "castor/benchmarks/semeval/lexicon_training.hpp"
#include "castor/benchmarks/semeval/weight_training.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <fstream>

namespace {

using namespace castor;
using semeval::Command;

struct Score {
  int commands = 0;
  int with_board = 0;
  int without_board = 0;
  /// One of the readings is right.
  int among_readings = 0;
  double milliseconds = 0;
  double longest = 0;

  void operator+=(const Score& other) {
    commands += other.commands;
    with_board += other.with_board;
    without_board += other.without_board;
    among_readings += other.among_readings;
    milliseconds += other.milliseconds;
    longest = std::max(longest, other.longest);
  }
};

/// Tries an interpreter on commands, and writes down where it fails.
class Examination {
public:
  explicit Examination(const std::string& failures) {
    if (!failures.empty())
      failures_.open(failures);
  }

  Score examine(semeval::CommandInterpreter& interpreter,
                const std::vector<const Command*>& commands) {
    Score score;
    for (const auto* command : commands) {
      const auto right = to_string(command->tree);
      const auto begin = std::chrono::steady_clock::now();
      const auto readings = interpreter.interpret(command->text, &command->board);
      const std::chrono::duration<double, std::milli> time =
        std::chrono::steady_clock::now() - begin;
      score.milliseconds += time.count();
      score.longest = std::max(score.longest, time.count());
      const auto blind = interpreter.interpret(command->text, nullptr);
      const auto best = readings.empty() ? std::string() : to_string(readings.front().tree);
      const bool is_among = std::any_of(readings.begin(), readings.end(), [&](const auto& reading) {
        return to_string(reading.tree) == right;
      });
      ++score.commands;
      score.with_board += best == right ? 1 : 0;
      score.without_board += !blind.empty() && to_string(blind.front().tree) == right ? 1 : 0;
      score.among_readings += is_among ? 1 : 0;
      if (best != right && failures_.is_open())
        failures_ << command->id << "\t" << command->text << "\n"
                  << (is_among       ? "  misjudged\n"
                      : best.empty() ? "  not parsed\n"
                                     : "  missing\n")
                  << "  wanted " << right << "\n  found  " << best << "\n";
    }
    return score;
  }

private:
  std::ofstream failures_;
};

semeval::CommandInterpreter train(const std::vector<const Command*>& commands) {
  const auto lexicon = semeval::robot_command_lexicon(semeval::learn_words(commands));
  return {lexicon, semeval::learn_weights(lexicon, commands)};
}

void print(const char* what, const Score& score) {
  const auto percent = [&score](int count) { return 100.0 * count / std::max(score.commands, 1); };
  fmt::print(
    "{:8} {:5} commands   with the board {:6.2f} %   without {:6.2f} %   among the readings "
    "{:6.2f} %   {:.2f} ms each, {:.1f} at most\n",
    what, score.commands, percent(score.with_board), percent(score.without_board),
    percent(score.among_readings), score.milliseconds / std::max(score.commands, 1), score.longest);
  std::fflush(stdout);
}

/// The commands whose layout is one of this fold, or those of all others.
std::vector<const Command*> fold_of(const std::vector<Command>& corpus, int fold, int folds,
                                    bool is_in) {
  std::vector<const Command*> chosen;
  for (const auto& command : corpus)
    if ((command.layout % folds == fold) == is_in)
      chosen.push_back(&command);
  return chosen;
}

std::vector<const Command*> all_of(const std::vector<Command>& corpus) {
  return fold_of(corpus, 0, 1, true);
}

} // namespace

int main(int argc, char** argv) {
  CLI::App app{"How many commands of SemEval-2014 task 6 are understood"};
  std::string train_folder = "../shared/data/semeval2014_t6/train_data";
  std::string test_folder;
  std::string failures;
  int folds = 5;
  bool is_shipped = false;
  app.add_option("--train", train_folder, "Folder of the training commands");
  app.add_option("--test", test_folder, "Folder of other commands to try what was learned on");
  app.add_option("--folds", folds, "Cross-validation; commands of one layout share a fold")
    ->check(CLI::Range(2, 100));
  app.add_flag("--shipped", is_shipped, "Try what is part of the library instead of learning");
  app.add_option("--failures", failures, "File to list commands in that were not understood");
  CLI11_PARSE(app, argc, argv);
  try {
    Examination examination(failures);
    if (is_shipped) {
      auto interpreter = semeval::robot_command_interpreter();
      const auto corpus = semeval::read_corpus(test_folder.empty() ? train_folder : test_folder);
      print("test", examination.examine(interpreter, all_of(corpus)));
      return 0;
    }
    const auto corpus = semeval::read_corpus(train_folder);
    if (!test_folder.empty()) {
      auto interpreter = train(all_of(corpus));
      const auto held_out = semeval::read_corpus(test_folder);
      print("test", examination.examine(interpreter, all_of(held_out)));
      return 0;
    }
    Score total;
    for (int fold = 0; fold < folds; ++fold) {
      auto interpreter = train(fold_of(corpus, fold, folds, false));
      const auto score = examination.examine(interpreter, fold_of(corpus, fold, folds, true));
      print(("fold " + std::to_string(fold + 1)).c_str(), score);
      total += score;
    }
    print("all", total);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}
