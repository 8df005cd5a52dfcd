#pragma once

#include "castor/mapping/planar/poses.hpp"

#include <cstdint>
#include <optional>
#include <set>
#include <span>

namespace castor::mapping {

/// Somebody whom a tracker sees now, in the map frame.
struct SeenPerson {
  std::int64_t id = 0;
  Point2 place;
  /// Direction of walking, radians.
  double heading = 0;
  /// m/s.
  double speed = 0;
};

struct FollowedPersonOptions {
  /// Somebody new is the person who was lost if so near to where that one would be by now, metres.
  double reach = 1;
  /// The same for each second out of sight, m/s, up to so far.
  double growth = 0.5;
  double farthest = 2.5;
};

/// Decides who of those in sight is the person to follow: the one with the same id, or, when that
/// id is gone, somebody new where the person has to be.
class FollowedPerson {
public:
  FollowedPerson(std::int64_t id, const FollowedPersonOptions& options)
    : id_(id), options_(options) {}

  /// @param time microseconds
  std::optional<SeenPerson> find(std::span<const SeenPerson> people, std::int64_t time);

  /// Of now: a person who was lost for a while may have got another one.
  std::int64_t id() const { return id_; }

private:
  std::int64_t id_;
  FollowedPersonOptions options_;
  std::optional<SeenPerson> last_;
  std::int64_t last_time_ = 0;
  /// Who was in sight together with the person, and so is somebody else.
  std::set<std::int64_t> others_;
};

} // namespace castor::mapping
