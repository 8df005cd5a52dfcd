#include "castor/communication/parsing/feasibility.hpp"
#include "castor/communication/parsing/tokens.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

using namespace castor::communication;

TEST(Feasibility, ClausesThatSaySomethingFails) {
  for (const auto* clause :
       {"that is not possible", "there is no room", "there isn't enough space behind it",
        "the place is occupied", "it doesn't fit there", "you cannot", "you can't reach it",
        "that does not work", "failing that", "it is impossible", "that spot is not free"})
    EXPECT_TRUE(says_it_fails(words_of(clause))) << clause;
  for (const auto* clause : {"the ball is red", "you can", "there is room", "it is not red",
                             "you can not see the ball", "nothing is on the left"})
    EXPECT_FALSE(says_it_fails(words_of(clause))) << clause;
}

TEST(Feasibility, ClausesThatSaySomethingSucceeds) {
  for (const auto* clause : {"you can", "possible", "that is possible", "there is room",
                             "there is enough space for it", "it fits", "you can reach it"})
    EXPECT_TRUE(says_it_succeeds(words_of(clause))) << clause;
  for (const auto* clause : {"the ball is red", "there is no room", "there is room behind the box",
                             "you can see the ball", "it is"})
    EXPECT_FALSE(says_it_succeeds(words_of(clause))) << clause;
}

TEST(Feasibility, SentencesThatSayWhatToDoOtherwiseGoWithTheOneBefore) {
  EXPECT_EQ(sentences_of("Put it on the left. If that is not possible, give it to me.").size(), 1U);
  EXPECT_EQ(sentences_of("If there is room, put it there. If there is not, leave it.").size(), 1U);
  EXPECT_EQ(sentences_of("Put it on the left. If the ball is red, give it to me.").size(), 2U);
}
