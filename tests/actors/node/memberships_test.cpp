#include "castor/actors/node/memberships.hpp"

#include "castor/actors/node/well_known_actors.hpp"
#include "castor/tools/simulation/testing_system.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <variant>
#include <vector>

namespace castor::test {

namespace {

using testing::ElementsAre;
using testing::SizeIs;

/// A node that takes part in one system as its process 2, with stand-ins for its links.
class MembershipsTest : public testing::Test, protected simulation::TestingSystem {
protected:
  MembershipsTest() {
    node->route(coordinator(2));
    PartPlan plan;
    plan.processes.resize(3);
    plan.processes[1] = {"other", "other", 7000, false};
    caf::anon_send(
      caf::actor_cast<caf::actor>(links.front().mesh->well_known(2, part_agent_number)), plan);
    scheduler.run();
  }

  ~MembershipsTest() override {
    node->end();
    for (auto& x : actors)
      caf::anon_send_exit(x, caf::exit_reason::user_shutdown);
    scheduler.run();
  }

  static Hello coordinator(ProcessNumber receiver) {
    return {"run", "s", 100, 0, receiver, 0, 0, 0};
  }

  /// From process 1, which takes this one for the process `receiver`, in the life `known`.
  static Hello other(ProcessNumber receiver, std::uint64_t known) {
    return {"other", "s", 200, 1, receiver, known, 0, 0};
  }

  bool is_taken(const Hello& x) { return std::holds_alternative<caf::actor>(node->route(x)); }

  bool is_refused_for_good(const Hello& x) {
    auto route = node->route(x);
    auto* refusal = std::get_if<Refusal>(&route);
    return refusal && refusal->final;
  }

  MembershipParts parts() {
    MembershipParts result;
    result.name = "node";
    result.spawn_link = [this](LinkParts x) {
      links.push_back(std::move(x));
      actors.push_back(system.spawn([this, number = links.size() - 1]() -> caf::behavior {
        return {[this, number](const CloseLink&) { closed.push_back(number); }};
      }));
      return actors.back();
    };
    return result;
  }

  /// In the order in which they were made.
  std::vector<LinkParts> links;
  std::vector<caf::actor> actors;
  std::vector<std::size_t> closed;
  std::shared_ptr<Memberships> node = std::make_shared<Memberships>(system, parts());
};

TEST(Dials, OfTwoNodesTheOneWithTheLowerNumberUnlessTheOtherCannotBeReached) {
  PartPlan plan;
  plan.processes.resize(5);
  plan.processes[1] = {"arm", "192.0.2.1", 7117, false};
  plan.processes[2] = {"eye", "192.0.2.2", 7117, false};
  plan.processes[3] = {"speech", "/run/links-1/1", 0, false};
  plan.processes[4] = {"vision", "/run/links-1/2", 0, false};
  for (ProcessNumber self = 1; self < plan.processes.size(); ++self)
    for (ProcessNumber peer = 1; peer < plan.processes.size(); ++peer)
      if (self != peer) {
        bool expected = (self > 2) != (peer > 2) ? self > 2 : self < peer;
        EXPECT_EQ(dials(plan, self, peer), expected) << self << " and " << peer;
      }
}

TEST_F(MembershipsTest, TakesThoseWhoKnowItAsItIs) {
  EXPECT_THAT(links, SizeIs(2));
  EXPECT_TRUE(is_taken(other(2, 0)));
  EXPECT_TRUE(is_taken(other(2, links[1].self.incarnation)));
}

TEST_F(MembershipsTest, ALinkToWhatRanHereBeforeDoesNotTouchThatOfNow) {
  EXPECT_TRUE(is_refused_for_good(other(2, 4711)));
  EXPECT_TRUE(is_refused_for_good(other(1, 0)));
}

TEST_F(MembershipsTest, BeginsAnewWhenTheCoordinatorHasGivenItUp) {
  EXPECT_TRUE(is_taken(coordinator(5)));
  EXPECT_THAT(node->systems(), ElementsAre("s"));
  scheduler.run();
  EXPECT_THAT(closed, ElementsAre(0, 1));
  ASSERT_THAT(links, SizeIs(3));
  EXPECT_EQ(links[2].self.process, 5);
  EXPECT_NE(links[2].self.incarnation, links[0].self.incarnation);
}

TEST_F(MembershipsTest, WhatIsLeftOfAnEarlierTimeInTheSystemDoesNotTouchThatOfNow) {
  auto earlier = caf::actor_cast<caf::actor>(links[0].mesh->well_known(2, part_agent_number));
  PartPlan plan;
  plan.processes.resize(6);
  plan.processes[1] = {"other", "other", 7000, false};
  caf::anon_send(earlier, plan);
  EXPECT_TRUE(is_taken(coordinator(5)));
  scheduler.run();
  EXPECT_THAT(links, SizeIs(3)) << "no link to process 1 as of an old plan";
  LinkNews lost;
  lost.peer = 0;
  lost.state = LinkState::lost;
  links[0].on_news(lost);
  EXPECT_THAT(node->systems(), ElementsAre("s"));
  links[2].on_news(lost);
  EXPECT_THAT(node->systems(), SizeIs(0));
}

TEST_F(MembershipsTest, WhoeverComesWhenItHasEndedIsRefused) {
  node->end();
  EXPECT_FALSE(is_taken(coordinator(3)));
  EXPECT_FALSE(is_refused_for_good(coordinator(3)));
  EXPECT_THAT(node->systems(), testing::IsEmpty());
}

TEST_F(MembershipsTest, OnlyTheCoordinatorIsLostForItsSilence) {
  EXPECT_EQ(links[0].options.patience, LinkOptions{}.patience);
  EXPECT_GT(links[1].options.patience, std::chrono::hours{24});
}

} // namespace

} // namespace castor::test
