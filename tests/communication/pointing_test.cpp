// What somebody means who points at a place on the table.
#include "castor/communication/dialogue/pointing.hpp"

#include "castor/communication/parsing/hybrid_logic.hpp"
#include "castor/tests/communication/table_scene.hpp"
#include "castor/tests/communication/table_talk.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <vector>

namespace castor::communication::test {

namespace {

using namespace std::chrono_literals;
using binding::FeatureKind;
using testing::ElementsAre;
using testing::IsEmpty;

constexpr const char* nothing_there = "I do not see what you point at.";
constexpr const char* which_thing = "Which thing do you mean?";

/// From left to right a red cube, a blue ball, a green cube near it, and far behind a yellow ball.
class PointingAt : public ::testing::Test {
protected:
  PointingAt() {
    put("cube", "red", "cube", -0.3, 0, 0.08);
    put("ball", "blue", "sphere", 0, 0, 0.04);
    put("block", "green", "cube", 0.1, 0, 0.04);
    put("far", "yellow", "sphere", 0, 0.4, 0.04);
  }

  void put(const std::string& id, const std::string& colour, const std::string& shape, double x,
           double y, double size) {
    table.put(id,
              {feature(FeatureKind::colour, colour), feature(FeatureKind::shape, shape),
               feature(FeatureKind::size, size > 0.06 ? "large" : "small"),
               binding::extent_of(size, size, size)},
              x, y);
  }

  void point(double x, double y, bool held = true) { talk.point({x, y, {}, held}); }

  std::string say(const std::string& text) { return talk.say(text).text; }

  /// What "these" are at a place.
  std::vector<std::string> within_reach(const Place& place, double reach) {
    DialogueMove move;
    move.content = parse_logical_form("@w1:thing(these ^ <Number>pl)");
    return table.known_to([&](SceneKnowledge& scene) {
      return antecedents_by_pointing(move, place, {}, scene, reach).at("w1/at");
    });
  }

