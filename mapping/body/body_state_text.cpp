#include "castor/mapping/body/body_state_text.hpp"

#include "castor/base/text_file.hpp"

#include <fmt/format.h>

#include <cmath>
#include <vector>

namespace castor::mapping {

std::string body_state_text(const SavedBody& x) {
  const auto& s = x.state;
  return fmt::format("body {} {} {} {} {} {} {} {} {} {}\n", x.time, s.pose.x, s.pose.y,
                     s.pose.heading, s.odometry.x, s.odometry.y, s.odometry.heading, s.collisions,
                     s.least_clearance, s.driven);
}

std::optional<SavedBody> parse_body_state(std::string_view text) {
  constexpr std::size_t words = 11;
  const auto lines = text_lines(text);
  if (lines.size() != 1 || lines[0].words.size() != words || lines[0].words[0] != "body")
    return std::nullopt;
  std::vector<double> numbers;
  for (std::size_t i = 1; i < words; ++i) {
    const auto number = parse_number(lines[0].words[i]);
    // Counts and times are exact up to here.
    constexpr double largest = 9e15;
    if (!number || std::abs(*number) > largest)
      return std::nullopt;
    numbers.push_back(*number);
  }
  SavedBody result;
  result.time = std::llround(numbers[0]);
  result.state = {{numbers[1], numbers[2], numbers[3]},
                  {numbers[4], numbers[5], numbers[6]},
                  std::llround(numbers[7]),
                  numbers[8],
                  numbers[9]};
  return result;
}

} // namespace castor::mapping
