// What a robot that is shown around says of rooms, with the words that configs/explorer.cast has.

#include "castor/base/text_file.hpp"
#include "castor/tests/binding/proxies.hpp"
#include "castor/tests/communication/told_world.hpp"

#include <gtest/gtest.h>

#include <string>

namespace castor::communication::test {

namespace {

using binding::test::concept_of;

std::string configured(const std::string& file) {
  return load_text(CASTOR_LANGUAGE_FOLDER "/" + file);
}

/// A corridor with an office, a kitchen and a room without a name, and behind the kitchen a living
/// room.
struct ShownRooms : ::testing::Test {
  ShownRooms() : world(configured("rooms.words"), configured("rooms.ontology")) {
    world.put("corridor", {concept_of("room"), concept_of("corridor")});
    world.put("office", {concept_of("room"), concept_of("office")});
    world.put("kitchen", {concept_of("room"), concept_of("kitchen")});
    world.put("room", {concept_of("room")});
    world.put("living room", {concept_of("room"), concept_of("living_room")});
    world.put("self", {concept_of("self")});
    for (auto* room : {"office", "kitchen", "room"})
      join("corridor", room);
    join("kitchen", "living room");
    world.know("room");
    world.know("self");
    world.learn_names_of("room");
  }

  void join(const std::string& a, const std::string& b) {
    world.relate("near", a, b);
    world.relate("near", b, a);
  }

  void expect_reply(const std::string& sentence, const std::string& reply) {
    auto talk = world.talk();
    EXPECT_EQ(talk.say(sentence).text, reply) << sentence;
  }

  ToldWorld world;
};

} // namespace

TEST_F(ShownRooms, AreCalledByTheirNames) {
  world.relate("in", "self", "kitchen");
  for (auto* sentence :
       {"What is this place?", "What do you call this place?", "What is this place called?",
        "What's the name of this place?", "What's the name of this room?", "Which room is this?",
        "What kind of room is this?", "What sort of room is this?", "What kind of place is this?",
        "What do you call this?", "What is this?"})
    expect_reply(sentence, "It is a kitchen.");
}

TEST_F(ShownRooms, AreWhereTheRobotIs) {
  world.relate("in", "self", "office");
  expect_reply("Where am I?", "You are in the office.");
  expect_reply("Where are we?", "We are in the office.");
  expect_reply("Do you know where you are?", "I am in the office.");
  expect_reply("Tell me where we are.", "We are in the office.");
  expect_reply("Are we in the kitchen?", "No.");
  expect_reply("Is this the office?", "Yes.");
}

TEST_F(ShownRooms, AreBesideOthers) {
  world.relate("in", "self", "room");
  expect_reply("What is next to the kitchen?", "There is a corridor and a living room.");
  expect_reply("Which rooms are next to the kitchen?", "There is a corridor and a living room.");
  expect_reply("What is near the office?", "There is a corridor.");
  for (auto* sentence :
       {"What is beside the kitchen?", "What's near the kitchen?",
        "Which rooms adjoin the kitchen?", "What rooms are next to the kitchen?",
        "What is adjacent to the kitchen?", "Which rooms are near the kitchen?",
        "Which rooms are beside the kitchen?", "What lies next to the kitchen?",
        "What rooms are adjacent to the kitchen?", "Which rooms are connected to the kitchen?",
        "Which rooms are close to the kitchen?", "What room is next to the kitchen?",
        "Which room is next to the kitchen?"})
    expect_reply(sentence, "There is a corridor and a living room.");
  expect_reply("How many rooms are next to the kitchen?",
               "There are two rooms next to the kitchen.");
  expect_reply("What is next to this room?", "There is a corridor.");
  expect_reply("Does the kitchen adjoin the office?", "No.");
  expect_reply("Does the kitchen border on the corridor?", "Yes.");
  expect_reply("Is the kitchen next to the corridor?", "Yes.");
  expect_reply("Is the kitchen next to the office?", "No.");
  expect_reply("Where is the living room?", "It is near the kitchen.");
}

TEST_F(ShownRooms, AreCounted) {
  world.relate("in", "self", "room");
  expect_reply("How many rooms are there?", "There are five rooms.");
  expect_reply("Which rooms are there?",
               "There is a corridor, a kitchen, a living room, an office and a room.");
}

// Only that they adjoin is known, not where they are, nor how large.
TEST_F(ShownRooms, AreNotSaidToBeWhereNobodyKnows) {
  world.relate("in", "self", "room");
  for (auto* sentence :
       {"What is behind the kitchen?", "Which room is to the left of the kitchen?",
        "Is the office to the left of the kitchen?", "What is in front of the kitchen?",
        "Which room is the biggest?", "Which is the biggest room?", "What is the largest room?",
        "Is the kitchen bigger than the office?", "What is the nearest room?",
        "What is between the kitchen and the office?", "Is the corridor the smallest room?"})
    expect_reply(sentence, "I do not know.");
}

TEST_F(ShownRooms, AreReachedThroughOthers) {
  world.relate("in", "self", "room");
  expect_reply("How do I get to the living room?", "Through the corridor and the kitchen.");
  expect_reply("Which way is the office?", "Through the corridor.");
  expect_reply("What is the way to the corridor?", "A way leads straight there from here.");
  expect_reply("How do I get to the bathroom?", "I do not know.");
  expect_reply("How do I get to the ball?", "I do not see a ball.");
}

TEST_F(ShownRooms, HaveNoWayToWhereTheRobotIs) {
  world.relate("in", "self", "kitchen");
  expect_reply("How can I get to the kitchen?", "It is here.");
}

TEST_F(ShownRooms, HaveNoKnownWayFromNowhere) {
  expect_reply("How do I get to the kitchen?", "I do not know.");
}

} // namespace castor::communication::test
