#include "castor/tests/tools/cli/nodes_fixture.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <iostream>
#include <string>

namespace castor::test {

namespace {

using testing::HasSubstr;

/// Actions whose requester and executor are in processes of their own.
class ActionsOverProcesses : public Nodes {
protected:
  std::string diary() const { return (folder / "diary").string(); }

  std::string carrier(const std::string& options = {}) const {
    return "CPP UM carrier Carrier --diary " + diary() + options + "\n";
  }

  /// Lets the sender ask for an action of b, once it listens.
  static Answer add_scene(const std::string& where, const std::string& sender = "sender") {
    EXPECT_TRUE(eventually([&] {
      return ask({"wm", "ls", where + "/Life"}).output.find(sender) != std::string::npos;
    }));
    return ask({"wm", "add", where, "Scene",
                R"({"number": 1, "state": "running", "after_another": false, "executor": "b"})"});
  }

  static std::string actions() { return ask({"actions"}).output; }
};

/// `scripts/action-kills` kills a hundred times.
TEST_F(ActionsOverProcesses, EndInEachStateWhenOneOfTheirProcessesIsKilled) {
  auto* given = std::getenv("CASTOR_ACTION_KILLS");
  std::string times = given ? given : "1";
  auto policy = " one_for_one RESTARTS 100000 IN 1s DELAY 1ms TO 1ms\n";
  auto file = write("kills.cast",
                    subarchitecture("a", "localhost", "--lease 100ms") +
                      "CPP UM sender Sender --isolate\nCPP UM killer Killer --times " + times +
                      " --diary " + diary() + "\n" + subarchitecture("b", "localhost") +
                      carrier(" --isolate") + "SUPERVISE SYSTEM" + policy + "SUPERVISE *" + policy);
  Process castor{command({"run", file, "--for", given ? "3600s" : "100s"})};
  EXPECT_EQ(castor.wait(), 7) << castor.errors();
  if (given)
    std::cout << castor.output() << castor.errors();
}

TEST_F(ActionsOverProcesses, FailWhenTheExecutorsNodeIsKilledWithItsWorkingMemory) {
  auto one = start_node("one");
  auto two = start_node("two");
  Process castor{run_on({&one, &two},
                        subarchitecture("a", "one") + "CPP UM sender Sender\n" +
                          subarchitecture("b", "two") + carrier(),
                        {"--lost-after", "1s"})};
  auto added = add_scene("a");
  ASSERT_EQ(added.status, 0) << added.errors << castor.errors();
  EXPECT_TRUE(eventually([&] { return actions().find("running") != std::string::npos; }))
    << actions();
  EXPECT_THAT(actions(), HasSubstr("b.carrier"));
  two.process->send_signal(SIGKILL);
  EXPECT_TRUE(eventually([&] { return actions().find("failed") != std::string::npos; }))
    << actions();
  EXPECT_THAT(actions(), HasSubstr("carrier of b ended while it executed it"));
  castor.send_signal(SIGINT);
  castor.wait();
}

TEST_F(ActionsOverProcesses, AreCancelledWhenTheRequestersNodeIsKilledWithItsWorkingMemory) {
  auto one = start_node("one");
  auto two = start_node("two");
  Process castor{run_on({&one, &two},
                        subarchitecture("a", "one") + "CPP UM sender Sender\n" +
                          subarchitecture("b", "two") + carrier() + "CPP UM second Sender\n",
                        {"--lost-after", "1s"})};
  auto added = add_scene("a");
  ASSERT_EQ(added.status, 0) << added.errors << castor.errors();
  EXPECT_TRUE(eventually([&] { return actions().find("running") != std::string::npos; }))
    << actions();
  one.process->send_signal(SIGKILL);
  // The executor is free for somebody else.
  added = add_scene("b", "second");
  ASSERT_EQ(added.status, 0) << added.errors << castor.errors();
  EXPECT_TRUE(eventually([&] {
    auto now = actions();
    return now.find("running") != std::string::npos && now.find("b.second") != std::string::npos;
  }))
    << actions();
  castor.send_signal(SIGINT);
  castor.wait();
}

} // namespace

} // namespace castor::test
