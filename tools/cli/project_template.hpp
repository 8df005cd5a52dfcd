#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace castor::cli {

/// A file that `castor new` makes, with {{name}}, {{library}} and {{Class}} in its text.
struct TemplateFile {
  /// What it is a part of: "component", "subarchitecture" or "robot".
  std::string_view kind;
  /// Below the new folder; NAME in it stands for the name.
  std::string_view path;
  std::string_view text;
};

/// All of them; from tools/cli/templates.
std::span<const TemplateFile> template_files();

/// The kinds that there are templates of.
std::vector<std::string_view> template_kinds();

/// What a new project and the things in it are called.
struct ProjectName {
  /// "door-watcher": the folder, the .cast file, and what components are called.
  std::string name;
  /// "door_watcher": CMake targets.
  std::string library;
  /// "DoorWatcher": C++ types.
  std::string class_name;
};

/// The names that follow from the one that the user has chosen; says what is wrong with it if it
/// cannot be one.
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

/// The files of a new project; none if there are no templates of that kind.
std::vector<ProjectFile> project_files(std::string_view kind, const ProjectName& name);

/// The component classes that the files register.
std::vector<std::string> registered_classes(const std::vector<ProjectFile>& files);

} // namespace castor::cli
