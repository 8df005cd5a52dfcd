#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace castor::mapping {

/// How well rooms that were found agree with true ones, as in R. Bormann, F. Jordan, W. Li,
/// J. Hampp, M. Haegele: "Room Segmentation: Survey, Implementation, and Analysis", ICRA 2016, and
/// the evaluation published with it. With true rooms T_i and found rooms F_j as sets of pixels,
///
///   recall    = mean over i of max over j of |T_i and F_j| / |T_i|
///   precision = mean over j of max over i of |T_i and F_j| / |F_j|
///
/// so that a true room in pieces costs recall, and rooms found as one cost precision.
struct RoomScores {
  double recall = 0;
  double precision = 0;
  /// The same with each room weighted by its pixels.
  double recall_by_area = 0;
  double precision_by_area = 0;
  std::size_t true_rooms = 0;
  std::size_t found_rooms = 0;
};

/// Both as label images of the same shape: a positive number for each pixel of a room, else 0.
/// Rooms of at most `smallest` pixels are left out, as in the published evaluation. A score is 0
/// where there is no room to take the mean of.
/// @throws std::invalid_argument if the images differ in size
RoomScores room_scores(const std::vector<std::int32_t>& truth,
                       const std::vector<std::int32_t>& found, std::size_t smallest = 100);

/// Label images of connected pixels (eight neighbours each) that are `free`, numbered from 1.
/// @throws std::invalid_argument if `free` is not of `width` times `height` pixels
std::vector<std::int32_t> connected_rooms(const std::vector<bool>& free, int width, int height);

} // namespace castor::mapping
