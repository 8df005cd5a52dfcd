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
  expect_reply("Which rooms are next to the kitchen?", "There is a corridor and a living room.");
  expect_reply("Is the kitchen next to the corridor?", "Yes.");
  expect_reply("Is the kitchen next to the office?", "No.");
  expect_reply("Where is the living room?", "It is near the kitchen.");
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
