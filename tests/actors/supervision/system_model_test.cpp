#include "castor/actors/supervision/system_model.hpp"

#include "castor/tests/actors/node/support.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>

namespace castor::test {

namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::Pair;
using testing::UnorderedElementsAre;

class SystemModelTest : public testing::Test {
protected:
  SystemModelTest() {
    set("CPP MG m M --shutdown 2s\nCPP UM u U --restart temporary\n");
    Placement placement;
    placement.of = {{"m", 1}};
    failover.set(placement);
  }

  void set(const std::string& components) {
    auto described = architecture(subarchitecture("a", "localhost") + components);
    tree.set(described);
    model.set(std::move(described), 5s);
  }

  SupervisionTree tree;
  Failover failover;
  SystemModel model{tree, failover};
};

TEST_F(SystemModelTest, ChildrenAreThoseOfTheArchitecture) {
  EXPECT_EQ(model.child("m").shutdown, 2s);
  EXPECT_EQ(model.child("u").shutdown, 5s);
  EXPECT_EQ(model.child("a_wm").kind, ComponentKind::working_memory);
  EXPECT_EQ(model.find("x"), nullptr);
  EXPECT_THAT(model.in_order({"u", "x", "a_wm"}), ElementsAre("a_wm", "u"));
}

TEST_F(SystemModelTest, ChildrenThatStayKeepTheirLives) {
  model.begin_life("m");
  model.set_given_up("m", true);
  set("CPP MG m M\n");
  EXPECT_EQ(model.child("m").incarnation, 2u);
  EXPECT_TRUE(model.child("m").given_up);
  EXPECT_EQ(model.child("m").shutdown, 5s);
  EXPECT_EQ(model.find("u"), nullptr);
}

TEST_F(SystemModelTest, ChangesTellWhatWasBefore) {
  EXPECT_TRUE(model.set_alive("m", false));
  EXPECT_FALSE(model.set_alive("m", true));
  EXPECT_FALSE(model.set_killed("m", true));
  EXPECT_TRUE(model.set_killed("m", false));
}

TEST_F(SystemModelTest, PlansNameLivesThatAreNotTheFirst) {
  model.begin_life("u");
  auto plan = model.plan();
  EXPECT_THAT(plan.incarnations, ElementsAre(Pair("u", 2u)));
  EXPECT_THAT(plan.temporary, ElementsAre("u"));
  EXPECT_THAT(plan.placement, ElementsAre(Pair("m", 1)));
}

TEST_F(SystemModelTest, WhatIsBetweenProcessesIsMadeNowhere) {
  failover.begin_move({"m"});
  failover.set_successor(0, 2, {{"u"}, {}});
  EXPECT_THAT(model.plan().placement, UnorderedElementsAre(Pair("m", nowhere), Pair("u", nowhere)));
  failover.end_move("m");
  EXPECT_THAT(model.plan().placement, UnorderedElementsAre(Pair("m", 1), Pair("u", nowhere)));
}

TEST_F(SystemModelTest, RostersSayHowOftenComponentsWereStartedAgain) {
  model.begin_life("u");
  model.set_given_up("u", true);
  auto roster = model.roster({});
  ASSERT_EQ(roster.components.size(), 3u);
  EXPECT_TRUE(roster.components[0].is_task_manager);
  auto& u = roster.components[2];
  EXPECT_EQ(u.identity.name, "u");
  EXPECT_EQ(u.restarts, 1u);
  EXPECT_FALSE(u.will_restart);
  EXPECT_THAT(roster.placement, testing::Contains(Pair("m", 1)));
}

} // namespace

} // namespace castor::test
