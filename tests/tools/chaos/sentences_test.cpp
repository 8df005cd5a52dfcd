#include "castor/tools/chaos/sentences.hpp"
#include "castor/tools/chaos/workload_record.hpp"

#include <gmock/gmock.h>

namespace castor::faults {

namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(Sentences, AnAnswerBelongsToTheSentenceThatItIsAReplyTo) {
  Sentences x;
  for (int i = 0; i < 11; ++i)
    x.said(x.add("Hello.", 0), i * 1s);
  x.answer(x.all()[10].id, false, 12s);
  x.answer("somebody else's", false, 12s);
  x.answer("", false, 12s);
  EXPECT_EQ(x.unanswered().size(), 10U);
  EXPECT_TRUE(x.all()[10].is_answered);
  EXPECT_EQ(x.all()[10].answer_time(), 2s);
}

TEST(Sentences, TheFirstAnswerCounts) {
  Sentences x;
  x.said(x.add("Where is it?", 0), 1s);
  x.answer(x.all()[0].id, true, 2s);
  x.answer(x.all()[0].id, false, 9s);
  EXPECT_TRUE(x.all()[0].apologised);
  EXPECT_EQ(x.all()[0].answer_time(), 1s);
}

TEST(Sentences, OneThatIsSaidAgainIsAnsweredInTimeIfItIsSoonAfterThat) {
  Sentences x;
  auto place = x.add("Hello.", 0);
  x.said(place, 1s);
  x.said(place, 20s);
  EXPECT_THAT(x.unanswered(), ElementsAre(place));
  x.answer(x.all()[0].id, false, 21s);
  EXPECT_EQ(x.all()[0].times_said, 2);
  EXPECT_EQ(x.all()[0].answer_time(), 1s);
}

TEST(Sentences, AnAnswerThatIsSeenBeforeItIsKnownThatItWasSaidCounts) {
  Sentences x;
  auto place = x.add("Hello.", 0);
  x.answer(x.all()[0].id, false, 2s);
  x.said(place, 3s);
  EXPECT_EQ(x.all()[0].times_said, 1);
  EXPECT_EQ(x.all()[0].answer_time(), 0s);
  EXPECT_THAT(x.unanswered(), IsEmpty());
}

TEST(Sentences, WhatIsMissingOrLateIsSaid) {
  Sentences x;
  x.said(x.add("a", 0), 1s);
  x.said(x.add("b", 0), 2s);
  x.said(x.add("c", 0), 3s);
  x.said(x.add("d", 0), 4s);
  x.add("never said", 0);
  x.answer(x.all()[1].id, false, 12s);
  x.answer(x.all()[2].id, false, 4s);
  x.answer(x.all()[3].id, false, std::nullopt);
  auto text = answers_missing(x.all(), 5s);
  EXPECT_EQ(text, "'a', said at 1 s, was not answered\n"
                  "'b', said at 2 s, was answered after 10 s, not within 5 s\n");
  EXPECT_THAT(answers_missing(x.all(), 10s), testing::Not(HasSubstr("'b'")));
  WorkloadRecord record;
  record.statements.push_back({"at 1s say \"a\"", {.due = 5, .done = 4}, "nobody was there"});
  record.took = 10s;
  count_sentences(record, x.all(), 5s);
  auto counts = record.total();
  EXPECT_EQ(counts.said, 4U);
  EXPECT_EQ(counts.answered, 3U);
  EXPECT_EQ(counts.unanswered, 1U);
  EXPECT_EQ(counts.late, 1U);
  EXPECT_EQ(actions_missing(record), "1 of 5 were not done: at 1s say \"a\": nobody was there\n");
  EXPECT_EQ(summary_of(record), "4 sentences, 3 answered, 0 apologised for (0.3 answers a second), "
                                "1 not answered, 1 late; 1 not done");
}

} // namespace

} // namespace castor::faults
