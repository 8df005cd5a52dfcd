#include "castor/actors/supervision/supervisor.hpp"

#include "castor/base/log.hpp"
#include "castor/tests/actors/node/support.hpp"
#include "castor/tools/simulation/testing_system.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace castor::test {

namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::IsEmpty;

/// A supervisor, with stand-ins for the agent of its process and for components.
class SupervisorTest : public testing::Test, protected simulation::TestingSystem {
protected:
  SupervisorTest() {
    set_log_level(LogLevel::off);
    described = architecture(subarchitecture("a", "localhost") + "CPP MG m M\nCPP UM u U\n");
    for_each_component(described, [&](auto& x) { names.push_back(x.name); });
    options.on_up = [this](const ComponentUp& x) { ups.push_back(x); };
    agent = system.spawn([this](caf::event_based_actor* self) -> caf::behavior {
      return {[this, self](const PartPlan&) -> caf::result<PartMade> {
                if (!holds_plan)
                  return make(names);
                auto answer = self->make_response_promise<PartMade>();
                held = [this, answer]() mutable { answer.deliver(make(names)); };
                return answer;
              },
              [this, self](const RestartComponent& x) {
                restarts.push_back(x);
                promise = self->make_response_promise();
                return *promise;
              },
              [](const JoinParts&) { return Acknowledged{}; },
              [this](Acknowledged) {
                if (held)
                  std::exchange(held, {})();
                else
                  promise->deliver(make({restarts.back().name}));
              }};
    });
    processes.set_own_agent(agent);
    SupervisorParts parts;
    parts.processes = &processes;
    parts.options = &options;
    parts.epoch = system.clock().now();
    parts.on_change = [](const SystemRosterPtr&) {};
    supervisor = system.spawn(castor::supervisor, std::move(parts));
    asker = system.spawn([this](caf::event_based_actor* self) -> caf::behavior {
      return {
        [this, self](const Deploy& x) {
          self->request(supervisor, caf::infinite, x).then([](const Deployed&) {});
        },
        [this, self](const StartComponents& x) {
          self->request(supervisor, caf::infinite, x).then([](ComponentsStarted) {});
        },
        [this, self](const StopComponents& x) {
          self->request(supervisor, caf::infinite, x).then([this](const ComponentsStopped& y) {
            stopped = y;
          });
        }};
    });
    caf::anon_send(asker, Deploy{described, {}});
    run();
    caf::anon_send(asker, StartComponents{names});
    run();
  }

  ~SupervisorTest() override {
    for (auto& x : {asker, supervisor, agent})
      caf::anon_send_exit(x, caf::exit_reason::user_shutdown);
    for (auto& x : made)
      caf::anon_send_exit(x, caf::exit_reason::user_shutdown);
    run();
    set_log_level(LogLevel::info);
  }

  void run() {
    while (scheduler.try_run_once()) {
    }
  }

  void let_time_pass(std::chrono::milliseconds x) {
    scheduler.advance_time(x);
    run();
  }

  PartMade make(const std::vector<std::string>& which) {
    PartMade result;
    for (auto& name : which) {
      made.push_back(system.spawn([this, name](caf::event_based_actor* self) -> caf::behavior {
        self->set_exit_handler([this, self, name](const caf::exit_msg&) {
          end(name, ComponentEnded::How::stopped);
          self->quit();
        });
        return {[this, name](const ComponentFault&) { faults.push_back(name + " before "); },
                [this, self, name](const EnterPhase& x) {
                  if (!faults.empty() && faults.back().ends_with(' '))
                    faults.back() += x.phase == Phase::start ? "start" : "another phase";
                  PhaseDone done{std::uint32_t(described.component(name)->number), x.phase, {}};
                  if (x.phase == Phase::configure && name == slow)
                    late = done;
                  else if (x.phase != Phase::run)
                    self->send(x.phase_controller, done);
                }};
      }));
      result.actors[name] = caf::actor_cast<caf::strong_actor_ptr>(made.back());
    }
    return result;
  }

  void answer_restart() {
    caf::anon_send(agent, Acknowledged{});
    run();
  }

  /// Says that a component has ended, in the life that it is known to live.
  void end(const std::string& name, ComponentEnded::How how) {
    caf::anon_send(supervisor, ComponentEnded{name, lives[name] + 1, how, "it failed"});
  }

