#include "castor/perception/vision/camera/image_codecs.hpp"

#include <dlfcn.h>

#include <string>

namespace castor::vision {

namespace {

/// Where the library of this function is.
std::filesystem::path own_folder() {
  Dl_info info{};
  if (!dladdr(reinterpret_cast<const void*>(&image_codecs), &info) || !info.dli_fname)
    return {};
  return std::filesystem::path(info.dli_fname).parent_path();
}

const ImageCodecs& load() {
  const auto file = own_folder() / CASTOR_IMAGE_CODECS;
  // Never closed: sources may live until the end.
  auto* library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  auto* function = library ? dlsym(library, image_codecs_function) : nullptr;
  if (!function)
    throw ImageSourceError(
      ImageFault::unreadable, file.string(),
      std::string{"files of pictures and videos cannot be read and written: "} + dlerror(),
      "It is installed with Castor's library for vision.");
  return *reinterpret_cast<const ImageCodecs* (*)()>(function)();
}

} // namespace

const ImageCodecs& image_codecs() {
  static const ImageCodecs& result = load();
  return result;
}

} // namespace castor::vision
