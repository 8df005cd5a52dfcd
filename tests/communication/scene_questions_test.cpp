#include "castor/communication/dialogue/dialogue_move.hpp"
#include "castor/communication/lexicon/english_lexicon.hpp"
#include "castor/communication/parsing/hybrid_logic.hpp"
#include "castor/communication/parsing/parser.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

using namespace castor::communication;

namespace {

Parser& english() {
  static Parser parser(english_lexicon());
  return parser;
}

std::string one_of(const std::vector<std::string>& values) {
  return *rc::gen::elementOf(values);
}

/// "big red metal cube", or "cubes" and the like; each property may be missing.
std::string description(bool is_plural) {
  const auto maybe = [](const std::vector<std::string>& values) {
    return *rc::gen::arbitrary<bool>() ? one_of(values) + " " : std::string();
  };
  return maybe({"small", "tiny", "large", "big"}) +
         maybe({"red", "gray", "blue", "green", "brown", "purple", "cyan", "yellow"}) +
         maybe({"metal", "metallic", "shiny", "rubber", "matte"}) +
         one_of({"cube", "block", "sphere", "ball", "cylinder", "thing", "object"}) +
         (is_plural ? "s" : "");
}

std::string relation() {
  return one_of({"left of", "right of", "to the left of", "on the right side of", "behind",
                 "in front of"}) +
         " the ";
}

/// The most words that one of its questions takes is 26.
std::string question() {
  const auto some = description(true);
  const auto one = description(false);
  const auto other = description(false);
  const auto quality = one_of({"colour", "color", "size", "shape", "material"});
  switch (*rc::gen::inRange(0, 12)) {
    case 0:
      return "What " + quality + " is the " + one + " " + relation() + other + "?";
    case 1:
      return "What is the " + quality + " of the " + one + " that is " + relation() + other + "?";
    case 2:
      return "How many " + some + " are there?";
    case 3:
      return "How many " + some + " are " + relation() + one + "?";
    case 4:
      return "How many " + some + " are " + relation() + one + " and " + relation() + other + "?";
    case 5:
      return "Is there a " + one + " " + relation() + other + "?";
    case 6:
      return "Are there more " + some + " than " + description(true) + "?";
    case 7:
      return "Is the " + one + " the same " + quality + " as the " + other + "?";
    case 8:
      return "Are there any " + some + " that are " + relation() + other + "?";
    case 9:
      return "Does the " + one + " have the same " + quality + " as the " + other + "?";
    case 10:
      return "Is the " + one + " " + relation() + other + "?";
    default:
      return "What is the " + one + " " + relation() + other + " made of?";
  }
}

} // namespace

RC_GTEST_PROP(SceneQuestions, AreUnderstoodAsQuestions, ()) {
  const auto text = question();
  const auto readings = english().readings(text);
  if (readings.empty())
    RC_FAIL("not understood: " + text);
  for (const auto& reading : readings) {
    const auto move = dialogue_move_type(reading);
    RC_ASSERT(move == (text[0] == 'W' || text[0] == 'H' ? DialogueMoveType::question_w
                                                        : DialogueMoveType::question_yn));
  }
}

TEST(SceneQuestions, AreAsVariousAsPeopleAskThem) {
  for (const std::string text :
       {"What number of cubes are there?",
        "Are there any cubes?",
        "Is there anything behind the cube?",
        "Is there anything else that is red?",
        "What is its color?",
        "What color is it?",
        "Is there another cube that has the same color as the sphere?",
        "What number of other objects are the same shape as the cube?",
        "Are there an equal number of cubes and spheres?",
        "Is the number of cubes greater than the number of spheres?",
        "Are there as many cubes as spheres?",
        "Do the cube and the sphere have the same color?",
        "Is the cube made of the same material as the sphere?",
        "What shape is the thing that is both left of the cube and right of the sphere?",
        "How many things are either cubes or red spheres?",
        "Is the red cube larger than the blue one?",
        "How many metal things are right of the blue cube or left of the sphere?",
        "Are all cubes red?",
        "How big is the ball?",
        "What kind of thing is this?",
        "Is it a cube or a ball?",
        "Is the ball between the box and the cube?"})
    EXPECT_FALSE(english().readings(text).empty()) << text;
}

TEST(SceneQuestions, PreferTheNearestAttachment) {
  const auto readings =
    english().readings("what colour is the ball left of the thing in front of the cube");
  ASSERT_EQ(readings.size(), 2u);
  const auto& form = readings.front();
  const auto& ball = *dependent(form, *find_nominal(form, form.root), "Cop-Restr");
  const auto& thing = *dependent(form, *dependent(form, ball, "Location"), "Anchor");
  EXPECT_EQ(thing.proposition, "thing");
  EXPECT_NE(dependent(form, thing, "Location"), nullptr);
}
