// What is answered to what is said of a table, in words.
#include "castor/communication/dialogue/respond.hpp"

#include "castor/communication/dialogue/content.hpp"
#include "castor/communication/dialogue/dialogue_move.hpp"
#include "castor/communication/dialogue/question_context.hpp"
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

  std::string reply_to(const DialogueMove& said, const Antecedents& known = {}) {
    const auto [move, antecedents] = context.complete(said, known);
    static Realiser realiser{english_lexicon()};
    auto response =
      table.known_to([&](SceneKnowledge& scene) { return respond(move, antecedents, scene); });
    relation = response.relation;
    context.note({move, antecedents}, response);
    auto result = response.text;
    for (auto& [content, simpler] : response.sentences) {
      auto words = realiser.realise(content);
      if (!words && !simpler.nominals.empty())
        words = realiser.realise(simpler);
      result += (result.empty() ? "" : " ") + words.value_or("<no words>");
    }
    return result;
  }

  TableScene table;
  RhetoricalRelation relation = RhetoricalRelation::narration;
  QuestionContext context{shared_vocabulary()};
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
  EXPECT_EQ(say("Is there a box behind the thing left of the small box?"),
            "I do not see anything to the left of the small box.");
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
  EXPECT_EQ(say("Are the blue things boxes?"), "Yes.");
  // The grey thing may be a box.
  EXPECT_EQ(say("Are the boxes blue?"), "I do not know.");
  EXPECT_EQ(say("Are all things blue?"), "No.");
  EXPECT_EQ(say("Do you see a ball?"), "Yes.");
}

TEST_F(Responses, Count) {
  // The grey thing may be one, too.
  EXPECT_EQ(say("How many boxes are there?"), "There are at least two boxes.");
  EXPECT_EQ(say("How many blue boxes are there?"), "There are two blue boxes.");
  EXPECT_EQ(say("How many things are behind the ball?"), "There is one thing behind the ball.");
  EXPECT_EQ(say("How many green things do you see?"), "There are no green things.");
  EXPECT_EQ(say("What is the number of blue cubes?"), "There are two blue cubes.");
  EXPECT_EQ(say("Are there more blue things than red things?"), "Yes.");
  EXPECT_EQ(say("Are there fewer blue things than red things?"), "No.");
  EXPECT_EQ(say("Are there more cubes than balls?"), "I do not know.");
  EXPECT_EQ(say("Are there two blue cubes?"), "Yes.");
  EXPECT_EQ(say("Are there at least two cubes?"), "Yes.");
  EXPECT_EQ(say("Are there two cubes?"), "I do not know.");
  EXPECT_EQ(say("Are there four cubes?"), "No.");
  EXPECT_EQ(say("Is the number of red things greater than the number of blue things?"), "No.");
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
  EXPECT_EQ(say("What do you see?"),
            "There is a small red ball, a grey thing, a small blue cube and a large blue cube.");
  // It is rather behind it.
  EXPECT_EQ(say("What is right of the large box?"), "There is a grey thing.");
  EXPECT_EQ(say("What is in front of the large box?"), "There is nothing.");
  EXPECT_EQ(say("Which thing is red?"), "There is a small red ball.");
}

TEST_F(Responses, DoNotGuess) {
  EXPECT_EQ(say("What shape is the grey thing?"), "I do not know.");
  EXPECT_EQ(say("Is the grey thing a ball?"), "I do not know.");
  EXPECT_EQ(say("What colour is the box?"), "Which box do you mean?");
  EXPECT_EQ(relation, RhetoricalRelation::clarification_question);
  EXPECT_EQ(say("Where is the green ball?"), "I do not see a green ball.");
  EXPECT_EQ(say("Is there a mug?"), "I do not see a mug.");
  EXPECT_EQ(say("Where am I?"), "I do not know.");
  EXPECT_EQ(say("Is the old box blue?"), "I do not know what 'old' means here.");
  context = QuestionContext{shared_vocabulary()};
  EXPECT_EQ(say("The red ball."), "What about it?");
  EXPECT_EQ(say("What is at the edge of the table?"), "I do not know.");
}

