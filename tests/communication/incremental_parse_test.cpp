#include "castor/communication/lexicon/english_lexicon.hpp"
#include "castor/communication/parsing/hybrid_logic.hpp"
#include "castor/communication/parsing/parser.hpp"
#include "castor/communication/parsing/tokens.hpp"

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

using namespace castor::communication;
using testing::IsEmpty;
using testing::SizeIs;

namespace {

Parser& english() {
  static Parser parser(english_lexicon());
  return parser;
}

/// The likeliest reading after each word.
std::vector<std::string> steps(const std::string& utterance) {
  IncrementalParse parse(english());
  std::vector<std::string> forms;
  for (const auto& word : words_of(utterance)) {
    parse.add(word);
    const auto packed = parse.form();
    EXPECT_EQ(packed.state, InterpretationState::unfinished);
    EXPECT_EQ(packed.string_position, static_cast<int>(forms.size()) + 1);
    EXPECT_THAT(packed.unparsable, IsEmpty()) << word;
    std::string text;
    for (const auto& form : unpack(packed, 0))
      text += to_string(form);
    forms.push_back(text);
  }
  return forms;
}

} // namespace

TEST(IncrementalParse, UnderstandsWhatHasBeenSaidSoFar) {
  EXPECT_THAT(
    steps("put the cup near the box"),
    testing::ElementsAre(
      "@w1:action(put ^ <Mood>imp ^ <Actor>(x1d:person ^ you) ^ <Patient>(x1c) ^ "
      "<Destination>(x1b))",
      "@w1:action(put ^ <Mood>imp ^ <Actor>(x1d:person ^ you) ^ <Patient>(x1c ^ "
      "<Delimitation>unique)"
      " ^ <Destination>(x1b))",
      "@w1:action(put ^ <Mood>imp ^ <Actor>(x1d:person ^ you) ^ <Patient>(w3:thing ^ cup ^ "
      "<Number>sg"
      " ^ <Delimitation>unique) ^ <Destination>(x1b))",
      "@w1:action(put ^ <Mood>imp ^ <Actor>(x1d:person ^ you) ^ <Patient>(w3:thing ^ cup ^ "
      "<Number>sg"
      " ^ <Delimitation>unique) ^ <Destination>(w4:region ^ near ^ <Anchor>(x4b)))",
      "@w1:action(put ^ <Mood>imp ^ <Actor>(x1d:person ^ you) ^ <Patient>(w3:thing ^ cup ^ "
      "<Number>sg"
      " ^ <Delimitation>unique) ^ <Destination>(w4:region ^ near ^ <Anchor>(x4b ^ "
      "<Delimitation>unique)))",
      "@w1:action(put ^ <Mood>imp ^ <Actor>(x1d:person ^ you) ^ <Patient>(w3:thing ^ cup ^ "
      "<Number>sg"
      " ^ <Delimitation>unique) ^ <Destination>(w4:region ^ near ^ <Anchor>(w6:thing ^ box ^ "
      "<Number>sg ^ <Delimitation>unique)))"));
}

TEST(IncrementalParse, FinishesByNarrowingDownToWholeUtterances) {
  IncrementalParse parse(english());
  for (const auto* word : {"this", "is", "a", "blue", "square"})
    parse.add(word);
  EXPECT_EQ(parse.form().state, InterpretationState::unfinished);
  parse.finish();
  const auto packed = parse.form();
  EXPECT_EQ(packed.state, InterpretationState::finished);
  EXPECT_EQ(packed.text, "this is a blue square");
  EXPECT_THAT(packed.readings, SizeIs(1));
  EXPECT_THAT(packed.unparsable, IsEmpty());
}

TEST(IncrementalParse, FindsNoFaultWithBeginnings) {
  for (const std::string utterance :
       {"what colour is the large cube to the left of the small metal sphere",
        "put the ball near the box on the table", "how many red things are there",
        "take the red ball and put it on the box", "the ball is not red"})
    steps(utterance);
}

RC_GTEST_PROP(IncrementalParse, CostsNoMoreThanItsLimits, ()) {
  const auto& lexicon = english().lexicon();
  const auto& limits = english().options().chart;
  IncrementalParse parse(english());
  const auto count = *rc::gen::inRange<std::size_t>(0, 24);
  for (std::size_t i = 0; i < count; ++i) {
    const auto entry = *rc::gen::inRange<std::size_t>(0, lexicon.entries().size() + 20);
    for (const auto& word :
         words_of(entry < lexicon.entries().size() ? lexicon.entries()[entry].phrase : "zorg"))
      parse.add(word);
  }
  const auto words = parse.chart().words().size();
  RC_ASSERT(words <= limits.words);
  RC_ASSERT(parse.chart().size() <= words * (words + 1) / 2 * limits.edges_per_span);
  parse.form();
  parse.finish();
  const auto packed = parse.form();
  RC_ASSERT(packed.readings.size() <= english().options().readings);
  // Either all of it is understood, or it says what is not.
  RC_ASSERT(!packed.readings.empty() || !packed.unparsable.empty());
}

RC_GTEST_PROP(IncrementalParse, SurvivesAnyText, (const std::string& text)) {
  const auto packed = english().parse(text);
  RC_ASSERT(!packed.readings.empty() || !packed.unparsable.empty());
}
