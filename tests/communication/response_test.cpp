// What is answered to what is said of a table, in words.
#include "castor/communication/dialogue/response.hpp"

#include "castor/communication/dialogue/content.hpp"
#include "castor/communication/dialogue/dialogue_move.hpp"
#include "castor/communication/dialogue/realiser.hpp"
#include "castor/communication/dialogue/referring_expression.hpp"
#include "castor/communication/dialogue/salience.hpp"
#include "castor/communication/lexicon/english_lexicon.hpp"
#include "castor/communication/parsing/hybrid_logic.hpp"
#include "castor/communication/parsing/packing.hpp"
#include "castor/communication/parsing/parser.hpp"
#include "castor/communication/parsing/tokens.hpp"
#include "castor/tests/communication/table_scene.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace castor::communication::test {

namespace {

using binding::Feature;
using binding::FeatureKind;

std::vector<Feature> looks(const std::string& colour, const std::string& shape,
                           const std::string& size) {
  return {feature(FeatureKind::colour, colour), feature(FeatureKind::shape, shape),
          feature(FeatureKind::size, size)};
}

DialogueMove move_of(const std::string& text) {
  static Parser parser{english_lexicon()};
  IncrementalParse parse{parser};
  for (auto& word : words_of(text))
    parse.add(word);
  parse.finish();
  auto form = parse.form();
  EXPECT_TRUE(form.unparsable.empty()) << text;
  DialogueMove move;
  move.content = unpack(form, form.readings.front().id).front();
  move.type = dialogue_move_type(move.content);
  return move;
}

/// A red ball left of a large blue box, a small blue box behind both, and something grey of which
/// nobody knows what it is.
class Responses : public ::testing::Test {
protected:
  Responses() {
    table.put("ball", looks("red", "sphere", "small"), 0, 0);
    table.put("box", looks("blue", "cube", "large"), 0.2, 0);
    table.put("block", looks("blue", "cube", "small"), 0.15, 0.3);
    table.put("blob", {feature(FeatureKind::colour, "grey")}, 0.5, 0.5);
    table.relate("left", "ball", "box");
    table.relate("right", "box", "ball");
    table.relate("back", "block", "box");
    table.relate("back", "block", "ball");
    table.relate("front", "ball", "block");
  }

  std::string say(const std::string& text, const Antecedents& antecedents = {}) {
    return reply_to(move_of(text), antecedents);
  }

  std::string reply_to(const DialogueMove& move, const Antecedents& antecedents = {}) {
    static Realiser realiser{english_lexicon()};
    auto response =
      table.known_to([&](SceneKnowledge& scene) { return respond(move, antecedents, scene); });
    relation = response.relation;
    asked_about = response.asked_about;
    auto result = response.text;
    for (auto& content : response.contents)
      result += (result.empty() ? "" : " ") + realiser.realise(content).value_or("<no words>");
    return result;
  }

