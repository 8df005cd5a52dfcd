// Robots that talk about other things than a table, with words and concepts of their own.

#include "castor/communication/dialogue/dialogue_move.hpp"
#include "castor/communication/dialogue/presence.hpp"
#include "castor/communication/parsing/parser.hpp"
#include "castor/tests/binding/proxies.hpp"
#include "castor/tests/communication/told_world.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace castor::communication::test {

namespace {

using binding::FeatureKind;
using binding::test::concept_of;

constexpr auto words_of_rooms = R"(
nouns Thing
  kitchen office pantry room place

words IsThere
  do_you_know
)";

constexpr auto concepts_of_rooms = R"(
concept pantry: room
concept ball: thing with shape sphere
)";

/// A kitchen with a red ball, and another room, with the robot in it.
struct Rooms : ::testing::Test {
  Rooms() : world(words_of_rooms, concepts_of_rooms) {
    world.put("kitchen", {concept_of("room"), concept_of("kitchen")});
    world.put("room 2", {concept_of("room")});
    world.put("robot", {concept_of("self")});
    world.put("ball", {concept_of("thing"), feature(FeatureKind::shape, "sphere"),
                       feature(FeatureKind::colour, "red")});
    world.relate("in", "robot", "room 2");
    world.relate("in", "ball", "kitchen");
    world.know("room");
    world.know("self");
    world.know("thing");
  }

  ToldWorld world;
};

} // namespace

TEST_F(Rooms, AreAskedFor) {
  auto talk = world.talk();
  EXPECT_EQ(talk.say("How many rooms are there?").text, "There are two rooms.");
  EXPECT_EQ(talk.say("Which rooms are there?").text, "There is a kitchen and a room.");
  EXPECT_EQ(talk.say("Is there a kitchen?").text, "Yes.");
  EXPECT_EQ(talk.say("Is there a pantry?").text, "I do not see a pantry.");
  EXPECT_EQ(talk.say("Is the kitchen a room?").text, "Yes.");
  EXPECT_EQ(talk.say("Is the kitchen an office?").text, "No.");
  EXPECT_EQ(talk.say("Is the ball a room?").text, "No.");
  EXPECT_EQ(talk.say("Is the kitchen a thing?").text, "No.");
}

TEST_F(Rooms, AreNoThings) {
  auto talk = world.talk();
  EXPECT_EQ(talk.say("What do you see?").text, "There is a red ball.");
  EXPECT_EQ(talk.say("How many things are there?").text, "There is one thing.");
  EXPECT_EQ(talk.say("Where is the kitchen?").text, "I do not know.");
  EXPECT_EQ(talk.say("Is the kitchen left of the ball?").text, "No.");
}

TEST_F(Rooms, AreWhereTheRobotAndThingsAre) {
  auto talk = world.talk();
  EXPECT_EQ(talk.say("Where is the ball?").text, "It is in the kitchen.");
  EXPECT_EQ(talk.say("Is the ball in the kitchen?").text, "Yes.");
  EXPECT_EQ(talk.say("Are you in the kitchen?").text, "No.");
  EXPECT_EQ(talk.say("What is in the kitchen?").text, "There is a red ball.");
  EXPECT_EQ(talk.say("What is in this room?").text, "There is nothing.");
  EXPECT_EQ(talk.say("Is this the kitchen?").text, "No.");
  EXPECT_EQ(talk.say("What is this room?").text, "It is a room.");
  EXPECT_EQ(talk.say("What room is this?").text, "It is a room.");
  EXPECT_EQ(talk.say("Which room are you in?").text, "I am in a room.");
  EXPECT_EQ(talk.say("Which room is the ball in?").text, "It is in the kitchen.");
  EXPECT_EQ(talk.say("Is the ball here?").text, "No.");
  EXPECT_EQ(talk.say("What is here?").text, "There is nothing.");
}

TEST_F(Rooms, MayBeWhatTheyAreNotKnownToBe) {
  auto talk = world.talk();
  EXPECT_EQ(talk.say("Are you in the office?").text, "I do not know.");
  EXPECT_EQ(talk.say("Is this the office?").text, "I do not know.");
  EXPECT_EQ(talk.say("Where is the office?").text, "I do not know.");
  EXPECT_EQ(talk.say("Is this an office?").text, "I do not know.");
}

