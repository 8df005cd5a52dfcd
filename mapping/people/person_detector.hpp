#pragma once

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
  /// Neighbouring beams that end closer together, metres, are of the same leg or body.
  double part_gap = 0.12;
  /// Parts whose middles are closer together, metres, are of the same person.
  double person_size = 0.5;
  /// What is wider is no part of a person, metres.
  double widest_part = 0.75;
};

/// Finds people in scans: legs or bodies where it was free before. Somebody who has not moved since
/// the robot came is not found, as little as one who stands at a wall.
class PersonDetector {
public:
  explicit PersonDetector(const DetectorOptions& options)
    : options_(options), free_space_(options.free_space) {}

  /// Where people may be; some of them may be things, so that only those who walk count
  /// (PersonTracks).
  /// @param robot its pose, without jumps (in the odometry frame), when it was scanned
  /// @param known where known people are expected, in that frame
  std::vector<Point2> detect(const LaserScan& scan, const Pose2& robot,
                             std::span<const Point2> known);

private:
  /// Whether the beams beside these end elsewhere, so that they are no piece of a wall.
  bool stands_alone(const LaserScan& scan, std::size_t first, std::size_t last) const;

  /// Parts of the same person as one place each.
  std::vector<Point2> group(std::vector<Point2> parts) const;

  DetectorOptions options_;
  FreeSpace free_space_;
};

} // namespace castor::mapping
