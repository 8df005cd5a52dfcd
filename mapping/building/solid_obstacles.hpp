#pragma once

#include "castor/mapping/building/building.hpp"
#include "castor/mapping/building/obstacles.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace castor::mapping {

/// Outlines of solids as seen from above, whose distances are calculated exactly. An index of equal
/// square cells keeps rays from looking at all of them (J. G. Cleary and G. Wyvill, "Analysis of an
/// algorithm for fast ray tracing using uniform space subdivision", 1988).
class SolidObstacles final : public Obstacles {
public:
  /// @param cell edge of a cell, metres; it changes the speed only. It is doubled until there are
  /// at most a million cells.
  explicit SolidObstacles(std::span<const Solid> solids, double cell = 0.5);

  std::optional<double> cast(const Point2& origin, double direction,
                             double max_range) const override;
  double clearance(const Point2& p, double limit) const override;

private:
  /// A box in its own frame, or a disc if it has a radius.
  struct Outline {
    Point2 centre;
    double cosine = 1;
    double sine = 0;
    double half_length = 0;
    double half_width = 0;
    double radius = 0;
  };

  struct Ray {
    Point2 origin;
    Point2 direction;
  };

  static double hit(const Outline& x, const Ray& ray);
  static double away(const Outline& x, const Point2& p);
  void find_extent();
  void fill_cells();
  /// Column or row of a coordinate, within the index.
  std::int64_t column(double x) const;
  std::int64_t row(double y) const;

  std::vector<Outline> outlines_;
  double cell_;
  Point2 low_;
  Point2 high_;
  std::int64_t columns_ = 0;
  std::int64_t rows_ = 0;
  /// Outlines that touch cell i: members_[first_[i]] to members_[first_[i + 1] - 1].
  std::vector<std::uint32_t> first_;
  std::vector<std::uint32_t> members_;
};

} // namespace castor::mapping
