#include "castor/mapping/exports/map_picture.hpp"

#include "castor/base/picture_files.hpp"
#include "castor/mapping/planar/poses.hpp"

#include <fmt/format.h>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace castor::mapping {

namespace {

constexpr int unknown_grey = 205;
/// Around everything, metres.
constexpr double margin = 0.5;

/// A part of the floor in the frame of the map, whose rows are along x.
struct Extent {
  double left = std::numeric_limits<double>::infinity();
  double right = -std::numeric_limits<double>::infinity();
  double bottom = std::numeric_limits<double>::infinity();
  double top = -std::numeric_limits<double>::infinity();

  void include(double x, double y) {
    left = std::min(left, x);
    right = std::max(right, x);
    bottom = std::min(bottom, y);
    top = std::max(top, y);
  }
};

/// Places in the picture: the map's rows are horizontal, whatever the map's heading.
class Layout {
public:
  Layout(const CellMap& map, const std::vector<MapTrack>& tracks, int side)
    : origin_(map.origin), cell_size_(map.cell_size) {
    Extent extent;
    if (map.columns > 0 && map.rows > 0) {
      extent.include(0, 0);
      extent.include(map.columns * cell_size_, map.rows * cell_size_);
    }
    for (auto& track : tracks)
      for (auto& pose : track.poses) {
        auto x = between(origin_, pose);
        extent.include(x.x, x.y);
      }
    if (!(extent.left <= extent.right))
      throw std::invalid_argument("there is neither a cell nor a pose to draw");
    left_ = extent.left - margin;
    top_ = extent.top + margin;
    auto width = extent.right + margin - left_;
    auto height = top_ - extent.bottom + margin;
    auto cells = std::max(width, height) / cell_size_;
    pixels_ = cells > side ? 1 / std::ceil(cells / side) : std::floor(std::max(1., side / cells));
    size_ = {static_cast<int>(std::ceil(width / metres_per_pixel())),
             static_cast<int>(std::ceil(height / metres_per_pixel()))};
  }

  double metres_per_pixel() const { return cell_size_ / pixels_; }

  cv::Size size() const { return size_; }

  /// Of a point on the map, whose origin is (0, 0).
  cv::Point2d at(double x, double y) const {
    return {(x - left_) / metres_per_pixel(), (top_ - y) / metres_per_pixel()};
  }