  TableScene table;
  RhetoricalRelation relation = RhetoricalRelation::narration;
  std::string asked_about;
};

TEST_F(Responses, TellWhatSomethingIsLike) {
  EXPECT_EQ(say("What colour is the ball?"), "It is red.");
  EXPECT_EQ(say("What is the colour of the large box?"), "It is blue.");
  EXPECT_EQ(say("What shape is the red thing?"), "It is a sphere.");
  EXPECT_EQ(say("How big is the thing left of the large box?"), "It is small.");
  EXPECT_EQ(say("What size is the cube that is behind the ball?"), "It is small.");
  EXPECT_EQ(say("What is the red thing?"), "It is a small red ball.");
  EXPECT_EQ(relation, RhetoricalRelation::answer);
}

TEST_F(Responses, FollowSeveralRelations) {
  EXPECT_EQ(say("What colour is the thing left of the box that is right of the ball?"),
            "It is red.");
  EXPECT_EQ(say("What shape is the thing in front of the small box behind the large box?"),
            "It is a sphere.");
  EXPECT_EQ(say("What shape is the thing that is in front of the box that is behind the ball?"),
            "It is a sphere.");
  EXPECT_EQ(say("How many boxes are behind the thing left of the large box?"),
            "There is one box behind the thing to the left of the large box.");
  EXPECT_EQ(say("How many things are there behind the ball?"),
            "There is one thing behind the ball.");
  EXPECT_EQ(say("Is there a box behind the thing left of the small box?"), "No.");
}

TEST_F(Responses, SayWhereSomethingIs) {
  EXPECT_EQ(say("Where is the ball?"), "It is to the left of the large cube.");
  EXPECT_EQ(say("Where is the small box?"), "It is behind the large cube.");
  EXPECT_EQ(say("Where is the grey thing?"), "It is on the table.");
}

TEST_F(Responses, SayYesAndNo) {
  EXPECT_EQ(say("Is the ball red?"), "Yes.");
  EXPECT_EQ(say("Is the ball blue?"), "No, it is red.");
  EXPECT_EQ(say("Is the red thing left of the large box?"), "Yes.");
  EXPECT_EQ(say("Is the red thing right of the large box?"), "No.");
  EXPECT_EQ(say("Is the red thing a ball?"), "Yes.");
  EXPECT_EQ(say("Is the red thing a box?"), "No.");
  EXPECT_EQ(say("Is there a blue box?"), "Yes.");
  EXPECT_EQ(say("Is there a red box?"), "No.");
  EXPECT_EQ(say("Are there any cubes behind the ball?"), "Yes.");
  EXPECT_EQ(say("Are the boxes blue?"), "Yes.");
  EXPECT_EQ(say("Are all things blue?"), "No.");
  EXPECT_EQ(say("Do you see a ball?"), "Yes.");
}

TEST_F(Responses, Count) {
  EXPECT_EQ(say("How many boxes are there?"), "There are two boxes.");
  EXPECT_EQ(say("How many things are behind the ball?"), "There is one thing behind the ball.");
  EXPECT_EQ(say("How many green things do you see?"), "There are no green things.");
  EXPECT_EQ(say("What is the number of blue cubes?"), "There are two blue cubes.");
  EXPECT_EQ(say("Are there more cubes than balls?"), "Yes.");
  EXPECT_EQ(say("Are there fewer cubes than balls?"), "No.");
  EXPECT_EQ(say("Are there two cubes?"), "Yes.");
  EXPECT_EQ(say("Are there three cubes?"), "No.");
  EXPECT_EQ(say("Is the number of balls greater than the number of cubes?"), "No.");
}

TEST_F(Responses, CompareThings) {
  EXPECT_EQ(say("Is the ball the same size as the large box?"), "No.");
  EXPECT_EQ(say("Is the small box the same colour as the large box?"), "Yes.");
  EXPECT_EQ(say("Do the ball and the small box have the same size?"), "Yes.");
  EXPECT_EQ(say("How many things are the same colour as the small box?"), "There is one thing.");
  EXPECT_EQ(say("Is there another thing that is the same size as the ball?"), "Yes.");
  EXPECT_EQ(say("Is there another thing that is the same colour as the ball?"), "No.");
}

TEST_F(Responses, ListWhatIsThere) {
  EXPECT_THAT(say("What is left of the large box?"), "There is a small red ball.");
  EXPECT_THAT(say("What do you see?"),
              testing::AllOf(testing::HasSubstr("There is a small red ball."),
                             testing::HasSubstr("There is a large blue cube."),
                             testing::HasSubstr("There is a grey thing.")));
  EXPECT_EQ(say("What is right of the large box?"), "There is nothing.");
  EXPECT_EQ(say("Which thing is red?"), "There is a small red ball.");
}

TEST_F(Responses, DoNotGuess) {
  EXPECT_EQ(say("What shape is the grey thing?"), "I do not know.");
  EXPECT_EQ(say("Is the grey thing a ball?"), "I do not know.");
  EXPECT_EQ(say("What colour is the box?"), "Which box do you mean?");
  EXPECT_EQ(relation, RhetoricalRelation::clarification_question);
  EXPECT_EQ(say("Where is the green ball?"), "I do not see a green ball.");
  EXPECT_EQ(say("Is the old box blue?"), "I do not know what 'old' means here.");
  EXPECT_EQ(say("The red ball."), "What about it?");
  EXPECT_EQ(say("What is on the left?"), "I do not know what 'left' means here.");
}

TEST_F(Responses, TakeAssertionsAsTheyAre) {
  EXPECT_EQ(say("This is a red ball."), "Ok.");
  EXPECT_EQ(say("The grey thing is a pyramid."), "Ok.");
  EXPECT_EQ(relation, RhetoricalRelation::acceptance);
  EXPECT_EQ(say("The ball is blue."), "No, it is red.");
  EXPECT_EQ(relation, RhetoricalRelation::correction);
  EXPECT_EQ(say("There is a green ball."), "I do not see a green ball.");
  EXPECT_EQ(say("There is a ball left of the large box."), "Ok.");
}

TEST_F(Responses, KnowWhatPronounsStandFor) {
  EXPECT_EQ(say("What colour is it?", {{"w4", "ball"}}), "It is red.");
  EXPECT_EQ(say("Is it left of the large box?", {{"w2", "ball"}}), "Yes.");
  EXPECT_EQ(say("What is left of it?", {{"w5", "box"}}), "There is a small red ball.");
  EXPECT_EQ(say("What colour is it?"), "Which thing do you mean?");
}

TEST_F(Responses, UnderstandWhatClarifiesThem) {
  const auto question = move_of("What size is the box?");
  ASSERT_EQ(reply_to(question), "Which box do you mean?");
  auto reply = [&](const std::string& text) {
    return reply_to(clarified(question, asked_about, move_of(text).content));
  };
  const auto asked = asked_about;
  EXPECT_EQ(reply("The large one."), "It is large.");
  asked_about = asked;
  EXPECT_EQ(reply("The one behind the ball."), "It is small.");
  asked_about = asked;
  EXPECT_EQ(reply("The ball."), "It is small.");
  asked_about = asked;
  EXPECT_EQ(reply("The blue one."), "Which blue box do you mean?");
  asked_about = asked;
  EXPECT_EQ(reply("The red one."), "I do not see a red box.");
}

TEST_F(Responses, ArePolite) {
  EXPECT_EQ(say("Hello."), "Hello.");
  EXPECT_EQ(say("Good bye."), "Bye.");
  EXPECT_EQ(say("Put the ball near the large box."), "I can not do that.");
  EXPECT_EQ(say("Put the cup near the large box."), "I do not see a cup.");
  EXPECT_EQ(say("Take the box."), "Which box do you mean?");
}

TEST_F(Responses, NameThingsSoThatTheyAreNotMistaken) {
  static Realiser realiser{english_lexicon()};
  auto name = [&](const std::string& id) {
    auto scene = table.known_to([&](SceneKnowledge& x) {
      x.candidates({}, {{{{}}, {}}, {}, {}});
      return x;
    });
    for (auto& thing : scene.things())
      if (scene.proxy_of(thing) == id)
        return realiser.realise(exists(referring_expression(scene, thing))).value_or("<no words>");
    return std::string{"<no such thing>"};
  };
  EXPECT_EQ(name("ball"), "There is the ball.");
  EXPECT_EQ(name("box"), "There is the large cube.");
  EXPECT_EQ(name("block"), "There is the small cube.");
  EXPECT_EQ(name("blob"), "There is the grey thing.");
}

// -- what pronouns stand for

const Nominal it{"w1", "thing", "it", {{"Number", "sg"}}, {}};
const Nominal they{"w1", "thing", "they", {{"Number", "pl"}}, {}};

TEST(Salience, IsHighestForWhatWasSpokenOfLast) {
  std::vector<MoveReferents> history{{{}, 2, {{"w3", "box", false, {"box"}}}},
                                     {{}, 1, {{"w3", "ball", false, {"ball"}}}}};
  EXPECT_EQ(antecedent_of(it, history), "box");
  history.push_back({{}, 3, {{"w2", "cube", false, {"one", "other"}}}});
  EXPECT_EQ(antecedent_of(it, history), "box");
  history.push_back({{}, 4, {{"w2", "ball", false, {"ball"}}, {"w3", "box", false, {"box"}}}});
  EXPECT_EQ(antecedent_of(it, history), "ball");
}

TEST(Salience, IsOfOneOrOfSeveral) {
  const std::vector<MoveReferents> history{{{}, 1, {{"w3", "ball", true, {"balls"}}}}};
  EXPECT_EQ(antecedent_of(it, history), "");
  EXPECT_EQ(antecedent_of(they, history), "balls");
  EXPECT_EQ(antecedent_of(it, {}), "");
}

} // namespace

} // namespace castor::communication::test
