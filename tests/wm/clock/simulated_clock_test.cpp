#include "castor/wm/clock/clock_control.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace castor {

namespace {

using namespace std::chrono_literals;

class SimulatedClockTest : public testing::TestWithParam<Activity::Order> {
protected:
  /// Lets time go on to `limit`, and returns when it stands there.
  void go_on_to(Timestamp limit) {
    control.set_limit(limit);
    std::unique_lock guard{mutex};
    EXPECT_TRUE(changed.wait_for(guard, 30s, [&] { return reached == limit; }));
  }

  /// An actor without a thread, that wakes every `period` and does nothing else.
  void tick(char name, std::uint64_t order, Timestamp time, Timestamp period) {
    clock->wake_at(time, order, [this, name, order, time, period] {
      auto turn = activity->begin();
      log += name;
      if (clock->now() != time)
        log += '!';
      tick(name, order, time + period, period);
      activity->end(turn);
    });
  }

  std::shared_ptr<Activity> activity = std::make_shared<Activity>(GetParam());
  std::shared_ptr<SimulatedClock> clock =
    std::make_shared<SimulatedClock>(activity, ClockAdvance{});
  std::mutex mutex;
  std::condition_variable changed;
  Timestamp reached{0};
  ClockControl control{{clock, nullptr, nullptr, [this](Timestamp x) {
                          std::lock_guard guard{mutex};
                          reached = x;
                          changed.notify_all();
                        }}};
  std::string log;
};

INSTANTIATE_TEST_SUITE_P(Orders, SimulatedClockTest,
                         testing::Values(Activity::Order::parallel, Activity::Order::one_at_a_time),
                         [](auto& x) {
                           return x.param == Activity::Order::parallel ? "parallel"
                                                                       : "one_at_a_time";
                         });

TEST_P(SimulatedClockTest, WakesSleepersInOrderAndStandsAtItsLimit) {
  {
    auto hold = clock->hold();
    tick('b', 2, 1s, 1s);
    tick('a', 1, 1s, 1s);
    tick('c', 0, 1500ms, 10s);
  }
  EXPECT_EQ(clock->now(), Timestamp{0});
  go_on_to(2s);
  EXPECT_EQ(log, "abcab");
  EXPECT_EQ(clock->now(), Timestamp{2s});
}

TEST_P(SimulatedClockTest, StandsWhileSomebodyHoldsIt) {
  auto hold = clock->hold();
  tick('a', 1, 1s, 1s);
  control.set_limit(10s);
  EXPECT_EQ(clock->now(), Timestamp{0});
  EXPECT_EQ(log, "");
  hold = TimeHold{};
  go_on_to(10s);
  EXPECT_EQ(log, "aaaaaaaaaa");
}

TEST_P(SimulatedClockTest, WhoIsForgottenIsNotWoken) {
  {
    auto hold = clock->hold();
    auto key = clock->wake_at(1s, 0, [this] { log += 'a'; });
    clock->forget(key);
  }
  go_on_to(2s);
  EXPECT_EQ(log, "");
}

TEST_P(SimulatedClockTest, IsPausedAndGoesOnByAStep) {
  control.set_pace({std::nullopt, true});
  control.set_limit(10s);
  {
    auto hold = clock->hold();
    tick('a', 1, 1s, 1s);
  }
  EXPECT_EQ(clock->now(), Timestamp{0});
  control.step(2500ms);
  while (clock->now() < 2500ms)
    std::this_thread::yield();
  EXPECT_EQ(log, "aa");
  control.set_pace({});
  go_on_to(10s);
  EXPECT_EQ(log, "aaaaaaaaaa");
}

TEST_P(SimulatedClockTest, KeepsAFactorOfRealTime) {
  control.set_pace({20, false});
  {
    auto hold = clock->hold();
    tick('a', 1, 1s, 1s);
  }
  auto begin = std::chrono::steady_clock::now();
  go_on_to(4s);
  EXPECT_GE(std::chrono::steady_clock::now() - begin, 190ms);
  EXPECT_EQ(log, "aaaa");
}

/// Actors that pass a token on to each other, and now and then sleep; threads from outside disturb
/// them.
TEST_P(SimulatedClockTest, LosesNobodyWhileThreadsFromOutsideComeAndGo) {
  std::atomic<bool> over{false};
  std::vector<std::thread> outsiders;
  for (int i = 0; i < 3; ++i)
    outsiders.emplace_back([&] {
      while (!over) {
        clock->hold();
        std::this_thread::yield();
      }
    });
  {
    auto hold = clock->hold();
    tick('a', 1, 1ms, 1ms);
  }
  go_on_to(2s);
  EXPECT_EQ(log, std::string(2000, 'a'));
  over = true;
  for (auto& x : outsiders)
    x.join();
}

TEST(Activity, TurnsAreTakenInTheOrderInWhichTheyWereGiven) {
  Activity activity{Activity::Order::one_at_a_time};
  std::vector<Activity::Turn> turns;
  for (int i = 0; i < 8; ++i)
    turns.push_back(activity.begin());
  std::vector<int> order;
  std::vector<std::thread> threads;
  for (int i = 7; i >= 0; --i)
    threads.emplace_back([&, i] {
      activity.await(turns[static_cast<std::size_t>(i)]);
      order.push_back(i);
      activity.end(turns[static_cast<std::size_t>(i)]);
    });
  for (auto& x : threads)
    x.join();
  EXPECT_EQ(order, (std::vector<int>{0, 1, 2, 3, 4, 5, 6, 7}));
}

} // namespace

} // namespace castor
