#include "castor/actors/supervision/failover.hpp"

#include "castor/tests/actors/node/support.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

namespace castor::test {

namespace {

using testing::ElementsAre;
using testing::IsEmpty;

class FailoverTest : public testing::Test {
protected:
  FailoverTest() {
    Placement placement;
    placement.hosts = {{"one", 1}, {"two", 2}, {"three", 3}};
    placement.of = {{"a_wm", 1}, {"a_tm", 1}, {"m", 1}, {"u", 1}, {"camera", 2}};
    failover.set(placement);
  }

  Failover::Loss lose(ProcessNumber lost, const std::vector<std::string>& names) {
    up.erase(lost);
    return failover.lose(lost, names, described, [this](auto x) { return up.count(x) > 0; });
  }

  ArchitectureDescription described =
    architecture(subarchitecture("a", "one") + "CPP MG m M\nCPP UM u U\n" +
                 "COMPONENT two CPP camera C\nFAILOVER u TO two three\n");
  std::set<ProcessNumber> up{0, 1, 2, 3};
  Failover failover;
};

TEST_F(FailoverTest, ChildrenMoveToTheFirstHostThatIsUp) {
  auto loss = lose(1, {"u"});
  EXPECT_THAT(loss.moved, ElementsAre("u"));
  EXPECT_EQ(failover.process_of("u"), 2);
  EXPECT_FALSE(loss.needs_successor);
  EXPECT_THAT(lose(2, {"u"}).moved, ElementsAre("u"));
  EXPECT_EQ(failover.process_of("u"), 3);
}

TEST_F(FailoverTest, WithoutSuchAHostChildrenAwaitTheSuccessorOfTheirProcess) {
  auto loss = lose(1, {"m", "u"});
  EXPECT_THAT(loss.moved, ElementsAre("u"));
  EXPECT_THAT(loss.left, ElementsAre("m"));
  ASSERT_TRUE(loss.needs_successor);
  failover.set_successor(1, 4, {loss.left, {}});
  EXPECT_EQ(failover.process_of("m"), 4);
  EXPECT_EQ(failover.placement().hosts.at("one"), 4);
  EXPECT_TRUE(failover.is_awaited("m"));
  EXPECT_TRUE(failover.is_between_processes("m"));
  EXPECT_FALSE(failover.take_awaited(1));
  auto awaited = failover.take_awaited(4);
  ASSERT_TRUE(awaited);
  EXPECT_THAT(awaited->names, ElementsAre("m"));
  EXPECT_FALSE(failover.is_awaited("m"));
  EXPECT_FALSE(failover.take_awaited(4));
}

TEST_F(FailoverTest, WorkingMemoriesMoveOnlyIfTheyLoseNothingByThat) {
  described = architecture("SUBARCHITECTURE a one\nCPP WM SubarchitectureWorkingMemory --journal "
                           "/tmp/j\nCPP TM T\nFAILOVER a TO two\n");
  EXPECT_THAT(lose(1, {"a_wm"}).left, ElementsAre("a_wm"));
}

TEST_F(FailoverTest, AHostThatOthersMayHaveToMoveToGetsASuccessorToo) {
  auto loss = lose(3, {});
  EXPECT_TRUE(loss.needs_successor);
  failover.set_successor(3, 4, {});
  EXPECT_EQ(failover.placement().hosts.at("three"), 4);
  EXPECT_FALSE(failover.take_awaited(4));
}

TEST_F(FailoverTest, TheSuccessorMayBeLostInItsTurn) {
  failover.set_successor(1, 4, {lose(1, {"m"}).left, {}});
  auto loss = lose(4, {"m"});
  EXPECT_FALSE(failover.is_awaited("m"));
  failover.set_successor(4, 5, {loss.left, {}});
  EXPECT_FALSE(failover.take_awaited(4));
  EXPECT_TRUE(failover.take_awaited(5));
}

TEST_F(FailoverTest, AMoveEndsOnce) {
  failover.begin_move({"u"});
  EXPECT_TRUE(failover.is_between_processes("u"));
  EXPECT_TRUE(failover.end_move("u"));
  EXPECT_FALSE(failover.end_move("u"));
  EXPECT_FALSE(failover.is_between_processes("u"));
}

TEST_F(FailoverTest, ANewPlacementTakesNothingBack) {
  failover.set_successor(1, 4, {lose(1, {"m"}).left, {}});
  lose(1, {"u"});
  Placement placement;
  placement.hosts = {{"one", 1}, {"two", 2}, {"three", 3}};
  placement.of = {{"m", 1}, {"u", 1}, {"added", 1}};
  failover.set(placement);
  EXPECT_EQ(failover.process_of("m"), 4);
  EXPECT_EQ(failover.process_of("u"), 2);
  EXPECT_EQ(failover.process_of("added"), 4);
  EXPECT_EQ(failover.placement().hosts.at("one"), 4);
  EXPECT_THAT(failover.placement().of.count("camera"), 0u);
}

} // namespace

} // namespace castor::test
