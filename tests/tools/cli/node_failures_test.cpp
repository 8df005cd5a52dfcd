#include "castor/tests/tools/cli/nodes_fixture.hpp"

#include "castor/tests/support/relay.hpp"

#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

namespace castor::test {

namespace {

using namespace std::chrono_literals;

/// What `Judge` ends a system with.
constexpr int judged = 7;

const std::string judge = "CPP UM judge Judge\n";

/// An address that takes no connection and refuses none: the queue of those who wait is full.
class BlackHole {
public:
  BlackHole() : fd_(socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof(address);
    if (bind(fd_, reinterpret_cast<sockaddr*>(&address), size) != 0 || listen(fd_, 0) != 0 ||
        getsockname(fd_, reinterpret_cast<sockaddr*>(&address), &size) != 0)
      throw std::runtime_error("cannot listen");
    port_ = ntohs(address.sin_port);
    for (int& x : waiting_) {
      x = socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK, 0);
      connect(x, reinterpret_cast<sockaddr*>(&address), sizeof(address));
    }
  }
  BlackHole(const BlackHole&) = delete;
  BlackHole& operator=(const BlackHole&) = delete;
  ~BlackHole() {
    for (int x : waiting_)
      close(x);
    close(fd_);
  }

  std::string address() const { return "127.0.0.1:" + std::to_string(port_); }

private:
  int fd_;
  std::uint16_t port_ = 0;
  std::array<int, 4> waiting_{};
};

TEST_P(NodesEitherWay, OfFiveProcessesFourGoOnWhenOneIsKilled) {
  std::vector<Node> nodes;
  for (auto name : {"one", "two", "three", "four"})
    nodes.push_back(start_node(name));
  auto member = [](const std::string& name) {
    return "CPP UM member-" + name + " Member --deadline 2s --all a,b,c,d,e --survivors a,b,c,d\n";
  };
  Process castor{run_on(
    {&nodes[0], &nodes[1], &nodes[2], &nodes[3]},
    subarchitecture("a", "localhost") + member("a") + "CPP UM judge Judge --count 4\n" +
      subarchitecture("b", "one") + member("b") + subarchitecture("c", "two") + member("c") +
      subarchitecture("d", "three") + member("d") + subarchitecture("e", "four") + member("e"),
    {"--open-access"})};
  ASSERT_TRUE(castor.wait_for_output("hears everybody")) << castor.errors();
  for (auto& x : nodes)
    ASSERT_TRUE(x.process->wait_for_output("hears everybody")) << x.process->errors();
  nodes[3].process->send_signal(SIGKILL);
  EXPECT_EQ(castor.wait(), judged) << castor.errors();
  EXPECT_NE(castor.errors().find("node four is out of reach"), std::string::npos)
    << castor.errors();
  for (auto name : {"one", "two", "three"})
    EXPECT_EQ(castor.errors().find("node " + std::string{name} + " is out of reach"),
              std::string::npos)
      << castor.errors();
}

TEST_P(NodesEitherWay, WhatIsWrittenUnderALeaseThatHasRunOutIsRefused) {
  auto one = start_node("one");
  auto two = start_node("two");
  Process castor{run_on({&one, &two},
                        subarchitecture("home", "localhost") + judge +
                          subarchitecture("a", "one", "--lease 300ms") +
                          "CPP UM heir Heir --deadline 30s\n" + subarchitecture("b", "two") +
                          "CPP UM holder Holder --deadline 30s\n",
                        {"--open-access"})};
  ASSERT_TRUE(one.process->wait_for_output("waits for the lease")) << castor.errors();
  two.process->send_signal(SIGSTOP);
  EXPECT_TRUE(one.process->wait_for_output("has taken the lease")) << castor.errors();
  two.process->send_signal(SIGCONT);
  EXPECT_EQ(castor.wait(), judged) << castor.errors();
  EXPECT_TRUE(two.process->wait_for_output("is refused: ")) << two.process->errors();
}

TEST_F(Nodes, OperationsFailWithinTheirDeadlineWhileThereIsNoConnectionAndWorkAgainAfterwards) {
  auto one = start_node("one", {"--insecure"});
  auto two = start_node("two", {"--insecure"});
  // Everybody talks to node two through it.
  Relay relay{two.port()};
  two.address = "127.0.0.1:" + std::to_string(relay.port());
  Process castor{run_on({&one, &two},
                        subarchitecture("home", "localhost") + judge + subarchitecture("a", "one") +
                          "CPP UM writer RemoteWriter --deadline 300ms\n" +
                          subarchitecture("b", "two"),
                        {"--open-access", "--insecure"})};
  ASSERT_TRUE(one.process->wait_for_output("writes")) << castor.errors();
  relay.freeze(true);
  EXPECT_TRUE(one.process->wait_for_output("is not answered: ")) << castor.errors();
  EXPECT_TRUE(castor.wait_for_output("node two is out of reach")) << castor.errors();
  relay.freeze(false);
  EXPECT_EQ(castor.wait(), judged) << castor.errors();
}

TEST_F(Nodes, ABlackHoleHindersNobodyElse) {
  BlackHole hole;
  Node one{"one", nullptr, hole.address()};
  auto two = start_node("two");
  auto begin = std::chrono::steady_clock::now();
  Process castor{run_on({&one, &two}, ticks(20), {"--insecure"})};
  EXPECT_TRUE(two.process->wait_for_output("two takes part"));
  EXPECT_EQ(castor.wait(), 2);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, 20s);
  EXPECT_NE(castor.errors().find("cannot reach the node one at " + one.address + ": "),
            std::string::npos)
    << castor.errors();
  EXPECT_EQ(castor.errors().find("the node two"), std::string::npos) << castor.errors();
  EXPECT_TRUE(two.process->wait_for_output("two leaves"));
}

} // namespace

} // namespace castor::test
