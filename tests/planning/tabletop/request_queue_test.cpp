#include "castor/planning/tabletop/request_queue.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace castor::planning {

namespace {

using testing::ElementsAre;
using testing::IsEmpty;

RequestedStep step(const std::string& move, const std::string& action) {
  RequestedStep result;
  result.move = {Address{"communication", move}};
  result.what.action = action;
  return result;
}

/// To the left.
RequestedStep put(const std::string& move, const std::string& thing) {
  auto result = step(move, "Put");
  result.what.things = {thing};
  result.what.places = {{"left", {}}};
  return result;
}

Address motive(const std::string& id) {
  return {"motivation", id};
}

communication::MoveReferents correction() {
  communication::MoveReferents result;
  result.corrects = true;
  return result;
}

communication::MoveReferents first() {
  communication::MoveReferents result;
  result.comes_first = true;
  return result;
}

class RequestQueueTest : public testing::Test {
protected:
  /// Actions of the steps as they would be done from now on, if all can be.
  std::vector<std::string> rest() {
    std::vector<std::string> result;
    while (const auto* next = queue.next())
      result.push_back(next->what.action);
    return result;
  }

  /// The next step is begun. \returns its action
  std::string begin(const std::string& id = "m") {
    const auto* next = queue.next();
    if (next == nullptr)
      return {};
    const auto action = next->what.action;
    queue.begin(motive(id), action + " is done");
    return action;
  }

  RequestQueue queue;
};

} // namespace

TEST_F(RequestQueueTest, HasOneStepDoneAtATime) {
  EXPECT_EQ(queue.add({step("a", "Take"), step("a", "Put")}, {}).id, "");
  queue.add({step("b", "Give")}, {});
  EXPECT_EQ(begin(), "Take");
  EXPECT_TRUE(queue.is_busy());
  EXPECT_EQ(queue.steps().result, "Take is done");
  EXPECT_EQ(queue.next(), nullptr);
  queue.done();
  EXPECT_FALSE(queue.is_busy());
  EXPECT_THAT(rest(), ElementsAre("Put", "Give"));
}

TEST_F(RequestQueueTest, PutsBackWhatWasTakenByMistake) {
  auto wrong = step("a", "Take");
  wrong.what.things = {"cylinder"};
  auto right = step("b", "Take");
  right.what.things = {"disc"};
  queue.add({wrong}, {});
  begin();
  queue.done();
  EXPECT_EQ(queue.add({right}, correction()).id, "");
  const auto* next = queue.next();
  ASSERT_NE(next, nullptr);
  EXPECT_EQ(next->what.action, "PutBack");
  EXPECT_THAT(next->what.things, ElementsAre("cylinder"));
  EXPECT_EQ(next->move.address.id, "b");
  EXPECT_THAT(rest(), ElementsAre("Take"));
}

TEST_F(RequestQueueTest, PutsBackWhatWasPutThereByMistake) {
  auto wrong = step("a", "Put");
  wrong.what.things = {"cylinder"};
  wrong.what.places = {{"left", {"ball"}}};
  auto right = wrong;
  right.move = {Address{"communication", "b"}};
  right.what.things = {"disc"};
  queue.add({wrong}, {});
  begin();
  queue.done();
  queue.add({right}, correction());
  const auto* next = queue.next();
  ASSERT_NE(next, nullptr);
  EXPECT_EQ(next->what.action, "PutBack");
  EXPECT_THAT(next->what.things, ElementsAre("cylinder"));
  EXPECT_THAT(rest(), ElementsAre("Put"));
}

TEST_F(RequestQueueTest, PutsNothingBackIfAnotherPlaceIsMeant) {
  auto wrong = step("a", "Put");
  wrong.what.things = {"cylinder"};
  wrong.what.places = {{"left", {"ball"}}};
  auto right = wrong;
  right.what.places = {{"left", {"disc"}}};
  queue.add({wrong}, {});
  begin();
  queue.done();
  queue.add({right}, correction());
  EXPECT_THAT(rest(), ElementsAre("Put"));
}

