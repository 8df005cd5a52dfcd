#pragma once

#include "castor/actors/component/registry.hpp"

#include <optional>
#include <string>
#include <vector>

namespace castor {

/// Loads a shared library permanently, and with it the component classes that it registers.
/// `library` is a path, or a name that the loader looks for ("robot" for librobot.so). Returns the
/// error, if there is one.
std::optional<std::string> load_plugin(const std::string& library);

/// Loads the libraries that a user names for the sake of their component classes. Returns the error
/// of the first that cannot be loaded or registers no class.
std::optional<std::string> load_plugins(const std::vector<std::string>& libraries);

/// The libraries of components that come with Castor, as `load_plugin` takes them.
std::vector<std::string> bundled_plugins();

/// Why a name cannot be that of a library; empty if it may be one.
std::string why_no_plugin(const std::string& library);

/// Loads the libraries of components that come with Castor.
void load_bundled_plugins();

/// Result of looking for a class.
struct ClassLookup {
  /// Null if there is no such class.
  const ComponentClass* found = nullptr;
  /// Why there is none, with what to do; empty if there is one.
  std::string problem;
};

/// The class that a .cast file means: one that is loaded, one of those that come with Castor, one
/// in the library lib<Class>.so, or for "Class@library" the one in that library.
ClassLookup find_class(const std::string& name);

} // namespace castor
