#include "castor/perception/vision/tabletop/tabletop_renderer_light.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace castor::vision {

namespace {

double linear(std::uint8_t value) {
  const double v = value / 255.0;
  return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

double display(double light) {
  return 255 * (light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055);
}

constexpr std::size_t table_size = 4096;
constexpr double knee = 0.8;

/// to_display() at i / (table_size - 1), for light that has passed the knee.
const std::array<double, table_size>& display_table() {
  static const auto table = [] {
    std::array<double, table_size> values{};
    for (std::size_t i = 0; i < table_size; ++i)
      values[i] = display(static_cast<double>(i) / (table_size - 1));
    return values;
  }();
  return table;
}

} // namespace

LinearColour to_linear(const SceneColour& colour) {
  return {linear(colour.red), linear(colour.green), linear(colour.blue)};
}

double to_display(double light) {
  if (light > knee) {
    const double excess = (light - knee) / (1 - knee);
    light = knee + (1 - knee) * excess / (1 + excess);
  }
  const double position = std::max(light, 0.0) * (table_size - 1);
  const auto i = std::min(static_cast<std::size_t>(position), table_size - 2);
  const auto& table = display_table();
  return table[i] + (position - static_cast<double>(i)) * (table[i + 1] - table[i]);
}

} // namespace castor::vision
