#include "castor/wm/clock/sleepers.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string>

namespace castor {

namespace {

using namespace std::chrono_literals;

constexpr auto all = std::numeric_limits<std::size_t>::max();

class SleepersTest : public testing::Test {
protected:
  Sleepers::Key add(Timestamp time, std::uint64_t order, char name) {
    return sleepers.add(time, order, [this, name] { woken += name; });
  }

  /// Names of those that are woken at that time, in order.
  std::string wake(Timestamp now, std::size_t count = all) {
    woken.clear();
    for (auto& wake : sleepers.take_due(now, count))
      wake();
    return woken;
  }

  Sleepers sleepers;
  std::string woken;
};

TEST_F(SleepersTest, AreWokenByTimeThenByOrderThenInTheirOwn) {
  add(2s, 1, 'd');
  add(1s, 2, 'b');
  add(1s, 2, 'c');
  add(1s, 1, 'a');
  add(3s, 0, 'e');
  EXPECT_EQ(sleepers.next(), Timestamp{1s});
  EXPECT_EQ(wake(2s), "abcd");
  EXPECT_EQ(sleepers.next(), Timestamp{3s});
}

TEST_F(SleepersTest, AreWokenOneAtATimeIfAsked) {
  add(1s, 2, 'b');
  add(1s, 1, 'a');
  EXPECT_EQ(wake(1s, 1), "a");
  EXPECT_EQ(wake(1s, 1), "b");
  EXPECT_EQ(wake(1s, 1), "");
}

TEST_F(SleepersTest, AreNotWokenBeforeTheirTimeNorAfterTheyWereRemoved) {
  auto a = add(1s, 1, 'a');
  add(1s, 1, 'b');
  EXPECT_EQ(wake(999'999us), "");
  sleepers.remove(a);
  EXPECT_EQ(wake(1s), "b");
  sleepers.remove(a);
  EXPECT_EQ(sleepers.next(), Timestamp::max());
}

} // namespace

} // namespace castor
