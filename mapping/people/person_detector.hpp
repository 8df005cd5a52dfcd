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

  DetectorOptions options_;
  FreeSpace free_space_;
};

} // namespace castor::mapping
