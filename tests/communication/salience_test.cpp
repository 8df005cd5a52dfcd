#include "castor/communication/dialogue/salience.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace castor::communication {

namespace {

using testing::ElementsAre;
using testing::IsEmpty;

MoveReferents request() {
  MoveReferents result;
  result.referents = {{"w1", "cube", false, {"red", "green"}}, {"w4", "ball", false, {"blue"}}};
  return result;
}

} // namespace

TEST(Salience, WhatWasChosenOfSeveralWasSpokenOf) {
  auto move = request();
  note_chosen(move, {"green"});
  ASSERT_EQ(move.referents.size(), 3U);
  EXPECT_THAT(move.referents[0].proxies, ElementsAre("green"));
  EXPECT_FALSE(move.referents[0].is_plural);
  EXPECT_THAT(move.referents[1].proxies, ElementsAre("blue"));
  // From which it was chosen, for "the other one".
  EXPECT_THAT(move.referents[2].proxies, ElementsAre("red", "green"));
  EXPECT_TRUE(move.referents[2].is_plural);
}

TEST(Salience, WhatIsChosenAnewTakesItsPlaceOnce) {
  auto move = request();
  note_chosen(move, {"green"});
  const auto chosen = move.referents;
  note_chosen(move, {"blue"});
  EXPECT_EQ(move.referents, chosen);
  note_chosen(move, {});
  EXPECT_EQ(move.referents, chosen);
}

TEST(Salience, WhatWasNotLeftOpenStays) {
  auto move = request();
  const auto before = move.referents;
  note_chosen(move, {"yellow"});
  note_chosen(move, {"red", "green"});
  EXPECT_EQ(move.referents, before);
}

TEST(Salience, ThingsThatWereMovedAreKnownByOtherProxies) {
  auto move = request();
  rename(move, {{"red", "red 2"}, {"yellow", "yellow 2"}});
  EXPECT_THAT(move.referents[0].proxies, ElementsAre("red 2", "green"));
  Antecedents antecedents{{"w1", {"red"}}, {"w2", {}}};
  rename(antecedents, {{"red", "red 2"}});
  EXPECT_THAT(antecedents["w1"], ElementsAre("red 2"));
  EXPECT_THAT(antecedents["w2"], IsEmpty());
}

} // namespace castor::communication