TEST_F(Rooms, AreNamedByPeople) {
  auto talk = world.talk();
  EXPECT_EQ(talk.say("This is the office.").text, "Ok.");
  EXPECT_EQ(talk.say("Where is the office?").text, "It is here.");
  EXPECT_EQ(talk.say("What is this room?").text, "It is an office.");
  EXPECT_EQ(talk.say("Where are you?").text, "I am in the office.");
  EXPECT_EQ(talk.say("Which room are you in?").text, "I am in the office.");
  EXPECT_EQ(talk.say("Are you in the office?").text, "Yes.");
  EXPECT_EQ(talk.say("Is the ball in the office?").text, "No.");
  EXPECT_EQ(talk.say("Is this the office?").text, "Yes.");
  EXPECT_EQ(talk.say("This is the kitchen.").text, "No, it is an office.");
}

TEST_F(Rooms, AreWhereWhoTalksIs) {
  auto talk = world.talk();
  EXPECT_EQ(talk.say("Where are we?").text, "We are in a room.");
  EXPECT_EQ(talk.say("Where am I?").text, "You are in a room.");
  EXPECT_EQ(talk.say("Are we in the kitchen?").text, "No.");
  EXPECT_EQ(talk.say("Is this the kitchen or the office?").text, "I do not know.");
  EXPECT_EQ(talk.say("We are in the office.").text, "Ok.");
  EXPECT_EQ(talk.say("What room are we in?").text, "We are in the office.");
  EXPECT_EQ(talk.say("Is this the kitchen or the office?").text, "It is the office.");
  EXPECT_EQ(talk.say("What is this place?").text, "It is an office.");
  EXPECT_EQ(talk.say("What is this room called?").text, "It is an office.");
  EXPECT_EQ(talk.say("What's the name of this room?").text, "It is an office.");
  EXPECT_EQ(talk.say("Which rooms do you know?").text, "There is a kitchen and an office.");
}

TEST(OtherWorlds, MayHaveNothingButRooms) {
  ToldWorld world(words_of_rooms, concepts_of_rooms);
  world.put("office", {concept_of("room"), concept_of("office")});
  world.put("robot", {concept_of("self")});
  world.relate("in", "robot", "office");
  world.relate("near", "office", "corridor");
  world.relate("near", "corridor", "office");
  world.put("corridor", {concept_of("room"), concept_of("corridor")});
  world.know("room");
  world.know("self");
  auto talk = world.talk();
  EXPECT_EQ(talk.say("What is this?").text, "It is an office.");
  EXPECT_EQ(talk.say("Where is the corridor?").text, "It is near the office.");
  EXPECT_EQ(talk.say("Is the corridor next to the office?").text, "Yes.");
  EXPECT_EQ(talk.say("The corridor is here.").text, "No, it is an office.");
}

/// Somebody takes note of what rooms are called.
struct NamedRooms : Rooms {
  NamedRooms() { world.learn_names_of("room"); }

  std::optional<NameTold> heard(const std::string& sentence) {
    const auto& words = world.words();
    Parser parser{words->lexicon()};
    const auto readings = parser.readings(sentence);
    EXPECT_FALSE(readings.empty()) << sentence;
    if (readings.empty())
      return std::nullopt;
    DialogueMove move;
    move.content = readings.front();
    move.type = dialogue_move_type(move.content);
    if (move.type != DialogueMoveType::assertion)
      return std::nullopt;
    move = with_names_told(std::move(move), *words);
    return with_knowledge(
      words, [this](auto& request) { return world.reply(request); },
      [&](SceneKnowledge& scene) { return name_told(move.content, scene); });
  }
};

TEST_F(NamedRooms, AreToldOf) {
  for (auto* sentence :
       {"this is the office", "this room is the office", "this room is an office",
        "this is my office", "we are in the office", "you are in the office now",
        "I am in the office", "now we are in the office", "the office is here",
        "that is the office", "this room is called the office", "we call this room the office"})
    EXPECT_EQ(heard(sentence), (NameTold{"world", "office"})) << sentence;
}

TEST_F(NamedRooms, AreNotToldOfByWhatIsDeniedOrAskedOrElsewhere) {
  for (auto* sentence :
       {"this is not the office", "is this the office", "what is this", "this is the red office",
        "the ball is in the office", "this is red", "we are not in the office",
        "these are the rooms", "this is a room", "this is a ball", "we are in this room"})
    EXPECT_EQ(heard(sentence), std::nullopt) << sentence;
}

TEST_F(NamedRooms, AreNamesThatBindingIsNotTold) {
  auto talk = world.talk();
  EXPECT_EQ(talk.say("This is the office.").text, "Ok.");
  // Nobody has taken note of it.
  EXPECT_EQ(talk.say("Where are you?").text, "I am in a room.");
}

