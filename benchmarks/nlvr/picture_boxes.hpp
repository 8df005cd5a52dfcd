#pragma once

#include "castor/perception/vision/types.hpp"

#include <vector>

namespace castor::nlvr {

/// Open boxes that are drawn beside each other: of the large areas of one colour in a picture those
/// that hold something, and empty ones of the same colour. From left to right, then downwards.
///
/// \throws std::invalid_argument if the picture has no pixels, or not three channels
std::vector<vision::ImageBox> find_picture_boxes(const vision::Image& picture);

} // namespace castor::nlvr
