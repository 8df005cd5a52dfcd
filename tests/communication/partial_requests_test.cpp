// Utterances of which only a part is understood: a request in them is proposed, and done when
// people agree; a question is answered.
#include "castor/communication/dialogue/partial_requests.hpp"

#include "castor/communication/dialogue/aside_clauses.hpp"
#include "castor/communication/parsing/tokens.hpp"
#include "castor/tests/communication/directive_sentences.hpp"
#include "castor/tests/communication/sentence_set.hpp"
#include "castor/tests/communication/table_talk.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace castor::communication::test {

namespace {

using testing::HasSubstr;
using testing::Not;

/// A red and a green cube, a blue and a purple ball.
const std::vector<ThingInSet> table{{"RC", "cube", "red", 0.02, -0.02, 0.055},
                                    {"GC", "cube", "green", 0.20, -0.06, 0.05},
                                    {"BB", "sphere", "blue", -0.16, -0.09, 0.06},
                                    {"PB", "sphere", "purple", 0.15, 0.06, 0.055}};

/// The reply to the last of several utterances.
Reply reply_to(const std::vector<std::string>& said) {
  TableScene scene;
  lay_out(table, scene);
  TableTalk talk{[&](auto& asked) { return scene.reply(asked); },
                 [&](auto& told, auto features) { scene.tell(told, std::move(features)); },
                 words_of_requests()};
  Reply reply;
  for (const auto& x : said)
    reply = talk.say(x);
  return reply;
}

std::string text_of_reply(const std::vector<std::string>& said) {
  const auto reply = reply_to(said);
  EXPECT_TRUE(reply.steps.empty()) << said.back();
  return reply.text;
}

/// What is done: "Give BB; Put RC left".
std::string done(const std::vector<std::string>& said) {
  std::string result;
  for (const auto& step : reply_to(said).steps) {
    result += (result.empty() ? "" : "; ") + step.action;
    for (const auto& x : step.things)
      result += ' ' + x;
    for (const auto& x : step.places) {
      result += ' ' + x.relation;
      for (const auto& landmark : x.landmarks)
        result += ' ' + landmark;
    }
  }
  return result;
}

bool is_aside_of_request(const std::string& said, bool is_first = false) {
  return is_aside(*words_of_requests()->lexicon(), words_of(said), Beside::request, is_first);
}

} // namespace

TEST(PartialRequests, AreProposedWithWhatIsNotUnderstood) {
  EXPECT_EQ(
    text_of_reply({"Would you be ever so sweet and pass me the purple ball?"}),
    "I do not understand \"would you be ever so sweet and\". Do you mean \"pass me the purple "
    "ball\"?");
  EXPECT_EQ(
    text_of_reply({"Put the red cube behind the blue ball, and be graceful."}),
    "I do not understand \"and be graceful\". Do you mean \"put the red cube behind the blue "
    "ball\"?");
  EXPECT_EQ(
    text_of_reply({"Give me the green cube, that spot feels so forlorn."}),
    "I do not understand \"that spot feels so forlorn\". Do you mean \"give me the green cube\"?");
}

TEST(PartialRequests, AreDoneWhenPeopleAgreeAndOnlyThen) {
  const std::string said = "Would you be ever so sweet and pass me the purple ball?";
  for (const auto* yes : {"Yes.", "Yes please.", "Please.", "Ok.", "Yes, do.", "Please do.",
                          "Go ahead.", "Right.", "Sure.", "Do it.", "Yes, that's it."})
    EXPECT_EQ(done({said, yes}), "Give PB") << yes;
  for (const auto* no : {"No.", "No, thanks.", "Better not.", "Please don't."})
    EXPECT_EQ(text_of_reply({said, no}), "What shall I do then?") << no;
  EXPECT_EQ(done({said, "No.", "Yes."}), "");
  EXPECT_EQ(done({said, "Yes.", "Yes."}), "");
}

TEST(PartialRequests, AreNotDoneAtOnceHoweverTheyAreAskedFor) {
  for (const auto* said : {"How about putting the red cube on the left, my aunt frizzled it there?",
                           "Why don't you put the red cube on the left, my aunt frizzled it there?",
                           "Can you put the red cube on the left, my aunt frizzled it there?",
                           "I want you to put the red cube on the left, my aunt frizzled it there.",
                           "Have the red cube on the left, my aunt frizzled it there.",
                           "I'd like the red cube on the left, my aunt frizzled it there."})
    EXPECT_EQ(done({said}), "") << said;
}

