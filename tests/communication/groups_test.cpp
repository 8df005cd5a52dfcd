// What is said of several things together, of some of those that were spoken of, and of others than
// these.
#include "castor/tests/communication/table_scene.hpp"
#include "castor/tests/communication/table_talk.hpp"

#include <gtest/gtest.h>

#include <string>
#include <utility>

namespace castor::communication::test {

namespace {

using binding::feature;
using binding::FeatureKind;

class Groups : public testing::Test {
protected:
  Groups() {
    put("red ball", "sphere", "red", 0.04, -0.3, 0);
    put("blue ball", "sphere", "blue", 0.08, 0, 0);
    put("green cube", "cube", "green", 0.08, 0.3, 0);
    put("white cube", "cube", "white", 0.04, 0, 0.2);
    put("white disc", "circle", "white", 0.04, 0.1, -0.2);
    table_.relate("left", "red ball", "blue ball");
    table_.relate("right", "green cube", "blue ball");
  }

  /// The reply to the last of several utterances.
  std::string last(std::initializer_list<const char*> utterances) {
    TableTalk talk{[&](auto& asked) { return table_.reply(asked); },
                   [&](auto& name, auto features) { table_.tell(name, std::move(features)); }};
    std::string reply;
    for (const auto* said : utterances)
      reply = talk.say(said).text;
    return reply;
  }

  std::string reply(const char* said) { return last({said}); }

private:
  void put(const char* id, const char* shape, const char* colour, double size, double x, double y) {
    table_.put(id,
               {feature(FeatureKind::shape, shape), feature(FeatureKind::colour, colour),
                feature(FeatureKind::size, size > 0.05 ? "large" : "small"),
                binding::extent_of(size, size, size)},
               x, y);
  }

  TableScene table_;
};

} // namespace

TEST_F(Groups, AreChosenFrom) {
  EXPECT_EQ(reply("Which is the bigger of the two balls?"), "It is the large blue ball.");
  EXPECT_EQ(reply("Name the biggest of the cubes."), "There is a large green cube.");
  EXPECT_EQ(reply("Which ball is the small one, the red one or the blue one?"),
            "There is a small red ball.");
  EXPECT_EQ(reply("Is the red ball bigger or the white cube?"),
            "There is a small red ball and a small white cube.");
  EXPECT_EQ(reply("Is the red ball bigger or the green cube?"), "It is the large green cube.");
  EXPECT_EQ(reply("Is it the disc or the green cube that is white?"),
            "There is a small white circle.");
  EXPECT_EQ(reply("Of the small things, which is the furthest to the left?"),
            "It is the small red ball.");
}

TEST_F(Groups, AreOfTheNumberThatIsSaid) {
  EXPECT_EQ(last({"How many cubes are there?", "Are both of them large?", "Which one isn't?"}),
            "There is a small white cube.");
  EXPECT_EQ(last({"How many small things are there?", "Are all three white?"}), "No.");
  EXPECT_EQ(reply("Are all three white?"), "Which thing do you mean?");
  EXPECT_EQ(reply("Are all but one of the small things white?"), "Yes.");
  EXPECT_EQ(reply("Are at least half of the things small?"), "Yes.");
  EXPECT_EQ(reply("Name two small things."), "There is a small red ball and a small white cube.");
}

TEST_F(Groups, AgreeOrDifferInSome) {
  EXPECT_EQ(reply("Do any two things have the same colour?"), "Yes.");
  EXPECT_EQ(reply("Are any two balls the same colour?"), "No.");
  EXPECT_EQ(reply("Are no two balls the same colour?"), "Yes.");
  EXPECT_EQ(last({"What colour is the disc?", "Does anything else have that colour?"}), "Yes.");
  EXPECT_EQ(last({"What colour is the red ball?", "Does anything else have that colour?"}), "No.");
  EXPECT_EQ(last({"Are the balls the same colour?", "Same shape?"}), "Yes.");
  EXPECT_EQ(reply("Which things share a colour with the disc?"), "There is a small white cube.");
}

TEST_F(Groups, HaveOthersBesidesThem) {
  EXPECT_EQ(reply("Is the red ball smaller than the other ball?"), "Yes.");
  EXPECT_EQ(reply("Are the balls bigger than everything else?"), "No.");
  EXPECT_EQ(reply("Is everything but the balls and the cubes white?"), "Yes.");
  EXPECT_EQ(reply("Are there as many balls as other things?"), "No.");
  EXPECT_EQ(reply("Is one of the balls larger than the other?"), "Yes.");
  EXPECT_EQ(reply("One ball is red and the other is blue."), "Ok.");
  EXPECT_EQ(reply("One ball is red and the other is green."), "No.");
  EXPECT_EQ(reply("The cube is the only white thing."), "Which cube do you mean?");
  EXPECT_EQ(reply("The balls are the only round things."), "No.");
}

TEST_F(Groups, HaveCommonValues) {
  EXPECT_EQ(reply("What is the most common colour?"), "It is white.");
  EXPECT_EQ(reply("Which size is the least common?"), "It is large.");
  EXPECT_EQ(reply("Which colours are on the left?"), "It is red.");
}

TEST_F(Groups, AreComparedOnlyWithWhatIsMeant) {
  EXPECT_EQ(reply("Is the blue ball bigger?"), "I do not know what 'larger' means here.");
  EXPECT_EQ(last({"Is the disc white?", "Is the blue ball bigger?"}), "Yes.");
  EXPECT_EQ(reply("Is the disc closer to the white cube than to the blue ball?"), "No.");
  EXPECT_EQ(reply("What is the third largest thing?"), "I do not know.");
  EXPECT_EQ(reply("There is no triangle, is there?"), "No.");
}

TEST_F(Groups, AreSpokenOfInShort) {
  EXPECT_EQ(last({"The disc is white, right?", "And large?"}), "No, it is small.");
  EXPECT_EQ(last({"There are two discs.", "Sorry, only one."}), "Ok.");
  EXPECT_EQ(last({"What is left of the blue ball?", "I meant the right."}),
            "There is a large green cube.");
  EXPECT_EQ(last({"What is left of the blue ball?", "What is to the right of it?"}),
            "There is a large green cube.");
  EXPECT_EQ(reply("What colour is the disc, no wait, I mean the red ball?"), "It is red.");
}

TEST_F(Groups, AreToldOfEachPart) {
  EXPECT_EQ(
    last({"The disc is a coin and the red ball is a cherry.", "What colour is the cherry?"}),
    "It is red.");
  EXPECT_EQ(last({"The disc isn't red but white.", "Is the disc a coin?"}), "I do not know.");
}

} // namespace castor::communication::test
