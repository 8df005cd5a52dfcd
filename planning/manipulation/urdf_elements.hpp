#pragma once

#include "castor/planning/manipulation/arm_model.hpp"

#include <stdexcept>
#include <string>
#include <vector>

namespace tinyxml2 {
class XMLElement;
}

/// Parsers of the elements of a URDF file, for urdf_reader.hpp.
namespace castor::manipulation {

/// An error in an element of a URDF file, with its line and its remedy.
class UrdfError : public std::runtime_error {
public:
  UrdfError(const tinyxml2::XMLElement& element, const std::string& message, std::string remedy);

  int line() const { return line_; }
  const std::string& remedy() const { return remedy_; }

private:
  int line_;
  std::string remedy_;
};

/// A joint with the names of the links that it joins.
struct UrdfJoint {
  Joint joint;
  std::string parent;
  std::string child;
  int line = 0;
};

/// A link; `meshes` are the lines of the shapes that are left out.
struct UrdfLink {
  Link link;
  std::vector<int> meshes;
  int line = 0;
};

// \throws UrdfError

/// A <joint>; it has no accelerations.
UrdfJoint read_urdf_joint(const tinyxml2::XMLElement& element);

/// A <link>.
UrdfLink read_urdf_link(const tinyxml2::XMLElement& element);

} // namespace castor::manipulation
