#include "castor/base/sibling_library.hpp"

#include <dlfcn.h>

#include <filesystem>
#include <stdexcept>

namespace castor {

namespace {

/// Where the library of this function is.
std::filesystem::path own_folder() {
  Dl_info info{};
  if (!dladdr(reinterpret_cast<const void*>(&function_of_sibling), &info) || !info.dli_fname)
    return {};
  return std::filesystem::path(info.dli_fname).parent_path();
}

} // namespace

void* function_of_sibling(const std::string& name, const std::string& function) {
  const auto file = own_folder() / ("libcastor_" + name + CASTOR_LIBRARY_SUFFIX);
  auto* library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  auto* result = library ? dlsym(library, function.c_str()) : nullptr;
  if (!result)
    throw std::runtime_error(std::string{"cannot load "} + file.string() +
                             ", which is installed with " + "Castor: " + dlerror());
  return result;
}

} // namespace castor
