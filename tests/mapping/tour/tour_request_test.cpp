#include "castor/communication/dialogue/dialogue_move.hpp"
#include "castor/communication/lexicon/english_lexicon.hpp"
#include "castor/communication/parsing/parser.hpp"
#include "castor/mapping/tour/tour_request.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <string>

namespace castor::mapping::test {

namespace {

/// What the parser of configs/explorer.cast makes of a sentence.
std::optional<TourRequest> heard(const std::string& sentence) {
  static communication::Parser parser(communication::lexicon_of_files(
    "english.ccg tabletop.words language/rooms.words", CASTOR_CONFIGS));
  const auto readings = parser.readings(sentence);
  EXPECT_FALSE(readings.empty()) << sentence;
  if (readings.empty())
    return std::nullopt;
  communication::DialogueMove move;
  move.content = readings.front();
  move.type = communication::dialogue_move_type(move.content);
  return tour_request(move);
}

TEST(TourRequest, IsADirective) {
  EXPECT_EQ(heard("go to the kitchen"), (TourRequest{TourWish::go, "kitchen"}));
  EXPECT_EQ(heard("go into the living room"), (TourRequest{TourWish::go, "living room"}));
  EXPECT_EQ(heard("drive to the office"), (TourRequest{TourWish::go, "office"}));
  EXPECT_EQ(heard("follow me"), (TourRequest{TourWish::follow, {}}));
  EXPECT_EQ(heard("stop"), (TourRequest{TourWish::stop, {}}));
  EXPECT_EQ(heard("go to the red kitchen"), std::nullopt);
  EXPECT_EQ(heard("this is the kitchen"), std::nullopt);
  EXPECT_EQ(heard("put the ball near the box"), std::nullopt);
  EXPECT_EQ(heard("do not follow me"), std::nullopt);
  EXPECT_EQ(tour_request({}), std::nullopt);
}

TEST(TourRequest, IsRepliedTo) {
  const auto reply = [](const std::string& sentence, bool is_known) {
    return reply_to(heard(sentence), is_known);
  };
  EXPECT_EQ(reply("follow me", true), "I follow you.");
  EXPECT_EQ(reply("stop", true), "I stop.");
  EXPECT_EQ(reply("go to the meeting room", true), "I go to the meeting room.");
  EXPECT_EQ(reply("go to the meeting room", false), "I do not know where the meeting room is.");
  EXPECT_EQ(reply("take the ball", false), "I can not do that.");
}

} // namespace

} // namespace castor::mapping::test
