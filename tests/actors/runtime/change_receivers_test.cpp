#include "castor/actors/runtime/change_receivers.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

namespace castor {

namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

ChangeNotice notice_for(FilterIds filters) {
  return {std::make_shared<ChangeEvent>(), std::move(filters)};
}

class ChangeReceiversTest : public ::testing::Test {
protected:
  void add(ReceiverId id, Priority priority = Priority::medium) {
    receivers.add(
      id, [this, id](const ChangeEvent&) { called.push_back(id); }, priority);
  }

  std::vector<ReceiverId> ids_of(const FilterIds& filters) const {
    std::vector<ReceiverId> result;
    for (auto& x : receivers.of(filters))
      result.push_back(x->id);
    return result;
  }

  ChangeReceivers receivers;
  std::vector<ReceiverId> called;
};

TEST_F(ChangeReceiversTest, AreOrderedByPriorityAndThenByAge) {
  add(1, Priority::low);
  add(2);
  add(3, Priority::high);
  add(4);
  add(5, Priority::high);
  EXPECT_THAT(ids_of({5, 4, 3, 2, 1}), ElementsAre(3, 5, 2, 4, 1));
}

TEST_F(ChangeReceiversTest, AreThoseOfTheFiltersAlone) {
  add(1);
  add(2);
  EXPECT_THAT(ids_of({2, 7}), ElementsAre(2));
  EXPECT_THAT(ids_of({}), IsEmpty());
}

TEST_F(ChangeReceiversTest, WhoIsRemovedIsFoundNoMoreButStaysCallable) {
  add(1);
  auto found = receivers.of({1});
  EXPECT_TRUE(receivers.remove(1));
  EXPECT_FALSE(receivers.remove(1));
  EXPECT_FALSE(receivers.contains(1));
  EXPECT_THAT(ids_of({1}), IsEmpty());
  found.front()->callback(ChangeEvent{});
  EXPECT_THAT(called, ElementsAre(1));
}

TEST_F(ChangeReceiversTest, ListenersAreCalledAtOnceAndTakeTheirFiltersFromTheNotice) {
  add(1);
  receivers.add_listener(2, [this](const ChangeEvent&) { called.push_back(2); });
  auto mixed = notice_for({1, 2});
  EXPECT_TRUE(receivers.call_listeners(mixed));
  EXPECT_THAT(mixed.filters, ElementsAre(1));
  EXPECT_THAT(called, ElementsAre(2));
  EXPECT_FALSE(receivers.call_listeners(mixed));
}

} // namespace

} // namespace castor
