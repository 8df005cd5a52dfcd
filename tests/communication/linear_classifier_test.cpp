#include "castor/communication/parsing/linear_classifier.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <vector>

/// Classes of sparse vectors.
namespace castor::communication::test {

namespace {

using testing::ElementsAre;
using testing::Gt;
using testing::Lt;
using Features = LinearClassifier::Features;
using Samples = std::vector<LinearClassifier::Sample>;

/// Of two classes for each of the first features, and of a third one for both together.
const Samples samples{{{{0, 1}}, 0},
                      {{{0, 0.8F}, {2, 0.6F}}, 0},
                      {{{1, 1}}, 1},
                      {{{1, 0.8F}, {2, 0.6F}}, 1},
                      {{{0, 0.7F}, {1, 0.7F}}, 2},
                      {{{0, 0.6F}, {1, 0.6F}, {2, 0.5F}}, 2}};

std::size_t likeliest(const std::vector<float>& scores) {
  return static_cast<std::size_t>(std::ranges::max_element(scores) - scores.begin());
}

TEST(LinearClassifier, KnowsWhatItHasSeen) {
  const LinearClassifier classifier{samples, 3, 3};
  for (const auto& sample : samples)
    EXPECT_EQ(likeliest(classifier.scores(sample.features)), sample.label);
}

TEST(LinearClassifier, TellsClassesFromEachOther) {
  const LinearClassifier classifier{samples, 3, 3};
  EXPECT_THAT(classifier.scores(Features{{0, 1}}), ElementsAre(Gt(0.5), Lt(-1), Lt(0.5)));
  EXPECT_THAT(classifier.scores(Features{{1, 1}}), ElementsAre(Lt(-1), Gt(0.5), Lt(0.5)));
}

TEST(LinearClassifier, IsCertainOfNothingWithoutFeatures) {
  const LinearClassifier classifier{samples, 3, 3};
  EXPECT_THAT(classifier.scores({}), ElementsAre(0, 0, 0));
}

TEST(LinearClassifier, IsTheSameForTheSameSamples) {
  const Features asked{{0, 0.5F}, {2, 0.9F}};
  EXPECT_EQ((LinearClassifier{samples, 3, 3}.scores(asked)),
            (LinearClassifier{samples, 3, 3}.scores(asked)));
}

TEST(LinearClassifier, LearnsFromNothing) {
  const LinearClassifier classifier{{}, 0, 2};
  EXPECT_THAT(classifier.scores({}), ElementsAre(0, 0));
}

} // namespace

} // namespace castor::communication::test