TEST_F(RequestQueueTest, PutsNothingBackThatIsNotHeldOrIsMeantOnceMore) {
  auto taken = step("a", "Take");
  taken.what.things = {"cylinder"};
  queue.add({taken}, {});
  begin();
  queue.add({step("b", "Put")}, correction());
  EXPECT_THAT(rest(), ElementsAre("Put"));
  begin();
  queue.add({taken}, {});
  begin();
  queue.done();
  queue.add({taken}, correction());
  EXPECT_THAT(rest(), ElementsAre("Take"));
}

TEST_F(RequestQueueTest, LeavesOutWhatComesAfterAStepThatCannotBeDone) {
  queue.add({step("a", "Take"), step("a", "Put")}, {});
  queue.add({step("b", "Give")}, {});
  begin();
  queue.give_up();
  EXPECT_FALSE(queue.is_busy());
  EXPECT_THAT(rest(), ElementsAre("Give"));
}

TEST_F(RequestQueueTest, GoesOnWithWhatDoesNotDependOnAStepThatCannotBeDone) {
  auto ball = step("a", "Put");
  ball.what.things = {"ball"};
  ball.what.places = {{"near", {"box"}}};
  auto cube = step("a", "Put");
  cube.what.things = {"cube"};
  cube.what.places = {{"left", {}}};
  auto beside = step("a", "Put");
  beside.what.things = {"disc"};
  beside.what.places = {{"near", {"ball"}}};
  auto on_disc = step("a", "Put");
  on_disc.what.things = {"ring"};
  on_disc.what.places = {{"on", {"disc"}}};
  queue.add({ball, beside, cube, on_disc}, {});
  begin();
  EXPECT_TRUE(queue.give_up());
  EXPECT_EQ(queue.steps().waiting, std::vector{cube});
  begin();
  EXPECT_FALSE(queue.give_up());
}

TEST_F(RequestQueueTest, DoesNothingAnyMoreWhenItIsToStop) {
  queue.add({step("a", "Take"), step("a", "Put")}, {});
  begin("m1");
  EXPECT_EQ(queue.stop(), motive("m1"));
  EXPECT_FALSE(queue.is_busy());
  EXPECT_EQ(queue.next(), nullptr);
  EXPECT_EQ(queue.stop().id, "");
}

TEST_F(RequestQueueTest, GoesOnWithWhatWasStopped) {
  queue.add({step("a", "Take"), step("a", "Put")}, {});
  queue.add({step("b", "Give")}, {});
  begin("m1");
  queue.stop();
  queue.stop();
  EXPECT_TRUE(queue.go_on());
  EXPECT_THAT(rest(), ElementsAre("Take", "Put", "Give"));
  EXPECT_FALSE(queue.go_on());
}

TEST_F(RequestQueueTest, ForgetsWhatWasStoppedWhenSomethingElseIsBegun) {
  queue.add({step("a", "Take")}, {});
  begin("m1");
  queue.stop();
  queue.add({step("b", "Give")}, {});
  begin("m2");
  // To go on is to go on with that.
  EXPECT_TRUE(queue.go_on());
  queue.done();
  EXPECT_FALSE(queue.go_on());
  EXPECT_THAT(rest(), IsEmpty());
}

TEST_F(RequestQueueTest, HasNothingToGoOnWithAtFirst) {
  EXPECT_FALSE(queue.go_on());
}

TEST_F(RequestQueueTest, WaitsUntilItIsToGoOnOrToStop) {
  EXPECT_FALSE(queue.resume());
  queue.pause();
  EXPECT_TRUE(queue.resume());
  EXPECT_FALSE(queue.resume());
  queue.pause();
  queue.stop();
  EXPECT_FALSE(queue.resume());
}

TEST_F(RequestQueueTest, BeginsNothingWhileItWaits) {
  queue.add({step("a", "Put")}, {});
  queue.pause();
  EXPECT_EQ(queue.next(), nullptr);
  queue.resume();
  EXPECT_NE(queue.next(), nullptr);
}

