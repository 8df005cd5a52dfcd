#include "castor/perception/vision/segmentation/region_matching.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

namespace castor::vision {

namespace {

std::array<double, 3> mean_colour(const ROI& x) {
  std::array<double, 3> sum{};
  std::size_t count = 0;
  auto& pixels = x.region.bytes;
  for (std::size_t i = 0; i < x.mask.bytes.size() && 3 * i + 2 < pixels.size(); ++i) {
    if (x.mask.bytes[i] == 0)
      continue;
    ++count;
    for (std::size_t c = 0; c < 3; ++c)
      sum[c] += pixels[3 * i + c];
  }
  for (auto& channel : sum)
    channel /= static_cast<double>(std::max<std::size_t>(count, 1));
  return sum;
}

/// How little speaks for it, the new one, the old one.
using Pair = std::tuple<double, std::size_t, std::size_t>;

std::vector<std::optional<std::size_t>> best_pairs(std::vector<Pair> pairs, std::size_t fresh,
                                                   std::size_t old) {
  std::sort(pairs.begin(), pairs.end());
  std::vector<std::optional<std::size_t>> result(fresh);
  std::vector<bool> taken(old);
  for (auto& [score, i, k] : pairs) {
    if (result[i] || taken[k])
      continue;
    result[i] = k;
    taken[k] = true;
  }
  return result;
}

} // namespace

double overlap(const ImageBox& a, const ImageBox& b) {
  auto shared = [](double center_a, double extent_a, double center_b, double extent_b) {
    auto low = std::max(center_a - extent_a / 2, center_b - extent_b / 2);
    auto high = std::min(center_a + extent_a / 2, center_b + extent_b / 2);
    return std::max(0.0, high - low);
  };
  auto both = shared(a.center.x, a.width, b.center.x, b.width) *
              shared(a.center.y, a.height, b.center.y, b.height);
  auto either = a.width * a.height + b.width * b.height - both;
  return either > 0 ? both / either : 0;
}

std::vector<std::optional<std::size_t>> match_boxes(std::span<const ImageBox> fresh,
                                                    std::span<const ImageBox> old, double least) {
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < fresh.size(); ++i)
    for (std::size_t k = 0; k < old.size(); ++k)
      if (auto x = overlap(fresh[i], old[k]); x > least)
        pairs.emplace_back(-x, i, k);
  return best_pairs(std::move(pairs), fresh.size(), old.size());
}

std::vector<std::optional<std::size_t>> match_looks(std::span<const ROI* const> fresh,
                                                    std::span<const ROI* const> old, double most) {
  constexpr double most_growth = 2;
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < fresh.size(); ++i)
    for (std::size_t k = 0; k < old.size(); ++k) {
      auto growth =
        fresh[i]->box.width * fresh[i]->box.height / (old[k]->box.width * old[k]->box.height);
      auto distance = colour_distance(*fresh[i], *old[k]);
      if (distance < most && growth < most_growth && growth > 1 / most_growth)
        pairs.emplace_back(distance, i, k);
    }
  return best_pairs(std::move(pairs), fresh.size(), old.size());
}

double colour_distance(const ROI& a, const ROI& b) {
  auto x = mean_colour(a);
  auto y = mean_colour(b);
  return std::hypot(x[0] - y[0], x[1] - y[1], x[2] - y[2]);
}

} // namespace castor::vision
