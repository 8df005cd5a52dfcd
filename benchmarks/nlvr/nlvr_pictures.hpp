#pragma once

#include "castor/benchmarks/nlvr/nlvr_scenes.hpp"
#include "castor/perception/vision/types.hpp"

#include <cstddef>
#include <vector>

namespace castor::nlvr {

/// What vision sees in the boxes of a picture: each is magnified and segmented as pictures of
/// tables are, and the colours and shapes of the regions are recognised. Shapes are known to be
/// flat: circles, squares and triangles.
///
/// \throws std::invalid_argument if the picture has no pixels, or not three channels
std::vector<Items> see_boxes(const vision::Image& picture);

/// How far what was seen agrees with what was drawn.
struct Agreement {
  std::size_t drawn = 0;
  std::size_t seen = 0;
  /// Pairs of both whose squares overlap by half.
  std::size_t found = 0;
  /// Of the pairs.
  std::size_t same_colour = 0;
  std::size_t same_shape = 0;
  std::size_t same_size = 0;
  /// Pictures whose boxes hold the same items throughout, and all of them.
  std::size_t same_pictures = 0;
  std::size_t pictures = 0;
};

/// Counts another picture.
void compare(const std::vector<Items>& drawn, const std::vector<Items>& seen, Agreement& total);

} // namespace castor::nlvr
