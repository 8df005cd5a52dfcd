#include "castor/actors/node/placement.hpp"

#include "castor/tests/actors/node/support.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace castor::test {

namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Pair;
using testing::SizeIs;

const std::map<std::string, Endpoint> no_nodes;

TEST(Placement, PutsEverythingWhereItsHostSays) {
  auto x = place(architecture("HOSTNAME arm 10.0.0.2:7200\n" + subarchitecture("a", "[arm]") +
                              "localhost CPP UM near C\n10.0.0.3 CPP UM far C\n"),
                 no_nodes);
  EXPECT_THAT(x.of, ElementsAre(Pair("a_tm", 1), Pair("a_wm", 1), Pair("far", 2)));
  ASSERT_THAT(x.processes, SizeIs(3));
  EXPECT_EQ(x.processes[1].name, "arm");
  EXPECT_EQ(x.processes[1].host, "10.0.0.2");
  EXPECT_EQ(x.processes[1].port, 7200);
  EXPECT_EQ(x.processes[2].name, "");
  EXPECT_EQ(x.processes[2].port, default_node_port);
  EXPECT_EQ(x.process_of("near"), 0);
}

/// What is wrong with the name of a host; empty if it is one.
std::string problem_of(const ArchitectureDescription& x, const std::string& name) {
  try {
    host_called(x, name);
    return {};
  } catch (const std::invalid_argument& e) {
    return e.what();
  }
}

TEST(Placement, KnowsHostsByTheirNamesAndByTheirAddresses) {
  auto x = architecture("HOSTNAME camera camera.test\nHOSTNAME unused 10.0.0.9\n"
                        "HOSTNAME here localhost\n" +
                        subarchitecture("a", "[camera]") + "far.test CPP UM far C\n");
  EXPECT_EQ(host_called(x, "camera"), "camera.test");
  EXPECT_EQ(host_called(x, "camera.test"), "camera.test");
  EXPECT_EQ(host_called(x, "far.test"), "far.test");
  EXPECT_EQ(host_called(x, "unused"), "10.0.0.9");
  EXPECT_THAT(problem_of(x, "camra"),
              HasSubstr("no host camra; did you mean 'camera'? its hosts are: camera, "));
  EXPECT_THAT(problem_of(x, "bogus"), HasSubstr("its hosts are: camera, far.test, unused"));
  EXPECT_THAT(problem_of(x, "here"), HasSubstr("is this machine"));
}

TEST(Placement, HasProcessesInReserveForThoseThatMoveWhenTheirNodeIsLost) {
  auto file = architecture("HOSTNAME spare 10.0.0.4\nHOSTNAME arm 10.0.0.2\nFAILOVER far TO "
                           "[arm] [spare] localhost\n" +
                           subarchitecture("a", "localhost") + "[arm] CPP UM far C\n");
  auto x = place(file, no_nodes);
  EXPECT_THAT(x.of, ElementsAre(Pair("far", 1)));
  ASSERT_THAT(x.processes, SizeIs(3));
  EXPECT_EQ(x.processes[2].name, "spare");
  EXPECT_THAT(x.hosts, ElementsAre(Pair("10.0.0.2", 1), Pair("10.0.0.4", 2)));
  EXPECT_THAT(other_hosts(file), ElementsAre(Pair("10.0.0.2", "arm"), Pair("10.0.0.4", "spare")));
}

TEST(Placement, NamesTheLineWhoseHostIsNoAddress) {
  auto x =
    place(architecture("FAILOVER a TO host:port\n" + subarchitecture("a", "localhost")), no_nodes);
  ASSERT_THAT(x.problems, SizeIs(1));
  EXPECT_EQ(x.problems.front().where.line(), 1u);
  EXPECT_THAT(x.problems.front().message, HasSubstr("the host of a is no address"));
}

TEST(Placement, LooksForNodesWhereItIsToldThatTheyAre) {
  auto x = place(architecture("FAILOVER a TO spare\n" + subarchitecture("a", "arm")),
                 {{"arm", {"127.0.0.1", 4001}}, {"spare", {"127.0.0.1", 4002}}});
  ASSERT_THAT(x.processes, SizeIs(3));
  EXPECT_EQ(x.processes[1].port, 4001);
  EXPECT_EQ(x.processes[2].port, 4002);
}

TEST(Placement, LeavesNumbersToProcessesThatHaveThem) {
  auto first =
    place(architecture(subarchitecture("a", "one") + subarchitecture("b", "two")), no_nodes);
  auto second = place(architecture("FAILOVER b TO one\n" + subarchitecture("b", "two") +
                                   subarchitecture("c", "three")),
                      no_nodes, first);
  EXPECT_EQ(second.process_of("b_wm"), first.process_of("b_wm"));
  EXPECT_EQ(second.hosts.at("one"), first.hosts.at("one"));
  EXPECT_EQ(second.process_of("c_wm"), 3);
  EXPECT_THAT(second.problems, IsEmpty());
}

} // namespace

} // namespace castor::test
