#include "castor/actors/runtime/inbox.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <variant>

namespace castor {

namespace {

ChangeNotice change_of(const std::string& id, FilterIds filters = {1}) {
  auto event = std::make_shared<ChangeEvent>();
  event->address.id = id;
  return {event, std::move(filters)};
}

class InboxTest : public ::testing::Test {
protected:
  std::string take_change(Inbox& inbox) {
    return std::get<ChangeNotice>(inbox.take()).event->address.id;
  }

  ChangeReceivers receivers;
  ComponentCounters counters;
};

TEST_F(InboxTest, HandsOutWhatArrivedOldestFirst) {
  Inbox inbox{receivers, counters, EventQueue::all, 100};
  inbox.put(change_of("a"));
  inbox.put(Inbox::Task{"a task", [] {}});
  inbox.put(change_of("b"));
  EXPECT_EQ(take_change(inbox), "a");
  EXPECT_EQ(std::get<Inbox::Task>(inbox.take()).what, "a task");
  EXPECT_EQ(take_change(inbox), "b");
  EXPECT_TRUE(inbox.is_empty());
  EXPECT_EQ(counters.events_received, 2u);
}

TEST_F(InboxTest, OfTheNewestOnlyTheLastChangeIsKept) {
  Inbox inbox{receivers, counters, EventQueue::newest, 4};
  EXPECT_FALSE(inbox.put(change_of("a")));
  inbox.put(Inbox::Task{"a task", [] {}});
  // The one that is dropped is acknowledged: at a limit of 4 each of them is.
  auto acknowledged = inbox.put(change_of("b"));
  ASSERT_TRUE(acknowledged);
  EXPECT_EQ(acknowledged->stream, EventStream::component);
  EXPECT_EQ(acknowledged->count, 1u);
  EXPECT_EQ(std::get<Inbox::Task>(inbox.take()).what, "a task");
  EXPECT_EQ(take_change(inbox), "b");
  EXPECT_EQ(counters.events_discarded, 1u);
}

TEST_F(InboxTest, WhatWasDeliveredIsAcknowledgedInBatches) {
  Inbox inbox{receivers, counters, EventQueue::all, 12};
  EXPECT_FALSE(inbox.delivered());
  EXPECT_FALSE(inbox.delivered());
  auto acknowledged = inbox.delivered();
  ASSERT_TRUE(acknowledged);
  EXPECT_EQ(acknowledged->count, 3u);
  EXPECT_FALSE(inbox.delivered());
}

TEST_F(InboxTest, ChangesThatAreSwitchedOffAreAcknowledgedAndDropped) {
  Inbox inbox{receivers, counters, EventQueue::all, 4};
  inbox.receive_changes(false);
  EXPECT_TRUE(inbox.put(change_of("a")));
  EXPECT_TRUE(inbox.is_empty());
  EXPECT_EQ(counters.events_received, 0u);
  inbox.receive_changes(true);
  EXPECT_FALSE(inbox.put(change_of("b")));
  EXPECT_EQ(take_change(inbox), "b");
}

TEST_F(InboxTest, WhatIsForAListenerDoesNotWaitForTheComponent) {
  int heard = 0;
  receivers.add_listener(7, [&](const ChangeEvent&) { ++heard; });
  Inbox inbox{receivers, counters, EventQueue::all, 4};
  inbox.receive_changes(false);
  inbox.put(change_of("a", {7}));
  EXPECT_EQ(heard, 1);
  EXPECT_TRUE(inbox.is_empty());
}

} // namespace

} // namespace castor