TEST(PartialRequests, AreDroppedWhenSomethingElseIsSaid) {
  const std::string said = "Would you be ever so sweet and pass me the purple ball?";
  EXPECT_EQ(done({said, "Put the red cube on the left."}), "Put RC left");
  EXPECT_EQ(done({said, "Put the red cube on the left.", "Yes."}), "");
  EXPECT_EQ(done({said, "What is behind the green cube?", "Yes."}), "");
  EXPECT_EQ(done({said, "Blorp the frizzle.", "Yes."}), "");
}

TEST(PartialRequests, AreProposedAnewWhenAFragmentChangesThem) {
  const std::string said = "Would you be ever so sweet and pass me the purple ball?";
  EXPECT_EQ(text_of_reply({said, "No, the blue one."}), "Shall I do that?");
  EXPECT_EQ(done({said, "No, the blue one.", "Yes."}), "Give BB");
  EXPECT_THAT(text_of_reply({"Would you be ever so sweet and pass me the ball?"}),
              HasSubstr("Which ball do you mean?"));
  EXPECT_EQ(text_of_reply({"Would you be ever so sweet and pass me the ball?", "The blue one."}),
            "Shall I do that?");
}

TEST(PartialRequests, SeveralAreProposedTogether) {
  EXPECT_EQ(
    done({"Would you be ever so sweet and pass me the blue ball and put the red cube on the left, "
          "my aunt admired it there?",
          "Yes."}),
    "Give BB; Put RC left");
}

TEST(PartialRequests, ItIsTheThingInThePartBefore) {
  EXPECT_EQ(done({"The green cube keeps blorping, put it on the left.", "Yes."}), "Put GC left");
  EXPECT_EQ(done({"The balls are blorping, give them to me.", "Yes."}), "Give BB PB");
  // Where what is before it is a remark, it is done at once.
  EXPECT_EQ(done({"The green cube keeps wobbling, put it on the left."}), "Put GC left");
  EXPECT_EQ(
    done(
      {"My uncle was beside the blue ball yesterday, so take the red cube and put it on the left.",
       "Yes."}),
    "Take RC; Put RC left");
  // Which of them?
  EXPECT_EQ(done({"The green cube wobbles and the red cube wobbles, put it on the left.", "Yes."}),
            "");
  EXPECT_EQ(done({"The blorp keeps wobbling beside the red cube, put it on the left.", "Yes."}),
            "");
}

TEST(PartialRequests, WhatChangesARequestIsNotLeftOut) {
  for (const auto* said :
       {"Give me the blue ball, but not the frizzled one.", "Give me the cubes except the frizzle.",
        "Give me the blue ball unless it frizzles.", "Don't frizzle and give me the blue ball.",
        "Give me the blue ball, but only when I frizzle.", "Give me the blue ball and the frizzle.",
        "Put the red cube on the left, where it frizzled.",
        "Give me the blue ball, the frizzled one.", "Nobody frizzles, give me the blue ball.",
        "Until I frizzle, give me the blue ball.", "I would never frizzle, give me the blue ball.",
        "Give me the blue ball, you must not frizzle it.",
        "I don't want it to frizzle, give me the blue ball.",
        "Give me the blue ball, I mean the frizzled one.",
        "Give me the blue ball without frizzling."}) {
    EXPECT_THAT(text_of_reply({said}), Not(HasSubstr("Do you mean \""))) << said;
    EXPECT_EQ(done({said, "Yes."}), "") << said;
  }
}

TEST(PartialRequests, OtherThingsAreNoAsides) {
  EXPECT_TRUE(is_aside_of_request("and be quick"));
  EXPECT_TRUE(is_aside_of_request("they look so forlorn"));
  EXPECT_TRUE(is_aside_of_request("my uncle was here yesterday and he adored it"));
  EXPECT_TRUE(is_aside_of_request("I don't need it any more"));
  EXPECT_TRUE(is_aside_of_request("that isn't stable"));
  EXPECT_TRUE(is_aside_of_request("and varnish the cube"));
  EXPECT_FALSE(is_aside_of_request("and the frizzle"));
  EXPECT_FALSE(is_aside_of_request("up yonder"));
  EXPECT_FALSE(is_aside_of_request("it mustn't touch the cube"));
  EXPECT_FALSE(is_aside_of_request("I don't want it there"));
  EXPECT_FALSE(is_aside_of_request("the one that glows"));
  EXPECT_FALSE(is_aside_of_request("if you find it blorpy"));
  EXPECT_FALSE(is_aside_of_request("and don't varnish the cube"));
}

