#include "castor/benchmarks/semeval/corpus.hpp"
#include "castor/benchmarks/semeval/lexicon_training.hpp"
#include "castor/benchmarks/semeval/weight_training.hpp"

#include <gmock/gmock.h>

#include <filesystem>

using namespace castor;
using testing::HasSubstr;

namespace {

semeval::Command command(const std::string& text, const std::string& tree) {
  return {"1", text, semeval::parse_rcl(tree), {}, 1};
}

std::vector<semeval::Command> examples() {
  return {
    command(
      "take the red box",
      "(event: (action: take (token: 1)) (entity: (color: red (token: 3)) (type: cube (token: "
      "4))))"),
    command("take the box on top of the ball",
            "(event: (action: take (token: 1)) (entity: (type: cube (token: 3)) (spatial-relation: "
            "(relation: above (token: 4 6)) (entity: (type: prism (token: 8))))))"),
    command(
      "move the ball from the box to the red box",
      "(event: (action: move (token: 1)) (entity: (type: prism (token: 3)) (spatial-relation: "
      "(relation: above) (entity: (type: cube (token: 6))))) (destination: (spatial-relation: "
      "(relation: above (token: 7)) (entity: (color: red (token: 9)) (type: cube (token: "
      "10))))))")};
}

std::vector<const semeval::Command*> pointers(const std::vector<semeval::Command>& commands) {
  std::vector<const semeval::Command*> all;
  for (const auto& one : commands)
    all.push_back(&one);
  return all;
}

} // namespace

TEST(LearnedWords, AreWhatTheyWereAnnotatedWith) {
  const auto commands = examples();
  const auto words = semeval::learn_words(pointers(commands));
  EXPECT_THAT(words, HasSubstr("words color\n  red{0.00}\n"));
  EXPECT_THAT(words, HasSubstr("words block\n  ball=prism{0.00}\n  box=cube{0.00}\n"));
  EXPECT_THAT(words, HasSubstr("  on_top_of=above{0.00}\n"));
  EXPECT_THAT(words, HasSubstr("filler the{0.00}\n"));
}

TEST(LearnedWords, SayRelationsThatNothingWasAnnotatedWith) {
  const auto commands = examples();
  EXPECT_THAT(semeval::learn_words(pointers(commands)), HasSubstr("  from=above{0.00}\n"));
}

TEST(LearnedWeights, PreferWhatWasRight) {
  const auto commands = examples();
  const auto all = pointers(commands);
  const auto lexicon = semeval::robot_command_lexicon(semeval::learn_words(all));
  semeval::CommandInterpreter interpreter(lexicon, semeval::learn_weights(lexicon, all));
  for (const auto& example : commands) {
    const auto readings = interpreter.interpret(example.text, nullptr);
    ASSERT_FALSE(readings.empty()) << example.text;
    EXPECT_EQ(to_string(readings.front().tree), to_string(example.tree));
  }
}

TEST(Corpus, SaysWhichFileIsMissing) {
  try {
    semeval::read_corpus("/nonexistent");
    FAIL() << "there is no such folder";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("/nonexistent/configuration.txt"));
  }
}

TEST(Corpus, HasABoardForEveryCommand) {
  const std::filesystem::path folder = CASTOR_SEMEVAL;
  if (!std::filesystem::exists(folder))
    GTEST_SKIP() << "there is no " << folder;
  const auto corpus = semeval::read_corpus(folder / "train_data");
  EXPECT_EQ(corpus.size(), 2500u);
  for (const auto& one : corpus) {
    EXPECT_FALSE(one.board.blocks.empty());
    // Who is told to take something holds nothing, which tells boards before a move from others.
    const auto action = one.tree.value_of("action");
    if (action == "take" || action == "drop") {
      EXPECT_EQ(one.board.held.has_value(), action == "drop") << one.id;
    }
  }
}
