#pragma once

#include "castor/mapping/people/part_likelihood.hpp"
#include "castor/mapping/people/person_motion.hpp"
#include "castor/mapping/people/scan_view.hpp"
#include "castor/mapping/planar/poses.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace castor::mapping {

struct TrackOptions {
  LikelihoodOptions likelihood;
  /// How much people change their velocity: root of the spectral density of their acceleration,
  /// m/s^1.5.
  double acceleration = 0.8;
  /// The same for how somebody who is hidden goes on, and for the motion before, as which that one
  /// goes on.
  double hidden_acceleration = 0.5;
  double steady_acceleration = 0.35;
  /// Steady motion begins anew if it is off by so much, metres.
  double swerving = 0.35;
  /// Somebody is a person after so many detections, such a way and at such a speed, and if so large
  /// a share of what was seen is where it was free before.
  int confirming = 7;
  double confirming_way = 0.4;
  double confirming_speed = 0.25;
  double confirming_new = 0.8;
  /// Who was not is a person after so long a way, if the place of the beginning is free now.
  double vacating_way = 0.6;
  /// Seconds after which somebody out of sight is given up, before it is known as a person, and
  /// where beams show that nobody is there.
  double patience = 3;
  double early_patience = 0.35;
  double absence = 0.8;
  /// Parts so near to somebody who is seen are nobody new, metres.
  double apart = 0.35;
};

/// Follows several people by their legs and bodies: a Kalman filter of constant velocity for each,
/// and the assignment of all parts to all people that is the most likely altogether. Each person
/// takes one part or two legs, or is hidden. So they keep their ids where they cross, and behind
/// one another.
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

  /// What the next scan shows, which is not before the last one.
  /// @param time microseconds
  void add(std::span<const BodyPart> parts, const ScanView& view, std::int64_t time);

  /// Where known people are expected at that time.
  std::vector<Point2> expected(std::int64_t time) const;

  /// Those who are known to be people.
  std::vector<Track> people() const;

private:
  struct Followed {
    Track track;
    PersonMotion motion;
    /// The same with less change of velocity, which tells better where somebody goes who is hidden.
    PersonMotion steady;
    Point2 first_place;
    int detections = 1;
    /// Of them, those where it was free before.
    int new_detections = 1;
    /// Time since the last detection, and that of it in which beams passed; seconds.
    double unseen = 0;
    double absent = 0;
  };

  void take(Followed& x, std::span<const BodyPart> parts, const Explanation& explanation);
  bool walks(const Followed& x, const ScanView& view) const;
  void miss(Followed& x, const ScanView& view, double dt) const;
  void begin(std::span<const BodyPart> parts, std::vector<bool> used);
  void begin_at(const Point2& place, double variance);

  TrackOptions options_;
  std::vector<Followed> followed_;
  std::int64_t next_id_;
  std::int64_t time_ = 0;
};

} // namespace castor::mapping
