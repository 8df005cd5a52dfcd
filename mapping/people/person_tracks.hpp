#pragma once

#include "castor/mapping/planar/poses.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace castor::mapping {

struct TrackOptions {
  /// Standard deviation of a detection, metres.
  double noise = 0.08;
  /// How much people change their velocity: root of the spectral density of their acceleration,
  /// m/s^1.5.
  double acceleration = 0.5;
  /// A detection belongs to a person within so many standard deviations, and within so many metres
  /// of where the person is expected.
  double gate = 3.5;
  double farthest = 1.2;
  /// Somebody is a person after so many detections, such a way and at such a speed.
  int confirming = 6;
  double confirming_way = 0.4;
  double confirming_speed = 0.2;
  /// Seconds after which somebody out of sight is given up, and before it is known as a person.
  double patience = 3;
  double early_patience = 0.35;
  /// A detection so near to another person's is no new person, metres.
  double apart = 0.5;
};

/// Follows several people by where they were detected: a Kalman filter of constant velocity for
/// each, and the assignment of detections to people that is the most likely one altogether. So they
/// keep their ids where they cross, and behind one another.
class PersonTracks {
public:
  struct Track {
    std::int64_t id = 0;
    Point2 place;
    /// m/s.
    Point2 velocity;
    /// Direction of walking; of somebody who stands, the last one.
    double heading = 0;
    /// Share of the last ten scans or so with the person.
    double visibility = 0;
    /// Known to be a person. Ids are given only then.
    bool is_person = false;

    double speed() const { return distance(Point2{}, velocity); }
  };

  /// @param first_id of the first person; others follow
  explicit PersonTracks(const TrackOptions& options, std::int64_t first_id = 1)
    : options_(options), next_id_(first_id) {}

  /// Next detections, not before the last ones.
  /// @param time microseconds
  void add(std::span<const Point2> detections, std::int64_t time);

  /// Where known people are expected at that time.
  std::vector<Point2> expected(std::int64_t time) const;

  /// Those who are known to be people.
  std::vector<Track> people() const;

private:
  struct Followed {
    Track track;
    Point2 first_place;
    /// Variances of place and velocity and their covariance, the same on both axes.
    double place_variance = 0;
    double covariance = 0;
    double velocity_variance = 0;
    int detections = 1;
    /// Time since the last detection, seconds.
    double unseen = 0;
  };

  void predict(Followed& x, double dt) const;
  void correct(Followed& x, const Point2& detection);
  void begin(const Point2& detection);

  TrackOptions options_;
  std::vector<Followed> followed_;
  std::int64_t next_id_;
  std::int64_t time_ = 0;
};

} // namespace castor::mapping