TEST_F(RequestQueueTest, ReplacesTheRequestThatIsBeingDone) {
  queue.add({step("a", "Take"), step("a", "Put")}, {});
  begin("m1");
  EXPECT_EQ(queue.add({step("b", "Push")}, correction()), motive("m1"));
  EXPECT_THAT(rest(), ElementsAre("Push"));
}

TEST_F(RequestQueueTest, ReplacesTheLastRequestOnlyIfSeveralWait) {
  queue.add({step("a", "Take")}, {});
  queue.add({step("b", "Give")}, {});
  queue.add({step("c", "Sort"), step("c", "Clear")}, {});
  EXPECT_EQ(begin(), "Take");
  EXPECT_EQ(queue.add({step("d", "Push")}, correction()).id, "");
  EXPECT_TRUE(queue.is_busy());
  queue.done();
  EXPECT_THAT(rest(), ElementsAre("Give", "Push"));
}

TEST_F(RequestQueueTest, TriesAnotherOneOfThoseThatWillDo) {
  auto one = step("a", "Put");
  one.what.things = {"x", "y"};
  one.what.number = 1;
  queue.add({one}, {});
  queue.next();
  queue.begin(motive("m"), "", {"x"});
  EXPECT_TRUE(queue.try_again(false));
  const auto* next = queue.next();
  ASSERT_NE(next, nullptr);
  EXPECT_THAT(next->what.things, ElementsAre("y"));
  queue.begin(motive("n"), "", {"y"});
  EXPECT_FALSE(queue.try_again(false));
}

TEST_F(RequestQueueTest, TriesOnceMoreWhatIsLeftOfSeveral) {
  auto all = step("a", "Put");
  all.what.things = {"x", "y"};
  queue.add({all}, {});
  begin();
  EXPECT_FALSE(queue.try_again(false));
  EXPECT_TRUE(queue.try_again(true));
  begin();
  EXPECT_FALSE(queue.try_again(true));
}

TEST_F(RequestQueueTest, DoesNotPutBackTwiceWhatACorrectionPutsBack) {
  auto back = step("b", "PutBack");
  back.what.things = {"x"};
  queue.add({put("a", "x")}, {});
  begin();
  queue.done();
  queue.add({put("b", "y"), back}, correction());
  EXPECT_THAT(rest(), ElementsAre("PutBack", "Put"));
}

/// "It was better before. Put it back."
TEST_F(RequestQueueTest, PutsBackOnceWhatIsSaidTwice) {
  auto back = step("b", "PutBack");
  back.what.things = {"x"};
  queue.add({step("a", "Undo")}, {});
  begin();
  queue.add({back}, {});
  EXPECT_FALSE(queue.has_steps_of(back.move.address));
  queue.done();
  queue.add({back}, {});
  EXPECT_THAT(rest(), ElementsAre("PutBack"));
  auto other = step("c", "PutBack");
  other.what.things = {"y"};
  queue.add({back, other}, {});
  EXPECT_THAT(rest(), ElementsAre("PutBack", "PutBack"));
}

TEST_F(RequestQueueTest, PutsBackNothingWhereNothingHadToBeMoved) {
  queue.add({put("a", "x")}, {});
  begin();
  queue.done(true);
  queue.add({put("b", "y")}, correction());
  EXPECT_THAT(rest(), ElementsAre("Put"));
}

TEST_F(RequestQueueTest, ThereIsWhereTheRequestBeforeIsDone) {
  auto left = step("a", "Clear");
  left.what.places = {{"left", {}}};
  auto there = step("b", "Clear");
  there.what.places = {{"there", {}}};
  queue.add({left}, {});
  begin();
  queue.add({there}, {});
  ASSERT_EQ(queue.steps().waiting.size(), 1u);
  EXPECT_EQ(queue.steps().waiting.front().what.places, left.what.places);
}

