// What people say about things on a table who know nothing of the grammar. The sets named `dev`
// have been looked at while the grammar was written; of those named `heldout` only totals are ever
// printed, so that they tell how much is understood of what nobody has looked at.
#include "castor/tests/communication/sentence_judge.hpp"
#include "castor/tests/communication/sentence_set.hpp"
#include "castor/tests/communication/table_talk.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <iostream>
#include <map>
#include <string>
#include <utility>

namespace castor::communication::test {

namespace {

struct SentenceTally {
  std::size_t right = 0;
  std::size_t not_answered = 0;
  std::size_t wrong = 0;

  void add(SentenceJudgement judgement) {
    right += judgement == SentenceJudgement::right ? 1 : 0;
    not_answered += judgement == SentenceJudgement::not_answered ? 1 : 0;
    wrong += judgement == SentenceJudgement::wrong ? 1 : 0;
  }
};

std::ostream& operator<<(std::ostream& out, const SentenceTally& x) {
  return out << x.right << " right, " << x.not_answered << " not answered, " << x.wrong << " wrong";
}

struct SetResult {
  SentenceTally total;
  std::map<std::string, SentenceTally> kinds;
  std::size_t silences = 0;
  /// What was said and replied where the robot was sure and wrong.
  std::string mistakes;
  std::string not_answered;
};

SetResult talk_about(const std::string& name) {
  const auto set = read_sentence_set(std::string{CASTOR_TABLE_SENTENCES} + '/' + name + ".json");
  SetResult result;
  for (auto& dialogue : set.dialogues) {
    auto& things = set.scenes.at(dialogue.scene);
    TableScene table;
    lay_out(things, table);
    TableTalk talk{[&](auto& asked) { return table.reply(asked); },
                   [&](auto& told, auto features) { table.tell(told, std::move(features)); }};
    for (auto& turn : dialogue.turns) {
      const auto reply = talk.say(turn.said);
      const auto judgement = judge(reply, turn.expected, things);
      result.total.add(judgement);
      result.kinds[dialogue.kind].add(judgement);
      result.silences += reply.silences;
      if (judgement == SentenceJudgement::wrong)
        result.mistakes += turn.said + " -- " + reply.text + '\n';
      if (judgement == SentenceJudgement::not_answered)
        result.not_answered += turn.said + " -- " + reply.text + '\n';
    }
  }
  std::cout << name << ": " << result.total << '\n';
  return result;
}

} // namespace

/// Sets that have been looked at.
class SentencesLookedAt : public testing::TestWithParam<std::pair<std::string, std::size_t>> {};

TEST_P(SentencesLookedAt, AreAnsweredRightOrNotAtAll) {
  const auto& [name, right_at_least] = GetParam();
  const auto result = talk_about(name);
  for (auto& [kind, tally] : result.kinds)
    std::cout << "  " << kind << ": " << tally << '\n';
  EXPECT_EQ(result.total.wrong, 0u) << result.mistakes;
  EXPECT_EQ(result.silences, 0u);
  EXPECT_GE(result.total.right, right_at_least) << result.not_answered;
}

INSTANTIATE_TEST_SUITE_P(
  TableSentences, SentencesLookedAt,
  testing::Values(std::pair{std::string{"dev"}, std::size_t{227}},
                  std::pair{std::string{"visitors_dev"}, std::size_t{169}},
                  std::pair{std::string{"dev_2"}, std::size_t{114}},
                  std::pair{std::string{"visitors_dev_2"}, std::size_t{112}},
                  std::pair{std::string{"guests_dev"}, std::size_t{175}},
                  std::pair{std::string{"neighbours_dev"}, std::size_t{156}},
                  std::pair{std::string{"neighbours_dev_2"}, std::size_t{157}},
                  std::pair{std::string{"newcomers_dev"}, std::size_t{205}}));

/// Sets that nobody has looked at who has changed the grammar.
class SentencesNeverLookedAt : public testing::TestWithParam<std::pair<std::string, std::size_t>> {
};

TEST_P(SentencesNeverLookedAt, AreMostlyUnderstood) {
  const auto& [name, right_at_least] = GetParam();
  EXPECT_GE(talk_about(name).total.right, right_at_least);
}

INSTANTIATE_TEST_SUITE_P(TableSentences, SentencesNeverLookedAt,
                         testing::Values(std::pair{std::string{"students_heldout"},
                                                   std::size_t{185}}));

} // namespace castor::communication::test
