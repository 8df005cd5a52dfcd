#include "castor/mapping/planar/scan_queue.hpp"

#include <gtest/gtest.h>

#include <memory>

namespace castor::mapping {

namespace {

std::shared_ptr<const LaserScan> scan(std::int64_t time) {
  auto result = std::make_shared<LaserScan>();
  result->time = time;
  return result;
}

TEST(ScanQueue, AScanWaitsForTheOdometryOfItsTime) {
  ScanQueue queue;
  queue.add(Odometry{0, {0, 0, 0}, {}});
  queue.add(scan(15));
  EXPECT_FALSE(queue.next());
  EXPECT_FALSE(queue.empty());
  queue.add(Odometry{20, {2, 0, 0}, {}});
  auto ready = queue.next();
  ASSERT_TRUE(ready);
  EXPECT_EQ(ready->scan->time, 15);
  EXPECT_NEAR(ready->odometry.x, 1.5, 1e-12);
  EXPECT_TRUE(queue.empty());
  EXPECT_FALSE(queue.next());
}

TEST(ScanQueue, ScansAreTakenInTheirOrder) {
  ScanQueue queue;
  queue.add(scan(1));
  queue.add(scan(2));
  EXPECT_FALSE(queue.next());
  queue.add(Odometry{0, {}, {}});
  queue.add(Odometry{5, {}, {}});
  EXPECT_EQ(queue.next()->scan->time, 1);
  EXPECT_EQ(queue.next()->scan->time, 2);
}

TEST(ScanQueue, AScanOlderThanAllOdometryIsDropped) {
  ScanQueue queue;
  queue.add(Odometry{10, {}, {}});
  queue.add(scan(5));
  queue.add(scan(10));
  EXPECT_EQ(queue.next()->scan->time, 10);
}

TEST(ScanQueue, WithoutOdometryTheOldestScansAreDropped) {
  ScanQueue queue{2};
  for (int time : {1, 2, 3})
    queue.add(scan(time));
  queue.add(Odometry{0, {}, {}});
  queue.add(Odometry{9, {}, {}});
  EXPECT_EQ(queue.next()->scan->time, 2);
  EXPECT_EQ(queue.next()->scan->time, 3);
  EXPECT_FALSE(queue.next());
}

} // namespace

} // namespace castor::mapping
