#include "castor/perception/vision/learning/word_learner.hpp"

#include "castor/base/text_file.hpp"
#include "castor/perception/vision/learning/learned_words_file.hpp"
#include "castor/perception/vision/recognition/regions.hpp"
#include "castor/perception/vision/recognition/shape_classifier.hpp"
#include "castor/perception/vision/tabletop/tabletop_renderer.hpp"
#include "castor/perception/vision/tabletop/tabletop_scene_parser.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

#include <unistd.h>

namespace castor::vision {

namespace {

using Evidence = std::vector<double>;

std::string best(const WordLearner& learner, const std::string& kind, const Evidence& evidence) {
  return learner.name(kind, evidence).front().value;
}

RegionFeatures look_at_one(const std::string& thing) {
  auto text = parse_tabletop_scene(
    "table cloth\ncamera 0 -0.62 0.55 looking-at 0 0 0 fov 42\n" + thing, "test");
  auto regions = find_regions(render(text.scene.at({}), text.scene.camera), &text.scene.camera);
  EXPECT_EQ(regions.size(), 1u) << thing;
  return regions.at(0).roi.features;
}

TEST(WordLearner, KnowsAColourAfterOneExample) {
  WordLearner learner;
  Evidence azure{55, 5, -60};
  EXPECT_EQ(best(learner, "colour", azure), "unknown");
  learner.learn("colour", "Azure", azure);
  EXPECT_EQ(best(learner, "colour", azure), "azure");
  EXPECT_EQ(best(learner, "colour", {57, 2, -56}), "azure");
  EXPECT_EQ(best(learner, "colour", {35, 60, -90}), "unknown");
  EXPECT_EQ(best(learner, "shape", Evidence(24, 0.1)), "unknown");
}

TEST(WordLearner, SeveralExamplesSayHowWideAWordIs) {
  WordLearner narrow;
  WordLearner wide;
  for (double x : {-1.0, 0.0, 1.0}) {
    narrow.learn("colour", "teal", {50 + x, 0, 0});
    wide.learn("colour", "teal", {50 + 20 * x, 0, 0});
  }
  EXPECT_EQ(best(narrow, "colour", {50, 20, 0}), "unknown");
  EXPECT_EQ(best(wide, "colour", {50, 20, 0}), "teal");
}

TEST(WordLearner, TheNearerOfTwoWordsIsTheLikelier) {
  WordLearner learner;
  learner.learn("colour", "azure", {55, 5, -60});
  learner.learn("colour", "navy", {20, 10, -30});
  auto names = learner.name("colour", {54, 4, -58});
  ASSERT_EQ(names.size(), 3u);
  EXPECT_EQ(names.front().value, "azure");
  EXPECT_EQ(names.back().value, "navy");
}

TEST(WordLearner, LearnsFromWhatIsSeen) {
  WordLearner learner;
  auto seen = [](const std::string& kind, const std::string& thing) {
    return WordLearner::evidence(kind, look_at_one(thing));
  };
  learner.learn("colour", "azure", seen("colour", "#0080ff cube at -0.1 0 size 0.07"));
  learner.learn("shape", "gizmo", seen("shape", "red cylinder at -0.1 0 size 0.07 0.10"));
  EXPECT_EQ(best(learner, "colour", seen("colour", "#0080ff disc at 0.1 0.1 size 0.09")), "azure");
  EXPECT_EQ(best(learner, "colour", seen("colour", "blue disc at 0.1 0.1 size 0.09")), "unknown");
  EXPECT_EQ(best(learner, "shape", seen("shape", "green cylinder at 0.1 0.1 size 0.06 0.09")),
            "gizmo");
  EXPECT_EQ(best(learner, "shape", seen("shape", "red sphere at 0.1 0.1 size 0.07")), "unknown");
  EXPECT_EQ(best(learner, "shape", seen("shape", "red square at 0.1 0.1 size 0.07")), "unknown");
}

TEST(WordLearner, RefusesWhatCannotBeLearned) {
  WordLearner learner;
  Evidence colour{50, 0, 0};
  EXPECT_THROW(learner.learn("taste", "sour", colour), std::invalid_argument);
  EXPECT_THROW(learner.learn("colour", "", colour), std::invalid_argument);
  EXPECT_THROW(learner.learn("colour", "light blue", colour), std::invalid_argument);
  EXPECT_THROW(learner.learn("colour", "unknown", colour), std::invalid_argument);
  EXPECT_THROW(learner.learn("colour", "azure", {50, 0}), std::invalid_argument);
  EXPECT_THROW(learner.learn("colour", "azure", {NAN, 0, 0}), std::invalid_argument);
  EXPECT_THROW(learner.learn("colour", "azure", colour, 0), std::invalid_argument);
  EXPECT_THROW(learner.learn("colour", "azure", colour, 1.5), std::invalid_argument);
  EXPECT_TRUE(learner.words().empty());
}

RC_GTEST_PROP(WordLearnerProperties, TheOrderOfTheExamplesDoesNotMatter, ()) {
  struct Example {
    std::string word;
    Evidence evidence;
    double weight;
  };
  std::vector<Example> examples;
  auto count = *rc::gen::inRange(1, 8);
  for (int i = 0; i < count; ++i)
    examples.push_back({*rc::gen::element<std::string>("azure", "teal", "navy"),
                        {*rc::gen::inRange(0, 100) / 1.0, *rc::gen::inRange(-80, 80) / 1.0,
                         *rc::gen::inRange(-80, 80) / 1.0},
                        *rc::gen::inRange(1, 11) / 10.0});
  std::vector<std::size_t> order(examples.size());
  std::iota(order.begin(), order.end(), 0);
  // Any permutation: each place takes one of those that are left.
  for (std::size_t i = 0; i < order.size(); ++i)
    std::swap(order[i], order[*rc::gen::inRange(i, order.size())]);
  WordLearner in_order;
  WordLearner shuffled;
  for (auto& x : examples)
    in_order.learn("colour", x.word, x.evidence, x.weight);
  for (auto i : order)
    shuffled.learn("colour", examples[i].word, examples[i].evidence, examples[i].weight);
  Evidence asked{50, *rc::gen::inRange(-80, 80) / 1.0, *rc::gen::inRange(-80, 80) / 1.0};
  auto share = [&](const WordLearner& learner, const std::string& word) {
    for (auto& x : learner.name("colour", asked))
      if (x.value == word)
        return x.confidence;
    return -1.0;
  };
  for (auto word : {"azure", "teal", "navy", "unknown"})
    RC_ASSERT(std::abs(share(in_order, word) - share(shuffled, word)) < 1e-9);
}

RC_GTEST_PROP(WordLearnerProperties, WhatIsWrittenIsReadAgainExactly, ()) {
  std::vector<LearnedWord> words;
  for (std::string word : {"azure", "gizmo-2", "teal"}) {
    auto kind = word == "gizmo-2" ? "shape" : "colour";
    LearnedWord x{kind, word, *rc::gen::inRange(1, 1000) / 7.0, {}, *rc::gen::inRange(0, 99) / 3.0};
    for (int i = 0; i < (word == "gizmo-2" ? trained_shape_network().hidden : 3); ++i)
      x.mean.push_back(*rc::gen::inRange(-1000000, 1000000) / 13.0);
    words.push_back(x);
  }
  RC_ASSERT(parse_learned_words(to_text(words), "words") == words);
}

TEST(LearnedWordsFile, IsWrittenAndReadAgain) {
  auto folder =
    std::filesystem::temp_directory_path() / ("castor-words-" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  auto file = folder / "words";
  EXPECT_TRUE(load_learned_words(file).empty());
  WordLearner learner;
  learner.learn("colour", "azure", {55, 5.25, -60});
  save_learned_words(file, learner.words());
  learner.learn("colour", "azure", {54, 5, -61});
  save_learned_words(file, learner.words());
  EXPECT_EQ(load_learned_words(file), learner.words());
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator{folder}, {}), 1);
  EXPECT_THROW(save_learned_words(folder / "none" / "words", {}), TextFileError);
  std::filesystem::remove_all(folder);
}

TEST(LearnedWordsFile, RefusesShapesThatAnotherNetworkHasDescribed) {
  LearnedWord gizmo{"shape", "gizmo", 1, {}, 0};
  gizmo.mean.resize(static_cast<std::size_t>(trained_shape_network().hidden));
  const auto text = to_text({{"colour", "azure", 1, {55, 5, -60}, 0}, gizmo});
  EXPECT_EQ(parse_learned_words(text, "my.words").size(), 2u);
  const auto line = "network " + identity(trained_shape_network());
  ASSERT_NE(text.find(line), std::string::npos) << text;
  for (const std::string other : {"network 01234567", "# without a network"}) {
    auto changed = text;
    changed.replace(changed.find(line), line.size(), other);
    try {
      parse_learned_words(changed, "my.words");
      FAIL() << changed;
    } catch (const TextFileError& e) {
      ASSERT_EQ(e.problems().size(), 1u) << e.what();
      EXPECT_NE(e.problems()[0].message.find("another shape network"), std::string::npos);
    }
  }
}

TEST(LearnedWordsFile, TellsOfEveryLineThatIsWrong) {
  const std::vector<std::string> wrong{
    "colour azure",
    "taste sour examples 1 scatter 0 mean 1 2 3",
    "colour teal examples 0 scatter 0 mean 1 2 3",
    "colour teal examples 1 scatter -1 mean 1 2 3",
    "colour teal examples many scatter 0 mean 1 2 3",
    "colour teal examples 1 scatter 0 mean 1 2",
    "shape gizmo examples 1 scatter 0 mean 1 2 3",
    "colour azure examples 1 scatter 0 mean 1 2 3",
  };
  std::string text = "# words\ncolour azure examples 1 scatter 0 mean 1 2 3\n";
  for (auto& line : wrong)
    text += line + "\n";
  try {
    parse_learned_words(text, "my.words");
    FAIL();
  } catch (const TextFileError& e) {
    ASSERT_EQ(e.problems().size(), wrong.size());
    for (std::size_t i = 0; i < wrong.size(); ++i) {
      EXPECT_EQ(e.problems()[i].where.line(), i + 3);
      EXPECT_EQ(e.problems()[i].where.file(), "my.words");
    }
    EXPECT_NE(std::string{e.what()}.find("my.words:3: error: "), std::string::npos) << e.what();
  }
}

} // namespace

} // namespace castor::vision
