#include "castor/wm/events/event_flow.hpp"

#include "castor/tests/wm/values/test_types.hpp"

#include "castor/tests/support/flow_line.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <deque>
#include <memory>
#include <vector>

namespace castor::test {

namespace {

struct ArriveAsEvents {
  void operator()(const EventFlow::Batch& batch, std::deque<std::uint64_t>& queue) const {
    for (auto& notice : batch)
      queue.push_back(notice.event->sequence);
  }
};

/// A sender and a receiver, and what is on its way between them.
class Line : public FlowLine<EventFlow, std::uint64_t, ArriveAsEvents> {
public:
  using FlowLine::FlowLine;

  /// So many entries are written at once, for the first time.
  void write(std::size_t entries) {
    EventFlow::Batch batch;
    for (std::size_t i = 0; i < entries; ++i) {
      auto event = std::make_shared<ChangeEvent>();
      event->address = {"a", std::to_string(++written)};
      event->type = descriptor_of<Box>();
      event->sequence = written;
      batch.push_back({event, {1}});
    }
    send(flow.push(std::move(batch)));
  }

  std::uint64_t written = 0;
};

TEST(EventFlow, SendsUpToItsLimitAndGoesOnWithWhatIsTaken) {
  Line line{16};
  for (int i = 0; i < 40; ++i)
    line.write(1);
  EXPECT_EQ(line.queue.size(), 16u);
  EXPECT_EQ(line.flow.backlog().size(), 24u);
  line.take();
  line.take();
  line.take();
  EXPECT_TRUE(line.acknowledgements.empty()) << "it is not worth a message yet";
  line.take();
  line.acknowledge();
  EXPECT_EQ(line.queue.size(), 16u);
  EXPECT_EQ(line.flow.backlog().size(), 20u);
}

TEST(EventFlow, MergesNothingUntilMoreThanItsLimitWait) {
  Line line{100};
  for (int i = 0; i < 100; ++i)
    line.write(1);
  for (int i = 0; i < 24; ++i)
    line.take();
  line.acknowledge();
  for (int i = 0; i < 24; ++i)
    line.write(1);
  EXPECT_EQ(line.queue.size() + line.flow.backlog().size(), 100u);
  EXPECT_FALSE(line.flow.backlog().is_merging());
  line.write(1);
  line.write(1);
  EXPECT_TRUE(line.flow.backlog().is_merging());
}

TEST(EventFlow, TakesNoSmallerLimitThanTheLeast) {
  Line line{0};
  for (int i = 0; i < 40; ++i)
    line.write(1);
  EXPECT_EQ(line.queue.size(), std::size_t{least_queue_limit});
}

TEST(EventFlow, SurvivesMoreAcknowledgementsThanItSentEvents) {
  EventFlow flow{16};
  flow.acknowledge(5);
  EXPECT_EQ(flow.in_flight(), 0u);
}

RC_GTEST_PROP(EventFlowProperties, NoEventIsLostOrComesTwiceAndNobodyStarves, ()) {
  auto limit = *rc::gen::inRange<std::uint32_t>(0, 40);
  // 0: take, 1: acknowledgements arrive, otherwise a write of so many entries less one.
  auto steps = *rc::gen::scale(
    10.0, rc::gen::container<std::vector<std::size_t>>(
            rc::gen::weightedElement<std::size_t>({{6, 0}, {2, 1}, {6, 2}, {1, 4}, {1, 30}})));
  Line line{limit};
  auto at_most = std::max(limit, least_queue_limit);
  for (auto step : steps) {
    if (step > 1)
      line.write(step - 1);
    else if (step == 1)
      line.acknowledge();
    else if (!line.queue.empty())
      line.take();
    RC_ASSERT(line.flow.in_flight() >= line.queue.size());
    RC_ASSERT(line.queue.size() < at_most + 29);
  }
  // Whoever takes all that he gets, gets all.
  line.acknowledge();
  while (!line.queue.empty()) {
    line.take();
    if (line.queue.empty())
      line.acknowledge();
  }
  RC_ASSERT(line.flow.backlog().empty());
  RC_ASSERT(line.flow.in_flight() < Receipts::batch_for(limit));
  RC_ASSERT(line.taken.size() == line.written);
  for (std::size_t i = 0; i < line.taken.size(); ++i)
    RC_ASSERT(line.taken[i] == i + 1);
}

} // namespace

} // namespace castor::test