  cv::Point2d at(const Pose2& pose) const {
    auto x = between(origin_, pose);
    return at(x.x, x.y);
  }

private:
  Pose2 origin_;
  double cell_size_;
  double left_ = 0;
  double top_ = 0;
  /// Of a side of a cell.
  double pixels_ = 1;
  cv::Size size_;
};

void draw_cells(cv::Mat& picture, const CellMap& map, const Layout& layout) {
  if (map.columns <= 0 || map.rows <= 0)
    return;
  cv::Mat cells(map.rows, map.columns, CV_8UC3);
  for (int row = 0; row < map.rows; ++row)
    for (int column = 0; column < map.columns; ++column) {
      auto cell = map.at(column, map.rows - 1 - row);
      auto grey = static_cast<std::uint8_t>(cell < 0 ? unknown_grey : 254 - 254 * cell / 100);
      cells.at<cv::Vec3b>(row, column) = {grey, grey, grey};
    }
  auto upper_left = layout.at(0, map.rows * map.cell_size);
  auto lower_right = layout.at(map.columns * map.cell_size, 0);
  cv::Rect place{cv::Point{static_cast<int>(std::lround(upper_left.x)),
                           static_cast<int>(std::lround(upper_left.y))},
                 cv::Size{static_cast<int>(std::lround(lower_right.x - upper_left.x)),
                          static_cast<int>(std::lround(lower_right.y - upper_left.y))}};
  place.width = std::max(place.width, 1);
  place.height = std::max(place.height, 1);
  cv::Mat scaled;
  // Area: thin walls stay visible when the map is reduced.
  cv::resize(cells, scaled, place.size(), 0, 0,
             place.width < map.columns ? cv::INTER_AREA : cv::INTER_NEAREST);
  place &= cv::Rect{{}, picture.size()};
  scaled(cv::Rect{{}, place.size()}).copyTo(picture(place));
}

void draw_track(cv::Mat& picture, const MapTrack& track, const Layout& layout) {
  if (track.poses.empty())
    return;
  // Bits for fractions of a pixel.
  constexpr int shift = 4;
  auto fixed = [&](const cv::Point2d& x) {
    return cv::Point{static_cast<int>(std::lround(x.x * (1 << shift))),
                     static_cast<int>(std::lround(x.y * (1 << shift)))};
  };
  cv::Scalar colour{static_cast<double>(track.blue), static_cast<double>(track.green),
                    static_cast<double>(track.red)};
  std::vector<cv::Point> line;
  for (auto& pose : track.poses)
    line.push_back(fixed(layout.at(pose)));
  cv::polylines(picture, line, false, colour, track.width, cv::LINE_AA, shift);
  if (!track.has_ends)
    return;
  cv::circle(picture, line.front(), 5 << shift, colour, cv::FILLED, cv::LINE_AA, shift);
  constexpr double arrow = 0.5;
  auto& last = track.poses.back();
  cv::arrowedLine(picture, layout.at(last), layout.at(compose(last, {arrow, 0, 0})), colour, 2,
                  cv::LINE_AA, 0, 0.4);
}

void draw_mark(cv::Mat& picture, const MapMark& mark, const Layout& layout) {
  const cv::Scalar colour{static_cast<double>(mark.blue), static_cast<double>(mark.green),
                          static_cast<double>(mark.red)};
  const auto place = layout.at(Pose2{mark.place.x, mark.place.y, 0});
  const cv::Point pixel{static_cast<int>(std::lround(place.x)),
                        static_cast<int>(std::lround(place.y))};
  if (mark.radius > 0)
    cv::circle(picture, pixel, mark.radius, colour, cv::FILLED, cv::LINE_AA);
  if (mark.text.empty())
    return;
  const auto corner = pixel + cv::Point{mark.radius + 3, 5};
  // Readable on dark cells, too.
  cv::putText(picture, mark.text, corner, cv::FONT_HERSHEY_SIMPLEX, 0.5, cv::Scalar::all(255), 4,
              cv::LINE_AA);
  cv::putText(picture, mark.text, corner, cv::FONT_HERSHEY_SIMPLEX, 0.5, colour, 1, cv::LINE_AA);
}

/// A bar of 1, 2 or 5 times a power of ten metres, at most a quarter of the picture.
void draw_scale(cv::Mat& picture, const Layout& layout) {
  auto most = picture.cols * layout.metres_per_pixel() / 4;
  auto length = std::pow(10, std::floor(std::log10(most)));
  for (auto factor : {5, 2})
    if (length * factor <= most) {
      length *= factor;
      break;
    }
  auto pixels = static_cast<int>(std::lround(length / layout.metres_per_pixel()));
  cv::Point left{10, picture.rows - 10};
  cv::line(picture, left, left + cv::Point{pixels, 0}, cv::Scalar::all(60), 2);
  cv::putText(picture, fmt::format("{:g} m", length), left - cv::Point{0, 6},
              cv::FONT_HERSHEY_SIMPLEX, 0.5, cv::Scalar::all(60), 1, cv::LINE_AA);
}

cv::Mat drawn(const CellMap& map, const std::vector<MapTrack>& tracks,
              const MapPictureOptions& options, const std::vector<MapMark>& marks) {
  Layout layout{map, tracks, options.side};
  cv::Mat picture(layout.size(), CV_8UC3, cv::Scalar::all(unknown_grey));
  draw_cells(picture, map, layout);
  for (auto& x : tracks)
    draw_track(picture, x, layout);
  for (auto& x : marks)
    draw_mark(picture, x, layout);
  draw_scale(picture, layout);
  return picture;
}

} // namespace

MapPixels map_pixels(const CellMap& map, const std::vector<MapTrack>& tracks,
                     const MapPictureOptions& options, const std::vector<MapMark>& marks) {
  const auto picture = drawn(map, tracks, options, marks);
  return {picture.cols, picture.rows, {picture.datastart, picture.dataend}};
}

std::string map_picture(const CellMap& map, const std::vector<MapTrack>& tracks,
                        const MapPictureOptions& options, const std::vector<MapMark>& marks) {
  const auto picture = drawn(map, tracks, options, marks);
  const auto bytes = encode_png(picture.cols, picture.rows, picture.channels(),
                                {picture.data, picture.total() * picture.elemSize()});
  return {bytes.begin(), bytes.end()};
}

} // namespace castor::mapping
