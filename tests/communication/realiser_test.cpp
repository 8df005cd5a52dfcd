#include "castor/communication/dialogue/realiser.hpp"
#include "castor/communication/lexicon/english_lexicon.hpp"
#include "castor/communication/parsing/hybrid_logic.hpp"
#include "castor/communication/parsing/parser.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

using namespace castor::communication;

namespace {

Realiser& realiser() {
  static Realiser english(english_lexicon());
  return english;
}

std::string say(const std::string& form) {
  return realiser().realise(parse_logical_form(form)).value_or("nothing");
}

bool is_understood_as(const std::string& sentence, const LogicalForm& form) {
  static Parser parser(english_lexicon());
  const auto readings = parser.readings(sentence);
  return std::any_of(readings.begin(), readings.end(),
                     [&](const LogicalForm& reading) { return equivalent(reading, form); });
}

const std::string it = "<Cop-Restr>(i:thing ^ it ^ <Number>sg)";

std::string the(const std::string& nominal, const std::string& noun) {
  return "(" + nominal + ":thing ^ " + noun + " ^ <Number>sg ^ <Delimitation>unique)";
}

template <class T>
T one_of(const std::vector<T>& values) {
  return *rc::gen::elementOf(values);
}

/// The description of a thing, of at most `depth` others.
std::string description(int depth, int& names) {
  const auto name = "n" + std::to_string(names++);
  const bool is_plural = *rc::gen::arbitrary<bool>();
  std::string text = "(" + name + ":thing ^ " +
                     one_of<std::string>({"ball", "box", "cube", "thing", "square", "cylinder"}) +
                     " ^ <Number>" + (is_plural ? "pl" : "sg") + " ^ <Delimitation>unique";
  const auto property = [&](const std::string& mode, const std::string& sort,
                            const std::vector<std::string>& values) {
    if (*rc::gen::inRange(0, 3) == 0)
      text +=
        " ^ <" + mode + ">(n" + std::to_string(names++) + ":" + sort + " ^ " + one_of(values) + ")";
  };
  property("Colour", "colour", {"red", "green", "grey", "orange"});
  property("Size", "size", {"large", "small"});
  property("Material", "material", {"metal", "rubber"});
  if (depth > 0 && *rc::gen::arbitrary<bool>()) {
    const auto region = "n" + std::to_string(names++);
    text += " ^ <Location>(" + region + ":region ^ " +
            one_of<std::string>({"left", "right", "front", "back", "near", "on"}) + " ^ <Anchor>" +
            description(depth - 1, names) + ")";
  }
  return text + ")";
}

} // namespace

TEST(Realiser, SaysListsInOneSentence) {
  const auto a = [](const std::string& name, const std::string& noun) {
    return "(" + name + ":thing ^ " + noun + " ^ <Number>sg ^ <Delimitation>existential)";
  };
  EXPECT_EQ(say("@e:existence(be ^ <Subject>(c:conjunction ^ and ^ <First>" + a("x", "ball") +
                " ^ <Next>(d:conjunction ^ and ^ <First>" + a("y", "cube") + " ^ <Next>" +
                a("z", "object") + ")))"),
            "There is a ball, a cube and an object.");
  EXPECT_EQ(say("@e:ascription(be ^ <Cop-Restr>(t:thing ^ they ^ <Number>pl) ^ "
                "<Cop-Scope>(c:conjunction ^ and ^ <First>(x:colour ^ red) ^ <Next>(y:colour ^ "
                "blue)))"),
            "They are red and blue.");
}

