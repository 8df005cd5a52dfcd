#include "castor/actors/node/part_agent.hpp"

#include "castor/actors/node/messages.hpp"
#include "castor/actors/runtime/shell.hpp"
#include "castor/tests/actors/node/support.hpp"
#include "castor/tools/simulation/testing_system.hpp"
#include "castor/wm/memory/working_memory.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

namespace castor::test {

namespace {

using namespace std::chrono_literals;

/// The agent of process 0, with the working memory of `a`; that of `b` is in process 1, of which
/// nobody ever answers.
class PartAgentTest : public testing::Test, protected simulation::TestingSystem {
protected:
  PartAgentTest() {
    silent = system.spawn([]() -> caf::behavior { return {[](const LinkMessage&) {}}; });
    connect();
    PartAgentParts parts;
    parts.mesh = mesh;
    parts.messages = messages;
    parts.spawn.component = [](caf::actor_system& in, const ShellParts&) -> caf::actor {
      return in.spawn([]() -> caf::behavior { return {[](NeighboursPtr) {}}; });
    };
    agent = system.spawn(part_agent, std::move(parts));
    PartPlan plan;
    for (std::string name : {"a", "b"}) {
      auto one = architecture("SUBARCHITECTURE " + name +
                              "\nCPP WM SubarchitectureWorkingMemory\n"
                              "CPP TM AlwaysPositiveTaskManager\n");
      plan.architecture.subarchitectures.push_back(one.subarchitectures.front());
    }
    plan.processes.resize(2);
    plan.placement = {{"b_wm", ProcessNumber{1}}, {"b_tm", ProcessNumber{1}}};
    asker = system.spawn([this, plan](caf::event_based_actor* self) -> caf::behavior {
      self->request(agent, caf::infinite, plan).then([this](const PartMade& x) {
        made = x.actors;
      });
      return {[this, self](const JoinParts& x) {
                self->request(agent, caf::infinite, x).then([this](Acknowledged) { ++joined; });
              },
              [self](const WorkingMemoryActor& x) {
                self->request(x, caf::infinite, Subscribe{1, any_change().anywhere()})
                  .then([](const Outcome<Acknowledged>&) {}, [](const caf::error&) {});
              }};
    });
    run();
  }

  ~PartAgentTest() override {
    for (auto& x : {asker, agent, silent})
      caf::anon_send_exit(x, caf::exit_reason::user_shutdown);
    mesh->close();
    run();
  }

  void connect() { mesh->add_link(silent, std::make_shared<LinkRecord>(1)); }

  /// Without letting time pass.
  void run() {
    while (scheduler.try_run_once()) {
    }
  }

  void join(const caf::strong_actor_ptr& b) {
    caf::anon_send(asker, JoinParts{{{"a_wm", made.at("a_wm")}, {"b_wm", b}}, {}});
    run();
  }

  std::shared_ptr<PartMessages> messages = std::make_shared<PartMessages>(system_messages());
  std::shared_ptr<Mesh> mesh = std::make_shared<Mesh>(system, messages, ProcessNumber{0});
  caf::actor silent;
  caf::actor agent;
  caf::actor asker;
  std::map<std::string, caf::strong_actor_ptr> made;
  int joined = 0;
};

TEST_F(PartAgentTest, KnowsNothingOfTheWorkingMemoriesOfAProcessThatIsLostMeanwhile) {
  auto b = mesh->names().actor_of(make_actor_name(1, 20));
  mesh->end_process(1);
  join(b);
  EXPECT_EQ(joined, 1);
  EXPECT_TRUE(made.at("a_wm")->get() != nullptr);
}

TEST_F(PartAgentTest, AWorkingMemoryThatEndsHoldsNobodyUp) {
  join(mesh->names().actor_of(make_actor_name(1, 20)));
  EXPECT_EQ(joined, 1);
  // From now on it has something to tell others, which it waits for.
  auto a = caf::actor_cast<WorkingMemoryActor>(made.at("a_wm"));
  caf::anon_send(asker, a);
  run();
  join(mesh->names().actor_of(make_actor_name(1, 21)));
  EXPECT_EQ(joined, 1);
  caf::anon_send_exit(a, caf::exit_reason::kill);
  run();
  EXPECT_EQ(joined, 2);
}

} // namespace

} // namespace castor::test
