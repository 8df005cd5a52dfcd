#pragma once

#include <span>
#include <vector>

/// Where labels go on a picture.
namespace castor::vision {

/// Pixels; the right and lower edges are just outside.
struct LayoutRect {
  double left = 0;
  double top = 0;
  double width = 0;
  double height = 0;

  double right() const { return left + width; }
  double bottom() const { return top + height; }

  friend bool operator==(const LayoutRect&, const LayoutRect&) = default;
};

/// The area that two rectangles share.
double shared_area(const LayoutRect& a, const LayoutRect& b);

/// A label to be placed: the region that it belongs to, and its size. Nothing is placed if the size
/// is zero.
struct LayoutLabel {
  LayoutRect region;
  double width = 0;
  double height = 0;
};

/// Places one label after the other, `gap` beside its region, where it covers least of the labels
/// before it, of other regions and of its own, in this order; all within the `bounds`, unless a
/// label is larger than these.
std::vector<LayoutRect> place_labels(std::span<const LayoutLabel> labels, const LayoutRect& bounds,
                                     double gap);

} // namespace castor::vision
