#pragma once

#include <span>
#include <vector>

/// Layout of labels on a picture.
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

/// Area of the intersection of two rectangles.
double shared_area(const LayoutRect& a, const LayoutRect& b);

/// A label to be placed: its region, and its size. A label of size zero is not placed.
struct LayoutLabel {
  LayoutRect region;
  double width = 0;
  double height = 0;
};

/// Places one label after the other, `gap` beside its region, where it covers least of the labels
/// before it, of other regions and of its own, in this order of priority; within the `bounds`,
/// unless the label is larger.
std::vector<LayoutRect> place_labels(std::span<const LayoutLabel> labels, const LayoutRect& bounds,
                                     double gap);

} // namespace castor::vision
