#include "castor/perception/vision/camera/image_source_file.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "castor/base/input_file.hpp"
#include "castor/base/picture_files.hpp"
#include "castor/perception/vision/camera/image_source_probe.hpp"

namespace castor::vision {

namespace {

constexpr std::array<std::string_view, 12> image_extensions{".png", ".jpg",  ".jpeg", ".jpe",
                                                            ".bmp", ".ppm",  ".pgm",  ".pbm",
                                                            ".pnm", ".webp", ".tif",  ".tiff"};
constexpr std::array<std::string_view, 11> video_extensions{
  ".avi", ".mp4", ".m4v", ".mkv", ".mov", ".webm", ".mpg", ".mpeg", ".ogv", ".wmv", ".mjpg"};

std::string lower_extension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

std::vector<std::uint8_t> read_bytes(const std::filesystem::path& path, const ImageLimits& limits) {
  try {
    const InputFile file{path};
    if (file.size() > limits.max_bytes)
      throw ImageSourceError(ImageFault::too_large, path.string(),
                             "the file has " + std::to_string(file.size()) +
                               " bytes, more than the limit of " + std::to_string(limits.max_bytes),
                             "Use a smaller picture or raise the limit.");
    const auto bytes = file.read(file.size());
    return {bytes.begin(), bytes.end()};
  } catch (const InputFileError& e) {
    switch (e.reason()) {
      case InputFileError::Reason::missing:
        throw ImageSourceError(ImageFault::not_found, path.string(), e.what(),
                               "Check the name and the folder.");
      case InputFileError::Reason::folder:
      case InputFileError::Reason::special:
        throw ImageSourceError(ImageFault::not_an_image, path.string(),
                               std::string{"this is not a file: "} + e.what(),
                               "Name a picture file.");
      case InputFileError::Reason::too_long:
      case InputFileError::Reason::unreadable:
        break;
    }
    throw ImageSourceError(ImageFault::unreadable, path.string(),
                           std::string{"the file cannot be read ("} + e.what() + ")",
                           "Check that you may read it, and the disk that it is on.");
  }
}

void check_header(const std::filesystem::path& path, const std::vector<std::uint8_t>& bytes,
                  const ImageLimits& limits) {
  if (bytes.empty())
    throw ImageSourceError(ImageFault::truncated, path.string(), "the file is empty",
                           "Copy or save the picture again.");
  const auto probe = probe_image(bytes);
  if (!probe)
    throw ImageSourceError(ImageFault::not_an_image, path.string(),
                           "this is no picture in a format that is known here",
                           "Convert it to PNG or JPEG; BMP, PNM, WebP and TIFF are known as well.");
  if (probe->complete && (probe->width == 0 || probe->height == 0))
    throw ImageSourceError(ImageFault::not_an_image, path.string(),
                           "the picture has a width or height of zero", "Save it again.");
  if (probe->height > 0 && probe->width > limits.max_pixels / probe->height)
    throw ImageSourceError(ImageFault::too_large, path.string(),
                           "the picture has " + std::to_string(probe->width) + " x " +
                             std::to_string(probe->height) + " pixels, more than the limit of " +
                             std::to_string(limits.max_pixels),
                           "Scale it down or raise the limit.");
  if (!probe->complete)
    throw ImageSourceError(ImageFault::truncated, path.string(),
                           "the picture is damaged or ends early", "Copy or save it again.");
}

} // namespace

Image read_image(const std::filesystem::path& path, const ImageLimits& limits) {
  const auto bytes = read_bytes(path, limits);
  check_header(path, bytes, limits);
  auto pixels = decode_picture(bytes);
  if (pixels.values.empty())
    throw ImageSourceError(ImageFault::truncated, path.string(),
                           "the picture is damaged and cannot be decoded",
                           "Open it in a picture viewer and save it again, as PNG or JPEG.");
  Image image;
  image.width = static_cast<std::uint32_t>(pixels.width);
  image.height = static_cast<std::uint32_t>(pixels.height);
  image.channels = 3;
  image.bytes = std::move(pixels.values);
  return image;
}

void write_png(const std::filesystem::path& path, const Image& image) {
  if (image.width == 0 || image.height == 0 || (image.channels != 1 && image.channels != 3) ||
      image.bytes.size() != std::size_t{image.width} * image.height * image.channels)
    throw std::invalid_argument(
      "write_png: the picture must have 1 or 3 channels and as many bytes "
      "as its width, height and channels say");
  std::vector<std::uint8_t> bytes;
  try {
    bytes = encode_png(static_cast<int>(image.width), static_cast<int>(image.height),
                       static_cast<int>(image.channels), image.bytes);
  } catch (const std::runtime_error& e) {
    throw ImageSourceError(ImageFault::unwritable, path.string(),
                           std::string{"the picture cannot be encoded ("} + e.what() + ")",
                           "PNG allows for sides of up to 1000000 pixels.");
  }
  // Written beside and then renamed: nobody ever reads half a picture.
  auto beside = path;
  beside += ".part";
  errno = 0;
  std::ofstream file(beside, std::ios::binary);
  file.write(reinterpret_cast<const char*>(bytes.data()),
             static_cast<std::streamsize>(bytes.size()));
  file.close();
  std::error_code error;
  if (file)
    std::filesystem::rename(beside, path, error);
  if (!file || error) {
    const std::string reason = error ? error.message() : std::strerror(errno);
    std::filesystem::remove(beside, error);
    throw ImageSourceError(
      ImageFault::unwritable, path.string(), "the picture cannot be written (" + reason + ")",
      "Check that its folder exists, that you may write there and that the disk "
      "is not full.");
  }
}

bool has_image_extension(const std::filesystem::path& path) {
  const auto extension = lower_extension(path);
  return std::find(image_extensions.begin(), image_extensions.end(), extension) !=
         image_extensions.end();
}

bool has_video_extension(const std::filesystem::path& path) {
  const auto extension = lower_extension(path);
  return std::find(video_extensions.begin(), video_extensions.end(), extension) !=
         video_extensions.end();
}

} // namespace castor::vision
