#include "castor/tools/cli/project_template.hpp"

#include "castor/base/text.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <utility>

namespace castor::cli {

namespace {

/// The longest name that is allowed: file names and sockets are made of it.
constexpr std::size_t longest_name = 40;

/// Targets that CMake has in every project.
constexpr std::string_view cmake_targets[] = {"all",       "ALL_BUILD",  "clean",
                                              "depend",    "edit_cache", "help",
                                              "INSTALL",   "install",    "list_install_components",
                                              "package",   "PACKAGE",    "rebuild_cache",
                                              "RUN_TESTS", "test"};

bool is_letter(char x) {
  return std::isalpha(static_cast<unsigned char>(x)) != 0;
}

bool is_letter_or_digit(char x) {
  return std::isalnum(static_cast<unsigned char>(x)) != 0;
}

bool is_separator(char x) {
  return x == '-' || x == '_';
}

std::string filled_in(std::string_view text, const ProjectName& name) {
  std::string result{text};
  replace_all(result, "{{name}}", name.name);
  replace_all(result, "{{library}}", name.library);
  replace_all(result, "{{Class}}", name.class_name);
  return result;
}

std::string problem_with(const std::string& name) {
  constexpr auto rule = "; it is made of letters, digits, - and _, and begins with a letter";
  if (name.empty() || !is_letter(name.front()))
    return fmt::format("'{}' cannot be a name{}", name, rule);
  for (std::size_t i = 0; i < name.size(); ++i) {
    if (!is_letter_or_digit(name[i]) && !is_separator(name[i]))
      return fmt::format("'{}' cannot be a name{}", name, rule);
    if (is_separator(name[i]) && (i + 1 == name.size() || is_separator(name[i + 1])))
      return fmt::format("'{}' cannot be a name: behind - and _ stands a letter or a digit", name);
  }
  if (name.size() > longest_name)
    return fmt::format("'{}' is too long for a name: {} characters at most", name, longest_name);
  return {};
}

} // namespace

std::vector<std::string_view> template_kinds() {
  std::vector<std::string_view> result;
  for (auto& x : template_files())
    if (std::find(result.begin(), result.end(), x.kind) == result.end())
      result.push_back(x.kind);
  return result;
}

ProjectNameResult project_name(const std::string& name) {
  if (auto problem = problem_with(name); !problem.empty())
    return {std::nullopt, problem};
  ProjectName result{name, name, {}};
  std::replace(result.library.begin(), result.library.end(), '-', '_');
  bool begins_word = true;
  for (char x : name) {
    if (!is_separator(x))
      result.class_name +=
        begins_word ? static_cast<char>(std::toupper(static_cast<unsigned char>(x))) : x;
    begins_word = is_separator(x);
  }
  if (std::find(std::begin(cmake_targets), std::end(cmake_targets), result.library) !=
      std::end(cmake_targets))
    return {
      std::nullopt,
      fmt::format("'{}' cannot be a name: CMake has a target of that name in every project", name)};
  if (result.library == "castor" || result.library.starts_with("castor_"))
    return {std::nullopt, fmt::format("'{}' cannot be a name: it is taken for Castor's own", name)};
  return {std::move(result), {}};
}

std::vector<ProjectFile> project_files(std::string_view kind, const ProjectName& name) {
  std::vector<ProjectFile> result;
  for (auto& x : template_files()) {
    if (x.kind != kind)
      continue;
    std::string path{x.path};
    replace_all(path, "NAME", name.name);
    result.push_back({std::move(path), filled_in(x.text, name)});
  }
  return result;
}

std::vector<std::string> registered_classes(const std::vector<ProjectFile>& files) {
  constexpr std::string_view macro = "CASTOR_COMPONENT(";
  std::vector<std::string> result;
  for (auto& file : files)
    for (auto at = file.text.find(macro); at != file.text.npos; at = file.text.find(macro, at)) {
      at += macro.size();
      result.push_back(file.text.substr(at, file.text.find(',', at) - at));
    }
  return result;
}

} // namespace castor::cli
