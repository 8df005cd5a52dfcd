#include "castor/planning/manipulation/arm_file.hpp"

#include "castor/planning/manipulation/arm_statement.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace castor::manipulation {

namespace {

// No arm has more joints, or shapes on a link: a slip of the pen, or a file of something else.
constexpr std::size_t most_joints = 32;
constexpr std::size_t most_shapes = 64;

class ArmReader {
public:
  explicit ArmReader(std::string file_name) : file_name_(std::move(file_name)) {
    // nop
  }

  ArmText read(std::string_view text) {
    for (const auto& line : text_lines(text)) {
      try {
        read_line(line);
      } catch (const StatementError& error) {
        report(Severity::error, line, error.what(), error.remedy());
      }
    }
    check();
    sort_by_line(problems_);
    return {std::move(arm_), std::move(problems_)};
  }

private:
  void report(Severity severity, const TextLine& line, std::string message, std::string remedy) {
    problems_.push_back(finding(severity, file_name_, line, std::move(message), std::move(remedy)));
  }

  void read_line(const TextLine& line) {
    StatementWords words(line.words);
    const std::string keyword = words.next("a statement");
    const auto [first, is_new] = keywords_.emplace(keyword, line.number);
    const bool may_repeat =
      keyword == "joint" || keyword == "slide" || keyword == "fixed" || keyword == "shape";
    if (!is_new && !may_repeat && std::ranges::count(arm_keywords(), keyword) > 0)
      throw StatementError("\"" + keyword + "\" is given twice",
                           "Remove this line or line " + std::to_string(first->second) + ".");
    // Where a joint is missing, its numbers cannot be told apart.
    if (keyword == "home" && has_errors(problems_))
      return;
    read_statement(keyword, words, line.number);
    words.expect_end();
  }

  void read_statement(const std::string& keyword, StatementWords& words, int line) {
    if (keyword == "arm")
      arm_.name = words.name("the arm's name");
    else if (keyword == "base")
      add_base(words, line);
    else if (keyword == "joint")
      add_joint(words, JointKind::turning, line);
    else if (keyword == "slide")
      add_joint(words, JointKind::sliding, line);
    else if (keyword == "fixed")
      add_joint(words, JointKind::fixed, line);
    else if (keyword == "shape")
      add_shape(words);
    else if (keyword == "tool")
      arm_.tool = read_arm_pose(words, "the tool");
    else if (keyword == "gripper")
      arm_.gripper = read_gripper(words);
    else if (keyword == "home")
      arm_.home = read_home(words, arm_);
    else
      throw StatementError("\"" + keyword + "\" is not the beginning of a statement",
                           remedy_for(keyword, arm_keywords(), "statements"));
  }

  void take_name(const std::string& name, int line) {
    if (auto [first, is_new] = names_.emplace(name, line); !is_new)
      throw StatementError("the name " + name + " is given twice",
                           "Change it here or in line " + std::to_string(first->second) + ".");
  }

  void add_base(StatementWords& words, int line) {
    if (!arm_.links.empty())
      throw StatementError(
        "\"base\" stands after a joint",
        "Begin with the base: each joint moves the next link on the one before.");
    arm_.links.push_back({words.name("the base's name"), {}});
    take_name(arm_.links.front().name, line);
  }

  void add_joint(StatementWords& words, JointKind kind, int line) {
    if (keywords_.contains("home"))
      throw StatementError("a joint stands after \"home\"",
                           "Move \"home\" to the end of the file.");
    if (arm_.links.empty())
      arm_.links.push_back({"base", {}});
    if (arm_.joints.size() == most_joints)
      throw StatementError("there are more than " + std::to_string(most_joints) + " joints",
                           "Leave some out.");
    auto [joint, link] = read_joint(words, kind);
    take_name(link.name, line);
    take_name(joint.name, line);
    arm_.joints.push_back(std::move(joint));
    arm_.links.push_back(std::move(link));
  }

  void add_shape(StatementWords& words) {
    if (arm_.links.empty())
      throw StatementError("there is no link before this shape",
                           "Write \"base NAME\" or a joint before it, whose link it is a part of.");
    auto& shapes = arm_.links.back().shapes;
    if (shapes.size() == most_shapes)
      throw StatementError("a link has more than " + std::to_string(most_shapes) + " shapes",
                           "Leave some out.");
    shapes.push_back(read_shape(words));
  }

  void check() {
    // After an error in a line, what seems to be missing may be there.
    if (has_errors(problems_))
      return;
    const auto moving = moving_joints(arm_);
    if (arm_.name.empty())
      report(Severity::error, {}, "there is no \"arm\" line",
             "Say its name, for example: arm katana");
    if (moving.empty())
      report(
        Severity::error, {}, "there is no joint that moves",
        "Add joints, for example: joint elbow moves forearm at 0 0 0.19 axis y from -120 to 120 "
        "speed 70 acceleration 120");
    if (!keywords_.contains("tool"))
      report(Severity::error, {}, "there is no \"tool\" line",
             "Say where the arm grasps on its last link, for example: tool at 0 0 0.15");
    for (std::size_t i = 1; i < arm_.links.size(); ++i)
      has_shapes_ |= !arm_.links[i].shapes.empty();
    if (!has_shapes_)
      report(Severity::warning, {}, "no link that moves has a shape, so it collides with nothing",
             "Add shapes, for example: shape capsule 0.06 0.25 at 0 0 0.095");
    if (arm_.home.empty())
      for (auto index : moving)
        arm_.home.push_back(std::clamp(0.0, arm_.joints[index].lower, arm_.joints[index].upper));
  }

  std::string file_name_;
  ArmModel arm_;
  /// Lines where keywords, and names of links and joints, occur first.
  std::map<std::string, int> keywords_;
  std::map<std::string, int> names_;
  std::vector<Diagnostic> problems_;
  bool has_shapes_ = false;
};

} // namespace

ArmText parse_arm(std::string_view text, const std::string& file_name) {
  return ArmReader(file_name).read(text);
}

ArmText load_arm(const std::filesystem::path& path) {
  return load_parsed(path, parse_arm);
}

} // namespace castor::manipulation
