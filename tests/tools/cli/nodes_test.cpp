#include "castor/tests/tools/cli/nodes_fixture.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <string>
#include <thread>
#include <vector>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>

namespace castor::test {

namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

/// How many processes were started with these words among their arguments.
int processes_with(const std::string& words) {
  int result = 0;
  for (auto& x : std::filesystem::directory_iterator{"/proc"}) {
    std::ifstream in{x.path() / "cmdline"};
    std::string line{std::istreambuf_iterator<char>{in}, {}};
    std::replace(line.begin(), line.end(), '\0', ' ');
    result += line.find(words) != std::string::npos;
  }
  return result;
}

/// A connection that says what Castor does not expect.
class StrangeConnection {
public:
  explicit StrangeConnection(std::uint16_t port) : fd_(socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (connect(fd_, reinterpret_cast<sockaddr*>(&address), sizeof(address)) != 0)
      throw std::runtime_error("cannot connect");
  }
  StrangeConnection(const StrangeConnection&) = delete;
  StrangeConnection& operator=(const StrangeConnection&) = delete;
  ~StrangeConnection() { close(fd_); }

  void say(const std::string& what) { send(fd_, what.data(), what.size(), MSG_NOSIGNAL); }

private:
  int fd_;
};

TEST_P(NodesEitherWay, ASystemRunsOverThem) {
  auto one = start_node("one");
  auto two = start_node("two");
  Process castor{run_on({&one, &two}, ticks(20), {"--trace"})};
  EXPECT_EQ(castor.wait(), 0) << castor.errors();
  EXPECT_NE(castor.output().find("OVERWRITE       Tick"), std::string::npos) << castor.output();
  EXPECT_NE(castor.output().find("b.listener"), std::string::npos);
  EXPECT_TRUE(one.process->wait_for_output("one leaves"));
  EXPECT_TRUE(two.process->wait_for_output("two leaves"));
}

TEST_P(NodesEitherWay, ValuesArePulledAndPushed) {
  auto one = start_node("one");
  auto two = start_node("two");
  Process castor{run_on({&one, &two}, "COMPONENT [one] CPP beacon Beacon\n" +
                                        subarchitecture("a", "localhost") +
                                        "CPP UM judge Judge --count 2\nCPP UM near Watcher\n" +
                                        subarchitecture("b", "two") + "CPP UM far Watcher\n")};
  EXPECT_EQ(castor.wait(), 7) << castor.errors();
}

INSTANTIATE_TEST_SUITE_P(Nodes, NodesEitherWay, testing::Bool(), encryption);

TEST_F(Nodes, TwoSystemsAtOnceDoNotDisturbEachOther) {
  auto one = start_node("one");
  auto two = start_node("two");
  Process first{run_on({&one, &two}, ticks(30))};
  Process second{run_on({&one, &two}, ticks(60))};
  EXPECT_EQ(first.wait(), 0) << first.errors();
  EXPECT_EQ(second.wait(), 0) << second.errors();
}

TEST_F(Nodes, TellScriptsWhereTheyListenAndWhichSystemsComeAndGo) {
  Process one{command({"node", "--name", "one", "--listen", "127.0.0.1:0", "--json"})};
  ASSERT_TRUE(eventually([&] { return one.output().find('\n') != std::string::npos; }))
    << one.errors();
  auto listening = json_lines(one.output()).front();
  EXPECT_EQ(listening["event"], "listening");
  EXPECT_EQ(listening["name"], "one");
  EXPECT_EQ(listening["address"], "127.0.0.1");
  EXPECT_EQ(listening["pid"], one.pid());
  EXPECT_EQ(listening["tls"], false);
  Node node{"one", nullptr, "127.0.0.1:" + listening["port"].dump()};
  Process castor{run_on({&node}, subarchitecture("a", "one") + "CPP UM printer Printer\n")};
  EXPECT_EQ(castor.wait(), 0) << castor.errors();
  ASSERT_TRUE(one.wait_for_output("system left")) << one.errors();
  one.send_signal(SIGTERM);
  EXPECT_EQ(one.wait(), 0);
  auto lines = json_lines(one.output());
  ASSERT_EQ(lines.size(), 3U) << one.output();
  EXPECT_EQ(lines[1]["event"], "system joined");
  EXPECT_EQ(lines[2]["event"], "system left");
  EXPECT_EQ(lines[1]["system"], lines[2]["system"]);
  EXPECT_FALSE(lines[2]["reason"].get<std::string>().empty());
  EXPECT_NE(one.errors().find("printed by a component"), std::string::npos);
}

TEST_F(Nodes, WhatIsOutOfReachIsNamedAndNothingIsLeft) {
  auto one = start_node("one");
  Node nobody{"two", nullptr, "127.0.0.1:1"};
  auto begin = Clock::now();
  Process castor{run_on({&one, &nobody}, ticks(20))};
  EXPECT_EQ(castor.wait(), 2);
  EXPECT_LT(Clock::now() - begin, 20s);
  EXPECT_NE(
    castor.errors().find("system-1.cast:8: error: cannot reach the node two at 127.0.0.1:1"),
    std::string::npos)
    << castor.errors();
  EXPECT_TRUE(one.process->wait_for_output("one leaves"));
}

TEST_F(Nodes, AHostThatNobodyKnowsIsNamed) {
  Process castor{command({"run", write("far.cast", "SUBARCHITECTURE a no-such-host.invalid\n"
                                                   "CPP WM SubarchitectureWorkingMemory\n"
                                                   "CPP TM AlwaysPositiveTaskManager\n")})};
  EXPECT_EQ(castor.wait(), 2);
  EXPECT_NE(castor.errors().find("far.cast:2: error: cannot reach the node "
                                 "no-such-host.invalid:7117: no address for no-such-host.invalid"),
            std::string::npos)
    << castor.errors();
}

TEST_F(Nodes, ANodeMustHaveTheNameThatTheFileGivesIt) {
  auto one = start_node("one");
  auto other = start_node("other");
  other.name = "two";
  Process castor{run_on({&one, &other}, ticks(20))};
  EXPECT_EQ(castor.wait(), 2);
  EXPECT_NE(castor.errors().find("there is a node other where two should be"), std::string::npos)
    << castor.errors();
}

TEST_F(Nodes, AClassThatANodeDoesNotHaveIsNamed) {
  auto one = start_node("one");
  auto two = start_node("two", {CASTOR_EXECUTABLE, "node"}, {});
  Process castor{run_on({&one, &two}, ticks(20))};
  EXPECT_EQ(castor.wait(), 2);
  EXPECT_NE(castor.errors().find("on the node two: "), std::string::npos) << castor.errors();
  EXPECT_NE(castor.errors().find("Listener"), std::string::npos) << castor.errors();
}

TEST_F(Nodes, ALostNodeIsReportedAndTheOthersGoOn) {
  auto one = start_node("one");
  auto two = start_node("two");
  Process castor{run_on({&one, &two}, ticks(1'000'000), {"--for", "5s"})};
  ASSERT_TRUE(two.process->wait_for_output("hears ticks"));
  two.process->send_signal(SIGKILL);
  EXPECT_TRUE(castor.wait_for_output("node two is out of reach"));
  EXPECT_EQ(castor.wait(), 1);
  EXPECT_NE(castor.output().find("its node two does not answer"), std::string::npos)
    << castor.output();
  EXPECT_TRUE(one.process->wait_for_output("one leaves"));
}

TEST_P(NodesEitherWay, AStoppedNodeGoesOnWhereItWas) {
  auto one = start_node("one");
  auto two = start_node("two");
  Process castor{run_on({&one, &two}, ticks(300))};
  ASSERT_TRUE(two.process->wait_for_output("hears ticks"));
  two.process->send_signal(SIGSTOP);
  EXPECT_TRUE(castor.wait_for_output("node two is out of reach"));
  two.process->send_signal(SIGCONT);
  EXPECT_TRUE(castor.wait_for_output("node two is in reach again"));
  EXPECT_EQ(castor.wait(), 0) << castor.errors();
}

TEST_F(Nodes, StrangersAreTurnedAwayAndNobodyElseNotices) {
  auto one = start_node("one");
  auto two = start_node("two");
  Process castor{run_on({&one, &two}, ticks(200))};
  ASSERT_TRUE(two.process->wait_for_output("hears ticks"));
  StrangeConnection silent{two.port()};
  StrangeConnection slow{two.port()};
  slow.say("CAS");
  for (int i = 0; i < 20; ++i) {
    StrangeConnection{two.port()}.say("GET / HTTP/1.0\r\n\r\n");
    StrangeConnection{two.port()}.say(std::string("CASTOR\0\2\xff\xff\xff\x7f", 12));
    StrangeConnection{two.port()}.say(std::string(3000, static_cast<char>(i * 37)));
    StrangeConnection{two.port()};
  }
  EXPECT_TRUE(two.process->wait_for_output("it does not speak Castor's protocol"));
  EXPECT_TRUE(two.process->wait_for_output("a greeting of 2147483647 bytes"));
  EXPECT_TRUE(two.process->wait_for_output("it did not introduce itself in time"));
  EXPECT_EQ(castor.wait(), 0) << castor.errors();
  EXPECT_EQ(castor.errors().find("out of reach"), std::string::npos) << castor.errors();
}

TEST_F(Nodes, LocalOnesLeaveNothingBehindOnCtrlC) {
  auto name = folder.filename().string();
  auto file = write("local.cast", "HOSTNAME " + std::string{"n"} + " " + name +
                                    "\nSUBARCHITECTURE a [n]\nCPP WM SubarchitectureWorkingMemory\n"
                                    "CPP TM AlwaysPositiveTaskManager\nCPP UM ticker Ticker\n"
                                    "localhost CPP UM listener Listener --count 1000000\n");
  Process castor{command({"run", file, "--local-nodes"})};
  ASSERT_TRUE(castor.wait_for_output("hears ticks")) << castor.errors();
  castor.send_signal(SIGINT);
  EXPECT_EQ(castor.wait(), 0) << castor.errors();
  EXPECT_NE(castor.errors().find("stopped, in this order: listener, ticker, a_tm"),
            std::string::npos)
    << castor.errors();
}

TEST_F(Nodes, LocalOnesEndWithTheirLauncherEvenIfItIsKilled) {
  // A name that no other test's processes have.
  auto name = "killed-" + std::to_string(getpid());
  auto file = write("local.cast", "SUBARCHITECTURE a " + name +
                                    "\nCPP WM SubarchitectureWorkingMemory\n"
                                    "CPP TM AlwaysPositiveTaskManager\nCPP UM ticker Ticker\n"
                                    "localhost CPP UM listener Listener --count 1000000\n");
  Process castor{command({"run", file, "--local-nodes"})};
  ASSERT_TRUE(castor.wait_for_output("hears ticks")) << castor.errors();
  EXPECT_EQ(processes_with("--name " + name), 1);
  castor.send_signal(SIGKILL);
  castor.wait();
  EXPECT_TRUE(eventually([&] { return processes_with("--name " + name) == 0; }));
}

TEST_F(Nodes, VisionRunsOverThree) {
  Process castor{command({"run", CASTOR_CONFIGS "/vision-three-nodes.cast", "--local-nodes",
                          "--until-quiet", "1s", "--output", (folder / "out").string()})};
  EXPECT_EQ(castor.wait(), 0) << castor.errors();
  EXPECT_TRUE(std::regex_search(castor.output(), std::regex{"SceneObject +6\n"}))
    << castor.output();
  EXPECT_TRUE(std::filesystem::exists(folder / "out" / "pictures-001.png"));
}

TEST_F(Nodes, OnlyWhoHasACertificateOfTheSameCATalksToThoseWhoDo) {
  encrypt({"one", "two"});
  auto one = start_node("one");
  auto two = start_node("two");
  Process others{{CASTOR_MAKE_CERTS, (folder / "others").string(), "run"}};
  ASSERT_EQ(others.wait(), 0) << others.errors();
  auto arguments = run_on({&one, &two}, ticks(20));
  auto tls = std::find(arguments.begin(), arguments.end(), "--tls");
  ASSERT_NE(tls, arguments.end());
  *(tls + 1) = (folder / "others" / "run").string();
  Process stranger{arguments};
  EXPECT_EQ(stranger.wait(), 2);
  EXPECT_NE(stranger.errors().find("not signed by our CA"), std::string::npos) << stranger.errors();
  arguments.erase(tls, tls + 2);
  Process plain{arguments};
  EXPECT_EQ(plain.wait(), 2) << plain.errors();
}

TEST_F(Nodes, ListenBeyondTheMachineOnlyIfThatIsSafeOrWanted) {
  Process open{command({"node", "--name", "x", "--listen", "0.0.0.0:0"})};
  EXPECT_EQ(open.wait(), 2);
  EXPECT_NE(open.errors().find("--tls DIR"), std::string::npos) << open.errors();
  Process insecure{command({"node", "--name", "x", "--listen", "0.0.0.0:0", "--insecure"})};
  EXPECT_TRUE(insecure.wait_for_output("INSECURE: whoever reaches"));
  insecure.send_signal(SIGTERM);
  EXPECT_EQ(insecure.wait(), 0);
}

} // namespace

} // namespace castor::test
