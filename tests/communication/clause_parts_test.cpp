#include "castor/communication/dialogue/clause_parts.hpp"
#include "castor/communication/lexicon/english_lexicon.hpp"
#include "castor/communication/parsing/hybrid_logic.hpp"
#include "castor/communication/parsing/parser.hpp"
#include "castor/communication/parsing/pauses.hpp"
#include "castor/communication/parsing/tokens.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace castor::communication {

namespace {

Parser& clause_parser() {
  static Parser parser{english_lexicon()};
  return parser;
}

/// Whether one of the readings, parts reunited, is equal to a form.
bool means(const std::string& said, const std::string& form) {
  return std::ranges::any_of(clause_parser().readings(said), [&](auto& reading) {
    return equivalent(reunited(reading), parse_logical_form(form));
  });
}

std::string after(const std::string& said, const std::string& question) {
  const auto before = clause_parser().readings(said);
  const auto elliptical = clause_parser().readings(question);
  if (before.empty() || elliptical.empty())
    return "not understood";
  const auto whole = completed(elliptical.front(), reunited(before.front()));
  return whole ? to_string(*whole) : "nothing";
}

} // namespace

TEST(ClauseParts, RelativeClausesBelongToWhatIsAskedFor) {
  EXPECT_TRUE(means("What do you see that is red?",
                    "@e:existence(be ^ <Mood>int ^ <Wh-Restr>(x:thing ^ thing ^ <Number>pl ^ "
                    "<GenRelation>(r:ascription ^ be ^ <Cop-Restr>(x) ^ <Cop-Scope>(c:colour ^ "
                    "red))) ^ <Subject>(x))"));
}

TEST(ClauseParts, AlternativesAreWhatIsChosenFrom) {
  EXPECT_TRUE(means("Which is red, the ball or the cube?",
                    "@e:ascription(be ^ <Mood>int ^ <Wh-Restr>(x:thing ^ one ^ "
                    "<Specifier>which ^ <PartOf>(c:conjunction ^ or ^ <First>(a:thing ^ ball ^ "
                    "<Number>sg ^ <Delimitation>unique) ^ <Next>(b:thing ^ cube ^ <Number>sg ^ "
                    "<Delimitation>unique))) ^ <Cop-Restr>(x) ^ <Cop-Scope>(p:colour ^ red))"));
}

TEST(ClauseParts, ListsAreJoinedByTheirLastWord) {
  EXPECT_TRUE(means("Is it red, green or blue?",
                    "@e:ascription(be ^ <Mood>int ^ <Cop-Restr>(i:thing ^ it ^ <Number>sg) ^ "
                    "<Cop-Scope>(c:conjunction ^ or ^ <First>(x:colour ^ red) ^ "
                    "<Next>(d:conjunction ^ or ^ <First>(y:colour ^ green) ^ <Next>(z:colour ^ "
                    "blue))))"));
}

TEST(ClauseParts, ShortQuestionsAreAboutTheClauseBefore) {
  EXPECT_EQ(after("Is there a red ball?", "Which one?"),
            "@w1:existence(be ^ <Mood>int ^ <Subject>(w5:thing ^ ball ^ <Number>sg ^ "
            "<Colour>(w4:colour ^ red)) ^ <Wh-Restr>(w5))");
  EXPECT_NE(after("Two cubes are red.", "Which ones?").find("<Wh-Restr>"), std::string::npos);
  EXPECT_NE(after("Which balls are red?", "How many?").find("how-many"), std::string::npos);
  EXPECT_NE(after("There is a ball.", "Where?").find("region"), std::string::npos);
  // There is one, and it is known.
  EXPECT_EQ(after("Is the ball red?", "Which one?"), "nothing");
  EXPECT_EQ(after("Hello.", "Which one?"), "nothing");
  // What something is not so of.
  EXPECT_NE(after("Is everything red?", "Which one isn't?").find("<Polarity>neg"),
            std::string::npos);
  EXPECT_EQ(after("Is there a ball?", "Which one isn't?"), "nothing");
}

TEST(Pauses, MayBeLeftOut) {
  const auto understood = [](const std::string& text) {
    const auto words = words_of(text);
    const auto form = clause_parser().parse(text);
    EXPECT_FALSE(form.unparsable.empty()) << text;
    return parsed_with_pause(clause_parser(), words, form).has_value();
  };
  EXPECT_TRUE(understood("the ball what colour is it"));
  EXPECT_TRUE(understood("the green cube is it large"));
  EXPECT_FALSE(understood("the ball of of"));
  EXPECT_FALSE(understood("of"));
}

} // namespace castor::communication