  TableScene table;
  TableTalk talk{[this](auto& asked) { return table.reply(asked); }};
};

TEST_F(PointingAt, ReachesToTheEdgesOfThings) {
  EXPECT_THAT(within_reach({0, 0}, 0.01), ElementsAre("ball"));
  // The block begins 8 cm, the cube 26 cm from there.
  EXPECT_THAT(within_reach({0, 0}, 0.09), ElementsAre("ball", "block"));
  EXPECT_THAT(within_reach({0, 0}, 0.07), ElementsAre("ball"));
  EXPECT_THAT(within_reach({-0.2, 0}, 0.07), ElementsAre("cube"));
  EXPECT_THAT(within_reach({0.5, 0.5}, 0.1), IsEmpty());
}

TEST_F(PointingAt, MeansTheNearestThingOfTheKindThatIsSaid) {
  point(0, 0);
  EXPECT_EQ(say("What is this?"), "It is a small blue ball.");
  EXPECT_EQ(say("What is that?"), "It is a small blue ball.");
  EXPECT_EQ(say("What colour is this one?"), "It is blue.");
  EXPECT_EQ(say("What colour is this cube?"), "It is green.");
  EXPECT_EQ(say("What colour is the cube here?"), "It is green.");
  EXPECT_EQ(say("What colour is the cube over there?"), "It is green.");
  EXPECT_EQ(say("Is this small thing blue?"), "Yes.");
  EXPECT_EQ(say("What is here?"), "There is a small blue ball and a small green cube.");
  point(-0.3, 0.02);
  EXPECT_EQ(say("What is this?"), "It is a large red cube.");
  EXPECT_EQ(say("What colour is this cube?"), "It is red.");
}

TEST_F(PointingAt, MeansAllWithinReachBySeveral) {
  point(0.05, 0);
  EXPECT_EQ(say("What are these?"), "There is a small blue ball and a small green cube.");
  EXPECT_EQ(say("Are these two things small?"), "Yes.");
  EXPECT_EQ(say("Which of these is green?"), "There is a small green cube.");
  EXPECT_EQ(say("Are these three things small?"), nothing_there);
}

TEST_F(PointingAt, IsAskedAboutIfTwoThingsAreEquallyNear) {
  point(0.05, 0);
  EXPECT_EQ(say("What is this?"), which_thing);
  EXPECT_EQ(say("What colour is this ball?"), "It is blue.");
}

TEST_F(PointingAt, MeansTheSameInQuestionsStatementsAndCommands) {
  point(0, 0);
  EXPECT_EQ(say("Is this a ball?"), "Yes.");
  EXPECT_EQ(say("This is a ball."), "Ok.");
  EXPECT_EQ(say("Is this a cube?"), "No.");
  EXPECT_EQ(say("This is a cube."), "No, it is a small blue ball.");
  EXPECT_EQ(say("This cube is red."), "No, it is green.");
  EXPECT_EQ(say("Take this."), "I can not do that.");
  point(0.5, 0.5);
  for (auto* text : {"What is this?", "Is this a ball?", "This is a ball.", "This ball is blue.",
                     "Take this.", "Take the ball here.", "What are these?"})
    EXPECT_EQ(say(text), nothing_there) << text;
}

TEST_F(PointingAt, IsAnsweredLikeADescription) {
  table.relate("right", "ball", "cube");
  table.relate("left", "cube", "ball");
  auto reply = [this](std::string sentence, const std::string& phrase) {
    TableTalk fresh{[this](auto& asked) { return table.reply(asked); }};
    fresh.point({0.01, 0.01, {}, true});
    return fresh.say(sentence.replace(sentence.find('|'), 1, phrase)).text;
  };
  for (auto* sentence : {"What colour is |?",
                         "What shape is |?",
                         "Where is |?",
                         "Is | blue?",
                         "Is | not blue?",
                         "Is | a cube?",
                         "Is | large or small?",
                         "Is | right of the red cube?",
                         "Is | smaller than the red cube?",
                         "Is | the same colour as the red cube?",
                         "What is left of |?",
                         "Is there anything left of |?",
                         "Which thing is larger than |?",
                         "| is blue.",
                         "| is red.",
                         "| is not blue.",
                         "There is a cube left of |.",
                         "Take |.",
                         "Put | near the red cube.",
                         "Is everything larger than |?"})
    for (auto* phrase : {"this", "that", "this one", "that thing", "this ball", "this blue ball",
                         "the ball here", "that ball over there"})
      EXPECT_EQ(reply(sentence, phrase), reply(sentence, "the blue ball"))
        << sentence << ' ' << phrase;
  // "Here" at the end may be where the cube is.
  for (auto* sentence :
       {"Is the red cube left of |?", "The red cube is left of |.", "The red cube is right of |.",
        "How many things are left of |?", "There are two cubes left of |."})
    for (auto* phrase : {"this", "that", "this one", "that thing", "this ball"})
      EXPECT_EQ(reply(sentence, phrase), reply(sentence, "the blue ball"))
        << sentence << ' ' << phrase;
}

TEST_F(PointingAt, GoesBeforeWhatWasSpokenOf) {
  EXPECT_EQ(say("What colour is the red cube?"), "It is red.");
  point(0, 0);
  EXPECT_EQ(say("What colour is this?"), "It is blue.");
  EXPECT_EQ(say("Is the red cube large?"), "Yes.");
  EXPECT_EQ(say("And this?"), "No, it is small.");
  EXPECT_EQ(say("Is it blue?"), "Yes.");
  point(0.1, 0);
  EXPECT_EQ(say("What is the cube?"), "Which cube do you mean?");
  EXPECT_EQ(say("This one."), "It is a small green cube.");
}

TEST_F(PointingAt, IsNotNeededForWhatWasJustSpokenOf) {
  EXPECT_EQ(say("What is this?"), which_thing);
  EXPECT_EQ(say("Is there a red cube?"), "Yes.");
  EXPECT_EQ(say("Is that large?"), "Yes.");
  EXPECT_EQ(say("Hello."), "Hello.");
  EXPECT_EQ(say("What is this?"), which_thing);
  EXPECT_EQ(say("Take this."), which_thing);
}

TEST_F(PointingAt, IsNotNeededIfAStatementTellsWhatIsMeant) {
  EXPECT_EQ(say("This is a red cube."), "Ok.");
  EXPECT_EQ(say("Hello."), "Hello.");
  EXPECT_EQ(say("This is a cube."), which_thing);
  EXPECT_EQ(say("Hello."), "Hello.");
  EXPECT_EQ(say("This is a pyramid."), which_thing);
}

TEST_F(PointingAt, IsStaleAfterThreeUtterancesAboutOtherThings) {
  point(0, 0, false);
  EXPECT_EQ(say("What is this?"), "It is a small blue ball.");
  say("Hello.");
  say("Is the red cube large?");
  EXPECT_EQ(say("What is this?"), "It is a small blue ball.");
  for (int i = 0; i < 3; ++i)
    say("Hello.");
  EXPECT_EQ(say("What is this?"), which_thing);
  say("Hello.");
  EXPECT_EQ(say("What is this?"), which_thing);
  point(0, 0, false);
  EXPECT_EQ(say("What is this?"), "It is a small blue ball.");
}

TEST_F(PointingAt, IsNeverStaleWhileTheHandIsThere) {
  point(0, 0);
  for (int i = 0; i < 10; ++i)
    say("Hello.");
  EXPECT_EQ(say("What is this?"), "It is a small blue ball.");
}

TEST(PointingLimits, AreOfTimeWhereItIsKnown) {
  const Pointing pointing{0, 0, 1'000'000, {}};
  const PointingUse use{{{"communication", "pointing"}}, 0, false};
  EXPECT_FALSE(is_stale(pointing, use, {}, 61s, {}));
  EXPECT_TRUE(is_stale(pointing, use, {}, 62s, {}));
  EXPECT_FALSE(is_stale({0, 0, 1'000'000, true}, use, {}, 62s, {}));
  EXPECT_FALSE(is_stale({0, 0, {}, {}}, use, {}, 62s, {}));
}

TEST(PointingLimits, CountUtterancesSinceTheLastThatTookItUp) {
  const Pointing pointing{0, 0, {}, {}};
  const PointingUse use{{{"communication", "pointing"}}, 1, false};
  std::vector<MoveReferents> history;
  auto move = [&](std::uint64_t version, bool taken_up) {
    MoveReferents result;
    result.turn = static_cast<std::int32_t>(history.size());
    result.pointing = PointingUse{use.pointing, version, taken_up};
    history.push_back(result);
  };
  for (int i = 0; i < 5; ++i)
    move(0, false);
  EXPECT_FALSE(is_stale(pointing, use, history, {}, {})) << "another gesture was made before";
  move(1, false);
  move(1, false);
  move(1, true);
  move(1, false);
  move(1, false);
  EXPECT_FALSE(is_stale(pointing, use, history, {}, {}));
  move(1, false);
  EXPECT_TRUE(is_stale(pointing, use, history, {}, {}));
}

TEST(PlaceOfText, IsTwoNumbers) {
  const auto place = place_of_text("0.1,-0.25");
  ASSERT_TRUE(place);
  EXPECT_EQ(place->x, 0.1);
  EXPECT_EQ(place->y, -0.25);
  for (auto* text : {"", "0.1", "0.1,", ",0.1", "0.1,0.2,", "0.1;0.2", "a,b", "inf,0", "1,nan"})
    EXPECT_FALSE(place_of_text(text)) << text;
}

} // namespace

} // namespace castor::communication::test
