#pragma once

#include "castor/perception/vision/tracking/box_tracker.hpp"
#include "castor/perception/vision/types.hpp"

#include <filesystem>
#include <vector>

/// Sequences of the Object Tracking Benchmark (Y. Wu, J. Lim and M.-H. Yang, 2013).
namespace castor::otb {

struct Sequence {
  /// Of the pictures, in order.
  std::vector<std::filesystem::path> files;
  /// Where the thing is in each.
  std::vector<vision::ImageBox> truth;
};

/// Reads FOLDER/img and FOLDER/groundtruth_rect.txt.
/// \throws std::runtime_error if they do not fit together.
Sequence load_sequence(const std::filesystem::path& folder);

/// How a tracker that was shown the thing in the first picture did in the others.
struct Score {
  int pictures = 0;
  /// The overlap (intersection by union) with the truth.
  double mean_overlap = 0;
  /// The share of pictures in which that is at least 0.5.
  double success_rate = 0;
  /// Pictures in which the tracker did not see the thing; there, its last box counts.
  int missed = 0;
  double ms_per_picture = 0;
};

Score run(const Sequence& sequence, const vision::TrackingOptions& options = {});

} // namespace castor::otb
