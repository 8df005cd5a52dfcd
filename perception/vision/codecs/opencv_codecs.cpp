#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include <stdexcept>

#include "castor/perception/vision/camera/image_codecs.hpp"
#include "castor/perception/vision/codecs/video_source.hpp"

namespace castor::vision {

namespace {

class OpenCvCodecs final : public ImageCodecs {
  Image decode(std::span<const std::uint8_t> bytes) const override {
    cv::Mat pixels;
    try {
      // OpenCV only reads it.
      pixels = cv::imdecode(cv::Mat(1, static_cast<int>(bytes.size()), CV_8UC1,
                                    const_cast<std::uint8_t*>(bytes.data())),
                            cv::IMREAD_COLOR);
    } catch (const cv::Exception&) {
      pixels.release();
    }
    Image image;
    image.channels = 3;
    if (pixels.empty() || pixels.type() != CV_8UC3)
      return image;
    image.width = static_cast<std::uint32_t>(pixels.cols);
    image.height = static_cast<std::uint32_t>(pixels.rows);
    image.bytes.reserve(pixels.total() * 3);
    for (int row = 0; row < pixels.rows; ++row)
      image.bytes.insert(image.bytes.end(), pixels.ptr(row), pixels.ptr(row) + 3 * pixels.cols);
    return image;
  }

  std::vector<std::uint8_t> encode_png(const Image& image) const override {
    const cv::Mat pixels(static_cast<int>(image.height), static_cast<int>(image.width),
                         image.channels == 1 ? CV_8UC1 : CV_8UC3,
                         const_cast<std::uint8_t*>(image.bytes.data()));
    std::vector<std::uint8_t> bytes;
    try {
      cv::imencode(".png", pixels, bytes);
    } catch (const cv::Exception& e) {
      throw std::runtime_error(e.err);
    }
    return bytes;
  }

  std::unique_ptr<ImageSource> open_video(const std::filesystem::path& path,
                                          const ImageSourceOptions& options) const override {
    return vision::open_video(path, options);
  }

  std::unique_ptr<ImageSource> open_device(const std::filesystem::path& path,
                                           const ImageSourceOptions& options) const override {
    return vision::open_device(path, options);
  }
};

} // namespace

extern "C" const ImageCodecs* castor_image_codecs() {
  static const OpenCvCodecs result;
  return &result;
}

} // namespace castor::vision
