#include "castor/actors/runtime/plugin.hpp"

#include "castor/actors/runtime/bundled_plugins.hpp"
#include "castor/base/input_file.hpp"
#include "castor/base/suggestion.hpp"

#include <dlfcn.h>
#include <elf.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <mutex>
#include <set>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace castor {

namespace {

/// The libraries that CMake was told to bundle, separated by commas.
constexpr std::string_view bundled = CASTOR_BUNDLED_PLUGINS;

/// Component classes and the libraries that they are in, as CMake found them in the sources. One
/// that was added since is missing, so it is only a hint.
constexpr std::pair<std::string_view, std::string_view> libraries_of_classes[] = {
#include "component_classes.inc"
  {},
};

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

/// What the first bytes of a file say of the machine that it is made for; nothing if it is no
/// program and no library.
struct Machine {
  unsigned char word = 0;
  unsigned short number = 0;

  friend bool operator==(const Machine&, const Machine&) = default;
};

std::optional<Machine> machine_of(const InputFile& file) {
  Elf32_Ehdr head{};
  auto bytes = file.read(sizeof(head));
  // Up to the number, both kinds of head are alike.
  if (bytes.size() < sizeof(head) || std::memcmp(bytes.data(), ELFMAG, SELFMAG) != 0)
    return std::nullopt;
  std::memcpy(&head, bytes.data(), sizeof(head));
  return Machine{head.e_ident[EI_CLASS], head.e_machine};
}

/// What makes a file no library that this process could load; empty if nothing is seen.
std::string why_no_library(const std::string& file) {
  try {
    auto machine = machine_of(InputFile{file});
    if (!machine)
      return "it is no shared library; CMake makes one with add_library(NAME MODULE ...)";
    if (auto own = machine_of(InputFile{"/proc/self/exe"}); own && machine != own)
      return "it is made for another machine than this one; build it here";
  } catch (const InputFileError& e) {
    if (e.reason() == InputFileError::Reason::missing)
      return "there is no such file; build it, or write where it is";
    if (e.reason() == InputFileError::Reason::folder)
      return "it is a folder; name the library in it";
    return e.what();
  }
  return {};
}

/// What is in the way, if it is known without asking the loader.
std::string problem_of(const std::string& file) {
  if (file.find('/') == file.npos)
    return {};
  auto problem = why_no_library(file);
  return problem.empty() ? problem : "cannot load " + file + ": " + problem;
}

/// In a word without a path, which the loader looks for in its own places.
std::string not_found(const std::string& library, const std::string& file) {
  auto text = "cannot load " + file + ": the loader does not find it; ";
  std::error_code error;
  for (auto& x : {library, file})
    if (std::filesystem::is_regular_file(x, error))
      return text + "write --plugin ./" + x + " for the one in this folder";
  return text + "write its path, or add its folder to LD_LIBRARY_PATH";
}

/// Libraries are loaded by one thread at a time.
std::recursive_mutex& loading() {
  static std::recursive_mutex result;
  return result;
}

/// How many of the libraries that come with Castor were loaded.
enum class Bundled : std::uint8_t { none, some, all };

std::atomic<Bundled> bundled_loaded{Bundled::none};

bool is_loaded(const std::string& library) {
  auto file = file_name(library);
  // The loader would wait for ever to open a named pipe.
  if (!problem_of(file).empty())
    return false;
  auto* handle = dlopen(file.c_str(), RTLD_LAZY | RTLD_NOLOAD);
  if (!handle)
    return false;
  dlclose(handle);
  return true;
}

} // namespace

std::string why_no_plugin(const std::string& library) {
  if (!library.ends_with(".cast"))
    return {};
  return library +
         " is a .cast file, no library with component classes; write it without "
         "--plugin: castor run " +
         library;
}

std::optional<std::string> load_plugin(const std::string& library) {
  auto file = file_name(library);
  for (auto& problem : {why_no_plugin(library), problem_of(file)})
    if (!problem.empty())
      return problem;
  // Never closed: values and components of its types may live until the end.
  if (dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL))
    return std::nullopt;
  const std::string why = dlerror();
  if (file.find('/') == file.npos && why.starts_with(file + ": cannot open shared object"))
    return not_found(library, file);
  return "cannot load " + file + ": " + why;
}

std::optional<std::string> load_plugins(const std::vector<std::string>& libraries) {
  std::set<std::string> parts_of_castor;
  for (auto& x : libraries)
    if (is_loaded(x))
      parts_of_castor.insert(x);
  for (auto& x : libraries) {
    // It may have come with another one that links with it, and its classes too.
    bool was_there = is_loaded(x);
    auto classes = Registry::instance().all().size();
    if (auto problem = load_plugin(x))
      return problem;
    if (parts_of_castor.count(x) > 0 ||
        (!was_there && Registry::instance().all().size() == classes))
      return "the library " + x +
             " registers no component class of its own; CASTOR_COMPONENT(Class, \"...\") in a "
             "source file of it does that";
  }
  return std::nullopt;
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

std::string bundled_plugin_of(const std::string& class_name) {
  for (auto& [name, library] : libraries_of_classes)
    if (name == class_name)
      return bundled_file_name(library);
  return {};
}

bool lacks_bundled_plugins() {
  return bundled_loaded == Bundled::some;
}

void load_bundled_plugins() {
  std::lock_guard guard{loading()};
  if (bundled_loaded.exchange(Bundled::all) == Bundled::all)
    return;
  for (auto& library : bundled_plugins())
    if (auto problem = load_plugin(library))
      log_runtime(LogLevel::warning, *problem);
}

ClassLookup find_class(const std::string& name) {
  std::lock_guard guard{loading()};
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
  if (auto library = bundled_plugin_of(name); !library.empty() && !load_plugin(library)) {
    if (bundled_loaded == Bundled::none)
      bundled_loaded = Bundled::some;
    if (auto* found = registry.find(name))
      return {found, {}};
  }
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
  auto guess = did_you_mean(name, known);
  if (guess.empty())
    guess = "`castor components` lists the classes, --plugin loads further ones";
  return {nullptr, "there is no component class " + name + " and no library lib" + name +
                     ".so where the loader looks; " + guess};
}

} // namespace castor
