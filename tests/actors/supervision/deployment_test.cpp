#include "castor/actors/supervision/deployment.hpp"

#include "castor/tests/actors/node/support.hpp"
#include "castor/tools/simulation/testing_system.hpp"

#include <caf/scoped_actor.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace castor::test {

namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Key;
using testing::SizeIs;

/// A system in one process, on CAF's test coordinator, with a stand-in for its agent.
class DeploymentTest : public testing::Test, protected simulation::TestingSystem {
protected:
  DeploymentTest() {
    agent = system.spawn([this](caf::event_based_actor* self) -> caf::behavior {
      return {[this](const PartPlan& x) -> caf::result<PartMade> {
                plans.push_back(x);
                if (silent)
                  return caf::delegated<PartMade>{};
                return made;
              },
              [this, self](const JoinParts& x) {
                joined.push_back(x);
                made.actors["later"] = caf::actor_cast<caf::strong_actor_ptr>(self);
                return Acknowledged{};
              }};
    });
    processes.set_own_agent(agent);
    made.actors["a_wm"] = caf::actor_cast<caf::strong_actor_ptr>(agent);
    host = system.spawn([this](caf::event_based_actor* self) -> caf::behavior {
      deployments = std::make_shared<Deployments>(self, processes, 5s);
      return {[this](Acknowledged) {
        deployments->add(std::move(orders.front()));
        orders.pop_front();
      }};
    });
    scheduler.run();
  }

  ~DeploymentTest() override {
    for (auto& x : {agent, host})
      caf::anon_send_exit(x, caf::exit_reason::user_shutdown);
    scheduler.run();
  }

  /// The outcome is in `problems` once there is one.
  void deploy(const std::string& text) {
    Deployments::Order order;
    order.plan = [this, text] {
      ++asked_for;
      PartPlan result;
      result.architecture = architecture(text);
      return result;
    };
    order.done = [this](const Deployments::Problems& x) { problems = x; };
    orders.push_back(std::move(order));
    caf::anon_send(host, Acknowledged{});
  }

  SystemOptions options;
  Processes processes{system, options, "test", [](const LinkNews&) {}};
  caf::actor agent;
  caf::actor host;
  std::shared_ptr<Deployments> deployments;
  /// Which the host is to give.
  std::deque<Deployments::Order> orders;

  /// What the agent answers; nothing at all if it is silent.
  PartMade made;
  bool silent = false;
  std::vector<PartPlan> plans;
  std::vector<JoinParts> joined;
  int asked_for = 0;
  std::optional<Deployments::Problems> problems;
};

TEST_F(DeploymentTest, BringsThePlanAndThenIntroducesWhatWasMade) {
  deploy(subarchitecture("a", "localhost"));
  scheduler.run();
  ASSERT_TRUE(problems);
  EXPECT_THAT(*problems, IsEmpty());
  EXPECT_THAT(plans, SizeIs(1));
  ASSERT_THAT(joined, SizeIs(1));
  EXPECT_THAT(joined.front().actors, ElementsAre(Key("a_wm")));
  EXPECT_THAT(deployments->actors(), ElementsAre(Key("a_wm")));
}

TEST_F(DeploymentTest, CarriesOutOneOrderAfterTheOther) {
  deploy(subarchitecture("a", "localhost"));
  deploy(subarchitecture("a", "localhost") + "CPP UM later C\n");
  scheduler.run_once();
  // What is to be is asked for when it is the order's turn.
  EXPECT_EQ(asked_for, 1);
  scheduler.run();
  EXPECT_EQ(asked_for, 2);
  ASSERT_THAT(joined, SizeIs(2));
  EXPECT_THAT(joined.back().actors, ElementsAre(Key("a_wm"), Key("later")));
}

TEST_F(DeploymentTest, ForgetsWhatIsNotPartOfTheSystemAnyMore) {
  deployments->set_actor("former", caf::actor_cast<caf::strong_actor_ptr>(host));
  deploy(subarchitecture("a", "localhost"));
  scheduler.run();
  EXPECT_THAT(deployments->actors(), ElementsAre(Key("a_wm")));
}

TEST_F(DeploymentTest, SaysWhatStandsInTheWayAndIntroducesNobody) {
  made.problems.emplace_back().message = "there is no class W";
  deploy(subarchitecture("a", "localhost"));
  scheduler.run();
  ASSERT_TRUE(problems);
  ASSERT_THAT(*problems, SizeIs(1));
  EXPECT_EQ(problems->front().message, "there is no class W");
  EXPECT_THAT(joined, IsEmpty());
}

TEST_F(DeploymentTest, DoesNotWaitForEver) {
  silent = true;
  deploy(subarchitecture("a", "localhost"));
  scheduler.run();
  EXPECT_FALSE(problems);
  scheduler.advance_time(5s);
  scheduler.run();
  ASSERT_TRUE(problems);
  ASSERT_THAT(*problems, SizeIs(1));
  EXPECT_THAT(problems->front().message,
              HasSubstr("this process did not make its part of the system in 5 s"));
}

} // namespace

} // namespace castor::test
