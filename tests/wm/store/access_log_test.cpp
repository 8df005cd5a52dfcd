#include "castor/wm/store/access_log.hpp"

#include "castor/tests/wm/memory/working_memories.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace castor::test {

namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(AccessLog, CountsByComponentSubarchitectureAndType) {
  AccessLog log;
  EXPECT_THAT(log.all(), IsEmpty());
  log.note("b", "vision", "ROI", &Access::adds);
  log.note("a", "vision", "ROI", &Access::reads);
  log.note("b", "vision", "ROI", &Access::adds);
  log.note("b", "vision", "Ball", &Access::deletes);
  log.note("b", "arm", "ROI", &Access::overwrites);
  log.note("b", "arm", "ROI", &Access::events);
  EXPECT_THAT(log.all(), ElementsAre(Access{"a", "vision", "ROI", 0, 0, 0, 1, 0},
                                     Access{"b", "arm", "ROI", 0, 1, 0, 0, 1},
                                     Access{"b", "vision", "Ball", 0, 0, 1, 0, 0},
                                     Access{"b", "vision", "ROI", 2, 0, 0, 0, 0}));
  EXPECT_EQ(log.all().back().writes(), 2u);
}

class Accesses : public WorkingMemories {
protected:
  std::vector<Access> of(const std::string& name) {
    return ask<AccessReport>(wm.at(name), AccessQuery{}).accesses;
  }

  static Patience reader() {
    return {std::make_shared<const Client>(Client{"reader", "b"}), 1, 1s};
  }
};

TEST_F(Accesses, AreCountedWhereTheEntriesAre) {
  add({"a", "x"});
  overwrite({"a", "x"}, 0);
  ask<Outcome<EntryPtr>>(wm.at("b"), ReadRequest{{"a", "x"}, reader()});
  TypeQuery items;
  items.subarchitecture = "a";
  items.type = "Item";
  ask<Outcome<std::vector<EntryPtr>>>(wm.at("b"), QueryRequest{items, reader()});
  remove({"a", "x"});
  EXPECT_THAT(of("a"), ElementsAre(Access{"reader", "a", "Item", 0, 0, 0, 2, 0},
                                   Access{"tester", "a", "Item", 1, 1, 1, 0, 0}));
  EXPECT_THAT(of("b"), IsEmpty());
}

TEST_F(Accesses, LeaveOutWhatWasRefused) {
  overwrite({"a", "x"}, 0);
  ask<Outcome<EntryPtr>>(wm.at("a"), ReadRequest{{"a", "x"}, reader()});
  EXPECT_THAT(of("a"), IsEmpty());
}

TEST_F(Accesses, EventsAreCountedWhereTheyAreTold) {
  auto& component = listen();
  auto& onlooker = listen();
  Subscribe request{1, any_change().anywhere()};
  request.component = "watcher";
  caf::send_as(component.actor, wm.at("b"), request);
  subscribe(onlooker, "b", 1, any_change().anywhere());
  add({"a", "x"});
  add({"b", "y"});
  EXPECT_THAT(of("b"), ElementsAre(Access{"tester", "b", "Item", 1, 0, 0, 0, 0},
                                   Access{"watcher", "a", "Item", 0, 0, 0, 0, 1},
                                   Access{"watcher", "b", "Item", 0, 0, 0, 0, 1}));
}

} // namespace

} // namespace castor::test
