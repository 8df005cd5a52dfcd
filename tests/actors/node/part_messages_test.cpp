#include "castor/actors/node/part_messages.hpp"

#include "castor/actors/node/messages.hpp"
#include "castor/actors/runtime/shell_protocol.hpp"
#include "castor/tools/simulation/testing_system.hpp"
#include "castor/wm/memory/working_memory_protocol.hpp"
#include "castor/wm/values/reflect.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <numeric>
#include <string>
#include <vector>

namespace castor {

struct Parcel {
  std::string content;
};
CASTOR_REFLECT(Parcel, content)

} // namespace castor

namespace castor::test {

namespace {

using testing::Each;
using testing::HasSubstr;

class PartMessagesTest : public testing::Test, protected simulation::TestingSystem {
protected:
  ~PartMessagesTest() override {
    caf::anon_send_exit(working_memory, caf::exit_reason::user_shutdown);
    scheduler.run();
  }

  static caf::message events(std::size_t count) {
    return caf::make_message(
      RoutedEvents{std::vector<RoutedEvent>(count, {std::make_shared<const ChangeEvent>(), {}})});
  }

  static WriteRequest write(std::size_t bytes) {
    WriteRequest result;
    result.address = {"vision", "x"};
    result.client = std::make_shared<const Client>(Client{"writer", "vision", 1});
    result.value = Value::of(Parcel{std::string(bytes, 'x')});
    return result;
  }

  /// Events of the working memory arrive at a process.
  void arrive(ProcessNumber peer, std::size_t count) {
    auto arrived = messages.on_arrival(peer, caf::actor_cast<caf::strong_actor_ptr>(working_memory),
                                       events(count).content());
    ASSERT_TRUE(arrived);
    arrived(nullptr);
    scheduler.run();
  }

  std::uint64_t all_taken() const { return std::accumulate(taken.begin(), taken.end(), 0u); }

  PartMessages messages{system_messages()};
  std::vector<std::uint64_t> taken;
  caf::actor working_memory = system.spawn([this]() -> caf::behavior {
    return {[this](const EventsTaken& x) { taken.push_back(x.count); }};
  });
};

TEST_F(PartMessagesTest, EventsThatHaveArrivedAreAcknowledgedAQuarterOfTheLimitAtATime) {
  for (std::size_t i = 0; i < route_limit; ++i)
    arrive(1, 1);
  EXPECT_EQ(all_taken(), route_limit);
  EXPECT_THAT(taken, Each(route_limit / 4));
  arrive(1, route_limit / 2);
  EXPECT_EQ(all_taken(), route_limit + route_limit / 2);
}

TEST_F(PartMessagesTest, EventsAreCountedForEachProcessApart) {
  arrive(1, route_limit / 8);
  arrive(2, route_limit / 8);
  EXPECT_EQ(all_taken(), 0u);
  arrive(1, route_limit / 8);
  EXPECT_EQ(all_taken(), route_limit / 4);
}

TEST_F(PartMessagesTest, EventsCountOneByOneForTheRecord) {
  ChangeNotice notice;
  EXPECT_EQ(messages.count_events(events(3).content()), 3u);
  EXPECT_EQ(messages.count_events(caf::make_message(notice).content()), 1u);
  EXPECT_EQ(messages.count_events(caf::make_message(ChangeNotices{{notice, notice}}).content()),
            2u);
  EXPECT_EQ(messages.count_events(caf::make_message(StatusQuery{}).content()), 0u);
}

TEST_F(PartMessagesTest, NothingElseIsAcknowledged) {
  EXPECT_FALSE(messages.on_arrival(1, caf::actor_cast<caf::strong_actor_ptr>(working_memory),
                                   caf::make_message(StatusQuery{}).content()));
}

TEST_F(PartMessagesTest, AWriteIsRefusedThatItsWorkingMemoryDoesNotTake) {
  auto owner = make_actor_name(1, 20);
  auto small = caf::make_message(write(10));
  auto large = caf::make_message(write(1000));
  EXPECT_FALSE(messages.check(owner, large.content()));
  messages.set_largest_value(owner, "vision", 500);
  EXPECT_FALSE(messages.check(owner, small.content()));
  EXPECT_TRUE(messages.check(owner, large.content()));
  EXPECT_TRUE(messages.check(
    owner, caf::make_message(BatchRequest{"vision", {write(10), write(1000)}}).content()));
  EXPECT_FALSE(messages.check(make_actor_name(2, 20), large.content()));
}

TEST_F(PartMessagesTest, TheLimitIsThatOfTheLatestWorkingMemoryWhileItsProcessLives) {
  auto former = make_actor_name(1, 20);
  auto present = make_actor_name(1, 21);
  auto large = caf::make_message(write(1000));
  messages.set_largest_value(former, "vision", 500);
  messages.set_largest_value(present, "vision", 500);
  EXPECT_FALSE(messages.check(former, large.content()));
  EXPECT_TRUE(messages.check(present, large.content()));
  messages.process_ended(1);
  EXPECT_FALSE(messages.check(present, large.content()));
}

TEST_F(PartMessagesTest, WhatIsTooLargeIsNamedInTheOutcome) {
  auto failure = messages.too_large(caf::make_message(write(10)).content(), 2000, 1000);
  EXPECT_EQ(failure.kind, FailureKind::too_large);
  EXPECT_THAT(failure.message, HasSubstr("vision/x"));
  auto outcome = messages.failed_outcome(caf::make_message(write(10)).content(), failure);
  ASSERT_TRUE(outcome);
  EXPECT_EQ(outcome->get_as<Outcome<Version>>(0).failure().message, failure.message);
  EXPECT_FALSE(messages.failed_outcome(caf::make_message(StatusQuery{}).content(), failure));
}

TEST_F(PartMessagesTest, APushThatIsDroppedDoesNotCountAsUnderWay) {
  auto receipt = messages.receipt_if_dropped(
    caf::make_message(Pushed{"camera", Value::of(Parcel{"picture"})}).content());
  ASSERT_TRUE(receipt);
  EXPECT_EQ(receipt->get_as<PushesTaken>(0).type, "Parcel");
  EXPECT_EQ(receipt->get_as<PushesTaken>(0).count, 1u);
  EXPECT_FALSE(messages.receipt_if_dropped(caf::make_message(StatusQuery{}).content()));
}

} // namespace

} // namespace castor::test
