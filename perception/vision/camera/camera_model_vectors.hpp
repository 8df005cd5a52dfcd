#pragma once

#include <cmath>

#include "castor/perception/vision/types.hpp"

/// Vector arithmetic on Point3. A namespace of its own, so that it is there only for who asks for
/// it.
namespace castor::vision::vectors {

constexpr Point3 operator+(const Point3& a, const Point3& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}

constexpr Point3 operator-(const Point3& a, const Point3& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}

constexpr Point3 operator*(double factor, const Point3& a) {
  return {factor * a.x, factor * a.y, factor * a.z};
}

constexpr double dot(const Point3& a, const Point3& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

constexpr Point3 cross(const Point3& a, const Point3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

inline double norm(const Point3& a) {
  return std::sqrt(dot(a, a));
}

/// \pre `a` is not zero.
inline Point3 normalized(const Point3& a) {
  return (1.0 / norm(a)) * a;
}

} // namespace castor::vision::vectors
