#include "castor/actors/runtime/executed_actions.hpp"

#include <gtest/gtest.h>

namespace castor {

namespace {

const Address first{"a", "1"};
const Address second{"a", "2"};
const Address other{"c", "1"};

class ExecutedActionsTest : public testing::Test {
protected:
  void SetUp() override {
    actions.offer("Grasp", false);
    actions.offer("Look", true);
  }

  /// Id of the action that begins; empty for none.
  std::string begin() {
    auto x = actions.begin_next();
    return x ? x->action.id : "";
  }

  ExecutedActions actions;
};

TEST_F(ExecutedActionsTest, BeginOneAfterTheOtherInTheOrderOfTheirProposal) {
  actions.propose(first, "Grasp");
  actions.propose(second, "Grasp");
  EXPECT_EQ(begin(), "1");
  EXPECT_EQ(begin(), "");
  actions.finish(first);
  EXPECT_EQ(begin(), "2");
}

TEST_F(ExecutedActionsTest, PreferredOnesBeginBeforeThoseThatWait) {
  actions.propose(first, "Grasp");
  actions.propose(second, "Grasp");
  actions.propose(other, "Grasp");
  const Address last{"a", "4"};
  actions.propose(last, "Grasp");
  actions.prefer(second);
  actions.prefer(last);
  actions.prefer(last);
  actions.prefer({"a", "9"});
  for (const std::string id : {"2", "4", "1"}) {
    const auto next = actions.begin_next();
    ASSERT_TRUE(next);
    EXPECT_EQ(next->action.id, id);
    actions.finish(next->action);
  }
  EXPECT_EQ(begin(), "1");
}

TEST_F(ExecutedActionsTest, BeginAlongsideOthersIfTheirTypeMay) {
  actions.propose(first, "Grasp");
  actions.propose(second, "Grasp");
  actions.propose(other, "Look");
  EXPECT_EQ(begin(), "1");
  EXPECT_EQ(begin(), other.id);
  EXPECT_TRUE(actions.is_under_way(other));
}

TEST_F(ExecutedActionsTest, AreNotTakenTwice) {
  actions.propose(first, "Grasp");
  actions.propose(first, "Grasp");
  EXPECT_EQ(begin(), "1");
  actions.propose(first, "Grasp");
  actions.finish(first);
  EXPECT_EQ(begin(), "");
}

TEST_F(ExecutedActionsTest, OfTypesThatAreNotOfferedAreIgnored) {
  actions.propose(first, "Fly");
  EXPECT_EQ(begin(), "");
}

TEST_F(ExecutedActionsTest, ThatWereDeletedDoNotBegin) {
  actions.propose(first, "Grasp");
  EXPECT_FALSE(actions.deleted(first));
  EXPECT_EQ(begin(), "");
  actions.propose(other, "Grasp");
  EXPECT_FALSE(actions.memory_lost("c"));
  EXPECT_EQ(begin(), "");
}

TEST_F(ExecutedActionsTest, KnowThatTheirRequesterIsGoneWithItsSpecificEntry) {
  actions.propose(first, "Grasp");
  begin();
  actions.set_specific_entry(first, second);
  EXPECT_FALSE(actions.deleted(other));
  EXPECT_FALSE(actions.is_requester_gone(first));
  EXPECT_TRUE(actions.deleted(second));
  EXPECT_TRUE(actions.is_requester_gone(first));
}

TEST_F(ExecutedActionsTest, KnowThatTheirRequesterIsGoneWithItsWorkingMemory) {
  actions.propose(first, "Grasp");
  begin();
  EXPECT_FALSE(actions.memory_lost("c"));
  EXPECT_TRUE(actions.memory_lost("a"));
  EXPECT_TRUE(actions.is_requester_gone(first));
}

TEST_F(ExecutedActionsTest, TellOnceThatTheirEntryWasWritten) {
  actions.propose(first, "Grasp");
  begin();
  EXPECT_FALSE(actions.take_changed(first));
  EXPECT_TRUE(actions.changed(first));
  EXPECT_TRUE(actions.is_changed(first));
  EXPECT_TRUE(actions.take_changed(first));
  EXPECT_FALSE(actions.take_changed(first));
  actions.finish(first);
  EXPECT_FALSE(actions.changed(first));
}

} // namespace

} // namespace castor