  SystemOptions options;
  Processes processes{system, options, "test", [](const LinkNews&) {}, {}};
  ArchitectureDescription described;
  std::vector<std::string> names;
  caf::actor agent;
  caf::actor supervisor;
  caf::actor asker;
  std::vector<caf::actor> made;
  /// Lives over.
  std::map<std::string, std::uint64_t> lives;
  std::vector<RestartComponent> restarts;
  std::optional<caf::response_promise> promise;
  /// Whether plans are answered only by `answer_restart`.
  bool holds_plan = false;
  std::function<void()> held;
  /// Who does not say that it is configured, and what it would say.
  std::string slow;
  std::optional<PhaseDone> late;
  /// Who was told of a fault, and before what.
  std::vector<std::string> faults;
  std::vector<ComponentUp> ups;
  std::optional<ComponentsStopped> stopped;
};

TEST_F(SupervisorTest, WhoEndsBeforeItIsKnownToHaveBeenMadeIsStartedAgainToo) {
  end("u", ComponentEnded::How::failed);
  run();
  ASSERT_EQ(restarts.size(), 1u);
  ++lives["u"];
  end("u", ComponentEnded::How::failed);
  run();
  answer_restart();
  let_time_pass(1s);
  ASSERT_EQ(restarts.size(), 2u);
  EXPECT_EQ(restarts.back().incarnation, 3u);
  answer_restart();
  ASSERT_EQ(ups.size(), 1u);
  EXPECT_EQ(ups.back().incarnation, 3u);
}

TEST_F(SupervisorTest, TheTimeThatARoundWaitsForAnotherIsNotTimeToStop) {
  holds_plan = true;
  end("a_tm", ComponentEnded::How::failed);
  run();
  ++lives["a_tm"];
  ++lives["m"];
  ASSERT_TRUE(held);
  // Who is just being made cannot be stopped.
  caf::anon_send(asker, StopComponents{{"m", "u"}});
  run();
  let_time_pass(options.stop_patience + 1s);
  EXPECT_FALSE(stopped);
  answer_restart();
  ASSERT_TRUE(stopped);
  EXPECT_THAT(stopped->stuck, IsEmpty());
  EXPECT_THAT(stopped->stopped, ElementsAre("u", "m"));
}

TEST_F(SupervisorTest, WhoBlocksInConfigureIsStoppedAllTheSame) {
  slow = "m";
  end("a_tm", ComponentEnded::How::failed);
  run();
  ++lives["a_tm"];
  ++lives["m"];
  ASSERT_TRUE(late);
  caf::anon_send(asker, StopComponents{{"m", "u"}});
  run();
  ASSERT_TRUE(stopped);
  EXPECT_THAT(stopped->stuck, IsEmpty());
  EXPECT_THAT(stopped->stopped, ElementsAre("u", "m"));
  // The others have not waited for it either.
  EXPECT_THAT(ups, testing::Contains(testing::Field(&ComponentUp::component, "a_tm")));
}

TEST_F(SupervisorTest, FaultsForTheNextStartAreInjectedBeforeIt) {
  caf::anon_send(supervisor, InjectComponentFault{"u", {ComponentFault::Kind::blocked_start}});
  run();
  EXPECT_THAT(faults, IsEmpty());
  for (int life = 1; life <= 2; ++life) {
    end("u", ComponentEnded::How::failed);
    run();
    ++lives["u"];
    let_time_pass(1s);
    answer_restart();
    // Once, and not when it was configured.
    EXPECT_THAT(faults, ElementsAre("u before start"));
  }
}

TEST_F(SupervisorTest, AWholeSystemIsStoppedWhileSomebodyBlocksInConfigure) {
  slow = "m";
  end("a_wm", ComponentEnded::How::failed);
  run();
  for (auto* name : {"a_wm", "a_tm", "m", "u"})
    ++lives[name];
  ASSERT_TRUE(late);
  caf::anon_send(asker, StopComponents{names});
  run();
  ASSERT_TRUE(stopped);
  EXPECT_THAT(stopped->stuck, IsEmpty());
  EXPECT_THAT(stopped->stopped, ElementsAre("u", "m", "a_tm"));
}

TEST_F(SupervisorTest, WhoFailsBecauseAnotherIsDownDoesNotUseUpItsRestarts) {
  // Three are allowed in ten seconds.
  for (int i = 0; i < 5; ++i) {
    caf::anon_send(supervisor, ComponentEnded{"u", ++lives["u"], ComponentEnded::How::failed,
                                              "it is dark", "m"});
    run();
    let_time_pass(1s);
    answer_restart();
    ASSERT_EQ(restarts.size(), static_cast<std::size_t>(i) + 1);
    EXPECT_EQ(restarts.back().name, "u");
  }
}

} // namespace

} // namespace castor::test
