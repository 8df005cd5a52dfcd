#include "castor/benchmarks/manipulation/random_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>

namespace castor::manipulation {

double any(std::mt19937_64& random, double low, double high) {
  return std::uniform_real_distribution(low, high)(random);
}

std::vector<Spot> random_spots(std::mt19937_64& random, std::size_t count, double farthest) {
  std::vector<Spot> result;
  while (result.size() < count) {
    const double angle = any(random, -1.1, 1.1);
    const double away = any(random, 0.2, farthest);
    const Spot spot{away * std::sin(angle), -0.37 + away * std::cos(angle)};
    const auto is_near = [&](const Spot& x) {
      return std::hypot(x.x - spot.x, x.y - spot.y) < 0.1;
    };
    if (spot.y > -0.2 && std::abs(spot.x) < 0.3 && std::ranges::none_of(result, is_near))
      result.push_back(spot);
  }
  return result;
}

std::vector<std::string> random_colours(std::mt19937_64& random) {
  std::vector<std::string> result{"red", "green", "blue", "yellow", "purple", "orange"};
  std::ranges::shuffle(result, random);
  return result;
}

RandomThing random_thing(std::mt19937_64& random, const std::string& colour, const Spot& at) {
  constexpr const char* shapes[] = {"cube", "sphere", "cylinder"};
  RandomThing result{colour, shapes[random() % 3], at.x, at.y, any(random, 0.04, 0.06), 0, 0};
  result.turned = any(random, 0, 90);
  result.height = any(random, 0.05, 0.09);
  return result;
}

PutTask random_put_task(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto colours = random_colours(random);
  auto spots = random_spots(random, 4 + random() % 3);
  PutTask result;
  result.x = spots.back().x;
  result.y = spots.back().y;
  spots.pop_back();
  for (std::size_t i = 0; i < spots.size(); ++i)
    result.things.push_back(random_thing(random, colours[i], spots[i]));
  return result;
}

std::string scene_text(const std::vector<RandomThing>& things) {
  std::string result = "table wood\ncamera 0 -0.34 0.92  looking-at 0 0.02 0  fov 38\n";
  for (const auto& x : things)
    result += fmt::format("{} {} at {:.3f} {:.3f} size {:.3f}{} turned {:.0f}\n", x.colour, x.shape,
                          x.x, x.y, x.size,
                          x.shape == "cylinder" ? fmt::format(" {:.3f}", x.height) : "", x.turned);
  return result;
}

double median(std::vector<double> x) {
  if (x.empty())
    return 0;
  std::ranges::sort(x);
  return x[x.size() / 2];
}

std::string text_of_file(const std::string& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

} // namespace castor::manipulation
