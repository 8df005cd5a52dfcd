#include "castor/actors/component/push_flow.hpp"

#include "castor/tests/actors/component/scripted.hpp"
#include "castor/tests/support/flow_line.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cstdint>
#include <deque>
#include <numeric>
#include <utility>
#include <vector>

namespace castor::test {

namespace {

struct ArriveAsPush {
  void operator()(const Value& x, std::deque<std::int64_t>& queue) const {
    queue.push_back(x.as<Note>()->number);
  }
};

/// A provider and a receiver, and what is on its way between them.
class PushLine : public FlowLine<PushFlow, std::int64_t, ArriveAsPush> {
public:
  using FlowLine::FlowLine;

  void push() { send(flow.push(Value::of(Note{++pushed, {}}))); }

  void push_often(int times) {
    for (int i = 0; i < times; ++i)
      push();
  }

  void take_all() {
    while (!queue.empty()) {
      take();
      acknowledge();
    }
  }

  std::int64_t pushed = 0;
};

TEST(PushFlow, KeepsTheNewestOfWhatIsTooMuch) {
  PushLine line{8};
  line.push_often(8);
  EXPECT_EQ(line.queue.size(), 8u);
  line.push_often(2);
  EXPECT_EQ(line.flow.dropped(), 0u);
  line.push_often(90);
  EXPECT_EQ(line.flow.dropped(), 90u);
  EXPECT_EQ(line.flow.in_flight(), 8u);
  EXPECT_EQ(line.flow.waiting(), 2u);
  line.take_all();
  EXPECT_EQ(line.taken, (std::vector<std::int64_t>{1, 2, 3, 4, 5, 6, 7, 8, 99, 100}));
}

TEST(PushFlow, OfOneIsAlwaysTheNewest) {
  PushLine line{1};
  line.push_often(100);
  line.take_all();
  EXPECT_EQ(line.taken, (std::vector<std::int64_t>{1, 100}));
}

TEST(PushFlow, SurvivesMoreAcknowledgementsThanItSent) {
  PushFlow flow{0};
  flow.acknowledge(5);
  EXPECT_EQ(flow.in_flight(), 0u);
  EXPECT_EQ(flow.limit(), 1u);
}

RC_GTEST_PROP(PushFlowProperties, DropsOnlyWhatIsTooMuchAndNeverTheNewest, ()) {
  auto limit = *rc::gen::inRange<std::uint32_t>(1, 40);
  // 0: take, 1: acknowledgements arrive, 2: push.
  auto steps = *rc::gen::scale(10.0, rc::gen::container<std::vector<int>>(
                                       rc::gen::weightedElement<int>({{5, 0}, {2, 1}, {6, 2}})));
  PushLine line{limit};
  for (auto step : steps) {
    if (step == 2) {
      // As far as the provider can know.
      auto not_taken = std::accumulate(line.acknowledgements.begin(), line.acknowledgements.end(),
                                       line.queue.size() + line.flow.waiting());
      auto dropped = line.flow.dropped();
      line.push();
      RC_ASSERT(line.flow.dropped() == dropped || not_taken >= limit);
    } else if (step == 1) {
      line.acknowledge();
    } else if (!line.queue.empty()) {
      line.take();
    }
    RC_ASSERT(line.queue.size() <= limit);
    RC_ASSERT(line.flow.waiting() <= Receipts::batch_for(limit));
  }
  line.acknowledge();
  line.take_all();
  RC_ASSERT(line.flow.waiting() == 0u);
  RC_ASSERT(line.taken.size() + line.flow.dropped() == static_cast<std::size_t>(line.pushed));
  RC_ASSERT(std::is_sorted(line.taken.begin(), line.taken.end()));
  if (line.pushed > 0)
    RC_ASSERT(line.taken.back() == line.pushed);
}

} // namespace

} // namespace castor::test