TEST_F(Responses, SayNoMoreThanThatAThingIsRound) {
  table.put("disc or ball",
            {feature(FeatureKind::colour, "orange"), feature(FeatureKind::shape, "round")}, 0.3,
            0.3);
  EXPECT_EQ(say("What shape is the orange thing?"), "It is round.");
  EXPECT_EQ(say("What is the orange thing?"), "It is an orange round thing.");
  EXPECT_EQ(say("Is the orange thing round?"), "Yes.");
  EXPECT_EQ(say("Is the orange thing a ball?"), "I do not know.");
  EXPECT_EQ(say("Is the orange thing a cube?"), "No.");
  EXPECT_EQ(say("Is the red ball round?"), "Yes.");
}

TEST_F(Responses, SayHowSureTheyAre) {
  table.put("lump",
            {feature(FeatureKind::colour, "yellow"),
             binding::uncertain_feature(FeatureKind::shape, "pyramid", 0.62)},
            -0.5, 0.5);
  EXPECT_EQ(say("What shape is the yellow thing?"), "I think it is a pyramid.");
  EXPECT_EQ(say("What is the yellow thing?"), "I think it is a yellow pyramid.");
  EXPECT_EQ(say("Is the yellow thing a pyramid?"), "I think it is a pyramid.");
  EXPECT_EQ(say("What colour is the pyramid?"), "It is yellow.");
}

TEST_F(Responses, SayHowSureTheyAreOfSizes) {
  // As with a camera that is not calibrated.
  for (auto& [name, word] : {std::pair{"triangle", "small"}, std::pair{"cylinder", "large"}})
    table.put(name,
              {feature(FeatureKind::colour, "yellow"), feature(FeatureKind::shape, name),
               binding::uncertain_feature(FeatureKind::size, word, 0.7)},
              -0.5, 0.5);
  EXPECT_EQ(say("What size is the cylinder?"), "I think it is large.");
  EXPECT_EQ(say("Is the cylinder large?"), "I think it is large.");
  EXPECT_EQ(say("Is the cylinder small?"), "I think it is large.");
  EXPECT_EQ(say("Is the cylinder large or small?"), "I think it is large.");
  EXPECT_EQ(say("The cylinder is small."), "I think it is large.");
  EXPECT_EQ(relation, RhetoricalRelation::correction);
  EXPECT_EQ(say("What is the cylinder?"), "It is a yellow cylinder.");
  // Which of two is larger is known better.
  EXPECT_EQ(say("Is the cylinder larger than the triangle?"), "Yes.");
}

TEST_F(Responses, SayHowSureTheyAreOfColours) {
  table.put("lump",
            {binding::uncertain_feature(FeatureKind::colour, "orange", 0.62),
             feature(FeatureKind::shape, "cylinder")},
            -0.5, 0.5);
  EXPECT_EQ(say("What is the cylinder?"), "I think it is an orange cylinder.");
  EXPECT_EQ(say("Is the cylinder brown?"), "I think it is orange.");
  EXPECT_EQ(say("Is the cylinder brown or orange?"), "I think it is orange.");
}

TEST_F(Responses, NeitherGuessNorDropNegation) {
  EXPECT_EQ(say("Is anything red?"), "Yes.");
  EXPECT_EQ(say("Is a cube red?"), "No.");
  EXPECT_EQ(say("Is a ball red?"), "Yes.");
  EXPECT_EQ(say("Is anything behind the ball?"), "Yes.");
  EXPECT_EQ(say("Which things are not blue?"), "There is a small red ball and a grey thing.");
  EXPECT_EQ(say("How many things are not blue?"), "There are two things.");
  EXPECT_EQ(say("How many red and blue things are there?"), "There are three red and blue things.");
  EXPECT_EQ(say("The ball is not red."), "No, it is red.");
  EXPECT_EQ(say("The ball is not green."), "Ok.");
  EXPECT_EQ(say("There are two blue things."), "Ok.");
  EXPECT_EQ(say("There are three blue things."), "No, there are two blue things.");
  EXPECT_EQ(say("The ball is right of the large box."),
            "No, it is not to the right of the large box.");
  EXPECT_EQ(say("Who are you?"),
            "I am a robot that sees what lies on the table and talks about it.");
  EXPECT_EQ(say("Thanks."), "You are welcome.");
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
  EXPECT_EQ(say("What colour is it?", {{"w4", {"ball"}}}), "It is red.");
  EXPECT_EQ(say("Is it left of the large box?", {{"w2", {"ball"}}}), "Yes.");
  EXPECT_EQ(say("What is left of it?", {{"w5", {"box"}}}), "There is a small red ball.");
  EXPECT_EQ(say("What colour is it?"), "Which thing do you mean?");
}

