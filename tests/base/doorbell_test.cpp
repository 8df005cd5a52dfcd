#include "castor/base/doorbell.hpp"

#include "castor/base/ring_batch_end.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <deque>
#include <memory>
#include <thread>

namespace castor {

namespace {

using namespace std::chrono_literals;
using Clock = Doorbell::Clock;

constexpr auto for_ever = Clock::time_point::max();

std::shared_ptr<Doorbell> make_bell() {
  return std::make_shared<Doorbell>();
}

/// A thread that waits for news again and again, until there were so many.
class Sleeper {
public:
  /// @param patience of every second wait; the others have no deadline
  Sleeper(int news, Clock::duration patience)
    : thread_([this, news, patience] {
        bool is_patient = false;
        while (heard_ < news) {
          is_patient = !is_patient;
          bell_->wait_while([this] { return told_ == heard_; },
                            is_patient ? for_ever : Clock::now() + patience);
          heard_ = told_.load();
        }
      }) {}

  void tell() {
    ++told_;
    Doorbell::ring(bell_);
  }

  int heard() const { return heard_; }
  void join() { thread_.join(); }

private:
  std::shared_ptr<Doorbell> bell_ = make_bell();
  std::atomic<int> told_{0};
  std::atomic<int> heard_{0};
  std::thread thread_;
};

TEST(Doorbell, OneWhoHasSomethingToDoDoesNotWait) {
  EXPECT_TRUE(make_bell()->wait_while([] { return false; }, for_ever));
  EXPECT_TRUE(make_bell()->wait_while([] { return false; }, Clock::now() - 1s));
}

TEST(Doorbell, AWaitEndsAtItsDeadline) {
  auto until = Clock::now() + 20ms;
  EXPECT_FALSE(make_bell()->wait_while([] { return true; }, until));
  EXPECT_GE(Clock::now(), until);
  EXPECT_FALSE(make_bell()->wait_while([] { return true; }, Clock::now() - 1s));
}

TEST(Doorbell, ARingWhileNobodyWaitsIsForgotten) {
  auto bell = make_bell();
  Doorbell::ring(bell);
  EXPECT_FALSE(bell->wait_while([] { return true; }, Clock::now() + 5ms));
}

TEST(Doorbell, NoRingIsLost) {
  constexpr int news = 20'000;
  Sleeper sleeper{news, 1us};
  for (int i = 1; i <= news; ++i) {
    sleeper.tell();
    // Every other time it is about to wait again.
    while (i % 2 == 0 && sleeper.heard() < i)
      std::this_thread::yield();
  }
  sleeper.join();
}

TEST(Doorbell, ARingWithoutReasonDoesNotEndAWait) {
  auto bell = make_bell();
  std::atomic<int> looks{0};
  std::atomic<bool> is_idle{true};
  std::thread sleeper{
    [&] { EXPECT_TRUE(bell->wait_while([&] { return ++looks, is_idle.load(); }, for_ever)); }};
  // It looks again after every ring that it hears.
  while (looks < 10)
    Doorbell::ring(bell);
  is_idle = false;
  Doorbell::ring(bell);
  sleeper.join();
  EXPECT_FALSE(is_idle);
}

class RingBatchTest : public testing::TestWithParam<Clock::duration> {};

TEST_P(RingBatchTest, EveryoneIsWokenHoweverManyThereAre) {
  constexpr int news = 500;
  constexpr int sleepers = 30;
  std::deque<Sleeper> all;
  for (int i = 0; i < sleepers; ++i)
    all.emplace_back(news, GetParam());
  for (int i = 1; i <= news; ++i) {
    {
      RingBatch batch;
      for (auto& x : all)
        x.tell();
    }
    // Now and then all wait when the next batch comes; else some do, whom the chain passes over.
    for (auto& x : all)
      while (i % 8 == 0 && x.heard() < i)
        std::this_thread::yield();
  }
  for (auto& x : all)
    x.join();
}

// With short deadlines threads wake of themselves before it is their turn to be rung.
INSTANTIATE_TEST_SUITE_P(Patiences, RingBatchTest,
                         testing::Values(Clock::duration{1us}, Clock::duration{50us},
                                         Clock::duration{1h}));

TEST(RingBatch, ThoseWhereNobodyWaitsArePassedOver) {
  Sleeper first{1, 1h};
  Sleeper last{1, 1h};
  {
    RingBatch batch;
    for (int i = 0; i < 100; ++i)
      Doorbell::ring(make_bell());
    first.tell();
    for (int i = 0; i < 100; ++i)
      Doorbell::ring(make_bell());
    last.tell();
  }
  first.join();
  last.join();
}

TEST(RingBatch, RingsAtTheEndOfTheOutermost) {
  // Is not woken in between: a ring at which nobody waits is forgotten, and here it is not.
  auto bell = make_bell();
  std::atomic<bool> is_idle{true};
  std::atomic<bool> is_waiting{false};
  std::thread sleeper;
  {
    RingBatch outer;
    {
      RingBatch inner;
      Doorbell::ring(bell);
    }
    sleeper = std::thread{[&] {
      bell->wait_while(
        [&] {
          // Only a ring lets it look again.
          if (is_waiting.exchange(true))
            is_idle = false;
          return is_idle.load();
        },
        for_ever);
    }};
    while (!is_waiting)
      std::this_thread::yield();
  }
  sleeper.join();
  EXPECT_FALSE(is_idle);
}

TEST(RingBatch, OthersAreCalledAtItsEndOnceEach) {
  auto first = std::make_shared<int>(0);
  auto second = std::make_shared<int>(0);
  auto count = [](void* x) { ++*static_cast<int*>(x); };
  EXPECT_FALSE(at_end_of_ring_batch(first, count)) << "there is none";
  for (int batches = 1; batches <= 3; ++batches) {
    {
      RingBatch outer;
      {
        RingBatch inner;
        for (auto& who : {first, second, first})
          EXPECT_TRUE(at_end_of_ring_batch(who, count));
      }
      EXPECT_EQ(*first, batches - 1);
    }
    EXPECT_EQ(*first, batches);
    EXPECT_EQ(*second, batches);
  }
  EXPECT_EQ(first.use_count(), 1);
}

} // namespace

} // namespace castor
