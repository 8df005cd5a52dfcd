#pragma once

#include "castor/perception/vision/tracking/box_tracker.hpp"
#include "castor/perception/vision/types.hpp"

#include <filesystem>
#include <vector>

/// Sequences of the Object Tracking Benchmark (Y. Wu, J. Lim and M.-H. Yang, 2013).
namespace castor::otb {

struct Sequence {
  /// Files of the pictures, in order.
  std::vector<std::filesystem::path> files;
  /// Box of the object in each picture.
  std::vector<vision::ImageBox> truth;
};

/// Reads FOLDER/img and FOLDER/groundtruth_rect.txt.
/// \throws std::runtime_error if they do not fit together.
Sequence load_sequence(const std::filesystem::path& folder);

/// Result of a tracker that was given the object in the first picture, over the other pictures.
struct Score {
  int pictures = 0;
  /// The overlap (intersection by union) with the truth.
  double mean_overlap = 0;
  /// Share of pictures with an overlap of at least 0.5.
  double success_rate = 0;
  /// Number of pictures in which the tracker did not find the object; its last box counts there.
  int missed = 0;
  double ms_per_picture = 0;
};

Score run(const Sequence& sequence, const vision::TrackingOptions& options = {});

} // namespace castor::otb
