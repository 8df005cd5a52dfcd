#include "castor/communication/lexicon/english_lexicon.hpp"
#include "castor/communication/parsing/hybrid_logic.hpp"
#include "castor/communication/parsing/parser.hpp"

#include <gtest/gtest.h>

#include <set>

using namespace castor::communication;

namespace {

std::vector<LogicalForm> readings(const std::string& utterance) {
  static Parser parser(english_lexicon());
  return parser.readings(utterance);
}

/// The utterance most likely means this.
void expect_meaning(const std::string& utterance, const std::string& meaning) {
  const auto forms = readings(utterance);
  ASSERT_FALSE(forms.empty()) << utterance;
  EXPECT_TRUE(equivalent(forms[0], parse_logical_form(meaning))) << utterance << "\n"
                                                                 << to_string(forms[0]);
}

std::string the(const std::string& nominal, const std::string& noun,
                const std::string& further = "") {
  return "(" + nominal + ":thing ^ " + noun + " ^ <Number>sg ^ <Delimitation>unique" +
         (further.empty() ? "" : " ^ " + further) + ")";
}

std::string ask(const std::string& restr, const std::string& scope, const std::string& asked_for) {
  return "@e:ascription(be ^ <Mood>int ^ <Cop-Restr>" + restr + " ^ <Cop-Scope>" + scope +
         (asked_for.empty() ? "" : " ^ <Wh-Restr>(" + asked_for + ")") + ")";
}

const std::string how_many = "<Quantity>(q:number ^ how-many)";

} // namespace

TEST(English, Asserts) {
  expect_meaning("this is a blue square",
                 "@e:ascription(be ^ <Cop-Restr>(t:thing ^ this ^ <Number>sg) ^ "
                 "<Cop-Scope>(s:thing ^ square ^ <Number>sg ^ <Delimitation>existential ^ "
                 "<Colour>(c:colour ^ blue)))");
  expect_meaning("The ball is red.", "@e:ascription(be ^ <Cop-Restr>" + the("b", "ball") +
                                       " ^ <Cop-Scope>(c:colour ^ red))");
  expect_meaning("the ball isn't red", "@e:ascription(be ^ <Polarity>neg ^ <Cop-Restr>" +
                                         the("b", "ball") + " ^ <Cop-Scope>(c:colour ^ red))");
}

TEST(English, RefersBySpatialRelations) {
  expect_meaning(
    "the ball to the right of the box",
    "@b:thing(ball ^ <Number>sg ^ <Delimitation>unique ^ <Location>(r:region ^ right ^ "
    "<Anchor>" +
      the("x", "box") + "))");
  expect_meaning("the red thing that is left of the box",
                 "@b:thing(thing ^ <Number>sg ^ <Delimitation>unique ^ <Colour>(c:colour ^ red) ^ "
                 "<Location>(r:region ^ left ^ <Anchor>" +
                   the("x", "box") + "))");
}

TEST(English, Commands) {
  const std::string put = "@e:action(put ^ <Mood>imp ^ <Actor>(a:person ^ you) ^ <Patient>";
  expect_meaning("put the cup near the box", put + the("c", "cup") +
                                               " ^ <Destination>(r:region ^ near ^ <Anchor>" +
                                               the("b", "box") + "))");
  expect_meaning(
    "go to the kitchen",
    "@e:action(go ^ <Mood>imp ^ <Actor>(a:person ^ you) ^ <Destination>(r:place ^ to ^ "
    "<Anchor>(k:thing ^ kitchen ^ <Number>sg ^ <Delimitation>unique)))");
  for (const auto* same : {"pick up the ball", "pick the ball up", "take the ball"})
    expect_meaning(same, "@e:action(take ^ <Mood>imp ^ <Actor>(a:person ^ you) ^ <Patient>" +
                           the("b", "ball") + ")");
}

TEST(English, KeepsAmbiguousAttachmentsApart) {
  const auto forms = readings("put the ball near the box on the table");
  ASSERT_EQ(forms.size(), 2u);
  std::set<std::string> destinations;
  for (const auto& form : forms)
    destinations.insert(
      dependent(form, *find_nominal(form, form.root), "Destination")->proposition);
  EXPECT_EQ(destinations, (std::set<std::string>{"near", "on"}));
}