TEST(Realiser, Answers) {
  const std::string be = "@e:ascription(be ^ ";
  EXPECT_EQ(say(be + it + " ^ <Cop-Scope>(c:colour ^ blue))"), "It is blue.");
  EXPECT_EQ(say(be + "<Cop-Restr>" + the("s", "square") + " ^ <Cop-Scope>(c:colour ^ blue))"),
            "The square is blue.");
  EXPECT_EQ(say(be + it + " ^ <Cop-Scope>(c:colour ^ red) ^ <Marker>(m:marker ^ no))"),
            "No, it is red.");
  EXPECT_EQ(say(be + "<Polarity>neg ^ " + it + " ^ <Cop-Scope>(c:colour ^ red))"),
            "It is not red.");
  EXPECT_EQ(say(be + "<Cop-Restr>" + the("b", "box") + " ^ <Cop-Scope>(r:region ^ left ^ <Anchor>" +
                the("c", "ball") + "))"),
            "The box is to the left of the ball.");
  EXPECT_EQ(say("@e:existence(be ^ <Subject>(t:thing ^ thing ^ <Number>pl ^ "
                "<Quantity>(q:number ^ two) ^ <Colour>(c:colour ^ red)))"),
            "There are two red things.");
  EXPECT_EQ(say("@m:marker(yes)"), "Yes.");
  EXPECT_EQ(say("@m:greeting(hello)"), "Hello.");
}

TEST(Realiser, AsksBack) {
  EXPECT_EQ(say("@e:perception(mean ^ <Mood>int ^ <Wh-Restr>(b:thing ^ ball ^ <Number>sg ^ "
                "<Specifier>which) ^ <Actor>(y:person ^ you) ^ <Patient>(b))"),
            "Which ball do you mean?");
  EXPECT_EQ(say("@e:ascription(be ^ <Mood>int ^ " + it + " ^ <Cop-Scope>(c:colour ^ red))"),
            "Is it red?");
}

TEST(Realiser, QuotesWordsThatAreNotKnown) {
  EXPECT_EQ(say("@e:perception(know ^ <Polarity>neg ^ <Actor>(i:person ^ i) ^ "
                "<Patient>(w:thing ^ word ^ <Number>sg ^ <Delimitation>unique ^ <Name>(n:name ^ "
                "zorg)))"),
            "I do not know the word 'zorg'.");
}

TEST(Realiser, WritesArticlesAndPronounsAsPeopleDo) {
  const auto a_thing = [](const std::string& colour) {
    return "@t:thing(ball ^ <Number>sg ^ <Delimitation>existential ^ <Colour>(c:colour ^ " +
           colour + "))";
  };
  EXPECT_EQ(say(a_thing("orange")), "An orange ball.");
  EXPECT_EQ(say(a_thing("red")), "A red ball.");
  EXPECT_EQ(say("@e:action(give ^ <Mood>imp ^ <Actor>(a:person ^ you) ^ <Patient>" +
                the("b", "ball") + " ^ <Recipient>(i:person ^ i ^ <Case>accusative))"),
            "Give me the ball.");
}

TEST(Realiser, SaysNothingRatherThanSomethingElse) {
  EXPECT_EQ(say("@t:thing(zorg ^ <Number>sg)"), "nothing");
  EXPECT_EQ(say("@e:ascription(be ^ " + it + ")"), "nothing");
  EXPECT_EQ(say("@t:thing(ball ^ <Number>sg ^ <Delimitation>unique ^ <Owner>(o:person ^ you))"),
            "nothing");
  EXPECT_EQ(realiser().realise({}), std::nullopt);
}

RC_GTEST_PROP(Realiser, IsUnderstood, ()) {
  int names = 0;
  const auto subject = description(1, names);
  const bool asks = *rc::gen::arbitrary<bool>();
  const auto form = parse_logical_form(
    std::string("@e:ascription(be ^ ") + (asks ? "<Mood>int ^ " : "") + "<Cop-Restr>" + subject +
    " ^ <Cop-Scope>(p:region ^ " + one_of<std::string>({"left", "back", "near"}) + " ^ <Anchor>" +
    description(0, names) + "))");
  const auto sentence = realiser().realise(form);
  if (!sentence)
    RC_FAIL("not said: " + to_string(form));
  RC_LOG() << *sentence;
  RC_ASSERT(is_understood_as(*sentence, form));
}
