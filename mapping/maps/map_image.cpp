#include "castor/mapping/maps/map_image.hpp"

#include "castor/base/input_file.hpp"
#include "castor/mapping/maps/map_file_error.hpp"

#include <opencv2/imgcodecs.hpp>

#include <cstddef>

namespace castor::mapping {

MapImage read_map_image(const std::filesystem::path& path) {
  try {
    require_input_file(path);
  } catch (const InputFileError& e) {
    throw MapFileError(path.string(), 0, {}, e.what(),
                       "Put the image there, or correct its name; it is sought from the folder of "
                       "the .yaml.");
  }
  cv::Mat picture;
  try {
    picture = cv::imread(path.string(), cv::IMREAD_UNCHANGED);
  } catch (const cv::Exception&) {
    picture.release();
  }
  if (picture.empty())
    throw MapFileError(path.string(), 0, {}, "it is no image, or is damaged",
                       "Use a .pgm or .png that other programs can open.");
  cv::Mat pixels;
  auto scale = picture.depth() == CV_8U ? 1. : picture.depth() == CV_16U ? 1. / 257 : 255.;
  picture.convertTo(pixels, CV_64F, scale);
  auto channels = pixels.channels();
  // The last of two or four channels is transparency.
  auto has_alpha = channels % 2 == 0;
  auto colours = has_alpha ? channels - 1 : channels;
  MapImage result{pixels.cols, pixels.rows, {}, {}};
  for (int row = 0; row < pixels.rows; ++row) {
    auto* x = pixels.ptr<double>(row);
    for (int column = 0; column < pixels.cols; ++column, x += channels) {
      double sum = 0;
      for (int i = 0; i < colours; ++i)
        sum += x[i];
      result.grey.push_back(sum / colours);
      if (has_alpha)
        result.transparent.push_back(x[colours] < 255);
    }
  }
  return result;
}

} // namespace castor::mapping
