#pragma once

#include <string>

/// The libraries of components that come with Castor, of which `find_class` loads only those whose
/// classes are needed.
namespace castor {

/// Of `bundled_plugins()`, the one with that class, by what its sources said when Castor was built;
/// empty if that is not known.
std::string bundled_plugin_of(const std::string& class_name);

/// Whether only some of them were loaded, for their classes, so that this process does not know the
/// entry types of the others. `load_bundled_plugins` loads all, which takes a while: some of them
/// depend on hundreds of others.
bool lacks_bundled_plugins();

} // namespace castor
