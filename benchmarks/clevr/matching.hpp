#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <opencv2/core.hpp>

#include "castor/perception/vision/types.hpp"

namespace castor::clevr {

/// A region that was found for an object.
struct Match {
  std::size_t region = 0;
  std::size_t object = 0;
  /// Intersection over union.
  double overlap = 0;
};

/// Pairs regions with objects, one to one, best overlaps first, as long as they overlap at least
/// `min_overlap`. A region across two objects is at most one of them.
///
/// \param labels index of the visible object per pixel; -1 where there is none.
/// \param objects number of objects.
std::vector<Match> match_regions(std::span<const vision::ROI* const> regions,
                                 const cv::Mat_<int>& labels, std::size_t objects,
                                 double min_overlap);

} // namespace castor::clevr
