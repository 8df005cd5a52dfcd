#include "castor/perception/vision/scene_watch.hpp"

#include <cstdlib>
#include <utility>

namespace castor::vision {

namespace {

/// Luma of ITU-R BT.601, in 16 bit fixed point.
std::vector<std::uint8_t> to_grey(const Image& image) {
  auto channels = image.channels;
  auto pixels = static_cast<std::size_t>(image.width) * image.height;
  if (channels != 3)
    return image.bytes;
  std::vector<std::uint8_t> result(pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    auto* p = &image.bytes[3 * i];
    result[i] = static_cast<std::uint8_t>((7471u * p[0] + 38470u * p[1] + 19595u * p[2]) >> 16);
  }
  return result;
}

} // namespace

std::optional<SceneChanged> SceneWatch::observe(const Image& frame) {
  auto grey = to_grey(frame);
  bool is_first = last_.empty();
  bool changed = is_first ? options_.first_frame_counts : differs(grey);
  last_ = std::move(grey);
  if (changed) {
    something_happened_ = true;
    countdown_ = options_.still_frames;
  } else if (something_happened_) {
    --countdown_;
  }
  if (!something_happened_)
    return std::nullopt;
  SceneChanged result;
  if (countdown_ > 0) {
    result.changing = true;
  } else {
    something_happened_ = false;
    result.changed = true;
  }
  return result;
}

bool SceneWatch::differs(const std::vector<std::uint8_t>& grey) const {
  if (grey.size() != last_.size())
    return true;
  std::size_t count = 0;
  for (std::size_t i = 0; i < grey.size(); ++i)
    count += std::abs(int{grey[i]} - int{last_[i]}) > options_.pixel_threshold;
  return static_cast<double>(count) > options_.changed_share * static_cast<double>(grey.size());
}

} // namespace castor::vision
