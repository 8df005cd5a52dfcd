#include "castor/communication/dialogue/assertion.hpp"
#include "castor/communication/lexicon/english_lexicon.hpp"
#include "castor/communication/parsing/hybrid_logic.hpp"
#include "castor/communication/parsing/parser.hpp"
#include "castor/tests/communication/table_scene.hpp"
#include "castor/tests/communication/table_talk.hpp"

#include <gtest/gtest.h>

#include <string>
#include <utility>

namespace castor::communication::test {

namespace {

using binding::FeatureKind;

Telling told(const std::string& said) {
  static Parser parser{english_lexicon()};
  const auto readings = parser.readings(said);
  EXPECT_FALSE(readings.empty()) << said;
  if (readings.empty())
    return Telling::nothing;
  auto& form = readings.front();
  return telling_of(*find_nominal(form, form.root), form);
}

} // namespace

TEST(Assertions, AreToldOfWhatTheyAreAbout) {
  for (const auto* said : {"The ball is a toy.", "There is a toy.", "This is a toy."})
    EXPECT_EQ(told(said), Telling::of_one) << said;
  for (const auto* said :
       {"Every cube is a toy.", "All cubes are toys.", "Both balls are toys.",
        "The cubes are toys.", "Cubes are toys.", "The ball and the cube are toys.",
        "The ball is a toy and the cube is a gift."})
    EXPECT_EQ(told(said), Telling::of_each) << said;
  for (const auto* said : {"Most balls are toys.", "Two balls are toys.", "No ball is a toy.",
                           "Only the ball is a toy.", "There are three toys.", "There is no toy.",
                           "I do not think that the ball is a toy."})
    EXPECT_EQ(told(said), Telling::nothing) << said;
}

TEST(Assertions, AreAcceptedIfSomethingIsLearnt) {
  TableScene table;
  for (const auto* id : {"one", "two", "three"})
    table.put(id, {feature(FeatureKind::shape, "cube"), feature(FeatureKind::size, "small")}, 0, 0);
  TableTalk talk{[&](auto& asked) { return table.reply(asked); }};
  EXPECT_EQ(talk.say("Every cube is a toy.").text, "Ok.");
  EXPECT_EQ(talk.say("Most cubes are toys.").text, "I do not know whether that is so.");
  EXPECT_EQ(talk.say("Most cubes are small.").text, "Ok.");
  EXPECT_EQ(talk.say("What is this?").text, "Which thing do you mean?");
}

TEST(Assertions, AreQuestionsWithAQuestionMark) {
  TableScene table;
  table.put("one", {feature(FeatureKind::shape, "cube"), feature(FeatureKind::colour, "red")}, 0,
            0);
  table.put("two", {feature(FeatureKind::shape, "sphere"), feature(FeatureKind::colour, "blue")},
            0.3, 0);
  TableTalk talk{[&](auto& asked) { return table.reply(asked); }};
  EXPECT_EQ(talk.say("The cube is red.").text, "Ok.");
  EXPECT_EQ(talk.say("The cube is red?").text, "Yes.");
  EXPECT_EQ(talk.say("The cube is small?").text, "I do not know.");
  EXPECT_EQ(talk.say("There is a green thing?").text, "No.");
  EXPECT_EQ(talk.say("The cube is red and the ball is blue?").text, "Yes.");
  EXPECT_EQ(talk.say("All things are red?").text, "No.");
}

TEST(Assertions, NameThingsThatAreSpokenOfByTheNameLater) {
  TableScene table;
  table.put("one", {feature(FeatureKind::shape, "cylinder"), feature(FeatureKind::colour, "white")},
            0, 0);
  table.put("two", {feature(FeatureKind::shape, "circle"), feature(FeatureKind::colour, "brown")},
            0.3, 0);
  TableTalk talk{[&](auto& asked) { return table.reply(asked); },
                 [&](auto& name, auto features) { table.tell(name, std::move(features)); }};
  EXPECT_EQ(talk.say("What colour is the mug?").text, "I do not see a mug.");
  EXPECT_EQ(talk.say("The mug is large.").text, "I do not see a mug.");
  EXPECT_EQ(talk.say("How many things are there?").text, "There are two things.");
  EXPECT_EQ(talk.say("The cylinder is a mug.").text, "Ok.");
  EXPECT_EQ(talk.say("What colour is the mug?").text, "It is white.");
  EXPECT_EQ(talk.say("The mug is red.").text, "No, it is white.");
  EXPECT_EQ(talk.say("The disc is called a plate.").text, "Ok.");
  EXPECT_EQ(talk.say("What colour is the plate?").text, "It is brown.");
}

TEST(Assertions, AreToldOnceTheyAreClarified) {
  TableScene table;
  auto put = [&table](const char* id, const char* shape, const char* size) {
    table.put(id,
              {feature(FeatureKind::shape, shape), feature(FeatureKind::size, size),
               feature(FeatureKind::colour, "red")},
              0, 0);
  };
  put("one", "sphere", "small");
  put("two", "cube", "small");
  put("three", "cube", "large");
  auto new_talk = [&table](const std::string& who) {
    return TableTalk{
      [&table](auto& asked) { return table.reply(asked); },
      [&table, who](auto& name, auto features) { table.tell(who + name, std::move(features)); }};
  };
  auto talk = new_talk("first");
  EXPECT_EQ(talk.say("This is a toy.").text, "Which thing do you mean?");
  EXPECT_EQ(talk.say("The ball.").text, "Ok.");
  EXPECT_EQ(talk.say("What shape is the toy?").text, "It is a sphere.");
  // "This" would be what was spoken of last.
  talk = new_talk("second");
  EXPECT_EQ(talk.say("This is a plate.").text, "Which thing do you mean?");
  EXPECT_EQ(talk.say("The large one.").text, "Ok.");
  EXPECT_EQ(talk.say("What shape is the plate?").text, "It is a cube.");
  EXPECT_EQ(talk.say("The cube is a mug.").text, "Which cube do you mean?");
  EXPECT_EQ(talk.say("The small one.").text, "Ok.");
  EXPECT_EQ(talk.say("What size is the mug?").text, "It is small.");
  EXPECT_EQ(talk.say("The cube is green.").text, "Which cube do you mean?");
  EXPECT_EQ(talk.say("The large one.").text, "No, it is red.");
  EXPECT_EQ(talk.say("Is the large cube green?").text, "No, it is red.");
}

TEST(Assertions, OfWhatAThingIsNotTellNothingElse) {
  TableScene table;
  table.put("one", {feature(FeatureKind::shape, "cube")}, 0, 0);
  TableTalk talk{[&](auto& asked) { return table.reply(asked); },
                 [&](auto& name, auto features) { table.tell(name, std::move(features)); }};
  EXPECT_EQ(talk.say("The cube is not a mug.").text, "Ok.");
  EXPECT_EQ(talk.say("Is the cube a mug?").text, "No.");
  EXPECT_EQ(talk.say("Is the cube a toy?").text, "I do not know.");
}

TEST(Fragments, AreNotSaidOfWhatTheyExclude) {
  TableScene table;
  for (const auto* id : {"one", "two", "three"})
    table.put(id,
              {feature(FeatureKind::shape, id[0] == 'o' ? "sphere" : "cube"),
               feature(FeatureKind::colour, id[1] == 'w' ? "red" : "white"),
               feature(FeatureKind::size, "small")},
              0, 0);
  TableTalk talk{[&](auto& asked) { return table.reply(asked); }};
  EXPECT_EQ(talk.say("How many things are white?").text, "There are two white things.");
  EXPECT_EQ(talk.say("And red ones?").text, "There is one red thing.");
  EXPECT_EQ(talk.say("How many things are cubes?").text, "There are two things.");
  EXPECT_EQ(talk.say("And balls?").text, "There is one thing.");
}

} // namespace castor::communication::test
