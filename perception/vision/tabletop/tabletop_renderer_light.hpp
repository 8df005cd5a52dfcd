#pragma once

#include <cstdint>

#include "castor/perception/vision/tabletop/tabletop_scene.hpp"

/// Colours as amounts of light, and the random numbers of the renderer.
namespace castor::vision {

/// Light or reflectance, linear; 1 is white.
struct LinearColour {
  double red = 0;
  double green = 0;
  double blue = 0;

  friend constexpr LinearColour operator+(const LinearColour& a, const LinearColour& b) {
    return {a.red + b.red, a.green + b.green, a.blue + b.blue};
  }
  friend constexpr LinearColour operator*(double factor, const LinearColour& a) {
    return {factor * a.red, factor * a.green, factor * a.blue};
  }
  /// Light of one colour reflected by a surface of the other.
  friend constexpr LinearColour operator*(const LinearColour& a, const LinearColour& b) {
    return {a.red * b.red, a.green * b.green, a.blue * b.blue};
  }
};

/// Linear light by the transfer function of sRGB (IEC 61966-2-1).
LinearColour to_linear(const SceneColour& colour);

/// The sRGB value in [0, 255] of an amount of light; highlights beyond 0.8 are compressed so that
/// they do not clip at once.
double to_display(double light);

/// Hash of an integer (the finalizer of S. Vigna's SplitMix64).
constexpr std::uint64_t mixed(std::uint64_t x) {
  x += 0x9E3779B97F4A7C15;
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EB;
  return x ^ (x >> 31);
}

} // namespace castor::vision
