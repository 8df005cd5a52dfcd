#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace castor::cli {

/// Template of a file that `castor new` makes, with the placeholders {{name}}, {{library}} and
/// {{Class}}.
struct TemplateFile {
  /// Kind of project: "component", "subarchitecture" or "robot".
  std::string_view kind;
  /// Relative to the new folder; NAME in it is replaced by the project's name.
  std::string_view path;
  std::string_view text;
};

/// All templates, from tools/cli/templates.
std::span<const TemplateFile> template_files();

/// Kinds of projects.
std::vector<std::string_view> template_kinds();

/// Names of a new project and of its parts.
struct ProjectName {
  /// "door-watcher": the folder, the .cast file, and components.
  std::string name;
  /// "door_watcher": CMake targets.
  std::string library;
  /// "DoorWatcher": C++ types.
  std::string class_name;
};

/// The names derived from the user's choice, or the reason why it is not allowed.
struct ProjectNameResult {
  std::optional<ProjectName> name;
  std::string problem;
};
ProjectNameResult project_name(const std::string& name);

/// A file of a new project.
struct ProjectFile {
  std::string path;
  std::string text;
};

/// The files of a new project; empty for an unknown kind.
std::vector<ProjectFile> project_files(std::string_view kind, const ProjectName& name);

/// The component classes that the files register.
std::vector<std::string> registered_classes(const std::vector<ProjectFile>& files);

} // namespace castor::cli
