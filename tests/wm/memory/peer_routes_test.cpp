#include "castor/wm/memory/peer_routes.hpp"

#include "castor/tests/wm/values/test_types.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace castor::test {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

namespace {

class PeerRoutesTest : public testing::Test {
protected:
  auto record_near() {
    return [this](PeerRoutes::PeerNumber peer, const EventFlow::Batch& events) {
      for (auto& [event, interests] : events)
        for (auto interest : interests)
          sent.push_back(event->address.id + " to peer " + std::to_string(peer) + " for " +
                         std::to_string(interest));
    };
  }

  auto record_far() {
    return [this](PeerRoutes::RouteNumber route, const RoutedEvents& events) {
      for (auto& [event, receivers] : events.events) {
        auto text = event->address.id + " on route " + std::to_string(route) + ":";
        for (auto& [subarchitecture, interests] : receivers)
          for (auto interest : interests)
            text += " " + subarchitecture + " for " + std::to_string(interest);
        sent.push_back(text);
      }
    };
  }

  /// Writes entries of the subarchitecture a at once.
  void write(PeerRoutes& by, const std::vector<std::string>& ids) {
    PeerRoutes::Outgoing outgoing;
    for (auto& id : ids) {
      auto event = std::make_shared<ChangeEvent>();
      event->operation = Operation::overwrite;
      event->address = {"a", id};
      event->type = descriptor_of<Box>();
      by.collect(event, by.match(*event, Value::of(Box{})), outgoing);
    }
    by.push(std::move(outgoing), record_near(), record_far());
  }

  static Interest wants(InterestId id, const ChangeFilter& filter = any_change().in("a")) {
    return {"", id, filter, true};
  }

  PeerRoutes routes{false};
  std::vector<std::string> sent;
};

} // namespace

TEST_F(PeerRoutesTest, APeerGetsWhatItWants) {
  auto b = routes.add("b", std::nullopt);
  routes.set_interest(b, wants(7, any_change().at({"a", "x"})));
  routes.set_interest(b, wants(8));
  write(routes, {"x", "y"});
  EXPECT_THAT(sent, ElementsAre("x to peer 0 for 7", "x to peer 0 for 8", "y to peer 0 for 8"));
  EXPECT_EQ(routes.counters().forwarded, 2u);
  sent.clear();
  routes.set_interest(b, {"", 8, any_change().in("a"), false});
  write(routes, {"x", "y"});
  EXPECT_THAT(sent, ElementsAre("x to peer 0 for 7"));
}

TEST_F(PeerRoutesTest, ARouteCarriesOneCopyForAllItsPeers) {
  auto route = routes.add_route();
  for (auto name : {"b", "c"})
    routes.set_interest(routes.add(name, route), wants(7));
  write(routes, {"x"});
  EXPECT_THAT(sent, ElementsAre("x on route 0: b for 7 c for 7"));
  EXPECT_EQ(routes.counters().routed, 1u);
  EXPECT_EQ(routes.counters().forwarded, 2u);
}

TEST_F(PeerRoutesTest, ABroadcastGoesToEveryPeerOnItsOwn) {
  PeerRoutes broadcast{true};
  auto route = broadcast.add_route();
  broadcast.add("b", route);
  broadcast.add("c", route);
  broadcast.add("d", std::nullopt);
  write(broadcast, {"x"});
  EXPECT_THAT(sent,
              ElementsAre("x to peer 2 for 0", "x on route 0: b for 0", "x on route 0: c for 0"));
}

TEST_F(PeerRoutesTest, ARouteIsSentNoMoreThanItsLimit) {
  auto b = routes.add("b", routes.add_route());
  routes.set_interest(b, wants(7));
  for (std::uint32_t i = 0; i < route_limit + 10; ++i)
    write(routes, {std::to_string(i)});
  EXPECT_EQ(sent.size(), route_limit);
  EXPECT_EQ(routes.counters().backlog, 10u);
  sent.clear();
  routes.acknowledge(0, 4, record_far());
  EXPECT_EQ(sent.size(), 4u);
}

TEST_F(PeerRoutesTest, WhatWaitsForAWithdrawnInterestIsNotSent) {
  auto b = routes.add("b", routes.add_route());
  routes.set_interest(b, wants(7));
  for (std::uint32_t i = 0; i < route_limit + 10; ++i)
    write(routes, {std::to_string(i)});
  sent.clear();
  routes.set_interest(b, {"", 7, any_change().in("a"), false});
  routes.acknowledge(0, 10, record_far());
  EXPECT_THAT(sent, IsEmpty());
}

TEST_F(PeerRoutesTest, ALostProcessIsToldNothingAndAskedNothing) {
  auto route = routes.add_route();
  auto b = routes.add("b", route);
  auto c = routes.add("c", std::nullopt);
  routes.set_interest(b, wants(7));
  EXPECT_THAT(routes.concerned(any_change().anywhere()), ElementsAre(b, c));
  routes.end_route(route);
  write(routes, {"x"});
  EXPECT_THAT(sent, IsEmpty());
  EXPECT_THAT(routes.concerned(any_change().anywhere()), ElementsAre(c));
  EXPECT_EQ(routes.find("b"), b) << "it is known, and may not be there for a while";
}

TEST_F(PeerRoutesTest, ANameMayComeAgainForAnotherPeer) {
  auto former = routes.add("b", std::nullopt);
  routes.set_interest(former, wants(7));
  routes.remove(former);
  EXPECT_FALSE(routes.find("b"));
  EXPECT_THAT(routes.subarchitectures(), IsEmpty());
  auto b = routes.add("b", std::nullopt);
  EXPECT_NE(b, former);
  EXPECT_EQ(routes.find("b"), b);
  write(routes, {"x"});
  EXPECT_THAT(sent, IsEmpty()) << "what the former wanted";
}

TEST_F(PeerRoutesTest, AFilterOfOneSubarchitectureConcernsNoOther) {
  routes.add("b", std::nullopt);
  auto c = routes.add("c", std::nullopt);
  EXPECT_THAT(routes.concerned(any_change().in("c")), ElementsAre(c));
}

} // namespace castor::test
