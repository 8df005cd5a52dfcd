#include "castor/actors/system/system_inbox.hpp"

#include <gtest/gtest.h>

#include <string>
#include <thread>
#include <variant>

namespace castor::test {

namespace {

using namespace std::chrono_literals;

TEST(SystemInbox, TheFirstRequestToEndCounts) {
  SystemInbox inbox;
  EXPECT_FALSE(inbox.ended());
  inbox.end(3, "one");
  inbox.end(4, "two");
  ASSERT_TRUE(inbox.ended());
  EXPECT_EQ(*inbox.ended(), std::pair(3, std::string{"one"}));
}

TEST(SystemInbox, OrdersAreTakenOnceInTheirOrder) {
  SystemInbox inbox;
  inbox.add({"a", {}});
  inbox.add({"b", {}});
  auto orders = inbox.take_orders();
  ASSERT_EQ(orders.size(), 2u);
  EXPECT_EQ(std::get<std::string>(orders.front().what), "a");
  EXPECT_TRUE(inbox.take_orders().empty());
}

TEST(SystemInbox, WaitsUntilSomethingIsThere) {
  SystemInbox inbox;
  EXPECT_FALSE(inbox.wait(1ms));
  std::thread order{[&] { inbox.add({"a", {}}); }};
  // An order ends the wait, but not the system.
  EXPECT_FALSE(inbox.wait(1h));
  order.join();
  inbox.take_orders();
  std::thread end{[&] { inbox.end(0, "done"); }};
  EXPECT_TRUE(inbox.wait(1h));
  end.join();
}

TEST(SystemInbox, OnlyTheLimitThatIsAwaitedCounts) {
  SystemInbox inbox;
  inbox.await_limit(500ms);
  inbox.note_limit(500ms);
  EXPECT_TRUE(inbox.is_at_limit());
  inbox.await_limit(800ms);
  EXPECT_FALSE(inbox.is_at_limit());
  // Noted before the clock had the new limit, and late.
  inbox.note_limit(500ms);
  EXPECT_FALSE(inbox.is_at_limit());
  inbox.note_limit(800ms);
  EXPECT_TRUE(inbox.is_at_limit());
}

} // namespace

} // namespace castor::test
