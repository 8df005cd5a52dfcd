#pragma once

#include "castor/mapping/geometry/types.hpp"
#include "castor/wm/values/timestamp.hpp"

#include <cstddef>
#include <deque>
#include <optional>
#include <utility>

namespace castor::geometry {

/// Poses of one frame in its parent over time. A fixed one holds at all times.
class TransformHistory {
public:
  /// Adds the pose, in whatever order; one of the same time is replaced. Fixed and moving poses
  /// replace each other. Poses older than `length` before the newest are forgotten, and the oldest
  /// of more than `max_count`.
  void add(const Transform& x, Timestamp length, std::size_t max_count);

  bool is_fixed() const { return is_fixed_; }

  /// The pose at that time, interpolated between its neighbours; nothing outside of `known`, since
  /// nobody knows how it went on.
  std::optional<Pose> at(Timestamp time) const;

  /// First and last time at which the pose is known.
  /// \pre it is not fixed.
  std::pair<Timestamp, Timestamp> known() const;

private:
  struct Sample {
    Timestamp time{0};
    Pose pose;
  };

  /// In order of time; never empty after the first `add`.
  std::deque<Sample> samples_;
  bool is_fixed_ = false;
};

} // namespace castor::geometry
