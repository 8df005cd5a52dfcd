#include "castor/planning/manipulation/urdf_reader.hpp"

#include "castor/base/statement_words.hpp"
#include "castor/mapping/geometry/poses.hpp"
#include "castor/planning/manipulation/urdf_elements.hpp"

#include <tinyxml2.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace castor::manipulation {

namespace {

class UrdfReader {
public:
  UrdfReader(const std::string& text, std::string file_name, const UrdfOptions& options)
    : text_(text), file_name_(std::move(file_name)), options_(options) {
    // nop
  }

  ArmText read() {
    tinyxml2::XMLDocument document;
    if (document.Parse(text_.c_str(), text_.size()) != tinyxml2::XML_SUCCESS)
      report(Severity::error, document.ErrorLineNum(), "the file is no XML: " + xml_error(document),
             "Close every element, and every attribute's quotation mark.");
    else if (const auto* robot = document.FirstChildElement("robot"))
      read_robot(*robot);
    else
      report(Severity::error, 0, "there is no <robot>",
             "A file of URDF begins with <robot name=\"...\">.");
    sort_by_line(problems_);
    return {std::move(arm_), std::move(problems_)};
  }

private:
  static std::string xml_error(const tinyxml2::XMLDocument& document) {
    return tinyxml2::XMLDocument::ErrorIDToName(document.ErrorID());
  }

  void report(Severity severity, int line, std::string message, std::string remedy) {
    TextLine place;
    place.number = line;
    std::size_t begin = 0;
    for (int i = 1; i < line && begin < text_.size(); ++i)
      begin = std::min(text_.find('\n', begin), text_.size() - 1) + 1;
    if (line > 0)
      place.text = text_.substr(begin, text_.find_first_of("\r\n", begin) - begin);
    problems_.push_back(
      finding(severity, file_name_, place, std::move(message), std::move(remedy)));
  }

  void read_robot(const tinyxml2::XMLElement& robot) {
    if (const char* name = robot.Attribute("name"))
      arm_.name = name;
    for (const auto* x = robot.FirstChildElement(); x; x = x->NextSiblingElement())
      try {
        read_element(*x);
      } catch (const UrdfError& error) {
        report(Severity::error, error.line(), error.what(), error.remedy());
      }
    // After an error in an element, the chain would seem to be broken.
    if (!has_errors(problems_))
      find_chain();
    if (!has_errors(problems_))
      build();
  }

  void read_element(const tinyxml2::XMLElement& element) {
    const std::string name = element.Name();
    if (name.starts_with("xacro:"))
      throw UrdfError(element, "the file has to be expanded by xacro first",
                      "Expand it: xacro FILE > FILE.urdf");
    if (name == "link") {
      auto link = read_urdf_link(element);
      if (auto [other, is_new] = links_.emplace(link.link.name, link); !is_new)
        throw UrdfError(element, "the link " + other->first + " is there twice",
                        "Change its name here or in line " + std::to_string(other->second.line) +
                          ".");
    } else if (name == "joint") {
      auto joint = read_urdf_joint(element);
      if (auto [other, is_new] = joint_to_.emplace(joint.child, joint); !is_new)
        throw UrdfError(element, "the link " + joint.child + " has two parents",
                        "Remove this joint or " + other->second.joint.name + " in line " +
                          std::to_string(other->second.line) + ".");
    }
  }

  /// Names of the links that carry no other.
  std::vector<std::string> leaves() const {
    std::set<std::string> parents;
    for (const auto& [child, joint] : joint_to_)
      parents.insert(joint.parent);
    std::vector<std::string> result;
    for (const auto& [name, link] : links_)
      if (!parents.contains(name))
        result.push_back(name);
    return result;
  }

  void find_chain() {
    for (const auto& [child, joint] : joint_to_)
      for (const auto& name : {joint.parent, child})
        if (!links_.contains(name))
          report(Severity::error, joint.line,
                 "joint " + joint.joint.name + " is on the link " + name + ", which is not there",
                 "Add <link name=\"" + name + "\"/>, or correct the name.");
    if (has_errors(problems_))
      return;
    const auto ends = leaves();
    std::string tip = options_.tip;
    if (tip.empty() && ends.size() == 1)
      tip = ends.front();
    if (!links_.contains(tip)) {
      report(Severity::error, 0,
             tip.empty() ? "it is not certain which link the tool is on"
                         : "there is no link " + tip + " that the tool could be on",
             "Say which (UrdfOptions::tip). Links that carry no other are: " + joined(ends) + ".");
      return;
    }
    chain_ = {tip};
    for (auto joint = joint_to_.find(tip); joint != joint_to_.end();
         joint = joint_to_.find(chain_.back())) {
      if (std::ranges::count(chain_, joint->second.parent) > 0) {
        report(Severity::error, joint->second.line,
               "the links are a cycle: " + joint->second.parent + " carries itself",
               "Remove a joint: links have to be a tree.");
        return;
      }
      chain_.push_back(joint->second.parent);
    }
    std::ranges::reverse(chain_);
  }

  void build() {
    for (std::size_t i = 0; i < chain_.size(); ++i) {
      Link link{chain_[i], {}};
      add_shapes(chain_[i], {}, i + 1 < chain_.size() ? chain_[i + 1] : std::string(), link);
      arm_.links.push_back(std::move(link));
      if (i == 0)
        continue;
      auto joint = joint_to_.at(chain_[i]).joint;
      joint.acceleration = joint.speed / options_.time_to_speed;
      arm_.joints.push_back(std::move(joint));
    }
    arm_.tool = options_.tool;
    arm_.gripper = options_.gripper;
    const auto moving = moving_joints(arm_);
    if (moving.empty())
      report(Severity::error, 0, "no joint on the way to " + chain_.back() + " moves",
             "Say another link that the tool is on (UrdfOptions::tip).");
    for (auto index : moving)
      arm_.home.push_back(std::clamp(0.0, arm_.joints[index].lower, arm_.joints[index].upper));
  }

  /// The shapes of a link, and of those that it carries beside the chain.
  void add_shapes(const std::string& name, const Pose& pose, const std::string& next,
                  Link& result) {
    const auto& [link, meshes, line] = links_.at(name);
    for (auto shape : link.shapes) {
      shape.pose = geometry::compose(pose, shape.pose);
      result.shapes.push_back(shape);
    }
    for (auto mesh : meshes)
      report(Severity::warning, mesh,
             "the mesh of " + name + " is left out: nothing collides with it",
             "Describe its shape by boxes, cylinders and spheres in <collision>.");
    for (const auto& [child, joint] : joint_to_)
      if (joint.parent == name && child != next)
        add_shapes(child, geometry::compose(pose, joint.joint.origin), next, result);
  }

  const std::string& text_;
  std::string file_name_;
  const UrdfOptions& options_;
  ArmModel arm_;
  std::map<std::string, UrdfLink> links_;
  /// By the link that they carry.
  std::map<std::string, UrdfJoint> joint_to_;
  /// From the root to the tip.
  std::vector<std::string> chain_;
  std::vector<Diagnostic> problems_;
};

} // namespace

ArmText parse_urdf(const std::string& text, const std::string& file_name,
                   const UrdfOptions& options) {
  return UrdfReader(text, file_name, options).read();
}

ArmText load_urdf(const std::filesystem::path& path, const UrdfOptions& options) {
  return load_parsed(path, [&](const std::string& text, const std::string& name) {
    return parse_urdf(text, name, options);
  });
}

} // namespace castor::manipulation
