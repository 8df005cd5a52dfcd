#include "castor/planning/body/saved_arm_text.hpp"

#include "castor/base/text_file.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <iterator>
#include <utility>
#include <vector>

namespace castor::manipulation {

namespace {

/// The numbers that a line has after its first word; nothing if a word is none.
std::optional<std::vector<double>> numbers_of(const TextLine& line, std::size_t count) {
  if (line.words.size() < count + 1)
    return {};
  std::vector<double> result;
  for (std::size_t i = 1; i <= count; ++i) {
    const auto number = parse_number(line.words[i]);
    // Counts and times are exact up to here.
    constexpr double largest = 9e15;
    if (!number || std::abs(*number) > largest)
      return {};
    result.push_back(*number);
  }
  return result;
}

/// The text behind a number of words.
std::string rest_of(const TextLine& line, std::size_t words) {
  std::string result;
  for (std::size_t i = words; i < line.words.size(); ++i)
    result += (result.empty() ? "" : " ") + line.words[i];
  return result;
}

} // namespace

std::string saved_arm_text(const TimedArm& x) {
  const auto& s = x.state;
  auto result = fmt::format("arm {} {} {} {} {} {} {}\njoints", x.time, s.opening, s.changes,
                            s.collisions, s.missed, s.dropped, s.moved);
  for (const double position : s.positions)
    result += fmt::format(" {}", position);
  result += '\n';
  for (const auto& [thing, support] : s.things) {
    const auto& [at, turned, frame] = thing.pose;
    result += fmt::format("thing {} {} {} {} {} {} {} {}\non {}\n", at.x, at.y, at.z, turned.w,
                          turned.x, turned.y, turned.z, thing.name, support);
  }
  return result;
}

std::optional<TimedArm> parse_saved_arm(std::string_view text) {
  const auto lines = text_lines(text);
  if (lines.size() < 2 || lines.size() % 2 != 0 || lines[0].words[0] != "arm" ||
      lines[1].words[0] != "joints")
    return {};
  const auto counts = numbers_of(lines[0], 7);
  auto joints = numbers_of(lines[1], lines[1].words.size() - 1);
  if (!counts || !joints)
    return {};
  const auto& c = *counts;
  TimedArm result{std::llround(c[0]),
                  {*std::move(joints),
                   c[1],
                   static_cast<std::uint64_t>(std::llround(c[2])),
                   std::llround(c[3]),
                   std::llround(c[4]),
                   std::llround(c[5]),
                   c[6],
                   {}}};
  for (std::size_t i = 2; i < lines.size(); i += 2) {
    const auto pose = numbers_of(lines[i], 7);
    if (lines[i].words[0] != "thing" || lines[i + 1].words[0] != "on" || !pose)
      return {};
    const auto& p = *pose;
    WorldThing thing;
    thing.thing.name = rest_of(lines[i], 8);
    thing.thing.pose = {{p[0], p[1], p[2]}, {p[3], p[4], p[5], p[6]}, arm_frame};
    thing.support = rest_of(lines[i + 1], 1);
    result.state.things.push_back(std::move(thing));
  }
  return result;
}

} // namespace castor::manipulation
