#pragma once

#include "castor/perception/vision/types.hpp"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace castor::manipulation {

/// Key frames of a motion in one picture, with captions.
class FilmStrip {
public:
  /// @param width of each frame in the strip, pixels
  /// @param columns frames in a row
  explicit FilmStrip(int width = 320, int columns = 4) : width_(width), columns_(columns) {}

  /// @param frame 3 channels
  void add(const vision::Image& frame, const std::string& caption);

  std::size_t size() const { return frames_.size(); }

  /// All frames, in rows; empty without frames.
  vision::Image picture() const;

private:
  int width_;
  int columns_;
  std::vector<vision::Image> frames_;
};

/// Writes a PNG file, and makes its folder.
/// \throws std::runtime_error if that is not possible.
void write_png(const vision::Image& picture, const std::filesystem::path& file);

} // namespace castor::manipulation
