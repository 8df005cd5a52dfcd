#include "castor/actors/system/component_statuses.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <utility>

namespace castor::test {

namespace {

using namespace std::chrono_literals;

class ComponentStatuses : public testing::Test {
protected:
  ComponentStatuses() {
    roster.processes = {{}, {"arm", "10.0.0.2", 7117, false}};
    roster.placement = {{"far", 1}, {"near", 0}};
    for (auto name : {"near", "far"}) {
      ComponentStatus x;
      x.identity.name = name;
      x.identity.incarnation = 3;
      x.restarts = 2;
      roster.components.push_back(x);
    }
    parts = {PartStatus{}, PartStatus{}};
    parts[0]->components = {running("near")};
    parts[1]->components = {running("far")};
  }

  static ComponentStatus running(const std::string& name) {
    ComponentStatus result;
    result.identity.name = name;
    result.state = ComponentState::running;
    return result;
  }

  void lose_the_node(LinkState state, const std::string& why) {
    parts[1].reset();
    LinkStatus link;
    link.news = {1, state, why, "arm"};
    parts[0]->links = {link};
  }

  SystemRoster roster;
  PartStatuses parts;
};

TEST_F(ComponentStatuses, JoinWhatTheirProcessesAndTheSupervisorKnow) {
  auto x = component_statuses(roster, parts);
  ASSERT_EQ(x.size(), 2u);
  EXPECT_EQ(x[1].identity.name, "far");
  EXPECT_EQ(state_of(x[1]), "running");
  EXPECT_EQ(x[1].restarts, 2u);
}

TEST_F(ComponentStatuses, SayWhyANodeDoesNotAnswer) {
  lose_the_node(LinkState::down, "no sign of life");
  auto x = component_statuses(roster, parts);
  ASSERT_EQ(x.size(), 2u);
  EXPECT_EQ(state_of(x[1]), "failed");
  EXPECT_TRUE(x[1].out_of_reach);
  EXPECT_EQ(x[1].failure, "its node arm does not answer: no sign of life");
  EXPECT_EQ(x[1].restarts, 2u);
}

TEST_F(ComponentStatuses, TellThoseWhoComeBackFromThoseWhoDoNot) {
  lose_the_node(LinkState::lost, "it was started again");
  EXPECT_EQ(state_of(component_statuses(roster, parts)[1]), "failed");
  roster.components[1].will_restart = true;
  auto x = component_statuses(roster, parts)[1];
  EXPECT_EQ(state_of(x), "restarting");
  EXPECT_FALSE(x.out_of_reach);
}

TEST(ComponentStatus, ShowsWhetherTheComponentHasWork) {
  ComponentStatus x;
  x.state = ComponentState::running;
  EXPECT_FALSE(has_work(x));
  x.busy = 10ms;
  EXPECT_FALSE(has_work(x)) << "it merely polls";
  x.busy = 1s;
  EXPECT_TRUE(has_work(x));
  x.busy = 0ms;
  x.state = ComponentState::started;
  EXPECT_TRUE(has_work(x)) << "it is going to run";
  x.out_of_reach = true;
  EXPECT_FALSE(has_work(x));
}

} // namespace

} // namespace castor::test