TEST_F(Responses, UnderstandWhatClarifiesThem) {
  auto reply = [&](const std::string& text) {
    context = QuestionContext{shared_vocabulary()};
    EXPECT_EQ(say("What size is the box?"), "Which box do you mean?");
    return say(text);
  };
  EXPECT_EQ(reply("The large one."), "It is large.");
  EXPECT_EQ(reply("The one behind the ball."), "It is small.");
  EXPECT_EQ(reply("The ball."), "It is small.");
  EXPECT_EQ(reply("The blue one."), "Which blue box do you mean?");
  EXPECT_EQ(reply("The red one."), "I do not see a red box.");
}

TEST_F(Responses, CompleteWhatWasSaidBefore) {
  auto type_after = [&](const char* before, const char* text) {
    const CompleteMove said{move_of(before), {}};
    const auto move = move_of(text);
    context = QuestionContext{shared_vocabulary()};
    context.note(said, table.known_to([&](SceneKnowledge& scene) {
      return respond(said.move, said.antecedents, scene);
    }));
    return context.complete(move, {}).move.type;
  };
  EXPECT_EQ(type_after("The box is a toy.", "The large one."), DialogueMoveType::assertion);
  EXPECT_EQ(type_after("What colour is the box?", "The large one."), DialogueMoveType::question_w);
  EXPECT_EQ(type_after("The ball is a toy.", "The large box."), DialogueMoveType::none);
  EXPECT_EQ(type_after("The box is a toy.", "The ball is red."), DialogueMoveType::assertion);
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
      x.things();
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

Antecedents antecedents(const std::string& text, const std::vector<MoveReferents>& history) {
  return antecedents_in(move_of(text), history, *shared_vocabulary());
}

MoveReferents spoken_of(std::int32_t turn, std::vector<DiscourseReferent> referents) {
  return {{}, turn, true, {}, std::move(referents)};
}

TEST(Salience, IsHighestForWhatWasSpokenOfLast) {
  const std::string question = "What colour is it?";
  std::vector<MoveReferents> history{spoken_of(2, {{"w3", "box", false, {"box"}}}),
                                     spoken_of(1, {{"w3", "ball", false, {"ball"}}})};
  EXPECT_EQ(antecedents(question, history), (Antecedents{{"w4", {"box"}}}));
  history.push_back(spoken_of(3, {{"w2", "cube", false, {"one", "other"}}}));
  EXPECT_EQ(antecedents(question, history), (Antecedents{{"w4", {"box"}}}));
  history.push_back(spoken_of(4, {{"w2", "ball", false, {"ball"}}, {"w3", "box", false, {"box"}}}));
  EXPECT_EQ(antecedents(question, history), (Antecedents{{"w4", {"ball"}}}));
}

TEST(Salience, IsOfOneOrOfSeveral) {
  const std::vector<MoveReferents> history{spoken_of(1, {{"w3", "ball", true, {"balls"}}})};
  EXPECT_EQ(antecedents("What colour is it?", history), Antecedents{});
  EXPECT_EQ(antecedents("What colour are they?", history), (Antecedents{{"w4", {"balls"}}}));
  EXPECT_EQ(antecedents("What colour is it?", {}), Antecedents{});
  // Two things are "they" together.
  EXPECT_EQ(antecedents("What colour are they?", {spoken_of(1, {{"w2", "ball", false, {"ball"}},
                                                                {"w5", "box", false, {"box"}}})}),
            (Antecedents{{"w4", {"ball", "box"}}}));
}

TEST(Salience, DoesNotReachBeyondWhatWasNotUnderstood) {
  auto lost = spoken_of(2, {});
  lost.understood = false;
  EXPECT_EQ(
    antecedents("What colour is it?", {spoken_of(1, {{"w3", "ball", false, {"ball"}}}), lost}),
    Antecedents{});
}

TEST(Salience, TellsOthersFromThoseSpokenOf) {
  const std::vector<MoveReferents> history{
    spoken_of(1, {{"w2", "ball", true, {"one", "other", "third"}}}),
    spoken_of(2, {{"w1", "one", false, {"other"}}})};
  auto found = antecedents("What colour is the other one?", history);
  EXPECT_EQ(found["w6"], (std::vector<std::string>{"other"}));
  EXPECT_EQ(found["w6" + std::string{chosen_from}],
            (std::vector<std::string>{"one", "other", "third"}));
}

} // namespace

} // namespace castor::communication::test
