#pragma once

#include "castor/benchmarks/safety/braking_watch.hpp"

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

/// A robot that drives a circle in an empty hall, with a guard, each part in a process of its own.
namespace castor::benchmark {

/// m/s and m/s^2.
constexpr double circle_speed = 0.5;
constexpr double circle_braking = 0.8;

/// How long something is away that fails for a while. The robot has come to a stop by then.
constexpr std::chrono::milliseconds outage{1000};

/// Hosts of the architecture: of the robot, the driver, the guard, the working memory with the
/// driver's seat, and the laser.
const std::vector<std::string>& circle_nodes();

/// The `.cast` text.
/// @param folder of hall.building, which is written there
std::string guarded_circle(const std::filesystem::path& folder);

/// What is seen of the robot, if the architecture runs in this process.
BrakingWatch& circle_watch();

/// What a laser does wrong.
enum class LaserFault : std::uint8_t {
  none,
  silent,
  frozen,
  /// It sees something a centimetre before the robot's edge: within any stopping distance.
  obstacle
};

/// Signal to a process that makes its laser do so, if it has called `obey_laser_signals`.
int signal_of(LaserFault x);
void obey_laser_signals();

} // namespace castor::benchmark
