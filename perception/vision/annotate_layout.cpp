#include "castor/perception/vision/annotate_layout.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace castor::vision {

namespace {

// Prices per pixel covered, and per pixel of distance to the region.
constexpr double label_price = 100;
constexpr double other_region_price = 8;
constexpr double own_region_price = 3;
constexpr double distance_price = 12;

LayoutRect kept_within(LayoutRect rect, const LayoutRect& bounds) {
  rect.left = std::max(bounds.left, std::min(rect.left, bounds.right() - rect.width));
  rect.top = std::max(bounds.top, std::min(rect.top, bounds.bottom() - rect.height));
  return rect;
}

double distance_between(const LayoutRect& a, const LayoutRect& b) {
  const double x = std::max({0.0, a.left - b.right(), b.left - a.right()});
  const double y = std::max({0.0, a.top - b.bottom(), b.top - a.bottom()});
  return std::hypot(x, y);
}

/// Beside the region, the places that are preferred first; then further and further away.
std::vector<LayoutRect> candidates(const LayoutLabel& label, double gap) {
  const auto& region = label.region;
  std::vector<LayoutRect> result;
  for (const double away : {1.0, 4.0, 10.0, 20.0}) {
    const double above = region.top - away * gap - label.height;
    const double below = region.bottom() + away * gap;
    const double before = region.left - away * gap - label.width;
    const double behind = region.right() + away * gap;
    const double centred_x = region.left + (region.width - label.width) / 2;
    const double centred_y = region.top + (region.height - label.height) / 2;
    for (const auto& [left, top] :
         {std::pair{centred_x, above}, std::pair{centred_x, below}, std::pair{behind, centred_y},
          std::pair{before, centred_y}, std::pair{region.left, above},
          std::pair{region.right() - label.width, above}, std::pair{region.left, below},
          std::pair{region.right() - label.width, below}, std::pair{behind, above},
          std::pair{before, above}, std::pair{behind, below}, std::pair{before, below}})
      result.push_back({left, top, label.width, label.height});
  }
  return result;
}

} // namespace

double shared_area(const LayoutRect& a, const LayoutRect& b) {
  const double width = std::min(a.right(), b.right()) - std::max(a.left, b.left);
  const double height = std::min(a.bottom(), b.bottom()) - std::max(a.top, b.top);
  return width > 0 && height > 0 ? width * height : 0;
}

std::vector<LayoutRect> place_labels(std::span<const LayoutLabel> labels, const LayoutRect& bounds,
                                     double gap) {
  std::vector<LayoutRect> placed;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (!(labels[i].width > 0 && labels[i].height > 0)) {
      placed.emplace_back();
      continue;
    }
    LayoutRect best;
    double lowest = std::numeric_limits<double>::infinity();
    for (const auto& candidate : candidates(labels[i], gap)) {
      const auto rect = kept_within(candidate, bounds);
      double price = distance_price * distance_between(rect, labels[i].region);
      for (const auto& other : placed)
        price += label_price * shared_area(rect, other);
      for (std::size_t j = 0; j < labels.size(); ++j)
        price +=
          (i == j ? own_region_price : other_region_price) * shared_area(rect, labels[j].region);
      if (price < lowest) {
        lowest = price;
        best = rect;
      }
    }
    placed.push_back(best);
  }
  return placed;
}

} // namespace castor::vision
