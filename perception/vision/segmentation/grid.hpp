#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace castor::vision {

/// Three numbers per pixel, such as blue, green, red or L, a, b.
using Colour = std::array<float, 3>;

/// A value per pixel, in rows from the top.
template <class T>
class Grid {
public:
  Grid() = default;

  Grid(int width, int height, const T& value = T{})
    : width_(width), height_(height),
      cells_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), value) {
    // nop
  }

  int width() const { return width_; }
  int height() const { return height_; }
  int size() const { return width_ * height_; }

  /// \pre 0 <= x < width, 0 <= y < height.
  T& at(int x, int y) { return cells_[index(x, y)]; }
  const T& at(int x, int y) const { return cells_[index(x, y)]; }

  /// The cell with the index y * width + x.
  T& operator[](int cell) { return cells_[static_cast<std::size_t>(cell)]; }
  const T& operator[](int cell) const { return cells_[static_cast<std::size_t>(cell)]; }

  T* data() { return cells_.data(); }
  const T* data() const { return cells_.data(); }

private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(x);
  }

  int width_ = 0;
  int height_ = 0;
  std::vector<T> cells_;
};

} // namespace castor::vision
