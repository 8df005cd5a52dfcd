#pragma once

#include "castor/perception/vision/types.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace castor::vision {

/// Intersection over union of two boxes; 0 to 1.
double overlap(const ImageBox& a, const ImageBox& b);

/// Index of the old box for each new one, if there is a match: pairs are made in the order of their
/// overlap, the largest first, each box in one pair at most, none with an overlap of `least` or
/// less.
std::vector<std::optional<std::size_t>> match_boxes(std::span<const ImageBox> fresh,
                                                    std::span<const ImageBox> old, double least);

/// Difference in appearance of two regions: the distance of their mean colours, in grey levels of
/// 255.
double colour_distance(const ROI& a, const ROI& b);

/// Index of the old region of like appearance for each new one, anywhere in the image, if there is
/// a match: of about its size and less than `most` in colour_distance(). Pairs are made in the
/// order of their distance, the least first, each region in one pair at most.
std::vector<std::optional<std::size_t>> match_looks(std::span<const ROI* const> fresh,
                                                    std::span<const ROI* const> old, double most);

} // namespace castor::vision
