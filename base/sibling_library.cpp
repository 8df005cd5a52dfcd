#include "castor/base/sibling_library.hpp"

#include <dlfcn.h>

#include <stdexcept>
#include <string_view>

namespace castor {

namespace {

/// The file of the library of this function, ".../libcastor_base.so.0.1".
std::string own_file() {
  Dl_info info{};
  if (!dladdr(reinterpret_cast<const void*>(&function_of_sibling), &info) || !info.dli_fname)
    return {};
  return info.dli_fname;
}

} // namespace

void* function_of_sibling(const std::string& name, const std::string& function) {
  constexpr std::string_view own_name = "libcastor_base";
  auto file = own_file();
  if (const auto at = file.rfind(own_name); at != file.npos)
    file.replace(at, own_name.size(), "libcastor_" + name);
  auto* library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  auto* result = library ? dlsym(library, function.c_str()) : nullptr;
  if (!result)
    throw std::runtime_error("cannot load " + file +
                             ", which is installed with Castor: " + dlerror());
  return result;
}

} // namespace castor
