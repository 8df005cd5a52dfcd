#include "castor/communication/dialogue/clause_parts.hpp"
#include "castor/communication/lexicon/english_lexicon.hpp"
#include "castor/communication/parsing/chatter.hpp"
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
                    "@e:ascription(be ^ <Mood>int ^ <Wh-Restr>(x:thing ^ one ^ <Number>sg ^ "
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
  EXPECT_EQ(after("Which balls are not red?", "Which are not?").find("<Polarity>neg"),
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

namespace {

/// What is left of an utterance without chatter, as words; all of it if it has none.
std::string core_of(const std::string& text) {
  const auto words = words_of(text);
  std::string result;
  for (auto& word : without_chatter(words, clause_parser().lexicon()).value_or(words))
    result += (result.empty() ? "" : " ") + word;
  return result;
}

} // namespace

TEST(Chatter, IsLeftOutAroundAQuestion) {
  EXPECT_EQ(core_of("Forgive me for asking, but is the ball red?"), "is the ball red");
  EXPECT_EQ(core_of("According to my notes, there is a ball."), "there is a ball");
  EXPECT_EQ(core_of("If you don't mind, is the ball red?"), "is the ball red");
  EXPECT_EQ(core_of("Is the ball red, if I may ask?"), "is the ball red");
  EXPECT_EQ(core_of("Robbie, is the ball red?"), "is the ball red");
}

TEST(Chatter, IsLeftOutBeforeAQuestionWithinASentence) {
  EXPECT_EQ(core_of("I'd be grateful to know the size of the ball."),
            "tell me the size of the ball");
  EXPECT_EQ(core_of("I wonder if you might tell me how many balls there are."),
            "tell me how many balls there are");
  EXPECT_EQ(core_of("Sources tell me that the ball is red."), "the ball is red");
}

TEST(Chatter, WhatMayMeanSomethingIsKept) {
  for (const auto* text :
       {"if I take away the discs , how many things are there", "except for you , who is red",
        "suppose you moved it , where is the ball", "if you took it away , what is left",
        "nobody tells me that the ball is red", "I doubt that the ball is red",
        "underwater , is there a ball", "my zorg , what colour is it",
        "on the left , is there a ball"}) {
    const auto words = words_of(text);
    EXPECT_EQ(without_chatter(words, clause_parser().lexicon()), std::nullopt) << text;
  }
}

TEST(Chatter, OnlySentencesAreUnderstoodWithoutIt) {
  const auto understood = [](const std::string& text) {
    return parsed_otherwise(clause_parser(), words_of(text), clause_parser().parse(text))
      .has_value();
  };
  EXPECT_TRUE(understood("Forgive me, is the ball red?"));
  EXPECT_FALSE(understood("Those balls, I adore."));
  EXPECT_FALSE(understood("Forgive me, is the zorg red?"));
}

} // namespace castor::communication
