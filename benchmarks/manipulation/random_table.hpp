#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

/// Random tables with things where an arm like the Katana reaches them; metres, in the table's
/// frame.
namespace castor::manipulation {

/// Where the arms of benchmarks stand, and rest out of the camera's sight.
inline constexpr const char* benchmark_arm_at = "0 -0.33 heading 90";
inline constexpr const char* benchmark_arm_rest = "90 -20 110 60 90";

struct RandomThing {
  std::string colour;
  /// cube, sphere or cylinder.
  std::string shape;
  double x = 0;
  double y = 0;
  double size = 0;
  /// Of a cylinder.
  double height = 0;
  /// Degrees.
  double turned = 0;

  /// As the simulated table calls it.
  std::string name() const { return "the " + colour + ' ' + shape; }
};

struct Spot {
  double x = 0;
  double y = 0;
};

/// Numbers evenly between two.
double any(std::mt19937_64& random, double low, double high);

/// So many spots at least 10 cm apart.
/// @param farthest from the arm, metres
std::vector<Spot> random_spots(std::mt19937_64& random, std::size_t count, double farthest = 0.42);

/// Six colours in a random order.
std::vector<std::string> random_colours(std::mt19937_64& random);

/// Of 4 to 6 cm.
RandomThing random_thing(std::mt19937_64& random, const std::string& colour, const Spot& at);

/// To put the first of the things at a place of the table.
struct PutTask {
  std::vector<RandomThing> things;
  double x = 0;
  double y = 0;
};

/// Three to five things of different colours, and a free place.
PutTask random_put_task(std::uint64_t seed);

/// The file of a table with these things, as a camera of the PlayMate sees it.
std::string scene_text(const std::vector<RandomThing>& things);

/// 0 of none.
double median(std::vector<double> x);

/// Words of a command line, by their places.
struct Arguments {
  int count = 0;
  char** words = nullptr;

  std::string operator()(int index, const char* otherwise) const {
    return count > index ? words[index] : otherwise;
  }
};

std::string text_of_file(const std::string& file);

} // namespace castor::manipulation
