#include "castor/benchmarks/clevr/matching.hpp"

#include <algorithm>
#include <cmath>

#include "castor/perception/vision/opencv_bridge.hpp"

namespace castor::clevr {

std::vector<Match> match_regions(std::span<const vision::ROI* const> regions,
                                 const cv::Mat_<int>& labels, std::size_t objects,
                                 double min_overlap) {
  std::vector<int> visible(objects, 0);
  for (const int label : labels) {
    if (label >= 0)
      ++visible[static_cast<std::size_t>(label)];
  }
  std::vector<Match> candidates;
  for (std::size_t region = 0; region < regions.size(); ++region) {
    const vision::ROI& roi = *regions[region];
    const cv::Mat_<std::uint8_t> mask = vision::as_mat(roi.mask);
    const cv::Point corner(cvRound(roi.box.center.x - (roi.box.width - 1) / 2),
                           cvRound(roi.box.center.y - (roi.box.height - 1) / 2));
    std::vector<int> common(objects, 0);
    int own = 0;
    for (int y = 0; y < mask.rows; ++y) {
      for (int x = 0; x < mask.cols; ++x) {
        if (mask(y, x) == 0)
          continue;
        ++own;
        const int label = labels(y + corner.y, x + corner.x);
        if (label >= 0)
          ++common[static_cast<std::size_t>(label)];
      }
    }
    for (std::size_t object = 0; object < objects; ++object) {
      const double either = own + visible[object] - common[object];
      if (common[object] > 0 && common[object] >= min_overlap * either)
        candidates.push_back({region, object, common[object] / either});
    }
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Match& a, const Match& b) { return a.overlap > b.overlap; });
  std::vector<Match> matches;
  for (const auto& candidate : candidates) {
    const bool taken = std::any_of(matches.begin(), matches.end(), [&](const Match& match) {
      return match.region == candidate.region || match.object == candidate.object;
    });
    if (!taken)
      matches.push_back(candidate);
  }
  return matches;
}

} // namespace castor::clevr