TEST_F(RequestQueueTest, AddsACorrectionOfWhatIsDoneAlready) {
  queue.add({step("a", "Take")}, {});
  begin();
  queue.done();
  EXPECT_EQ(queue.add({step("b", "Push")}, correction()).id, "");
  EXPECT_THAT(rest(), ElementsAre("Push"));
}

TEST_F(RequestQueueTest, DoesFirstWhatIsToBeFirst) {
  queue.add({step("a", "Take"), step("a", "Put")}, {});
  begin("m1");
  EXPECT_EQ(queue.add({step("b", "Push")}, first()), motive("m1"));
  EXPECT_THAT(rest(), ElementsAre("Push", "Take", "Put"));
}

TEST_F(RequestQueueTest, TriesAgainWhatWasGivenUpAfterWhatIsToBeFirst) {
  queue.add({step("a", "Take"), step("a", "Put"), step("a", "Give")}, {});
  begin("m1");
  queue.done();
  begin("m2");
  queue.give_up();
  EXPECT_THAT(queue.steps().waiting, IsEmpty());
  queue.add({step("b", "Push")}, first());
  EXPECT_THAT(rest(), ElementsAre("Push", "Put", "Give"));
}

TEST_F(RequestQueueTest, ForgetsWhatWasGivenUpWhenSomethingElseIsBegun) {
  queue.add({step("a", "Take")}, {});
  begin();
  queue.give_up();
  queue.add({step("b", "Give")}, {});
  begin();
  queue.done();
  queue.add({step("c", "Push")}, first());
  EXPECT_THAT(rest(), ElementsAre("Push"));
}

TEST_F(RequestQueueTest, GoesOnWithWhatAPredecessorKnew) {
  queue.add({step("a", "Take"), step("a", "Put")}, {});
  begin("m1");
  const auto known = queue.steps();
  RequestQueue successor;
  successor.recall(known, true);
  EXPECT_EQ(successor.steps(), known);
  EXPECT_TRUE(successor.is_busy());
  // The motive was never added, or is forgotten.
  successor.recall(known, false);
  EXPECT_FALSE(successor.is_busy());
  ASSERT_NE(successor.next(), nullptr);
  EXPECT_EQ(successor.steps().current.what.action, "Take");
}

TEST_F(RequestQueueTest, UndoesWhatIsHalfDoneBeforeOtherRequests) {
  queue.add({step("a", "Swap"), step("a", "Put")}, {});
  queue.add({step("b", "Give")}, {});
  begin();
  queue.give_up(true);
  EXPECT_EQ(queue.steps().waiting.front().move.address.id, "a");
  EXPECT_THAT(rest(), ElementsAre("Undo", "Give"));
}

TEST(WithoutNeedlessMoves, WhatIsGivenNextIsNotPutSomewhereBefore) {
  auto off = step("a", "Put");
  off.what.things = {"cube"};
  off.what.places = {{"elsewhere", {}}};
  auto give = step("a", "Give");
  give.what.things = {"cube"};
  EXPECT_EQ(without_needless_moves({off, give}), std::vector{give});
  auto other = give;
  other.what.things = {"ball"};
  EXPECT_EQ(without_needless_moves({off, other}).size(), 2U);
  auto left = off;
  left.what.places = {{"left", {}}};
  EXPECT_EQ(without_needless_moves({left, give}).size(), 2U);
  EXPECT_EQ(without_needless_moves({off, left}).size(), 2U);
  EXPECT_EQ(without_needless_moves({give, off}).size(), 2U);
}

TEST(WithoutNeedlessMoves, WhatIsPutSomewhereNextIsNotTakenBefore) {
  auto take = step("a", "Take");
  take.what.things = {"cube"};
  auto put = step("a", "Put");
  put.what.things = {"cube"};
  put.what.places = {{"left", {}}};
  EXPECT_EQ(without_needless_moves({take, put}), std::vector{put});
  auto other = put;
  other.what.things = {"ball"};
  EXPECT_EQ(without_needless_moves({take, other}).size(), 2U);
  EXPECT_EQ(without_needless_moves({put, take}).size(), 2U);
}

} // namespace castor::planning
