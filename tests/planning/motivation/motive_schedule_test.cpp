#include "castor/planning/motivation/motive_schedule.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <map>
#include <random>
#include <string>
#include <vector>

namespace castor::planning {
namespace {

using namespace std::chrono_literals;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;

Motive motive(const std::string& words, double priority, std::vector<std::string> resources,
              const std::string& asker = "ann") {
  Motive result;
  result.words = words;
  result.goal.goal = "(" + words + ")";
  result.priority = priority;
  result.resources = std::move(resources);
  result.asker = asker;
  result.because = asker + " asked for it";
  return result;
}

MotiveOrder begin(const std::string& id) {
  return {MotiveOrder::Kind::begin, id};
}

MotiveOrder end(const std::string& id) {
  return {MotiveOrder::Kind::end, id};
}

class MotiveScheduleTest : public testing::Test {
protected:
  MotiveStatus status(const std::string& id) const { return schedule.motive(id).status; }
  std::string why(const std::string& id) const { return schedule.motive(id).history.back().why; }
  std::vector<MotiveStatus> history(const std::string& id) const {
    std::vector<MotiveStatus> result;
    for (const auto& x : schedule.motive(id).history)
      result.push_back(x.status);
    return result;
  }

  MotiveSchedule schedule;
};

TEST_F(MotiveScheduleTest, PursuesOneMotiveForEachResource) {
  schedule.propose("find", motive("find the book", 1, {"base"}), 1s);
  schedule.propose("say", motive("say hello", 1, {"voice"}), 2s);
  schedule.propose("go", motive("go home", 1, {"base"}), 3s);
  EXPECT_THAT(schedule.take_orders(), ElementsAre(begin("find"), begin("say")));
  EXPECT_EQ(status("go"), MotiveStatus::queued);
  schedule.ended("find", ActionOutcome::succeeded, "", 4s);
  EXPECT_THAT(schedule.take_orders(), ElementsAre(begin("go")));
  EXPECT_EQ(status("find"), MotiveStatus::completed);
  EXPECT_THAT(history("find"), ElementsAre(MotiveStatus::proposed, MotiveStatus::queued,
                                           MotiveStatus::active, MotiveStatus::completed));
  EXPECT_EQ(schedule.motive("find").history.back().time, 4'000'000);
}

TEST_F(MotiveScheduleTest, BeginsAgainWhatWasInterrupted) {
  schedule.propose("find", motive("find the book", 1, {"base"}), 0s);
  for (int i = 1; i <= 5; ++i) {
    EXPECT_THAT(schedule.take_orders(), ElementsAre(begin("find"))) << i;
    schedule.interrupted("find", "the planner ended", 1s);
    EXPECT_EQ(status("find"), MotiveStatus::active);
  }
  EXPECT_THAT(schedule.take_orders(), ElementsAre(begin("find")));
  schedule.interrupted("find", "the planner ended", 2s);
  EXPECT_EQ(status("find"), MotiveStatus::dropped) << "after too often";
  EXPECT_EQ(why("find"), "the planner ended");
  EXPECT_THAT(schedule.take_orders(), IsEmpty());
}

TEST_F(MotiveScheduleTest, DropsWhatNobodyWantsAnyMoreThoughItsPlannerHasEnded) {
  schedule.propose("find", motive("find the book", 1, {"base"}), 0s);
  schedule.withdraw("find", "nobody wants it any more", 1s);
  schedule.interrupted("find", "the planner ended", 2s);
  EXPECT_EQ(status("find"), MotiveStatus::dropped);
  EXPECT_EQ(why("find"), "nobody wants it any more");
}

TEST_F(MotiveScheduleTest, TakesTheMoreUrgentThenTheCheaperThenTheOlderOne) {
  schedule.propose("now", motive("now", 9, {"base"}), 0s);
  schedule.propose("a", motive("a", 1, {"base"}), 0s);
  auto expensive = motive("b", 2, {"base"});
  expensive.cost = 5;
  schedule.propose("b", expensive, 0s);
  schedule.propose("c", motive("c", 2, {"base"}), 0s);
  schedule.propose("d", motive("d", 2, {"base"}), 0s);
  std::vector<std::string> order;
  for (std::string current = "now"; order.size() < 4;) {
    schedule.take_orders();
    schedule.ended(current, ActionOutcome::succeeded, "", 1s);
    const auto orders = schedule.take_orders();
    ASSERT_EQ(orders.size(), 1U);
    current = orders.front().motive;
    order.push_back(current);
  }
  EXPECT_THAT(order, ElementsAre("c", "d", "b", "a"));
}

TEST_F(MotiveScheduleTest, EndsALessUrgentMotiveAndResumesItLater) {
  schedule.propose("find", motive("find the book", 1, {"base"}), 1s);
  schedule.take_orders();
  schedule.propose("charge", motive("charge", 9, {"base"}, ""), 2s);
  EXPECT_THAT(schedule.take_orders(), ElementsAre(end("find")));
  EXPECT_EQ(status("charge"), MotiveStatus::queued) << "until the base stands still";
  schedule.ended("find", ActionOutcome::cancelled, "the base stands still", 3s);
  EXPECT_THAT(schedule.take_orders(), ElementsAre(begin("charge")));
  EXPECT_EQ(status("find"), MotiveStatus::queued);
  EXPECT_THAT(why("find"), HasSubstr("it is more urgent to charge"));
  schedule.ended("charge", ActionOutcome::succeeded, "", 4s);
  EXPECT_THAT(schedule.take_orders(), ElementsAre(begin("find")));
}

TEST_F(MotiveScheduleTest, CompletesWhatIsDoneBeforeItCouldBeEnded) {
  schedule.propose("find", motive("find the book", 1, {"base"}), 1s);
  schedule.propose("charge", motive("charge", 9, {"base"}), 2s);
  schedule.ended("find", ActionOutcome::succeeded, "", 3s);
  EXPECT_EQ(status("find"), MotiveStatus::completed);
  EXPECT_EQ(status("charge"), MotiveStatus::active);
}

TEST_F(MotiveScheduleTest, KeepsWhatAMoreUrgentOneWaitsForFromOthers) {
  schedule.propose("carry", motive("carry", 5, {"arm"}), 1s);
  schedule.propose("both", motive("both", 4, {"arm", "base"}), 2s);
  schedule.propose("go", motive("go", 1, {"base"}), 3s);
  EXPECT_THAT(schedule.take_orders(), ElementsAre(begin("carry")));
  schedule.ended("carry", ActionOutcome::succeeded, "", 4s);
  EXPECT_THAT(schedule.take_orders(), ElementsAre(begin("both")));
}

TEST_F(MotiveScheduleTest, RejectsConflictsAndDuplicates) {
  auto left = motive("put the ball left of the box", 3, {"arm"}, "ann");
  left.about = "ball";
  auto right = motive("put the ball right of the box", 3, {"arm"}, "bob");
  right.about = "ball";
  schedule.propose("left", left, 1s);
  schedule.propose("right", right, 2s);
  EXPECT_EQ(status("right"), MotiveStatus::rejected);
  EXPECT_EQ(why("right"),
            "I am about to put the ball left of the box, because ann asked for it before");
  auto same = left;
  same.asker = "bob";
  schedule.propose("same", same, 2s);
  EXPECT_EQ(status("same"), MotiveStatus::rejected);
  // Once it is done, the other one may be wished for.
  schedule.ended("left", ActionOutcome::succeeded, "", 3s);
  schedule.propose("right again", right, 4s);
  EXPECT_EQ(status("right again"), MotiveStatus::active);
}

TEST_F(MotiveScheduleTest, DropsALessUrgentMotiveThatConflicts) {
  auto left = motive("put it left", 3, {"arm"});
  left.about = "ball";
  auto away = motive("put it away", 8, {"base"});
  away.about = "ball";
  schedule.propose("left", left, 1s);
  schedule.take_orders();
  schedule.propose("away", away, 2s);
  EXPECT_THAT(schedule.take_orders(), ElementsAre(end("left")));
  EXPECT_EQ(status("away"), MotiveStatus::queued);
  schedule.ended("left", ActionOutcome::cancelled, "", 3s);
  EXPECT_EQ(status("left"), MotiveStatus::dropped);
  EXPECT_THAT(why("left"), HasSubstr("more urgent to put it away"));
  EXPECT_EQ(status("away"), MotiveStatus::active);
}

TEST_F(MotiveScheduleTest, DropsWhatFailedAndWhatIsWithdrawn) {
  schedule.propose("a", motive("a", 1, {"base"}), 1s);
  schedule.propose("b", motive("b", 1, {"base"}), 1s);
  schedule.propose("c", motive("c", 1, {"base"}), 1s);
  schedule.ended("a", ActionOutcome::failed, "there is no plan", 2s);
  EXPECT_EQ(status("a"), MotiveStatus::dropped);
  EXPECT_EQ(why("a"), "there is no plan");
  schedule.take_orders();
  schedule.withdraw("c", "ann does not want it any more", 3s);
  EXPECT_EQ(status("c"), MotiveStatus::dropped);
  schedule.withdraw("b", "ann does not want it any more", 3s);
  EXPECT_THAT(schedule.take_orders(), ElementsAre(end("b")));
  schedule.ended("b", ActionOutcome::cancelled, "", 4s);
  EXPECT_EQ(status("b"), MotiveStatus::dropped);
  EXPECT_EQ(why("b"), "ann does not want it any more");
}

TEST_F(MotiveScheduleTest, DropsWhatHasWaitedForTooLong) {
  schedule.propose("a", motive("a", 5, {"base"}), 0s);
  auto impatient = motive("b", 1, {"base"});
  impatient.patience = 10;
  schedule.propose("b", impatient, 0s);
  schedule.drop_old(9s);
  EXPECT_EQ(status("b"), MotiveStatus::queued);
  schedule.drop_old(10s);
  EXPECT_EQ(status("b"), MotiveStatus::dropped);
  EXPECT_EQ(status("a"), MotiveStatus::active);
}

TEST_F(MotiveScheduleTest, AnswersQuestionsAboutItself) {
  const auto ask = [&](MotiveQuestionKind kind, const std::string& about = "") {
    return schedule.answer({kind, about});
  };
  using Kind = MotiveQuestionKind;
  EXPECT_EQ(ask(Kind::doing), "I am doing nothing.");
  EXPECT_EQ(ask(Kind::next), "I have nothing else to do.");
  EXPECT_EQ(ask(Kind::why), "I know of nothing like that that I did.");
  auto find = motive("find the book", 2, {"base"});
  find.because = "ann said 'find the book'";
  schedule.propose("find", find, 1s);
  auto tidy = motive("tidy up", 1, {"base"}, "");
  tidy.because = "the table is full";
  schedule.propose("tidy", tidy, 2s);
  EXPECT_EQ(ask(Kind::doing), "I am about to find the book, because ann said 'find the book'.");
  EXPECT_EQ(ask(Kind::next), "Then I will tidy up, because the table is full.");
  EXPECT_EQ(ask(Kind::why), "Because ann said 'find the book'.");
  EXPECT_EQ(ask(Kind::why_not, "tidy"), "I will tidy up as soon as I can.");
  schedule.ended("find", ActionOutcome::failed, "nobody knows where it is", 3s);
  EXPECT_EQ(ask(Kind::why_not, "book"), "Because nobody knows where it is.");
  EXPECT_EQ(ask(Kind::done), "I was to find the book, but did not: nobody knows where it is.");
  EXPECT_EQ(ask(Kind::whether, "book"),
            "No: I was to find the book, but nobody knows where it is.");
  EXPECT_EQ(ask(Kind::whether), "Not yet: I am about to tidy up.");
  schedule.ended("tidy", ActionOutcome::succeeded, "", 4s);
  EXPECT_EQ(ask(Kind::whether), "I was to tidy up, and that is done.");
  EXPECT_EQ(ask(Kind::done),
            "The last thing that I did was to tidy up, because the table is full.");
  EXPECT_EQ(ask(Kind::whether, "ball"), "I know of nothing like that that I was to do.");
}

TEST_F(MotiveScheduleTest, IsAskedAboutMotivesByTheirWords) {
  auto ball = motive("put the blue ball on the left", 1, {"arm"});
  ball.because = "you said so";
  schedule.propose("ball", ball, 0s);
  schedule.ended("ball", ActionOutcome::succeeded, "", 1s);
  const auto why = [&](const std::string& about) {
    return schedule.answer({MotiveQuestionKind::why, about});
  };
  EXPECT_EQ(why("blue ball|sphere"), "Because you said so.");
  EXPECT_EQ(why("red ball|sphere"), "I know of nothing like that that I did.");
  // Words as a whole.
  EXPECT_EQ(why("all"), "I know of nothing like that that I did.");
}

TEST_F(MotiveScheduleTest, KnowsMotivesThatWereOverBefore) {
  auto ball = motive("put the ball away", 1, {"arm"});
  ball.status = MotiveStatus::rejected;
  ball.history = {{1, MotiveStatus::rejected, "I do not see it any more"}};
  schedule.recall("ball", ball);
  EXPECT_EQ(schedule.answer({MotiveQuestionKind::why_not, ""}),
            "Because I do not see it any more.");
  EXPECT_TRUE(schedule.take_orders().empty());
}

TEST_F(MotiveScheduleTest, KnowsThatFurtherMotivesWillCome) {
  const MotiveQuestion next{MotiveQuestionKind::next, ""};
  EXPECT_EQ(schedule.answer(next, {"you said 'take it'", "you said 'stop'"}),
            "Then I will do something else, because you said 'take it'.");
  // What is queued comes before that.
  schedule.propose("a", motive("a", 2, {"base"}), 0s);
  schedule.propose("b", motive("b", 1, {"base"}), 0s);
  EXPECT_THAT(schedule.answer(next, {"you said 'take it'"}), testing::StartsWith("Then I will b"));
}

TEST_F(MotiveScheduleTest, DoesNotSayHowAPlannerSearches) {
  schedule.propose("a", motive("a", 1, {"base"}), 0s);
  schedule.ended("a", ActionOutcome::failed,
                 "there is no plan: all states that can be reached were looked at, 7", 1s);
  for (const auto kind :
       {MotiveQuestionKind::why_not, MotiveQuestionKind::done, MotiveQuestionKind::whether})
    EXPECT_THAT(schedule.answer({kind, ""}),
                testing::HasSubstr("as things are now, nothing that I can do leads to that"));
}

TEST_F(MotiveScheduleTest, ForgetsOldMotivesThatAreOver) {
  MotiveSchedule small(2);
  for (int i = 0; i < 10; ++i) {
    const auto id = std::to_string(i);
    small.propose(id, motive(id, 1, {"base"}), 0s);
    small.ended(id, ActionOutcome::succeeded, "", 0s);
    small.take_changed();
  }
  small.propose("last", motive("last", 1, {}), 0s);
  EXPECT_THAT(small.take_forgotten(), testing::Contains("0"));
  EXPECT_FALSE(small.knows("0"));
  EXPECT_TRUE(small.knows("9"));
}

/// Whatever happens, no resource is used twice, orders fit the statuses, and all motives end.
TEST(MotiveScheduleProperties, NeverUsesAResourceTwiceAndLosesNoMotive) {
  const std::vector<std::string> all{"arm", "base", "voice", "camera"};
  for (unsigned seed = 0; seed < 500; ++seed) {
    std::mt19937 random(seed);
    MotiveSchedule schedule;
    std::map<std::string, bool> running; // whether it is to end
    std::vector<std::string> ids;
    const auto follow_orders = [&] {
      for (const auto& x : schedule.take_orders())
        if (x.kind == MotiveOrder::Kind::begin) {
          ASSERT_FALSE(running.contains(x.motive)) << seed;
          running[x.motive] = false;
        } else {
          ASSERT_TRUE(running.contains(x.motive)) << seed;
          ASSERT_FALSE(running[x.motive]) << "ended twice, " << seed;
          running[x.motive] = true;
        }
      std::map<std::string, int> uses;
      for (const auto& [id, ends] : running)
        for (const auto& x : schedule.motive(id).resources)
          ASSERT_EQ(++uses[x], 1) << x << ' ' << seed;
    };
    const auto end_one = [&](Timestamp now) {
      auto chosen =
        std::next(running.begin(), static_cast<std::ptrdiff_t>(random() % running.size()));
      const auto [id, ends] = *chosen;
      running.erase(chosen);
      schedule.ended(id,
                     ends ? ActionOutcome::cancelled
                          : (random() % 2 ? ActionOutcome::succeeded : ActionOutcome::failed),
                     "over", now);
    };
    for (int i = 0; i < 60; ++i) {
      const Timestamp now{i};
      if (random() % 2 || running.empty()) {
        ids.push_back(std::to_string(i));
        auto x = motive(ids.back(), static_cast<double>(random() % 5), {});
        for (const auto& name : all)
          if (random() % 3 == 0)
            x.resources.push_back(name);
        if (random() % 3 == 0)
          x.about = "thing " + std::to_string(random() % 3);
        schedule.propose(ids.back(), x, now);
      } else if (random() % 4 == 0) {
        schedule.withdraw(ids[random() % ids.size()], "no more", now);
      } else {
        end_one(now);
      }
      follow_orders();
    }
    for (int i = 0; !running.empty(); ++i) {
      ASSERT_LT(i, 1000) << seed;
      end_one(Timestamp{100 + i});
      follow_orders();
    }
    for (const auto& id : ids) {
      const auto status = schedule.motive(id).status;
      EXPECT_TRUE(status == MotiveStatus::completed || status == MotiveStatus::dropped ||
                  status == MotiveStatus::rejected)
        << id << ' ' << seed;
    }
  }
}

} // namespace
} // namespace castor::planning