TEST(PartialRequests, WhatIsMuchLikeExamplesIsDoneAndSaidBack) {
  const auto reply = reply_to({"Where the red cube is, that's where I'd like the purple ball."});
  ASSERT_EQ(reply.steps.size(), 1U);
  EXPECT_EQ(done({"Where the red cube is, that's where I'd like the purple ball."}),
            "Put PB where RC");
  EXPECT_THAT(reply.text, HasSubstr("for 'put the purple ball where the red cube is'"));
  EXPECT_EQ(done({"Stick blue right of red."}), "Put BB right RC");
  EXPECT_EQ(done({"Stick blue left of red."}), "Put BB left RC");
}

TEST(PartialRequests, WhatIsLessLikeExamplesIsAskedBack) {
  const std::string said = "Place blue ball close with green cube.";
  EXPECT_EQ(text_of_reply({said}),
            "Do you mean \"put the blue ball right next to the green cube\"?");
  EXPECT_EQ(done({said, "Yes."}), "Put BB near GC");
  EXPECT_EQ(done({said, "No."}), "");
}

TEST(PartialRequests, WhatNamesUnknownThingsIsLikeNoExample) {
  EXPECT_THAT(text_of_reply({"Place blue ball close with blorp cube."}),
              Not(HasSubstr("Do you mean")));
}

TEST(PartialRequests, WhatIsLikeRemarksAsksForNothing) {
  for (const auto* said : {"My eyes aren't what they were.", "We want to see friction at work."})
    EXPECT_THAT(text_of_reply({said}), HasSubstr("I see.")) << said;
  EXPECT_EQ(done({"Put the red cube on the left, it's going to roll off into my lap."}),
            "Put RC left");
  // What nobody knows may matter, and so may a question.
  EXPECT_EQ(done({"It is only just blorped in, put the red cube on the left."}), "");
  EXPECT_THAT(text_of_reply({"Did my son telephone this morning?"}), Not(HasSubstr("I see.")));
}

TEST(PartialRequests, CautionsAreLeftOut) {
  EXPECT_EQ(done({"Put the red cube on the left, and mind the yellow cylinder."}), "Put RC left");
  EXPECT_EQ(done({"Please."}), "");
  EXPECT_EQ(done({"And so."}), "");
}

TEST(PartialRequests, ItIsTheThingThatWhatIsNotUnderstoodNames) {
  EXPECT_EQ(done({"Treat the blue ball as blorped.", "Take it."}), "Take BB");
  // Which of them?
  EXPECT_EQ(done({"Treat the blue ball as the red cube's blorp.", "Take it."}), "");
  EXPECT_EQ(done({"Take the red cube.", "Now blorp.", "Put it on the left."}), "");
}

TEST(PartialRequests, APlaceThatIsNotUnderstoodIsAskedFor) {
  const std::string said = "Put the red cube up yonder.";
  EXPECT_EQ(text_of_reply({said}), "I understand that I shall put the red cube somewhere, but not "
                                   "\"up yonder\". Where shall I put it?");
  EXPECT_EQ(done({said, "On the left."}), "Put RC left");
  EXPECT_EQ(done({said, "Next to the blue ball."}), "Put RC near BB");
  EXPECT_EQ(done({said, "Yes."}), "");
  EXPECT_THAT(text_of_reply({"Could you put the two balls over blorpward?"}),
              HasSubstr("I shall put the two balls somewhere"));
  EXPECT_THAT(text_of_reply({"Put the red blorp on the left."}), Not(HasSubstr("somewhere")));
  EXPECT_THAT(text_of_reply({"Put the cube that blorps on the left."}),
              Not(HasSubstr("somewhere")));
}

TEST(PartialRequests, AQuestionIsAnsweredAndTheRestSaidBack) {
  EXPECT_THAT(text_of_reply({"Where is the green cube, my uncle was so fond of it yesterday?"}),
              HasSubstr("I leave out"));
  // What would be so is not answered by what is so.
  EXPECT_THAT(text_of_reply({"Suppose the blue ball vanished, how many balls are there?"}),
              Not(HasSubstr("two balls")));
  EXPECT_THAT(text_of_reply({"If the ball vanished, how many balls are there?"}),
              Not(HasSubstr("two balls")));
}

TEST(PartialRequests, TypingErrorsOutsideOfThemAreNotCorrected) {
  EXPECT_THAT(text_of_reply({"Put the red cube up yonder."}), Not(HasSubstr("I take")));
  EXPECT_THAT(text_of_reply({"Would you be ever so sweet and pass me the bleu ball?"}),
              HasSubstr("I take 'bleu' for 'blue'"));
}

} // namespace castor::communication::test
