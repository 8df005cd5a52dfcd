#pragma once

#include "castor/perception/vision/types.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace castor::vision {

/// The area that two boxes share, as a share of the area that they cover together; 0 to 1.
double overlap(const ImageBox& a, const ImageBox& b);

/// For each new box the old one that it is a new view of, if there is one: the pairs with the
/// largest overlap first, each box in one pair at most, none with an overlap of `least` or less.
std::vector<std::optional<std::size_t>> match_boxes(std::span<const ImageBox> fresh,
                                                    std::span<const ImageBox> old, double least);

/// How much two regions differ in what is seen: the distance of their mean colours, in grey levels
/// of 255.
double colour_distance(const ROI& a, const ROI& b);

/// For each new region the old one that it looks like, wherever that was, if there is one: of about
/// its size and less than `most` in colour_distance(). The pairs with the least distance first,
/// each region in one pair at most.
std::vector<std::optional<std::size_t>> match_looks(std::span<const ROI* const> fresh,
                                                    std::span<const ROI* const> old, double most);

} // namespace castor::vision
