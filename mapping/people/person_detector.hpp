#pragma once

#include "castor/mapping/people/body_part.hpp"
#include "castor/mapping/people/free_space.hpp"
#include "castor/mapping/planar/poses.hpp"
#include "castor/mapping/planar/types.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace castor::mapping {

struct DetectorOptions {
  FreeSpaceOptions free_space;
  /// People are looked for up to there, metres from the scanner.
  double range = 8;
  /// Where nothing was seen before, as ahead of somebody who walks away, up to there.
  double near_range = 4;
  /// Neighbouring beams that end closer together, metres, are of the same leg or body.
  double part_gap = 0.12;
  /// What is wider is no part of a person, metres.
  double widest_part = 0.75;
  /// Beams beside a part that end so much farther away pass it, metres.
  double passing = 0.2;
  /// What does not stand out is a part if it is wider, metres.
  double least_part = 0.03;
  /// What is only new, or only stands out, is a part within that distance of where a known person
  /// is expected, metres.
  double known_reach = 0.75;
  /// What is new, and does not stand out, is a part unless something that was there before is
  /// beside it within that distance, metres.
  double joint = 0.3;
  /// What ends there on both sides is of that person and moves, within that distance, metres. A
  /// wall that somebody passes stands as before.
  double moving_reach = 0.5;
};

/// Finds legs and bodies in scans: what is where it was free before, or has just appeared and
/// stands alone, and near known people what stands alone. Some of it may be things, so that only
/// what walks is a person (PersonTracks).
class PersonDetector {
public:
  explicit PersonDetector(const DetectorOptions& options)
    : options_(options), free_space_(options.free_space) {}

  /// @param robot its pose, without jumps (in the odometry frame), when it was scanned
  /// @param known where known people are expected, in that frame
  std::vector<BodyPart> detect(const LaserScan& scan, const Pose2& robot,
                               std::span<const Point2> known);

private:
  /// Beams that end close together, from the first to the last with a return.
  struct Cluster {
    std::size_t first = 0;
    std::size_t last = 0;
    bool is_new = false;
    std::vector<Point2> ends;
  };

  std::vector<Cluster> clusters(const LaserScan& scan, const Pose2& scanner) const;
  /// Whether the beams on both sides pass it.
  bool stands_out(const LaserScan& scan, const Cluster& x) const;
  /// Whether the beam beside that edge passes it, on the side -1 or 1.
  bool passes(const LaserScan& scan, std::size_t edge, int side) const;
  /// Whether the next beam on a side ends near it, where it was not free before: it is a piece of
  /// something that stands, as of a wall at a small angle.
  bool is_joined(std::span<const Cluster> all, std::size_t i) const;
  /// Whether the beams on both sides pass it, or on one side, and something before it hides the
  /// other.
  bool is_separate(const LaserScan& scan, const Cluster& x) const;

  DetectorOptions options_;
  FreeSpace free_space_;
};

} // namespace castor::mapping
