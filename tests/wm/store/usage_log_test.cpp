#include "castor/wm/store/usage_log.hpp"

#include "castor/tests/wm/memory/working_memories.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace castor::test {

namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(UsageLog, CountsByComponentSubarchitectureAndType) {
  UsageLog log;
  EXPECT_THAT(log.all(), IsEmpty());
  log.record("b", "vision", "ROI", &Usage::adds);
  log.record("a", "vision", "ROI", &Usage::reads);
  log.record("b", "vision", "ROI", &Usage::adds);
  log.record("b", "vision", "Ball", &Usage::deletes);
  log.record("b", "arm", "ROI", &Usage::overwrites);
  log.record("b", "arm", "ROI", &Usage::events);
  EXPECT_THAT(log.all(), ElementsAre(Usage{"a", "vision", "ROI", 0, 0, 0, 1, 0},
                                     Usage{"b", "arm", "ROI", 0, 1, 0, 0, 1},
                                     Usage{"b", "vision", "Ball", 0, 0, 1, 0, 0},
                                     Usage{"b", "vision", "ROI", 2, 0, 0, 0, 0}));
  EXPECT_EQ(log.all().back().writes(), 2u);
}

class Accesses : public WorkingMemories {
protected:
  std::vector<Usage> of(const std::string& name) {
    return ask<UsageReport>(wm.at(name), UsageQuery{}).usages;
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
  EXPECT_THAT(of("a"), ElementsAre(Usage{"reader", "a", "Item", 0, 0, 0, 2, 0},
                                   Usage{"tester", "a", "Item", 1, 1, 1, 0, 0}));
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
  EXPECT_THAT(of("b"), ElementsAre(Usage{"tester", "b", "Item", 1, 0, 0, 0, 0},
                                   Usage{"watcher", "a", "Item", 0, 0, 0, 0, 1},
                                   Usage{"watcher", "b", "Item", 0, 0, 0, 0, 1}));
}

} // namespace

} // namespace castor::test
