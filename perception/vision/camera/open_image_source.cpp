#include "castor/perception/vision/camera/open_image_source.hpp"

#include <algorithm>
#include <cctype>
#include <string_view>
#include <system_error>

#include "castor/base/input_file.hpp"
#include "castor/base/named_file.hpp"
#include "castor/base/sibling_library.hpp"
#include "castor/mapping/geometry/camera_model.hpp"
#include "castor/perception/vision/camera/image_source_kinds.hpp"
#include "castor/perception/vision/camera/image_source_probe.hpp"
#include "castor/perception/vision/camera/video_sources.hpp"

namespace castor::vision {

using namespace geometry;

namespace {

constexpr std::string_view scene_prefix = "scene:";
constexpr std::string_view device_prefix = "/dev/video";

/// As in the working directory or else in the base directory.
std::filesystem::path resolve(const std::string& name, const ImageSourceOptions& options) {
  const std::filesystem::path path(name);
  std::error_code ignored;
  if (name.empty())
    throw ImageSourceError(ImageFault::not_found, "image source", "no name is given",
                           "Name a picture, a folder, a video, a camera such as /dev/video0, or a "
                           "scene as in scene:FILE.");
  auto found = file_named(name, options.base_directory);
  if (std::filesystem::exists(found, ignored))
    return found;
  std::string places = std::filesystem::absolute(path, ignored).string();
  if (path.is_relative() && !options.base_directory.empty())
    places += " and " + (options.base_directory / path).string();
  const auto colon = name.find(':');
  if (colon != std::string::npos && colon > 1)
    throw ImageSourceError(ImageFault::unknown_kind, name,
                           "\"" + name.substr(0, colon) +
                             "\" is no kind of image source, and there is no such file",
                           "Name a picture, a folder, a video, a camera such as /dev/video0, or a "
                           "scene as in scene:FILE.");
  throw ImageSourceError(ImageFault::not_found, name, "there is no such file or folder",
                         "Check the name; it was looked for at " + places + ".");
}

/// By its first bytes, as a file may have any name.
bool looks_like_image(const std::filesystem::path& path) {
  try {
    const auto start = InputFile{path}.read(64);
    return probe_image(std::vector<std::uint8_t>{start.begin(), start.end()}).has_value();
  } catch (const InputFileError&) {
    return false;
  }
}

const VideoSources& video_sources() {
  static const auto& result = *reinterpret_cast<const VideoSources* (*)()>(
    function_of_sibling("video_sources", "castor_video_sources"))();
  return result;
}

} // namespace

Camera camera_for(const ImageSourceOptions& options, int width, int height) {
  if (!options.calibration)
    return nominal_camera(width, height);
  Camera camera = *options.calibration;
  const double scale_x = static_cast<double>(width) / camera.width;
  const double scale_y = static_cast<double>(height) / camera.height;
  if (camera.width > 0 && camera.height > 0 && (scale_x != 1 || scale_y != 1)) {
    camera.fx *= scale_x;
    camera.fy *= scale_y;
    // Scaling keeps the image's corner in place, which is half a pixel off the first pixel's
    // centre.
    camera.cx = (camera.cx + 0.5) * scale_x - 0.5;
    camera.cy = (camera.cy + 0.5) * scale_y - 0.5;
    camera.width = width;
    camera.height = height;
  }
  return camera;
}

std::unique_ptr<ImageSource> open_image_source(const std::string& spec,
                                               const ImageSourceOptions& given) {
  ImageSourceOptions options = given;
  if (!options.clock)
    options.clock = [start = std::chrono::steady_clock::now()] {
      return std::chrono::duration_cast<std::chrono::microseconds>(
        std::chrono::steady_clock::now() - start);
    };
  if (spec.starts_with(scene_prefix))
    return open_scene(resolve(spec.substr(scene_prefix.size()), options), options);
  if (spec.starts_with(device_prefix))
    return video_sources().open_device(spec, options);
  const auto path = resolve(spec, options);
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored))
    return open_folder(path, options);
  // Cameras have other names as well, such as /dev/v4l/by-id/...
  if (std::filesystem::is_character_file(path, ignored))
    return video_sources().open_device(path, options);
  if (!std::filesystem::is_regular_file(path, ignored))
    throw ImageSourceError(ImageFault::unknown_kind, spec, "this is neither a file nor a folder",
                           "Name a picture, a folder, a video, a camera or a scene.");
  if (path.extension() == ".scene")
    return open_scene(path, options);
  if (has_image_extension(path) || looks_like_image(path))
    return open_still(path, options);
  if (has_video_extension(path))
    return video_sources().open_video(path, options);
  throw ImageSourceError(ImageFault::unknown_kind, spec,
                         "this is neither a picture nor a video nor a scene",
                         "Give it the extension of what it is, such as .png, .jpg, .avi, .mp4 or "
                         ".scene.");
}

} // namespace castor::vision
