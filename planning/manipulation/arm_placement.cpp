#include "castor/planning/manipulation/arm_placement.hpp"

#include "castor/base/statement_words.hpp"
#include "castor/base/text_file.hpp"
#include "castor/mapping/geometry/poses.hpp"

#include <numbers>
#include <stdexcept>
#include <vector>

namespace castor::manipulation {

namespace {

constexpr double degree = std::numbers::pi / 180;

std::vector<std::string> words_of(const std::string& text) {
  std::vector<std::string> result;
  for (auto& line : text_lines(text))
    result.insert(result.end(), line.words.begin(), line.words.end());
  return result;
}

/// Reads the words by `read`, and reports what is wrong with the whole text.
template <class F>
auto read_all_of(const std::string& text, F read) {
  const auto words = words_of(text);
  StatementWords statement(words);
  try {
    auto result = read(statement);
    statement.expect_end();
    return result;
  } catch (const StatementError& e) {
    throw std::invalid_argument("'" + text + "': " + e.what() + ". " + e.remedy());
  }
}

} // namespace

Pose arm_placement(const std::string& text) {
  return read_all_of(text, [](StatementWords& words) {
    Pose result;
    result.frame = geometry::table_frame;
    result.position.x = words.length("x of the arm", -100, 100);
    result.position.y = words.length("y of the arm", -100, 100);
    if (words.accept("heading"))
      result.rotation =
        geometry::rotation_about_z(words.number("the heading in degrees", -360, 360) * degree);
    return result;
  });
}

Configuration arm_posture(const ArmModel& arm, const std::string& text) {
  if (text.empty())
    return arm.home;
  auto result = read_all_of(text, [&](StatementWords& words) {
    Configuration x;
    for (auto index : moving_joints(arm)) {
      const auto& joint = arm.joints[index];
      const double unit = joint.kind == JointKind::turning ? degree : 1;
      x.push_back(words.number("the joint " + joint.name, -10'000, 10'000) * unit);
    }
    return x;
  });
  if (!within_limits(arm, result))
    throw std::invalid_argument("'" + text + "' is beyond the limits of a joint of " + arm.name);
  return result;
}

} // namespace castor::manipulation
