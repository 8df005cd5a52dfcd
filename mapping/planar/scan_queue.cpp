#include "castor/mapping/planar/scan_queue.hpp"

#include <utility>

namespace castor::mapping {

void ScanQueue::add(std::shared_ptr<const LaserScan> x) {
  waiting_.push_back(std::move(x));
  if (waiting_.size() > most_)
    waiting_.pop_front();
}

std::optional<ScanQueue::Ready> ScanQueue::next() {
  while (!waiting_.empty()) {
    auto scan = waiting_.front();
    auto odometry = history_.pose_at(scan->time);
    auto newest = history_.newest();
    if (!odometry && (!newest || newest->time < scan->time))
      return {};
    waiting_.pop_front();
    if (odometry)
      return Ready{std::move(scan), *odometry};
  }
  return {};
}

} // namespace castor::mapping
