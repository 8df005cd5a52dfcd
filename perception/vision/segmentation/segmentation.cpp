#include "castor/perception/vision/segmentation/segmentation.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <tuple>
#include <utility>

#include <opencv2/imgproc.hpp>

#include "castor/perception/vision/opencv_bridge.hpp"
#include "castor/perception/vision/segmentation/area_graph.hpp"
#include "castor/perception/vision/segmentation/ground_colour.hpp"
#include "castor/perception/vision/segmentation/grouping.hpp"
#include "castor/perception/vision/segmentation/neck.hpp"
#include "castor/perception/vision/segmentation/surface.hpp"
#include "castor/perception/vision/segmentation/watershed.hpp"
#include "castor/perception/vision/segmentation/working_picture.hpp"

namespace castor::vision {

namespace {

/// Contrasts are flooded in steps of this share of the flat contrast.
constexpr float flood_step = 0.5F;

Grid<std::uint8_t> shrink(Grid<std::uint8_t>& mask, int width, int height) {
  const cv::Mat source(mask.height(), mask.width(), CV_8U, mask.data());
  Grid<std::uint8_t> result(width, height);
  cv::Mat target(height, width, CV_8U, result.data());
  cv::resize(source, target, target.size(), 0, 0, cv::INTER_NEAREST);
  return result;
}

/// What the ground looks like at every pixel: what is seen of it, continued below the rest.
void learn_ground(AreaGraph& graph, const WorkingPicture& picture) {
  Grid<std::uint8_t> known(picture.colour.width(), picture.colour.height());
  for (const int cell : graph.area(graph.ground()).cells)
    known[cell] = 1;
  Grid<Colour> ground = interpolate(picture.colour, known);
  Grid<Colour> lab(ground.width(), ground.height());
  cv::Mat lab_mat = as_mat(lab);
  cv::cvtColor(as_mat(ground), lab_mat, cv::COLOR_BGR2Lab);
  graph.set_ground_colours(ground, lab, picture.lab);
}

/// What is known of the ground.
enum class Ground { unknown, seen, learned };

/// Fragments of things, of their shadows and of what they mirror are small as well, but they are
/// beside those things, or thin.
bool is_fragment(const AreaGraph& graph, int id, const SegmentationOptions& options) {
  const Area& area = graph.area(id);
  const Contact* outline = graph.contact(id, graph.ground());
  return area.pixels() < options.piece_area * graph.labels().size() &&
         (outline == nullptr || outline->length < options.alone * area.boundary() ||
          compactness(area, graph.labels().width()) < options.piece_compactness);
}

bool is_object(const AreaGraph& graph, int id, Ground ground, const SegmentationOptions& options) {
  const Area& area = graph.area(id);
  const double share = area.pixels() / graph.labels().size();
  const double largest =
    area.border == 0 ? options.max_area : std::min(options.max_area, options.max_cut_area);
  if (area.pixels() < options.min_pixels || share < options.min_area ||
      (ground != Ground::learned && share > largest))
    return false;
  if (ground != Ground::unknown && is_fragment(graph, id, options))
    return false;
  // Pixels on the border of the image, against all pixel pairs along the outline.
  if (area.border > options.max_border * (area.boundary() + area.border))
    return false;
  return ground != Ground::seen || ground_difference(area) >= options.ground_difference;
}

/// The mask of the area with these cells in image pixels, cut to its box, and the outline.
std::optional<Segment> make_segment(const std::vector<int>& cells, const WorkingPicture& picture,
                                    const Image& image) {
  const int width = picture.colour.width();
  std::vector<cv::Point> points;
  points.reserve(cells.size());
  for (const int cell : cells)
    points.emplace_back(cell % width, cell / width);
  cv::Rect box = cv::boundingRect(points);
  cv::Mat_<std::uint8_t> mask(box.size(), std::uint8_t{0});
  for (const auto& point : points)
    mask(point - box.tl()) = 255;
  if (picture.scale < 1) {
    const auto scaled = [&](int value) {
      return static_cast<int>(std::lround(value / picture.scale));
    };
    const cv::Point corner(scaled(box.x), scaled(box.y));
    const cv::Point end(std::min(scaled(box.br().x), static_cast<int>(image.width)),
                        std::min(scaled(box.br().y), static_cast<int>(image.height)));
    box = cv::Rect(corner, end);
    cv::Mat enlarged;
    cv::resize(mask, enlarged, box.size(), 0, 0, cv::INTER_LINEAR);
    cv::threshold(enlarged, mask, 127, 255, cv::THRESH_BINARY);
  }
  std::vector<std::vector<cv::Point>> contours;
  cv::findContours(mask, contours, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE, box.tl());
  if (contours.empty())
    return std::nullopt;
  const auto longest =
    std::max_element(contours.begin(), contours.end(),
                     [](const auto& a, const auto& b) { return a.size() < b.size(); });
  Segment segment;
  segment.box = {{box.x + (box.width - 1) / 2.0, box.y + (box.height - 1) / 2.0},
                 static_cast<double>(box.width),
                 static_cast<double>(box.height)};
  segment.mask = to_image(mask);
  for (const auto& point : *longest)
    segment.contour.push_back({static_cast<double>(point.x), static_cast<double>(point.y)});
  return segment;
}

std::vector<Segment> objects_of(const AreaGraph& graph, const WorkingPicture& picture,
                                const Image& image, Ground ground,
                                const SegmentationOptions& options) {
  std::vector<Segment> segments;
  for (int id = 0; id < graph.count(); ++id) {
    if (!graph.is_part(id) || !is_object(graph, id, ground, options))
      continue;
    for (const auto& cells :
         divide_at_necks(graph.area(id).cells, graph.labels().width(), options.neck)) {
      if (auto found = make_segment(cells, picture, image))
        segments.push_back(std::move(*found));
    }
  }
  std::sort(segments.begin(), segments.end(), [](const Segment& a, const Segment& b) {
    return std::tie(a.box.center.y, a.box.center.x) < std::tie(b.box.center.y, b.box.center.x);
  });
  return segments;
}

AreaGraph divide(const WorkingPicture& picture, double edge_factor,
                 const SegmentationOptions& options) {
  const float flat = picture.flat_contrast;
  AreaGraph graph(watershed(picture.contrast, flat, flood_step * flat), picture);
  join_weak(graph, edge_factor * static_cast<double>(flat), edge_factor * options.flat_contrast,
            options);
  return graph;
}

/// Whether the area that would be ground is one surface.
bool has_coherent_ground(const AreaGraph& graph, const WorkingPicture& picture,
                         const SegmentationOptions& options) {
  const Area& ground = graph.area(widest_on_border(graph));
  return colour_spread(ground, picture.lab) <= options.ground_spread;
}

std::vector<Segment> segment_close_up(const Image& image, SegmentationOptions options) {
  const CloseUpOptions& close_up = options.close_up;
  options.working_side = std::min(options.working_side, close_up.working_side);
  options.smoothing = close_up.smoothing;
  options.noise_factor = close_up.noise_factor;
  options.min_area = std::max(options.min_area, close_up.min_area);
  options.max_area = std::min(options.max_area, close_up.max_area);
  options.max_cut_area = close_up.max_cut_area;
  options.max_border = std::max(options.max_border, close_up.max_border);
  const WorkingPicture picture = make_working_picture(image, options);
  AreaGraph graph = divide(picture, close_up.edge_factor, options);
  const int widest = widest_on_border(graph);
  const double border = 2.0 * (graph.labels().width() + graph.labels().height());
  if (graph.area(widest).border <= close_up.ground_border * border) {
    group_without_ground(graph, options);
    return objects_of(graph, picture, image, Ground::unknown, options);
  }
  graph.set_ground(widest);
  learn_ground(graph, picture);
  group(graph, options);
  return objects_of(graph, picture, image, Ground::seen, options);
}

} // namespace

void prepare_segmentation() {
  const cv::Mat pixel(1, 1, CV_32FC3, cv::Scalar::all(0.5));
  cv::Mat lab;
  cv::cvtColor(pixel, lab, cv::COLOR_BGR2Lab);
  // Code and memory that are used for the first time take as long again as a picture.
  constexpr int width = 640;
  constexpr int height = 480;
  cv::Mat bytes(height, width, CV_8UC3, cv::Scalar::all(190));
  cv::rectangle(bytes, {width / 2, height / 2, 60, 60}, {190, 60, 30}, cv::FILLED);
  segment({width, height, 3, {bytes.datastart, bytes.dataend}});
}

std::vector<Segment> segment(const Image& image, const SegmentationOptions& options,
                             const BackgroundModel* background) {
  const WorkingPicture picture = make_working_picture(image, options);
  AreaGraph graph = divide(picture, options.edge_factor, options);
  if (background != nullptr) {
    Grid<std::uint8_t> foreground = background->foreground(image);
    join_ground(graph, shrink(foreground, picture.colour.width(), picture.colour.height()));
  } else if (!has_coherent_ground(graph, picture, options)) {
    return segment_close_up(image, options);
  }
  if (graph.ground() < 0)
    join_ground(graph, options);
  learn_ground(graph, picture);
  group(graph, options);
  return objects_of(graph, picture, image, background != nullptr ? Ground::learned : Ground::seen,
                    options);
}

} // namespace castor::vision