TEST(OtherWorlds, AreSaidNotToBeKnown) {
  ToldWorld world("", "");
  world.put("cup", {concept_of("thing"), concept_of("cup")});
  world.know("thing");
  auto talk = world.talk();
  EXPECT_EQ(talk.say("Which rooms are there?").text, "I know nothing of rooms.");
  EXPECT_EQ(talk.say("Where is the kitchen?").text, "I know nothing of rooms.");
  EXPECT_EQ(talk.say("How many rooms are there?").text, "I know nothing of rooms.");
  EXPECT_EQ(talk.say("Where are you?").text, "I do not know.");
}

TEST(OtherWorlds, MayHaveThingsThatNobodyKnowsTheKindOf) {
  ToldWorld world("nouns Thing\n  aquarium\n", "");
  world.put("ball", {concept_of("thing"), concept_of("cup")});
  world.put("aquarium", {concept_of("aquarium")});
  world.relate("left", "ball", "aquarium");
  world.know("thing");
  auto talk = world.talk();
  EXPECT_EQ(talk.say("Is there an aquarium?").text, "Yes.");
  EXPECT_EQ(talk.say("Where is the aquarium?").text, "I do not know.");
  EXPECT_EQ(talk.say("What do you see?").text, "There is a cup.");
}

TEST(OtherWorlds, HaveContainersAndPlacesOfTheirOwn) {
  // A warehouse: shelves with boxes in them, and aisles.
  ToldWorld world(R"(
nouns Thing
  shelf/shelves box aisle pallet
relation in
)",
                  R"(
concept aisle: place
concept shelf box pallet: thing
partition thing
partition place
)");
  world.put("shelf 1", {concept_of("shelf"), feature(FeatureKind::colour, "blue")});
  world.put("shelf 2", {concept_of("shelf"), feature(FeatureKind::colour, "green")});
  world.put("box 1", {concept_of("box"), feature(FeatureKind::colour, "red")});
  world.put("box 2", {concept_of("box"), feature(FeatureKind::colour, "white")});
  world.put("aisle", {concept_of("aisle")});
  world.put("robot", {concept_of("self")});
  world.relate("in", "box 1", "shelf 1");
  world.relate("in", "box 2", "shelf 1");
  world.relate("in", "robot", "aisle");
  world.relate("in", "shelf 2", "aisle");
  world.know("thing");
  world.know("place");
  world.know("self");
  auto talk = world.talk();
  EXPECT_EQ(talk.say("How many shelves are there?").text, "There are two shelves.");
  EXPECT_EQ(talk.say("How many boxes are in the blue shelf?").text,
            "There are two boxes in the blue shelf.");
  EXPECT_EQ(talk.say("Is there a red box in the green shelf?").text, "No.");
  EXPECT_EQ(talk.say("Where is the red box?").text, "It is in the blue shelf.");
  EXPECT_EQ(talk.say("Where are you?").text, "I am in the aisle.");
  EXPECT_EQ(talk.say("What is in this aisle?").text, "There is a green shelf.");
  EXPECT_EQ(talk.say("What is in the blue shelf?").text, "There is a red box and a white box.");
  EXPECT_EQ(talk.say("What colour is the shelf in this aisle?").text, "It is green.");
  EXPECT_EQ(talk.say("Is there a pallet?").text, "No.");
}

TEST(OtherWorlds, MayBeGardens) {
  ToldWorld world(R"(
nouns Thing
  plant rose fern flowerbed=bed
look tall size large
)",
                  R"(
concept plant: thing
concept rose fern: plant
concept bed: place
concept seedling: plant with size small
)");
  world.put("rose", {concept_of("rose"), feature(FeatureKind::colour, "red")});
  world.put("fern", {concept_of("fern"), feature(FeatureKind::colour, "green")});
  world.put("bed", {concept_of("bed")});
  world.relate("in", "rose", "bed");
  world.know("plant");
  world.know("place");
  auto talk = world.talk();
  EXPECT_EQ(talk.say("How many plants are there?").text, "There are two plants.");
  EXPECT_EQ(talk.say("What colour is the rose?").text, "It is red.");
  EXPECT_EQ(talk.say("Is the rose a plant?").text, "Yes.");
  EXPECT_EQ(talk.say("Where is the rose?").text, "It is in the bed.");
  EXPECT_EQ(talk.say("Is the fern in the flowerbed?").text, "No.");
  EXPECT_EQ(talk.say("Which plant is green?").text, "There is a green fern.");
}

} // namespace castor::communication::test