TEST(English, AsksForProperties) {
  const std::string what_colour = "(q:quality ^ colour ^ <Number>sg ^ <Specifier>what)";
  expect_meaning("what colour is the square", ask(the("s", "square"), what_colour, "q"));
  expect_meaning("what's the colour of the ball",
                 ask("(q:quality ^ colour ^ <Number>sg ^ <Delimitation>unique ^ <Owner>" +
                       the("b", "ball") + ")",
                     "(w:entity ^ what)", "w"));
  expect_meaning(
    "What colour is the large cube left of the small metal sphere?",
    ask(the("c", "cube",
            "<Size>(l:size ^ large) ^ <Location>(r:region ^ left ^ <Anchor>" +
              the("s", "sphere", "<Size>(k:size ^ small) ^ <Material>(m:material ^ metal)") + ")"),
        what_colour, "q"));
  expect_meaning(
    "what is the cube made of",
    ask(the("c", "cube"), "(m:composition ^ made-of ^ <Material>(w:entity ^ what))", "w"));
}

TEST(English, AsksWhether) {
  expect_meaning("is the thing red", ask(the("t", "thing"), "(c:colour ^ red)", ""));
  expect_meaning("is the red thing left of the ball",
                 ask(the("t", "thing", "<Colour>(c:colour ^ red)"),
                     "(r:region ^ left ^ <Anchor>" + the("b", "ball") + ")", ""));
  expect_meaning(
    "Is there a red cube behind the sphere?",
    "@e:existence(be ^ <Mood>int ^ <Subject>(c:thing ^ cube ^ <Number>sg ^ "
    "<Delimitation>existential ^ <Colour>(d:colour ^ red) ^ <Location>(r:region ^ back "
    "^ <Anchor>" +
      the("s", "sphere") + ")))");
  expect_meaning("Are there more cubes than spheres?",
                 "@e:existence(be ^ <Mood>int ^ <Subject>(c:thing ^ cube ^ <Number>pl ^ "
                 "<Quantity>(q:comparison ^ more ^ <Than>(s:thing ^ sphere ^ <Number>pl))))");
  expect_meaning("is the cube the same colour as the sphere",
                 ask(the("c", "cube"),
                     "(s:comparison ^ same ^ <Quality>(q:quality ^ colour ^ <Number>sg) ^ <Than>" +
                       the("t", "sphere") + ")",
                     ""));
}

TEST(English, AsksForThingsPlacesAndNumbers) {
  expect_meaning("what do you see", "@e:existence(be ^ <Mood>int ^ <Wh-Restr>(w:thing ^ thing ^ "
                                    "<Number>pl) ^ <Subject>(w))");
  expect_meaning("where is the box", ask(the("b", "box"), "(w:region ^ where)", "w"));
  expect_meaning("which objects are blue", ask("(o:thing ^ object ^ <Number>pl ^ <Specifier>which)",
                                               "(c:colour ^ blue)", "o"));
  expect_meaning("how many red things are there",
                 "@e:existence(be ^ <Mood>int ^ <Wh-Restr>(t:thing ^ thing ^ <Number>pl ^ " +
                   how_many + " ^ <Colour>(c:colour ^ red)) ^ <Subject>(t))");
  expect_meaning("how many things are left of the ball and the cube",
                 ask("(t:thing ^ thing ^ <Number>pl ^ " + how_many + ")",
                     "(r:region ^ left ^ <Anchor>(k:conjunction ^ and ^ <First>" +
                       the("b", "ball") + " ^ <Next>" + the("c", "cube") + "))",
                     "t"));
}

TEST(English, ManagesTheDialogue) {
  expect_meaning("hello", "@m:greeting(hello)");
  expect_meaning("yes", "@m:marker(yes)");
  expect_meaning("no", "@m:marker(no)");
  expect_meaning("good bye", "@m:closing(bye)");
  expect_meaning("I do not know the word 'zorg'.",
                 "@e:perception(know ^ <Polarity>neg ^ <Actor>(i:person ^ i) ^ "
                 "<Patient>" +
                   the("w", "word", "<Name>(n:name ^ zorg)") + ")");
}
