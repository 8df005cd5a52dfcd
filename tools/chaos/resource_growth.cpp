#include "castor/tools/chaos/resource_growth.hpp"

#include "castor/base/duration.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace castor::faults {

namespace {

/// Every two of so many make some ten thousand slopes.
constexpr std::size_t most_points = 200;

/// Evenly chosen; the first and the last are among them.
std::vector<ResourceSample> thinned(std::span<const ResourceSample> samples) {
  if (samples.size() <= most_points)
    return {samples.begin(), samples.end()};
  std::vector<ResourceSample> result;
  for (std::size_t i = 0; i < most_points; ++i)
    result.push_back(samples[i * (samples.size() - 1) / (most_points - 1)]);
  return result;
}

struct Resource {
  const char* name;
  std::uint64_t ResourceSample::*value;
  /// What one of it is shown as.
  double unit;
  const char* unit_name;
};

constexpr Resource memory{"memory", &ResourceSample::memory, 1e6, " MB"};
constexpr Resource files{"file descriptors", &ResourceSample::files, 1, ""};
constexpr Resource threads{"threads", &ResourceSample::threads, 1, ""};

} // namespace

double robust_slope(std::span<const double> x, std::span<const double> y) {
  std::vector<double> slopes;
  for (std::size_t i = 0; i < x.size(); ++i)
    for (std::size_t j = i + 1; j < x.size(); ++j)
      if (x[j] > x[i])
        slopes.push_back((y[j] - y[i]) / (x[j] - x[i]));
  if (slopes.empty())
    return 0;
  auto middle = slopes.begin() + static_cast<std::ptrdiff_t>(slopes.size() / 2);
  std::ranges::nth_element(slopes, middle);
  return *middle;
}

std::vector<std::string> leaks(const ProcessResources& process,
                               const ResourceTolerance& tolerance) {
  if (process.samples.empty())
    return {};
  auto begin = std::ranges::lower_bound(
    process.samples, process.samples.front().at + tolerance.warm_up, {}, &ResourceSample::at);
  auto samples = thinned({begin, process.samples.end()});
  if (samples.size() < tolerance.fewest_samples)
    return {};
  std::vector<double> times;
  for (auto& x : samples)
    times.push_back(in_seconds(x.at));
  std::vector<std::string> result;
  auto look_at = [&](const Resource& resource, double allowed, double allowed_percent) {
    std::vector<double> values;
    for (auto& x : samples)
      values.push_back(static_cast<double>(x.*resource.value));
    auto length = times.back() - times.front();
    auto growth = robust_slope(times, values) * length;
    auto least = *std::ranges::min_element(values);
    if (growth > std::max(allowed, least * allowed_percent / 100))
      result.push_back(fmt::format("{}: {:.3g}{} more {} in {:.0f} s, from {:.3g} to {:.3g}",
                                   process.process, growth / resource.unit, resource.unit_name,
                                   resource.name, length, values.front() / resource.unit,
                                   values.back() / resource.unit));
  };
  look_at(memory, tolerance.memory, tolerance.memory_percent);
  look_at(files, tolerance.files, 0);
  look_at(threads, tolerance.threads, 0);
  return result;
}

} // namespace castor::faults
