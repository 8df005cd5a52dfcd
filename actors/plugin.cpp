#include "castor/actors/plugin.hpp"

#include "castor/actors/cast/suggestion.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <string_view>
#include <utility>
#include <vector>

namespace castor {

namespace {

/// The libraries that CMake was told to bundle, separated by commas.
constexpr std::string_view bundled = CASTOR_BUNDLED_PLUGINS;

bool is_path(const std::string& library) {
  return library.find('/') != library.npos || library.find(".so") != library.npos;
}

/// With the version, so that it is there without what only developers have.
std::string bundled_file_name(std::string_view library) {
  return "lib" + std::string{library} + ".so." CASTOR_SOVERSION;
}

std::string file_name(const std::string& library) {
  return is_path(library) ? library : "lib" + library + ".so";
}

} // namespace

std::optional<std::string> load_plugin(const std::string& library) {
  auto file = file_name(library);
  // Never closed: values and components of its types may live until the end.
  if (dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL))
    return std::nullopt;
  return "cannot load " + file + ": " + dlerror();
}

std::vector<std::string> bundled_plugins() {
  std::vector<std::string> result;
  for (std::size_t at = 0; at < bundled.size();) {
    auto end = std::min(bundled.find(',', at), bundled.size());
    result.push_back(bundled_file_name(bundled.substr(at, end - at)));
    at = end + 1;
  }
  return result;
}

void load_bundled_plugins() {
  static bool done = false;
  if (std::exchange(done, true))
    return;
  for (auto& library : bundled_plugins())
    if (auto problem = load_plugin(library))
      note(LogLevel::warning, *problem);
}

ClassLookup find_class(const std::string& name) {
  auto& registry = Registry::instance();
  auto at = name.find('@');
  auto class_name = name.substr(0, at);
  if (at != name.npos) {
    if (auto problem = load_plugin(name.substr(at + 1)))
      return {nullptr, *problem};
    if (auto* found = registry.find(class_name))
      return {found, {}};
    return {nullptr,
            "the library " + name.substr(at + 1) + " registers no component class " + class_name};
  }
  if (auto* found = registry.find(name))
    return {found, {}};
  load_bundled_plugins();
  if (auto* found = registry.find(name))
    return {found, {}};
  auto problem = load_plugin(name);
  if (auto* found = registry.find(name))
    return {found, {}};
  if (!problem)
    return {nullptr, "lib" + name + ".so registers no component class " + name +
                       "; CASTOR_COMPONENT(" + name + ", \"...\") does that"};
  std::vector<std::string_view> known;
  for (auto* x : registry.all())
    known.push_back(x->name);
  auto guess = cast::did_you_mean(name, known);
  if (guess.empty())
    guess = "`castor components` lists the classes, --plugin loads further ones";
  return {nullptr, "there is no component class " + name + " and no library lib" + name +
                     ".so where the loader looks; " + guess};
}

} // namespace castor
