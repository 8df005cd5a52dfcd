// What vision finds on rendered tables of several kinds, and what it sees besides.
//
//   segmentation_benchmark [PICTURES] [SEED] [TEXTURES]
//
// PICTURES of each kind (40), drawn from SEED (1). TEXTURES is a folder of grey pictures with which
// tables are covered in one more kind, such as the brick, grass and gravel of Debian's
// python3-skimage. A thing is found if a region overlaps its visible part by at least half
// (intersection over union); any other region is false. After the kinds of tables, how often the
// colours of the things found are right that are said with a confidence of this tenth. The name of
// a paint other than the twelve usual ones is what most people call it.
#include "castor/benchmarks/clevr/matching.hpp"
#include "castor/mapping/geometry/camera_model.hpp"
#include "castor/perception/vision/opencv_bridge.hpp"
#include "castor/perception/vision/recognition/regions.hpp"
#include "castor/perception/vision/segmentation/size_limits.hpp"
#include "castor/perception/vision/tabletop/tabletop_renderer.hpp"

#include <fmt/core.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <numbers>
#include <random>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace castor::vision {

using namespace geometry;

namespace {

constexpr double least_overlap = 0.5;

constexpr std::array paints{
  SceneColour{180, 30, 30},  SceneColour{30, 60, 190},   SceneColour{30, 130, 40},
  SceneColour{220, 190, 30}, SceneColour{120, 40, 150},  SceneColour{230, 120, 20},
  SceneColour{40, 40, 40},   SceneColour{120, 120, 120}, SceneColour{235, 235, 235},
  SceneColour{110, 65, 30},  SceneColour{30, 150, 150},  SceneColour{240, 130, 170}};
/// Names of the paints.
constexpr std::array paint_names{"red",   "blue", "green", "yellow", "purple", "orange",
                                 "black", "grey", "white", "brown",  "cyan",   "pink"};
constexpr std::array grounds{SceneColour{190, 166, 134}, SceneColour{90, 100, 110},
                             SceneColour{200, 200, 200}, SceneColour{60, 110, 70},
                             SceneColour{235, 235, 230}, SceneColour{110, 80, 55}};
constexpr std::array woods{SceneColour{190, 166, 134}, SceneColour{150, 110, 75},
                           SceneColour{110, 80, 55}};
constexpr std::array browns{SceneColour{110, 65, 30},   SceneColour{140, 90, 50},
                            SceneColour{90, 60, 40},    SceneColour{170, 130, 90},
                            SceneColour{200, 170, 120}, SceneColour{120, 70, 50}};

/// Sum of the differences of the three channels.
int distance(const SceneColour& a, const SceneColour& b) {
  return std::abs(a.red - b.red) + std::abs(a.green - b.green) + std::abs(a.blue - b.blue);
}

std::string name_of(const SceneColour& paint) {
  for (std::size_t i = 0; i < paints.size(); ++i)
    if (distance(paints[i], paint) == 0)
      return paint_names[i];
  const auto shares = colour_shares({paint.blue / 255.0, paint.green / 255.0, paint.red / 255.0});
  const auto most = std::ranges::max_element(shares) - shares.begin();
  return colour_vocabulary()[static_cast<std::size_t>(most)];
}

/// Names that were said with about the same confidence.
struct ConfidenceBin {
  std::size_t all = 0;
  std::size_t right = 0;
};

/// By tenths of confidence.
using Reliability = std::array<ConfidenceBin, 10>;

struct RenderedTable {
  TabletopSnapshot scene;
  RenderOptions options;
};

/// Draws tables and things at random, the same ones for a seed. Lengths in metres.
class TableGenerator {
public:
  explicit TableGenerator(unsigned seed) : random_(seed) {}

  RenderedTable usual() { return with_things(6, 0.05, 0.1); }
  RenderedTable small() { return with_things(6, 0.01, 0.02); }

  RenderedTable with_low_lamp(double lamp_radius) {
    RenderedTable result = with_things(4, 0.05, 0.1, 0.06);
    result.scene.light.x = between(-1.2, 1.2);
    result.scene.light.y = between(-0.8, 0.6);
    result.scene.light.z = between(0.5, 1.2);
    result.options.lamp_radius = lamp_radius;
    return result;
  }

  RenderedTable touching() {
    RenderedTable result{any_table(), {}};
    auto first = thing(0.06, 0.08);
    first.x = between(-0.12, 0.12);
    first.y = between(-0.1, 0.12);
    first.colour = unlike(result.scene.table.colour, 120);
    auto second = first;
    second.turned_degrees = between(0, 360);
    if (const auto shape = any_shape(); is_flat(shape) == is_flat(first.shape))
      second.shape = shape;
    const double direction = between(0, 2 * std::numbers::pi);
    while (overlap(first, second)) {
      second.x += 0.0005 * std::cos(direction);
      second.y += 0.0005 * std::sin(direction);
    }
    result.scene.objects = {first, second};
    return result;
  }

  RenderedTable brown_on_wood() {
    RenderedTable result{any_table(), {}};
    result.scene.table.material = TableLook::Material::wood;
    result.scene.table.colour = one_of(woods);
    place_things(result.scene, 4, 0.05, 0.1);
    for (auto& x : result.scene.objects)
      do
        x.colour = one_of(browns);
      while (distance(x.colour, result.scene.table.colour) < 60);
    return result;
  }

  RenderedTable low_contrast() {
    RenderedTable result{any_table(), {}};
    place_things(result.scene, 4, 0.05, 0.1);
    const auto ground = result.scene.table.colour;
    const auto near = [this](int channel) {
      return static_cast<std::uint8_t>(
        std::clamp(channel + static_cast<int>(between(-40, 40)), 0, 255));
    };
    for (auto& x : result.scene.objects)
      do
        x.colour = {near(ground.red), near(ground.green), near(ground.blue)};
      while (distance(x.colour, ground) < 45);
    return result;
  }

  RenderedTable large() {
    RenderedTable result{any_table(), {}};
    TabletopObject sheet;
    sheet.shape = between(0, 1) < 0.5 ? TabletopShape::rectangle : TabletopShape::disc;
    sheet.size = {between(0.5, 0.62), between(0.4, 0.46), 0.005};
    if (sheet.shape == TabletopShape::disc)
      sheet.size.x = sheet.size.y = 0.46;
    sheet.x = between(-0.02, 0.02);
    sheet.y = between(-0.02, 0.02);
    sheet.colour = unlike(result.scene.table.colour, 120);
    result.scene.objects = {sheet};
    return result;
  }

private:
  double between(double low, double high) {
    return std::uniform_real_distribution<>{low, high}(random_);
  }

  template <class Range>
  typename Range::value_type one_of(const Range& range) {
    return range[std::uniform_int_distribution<std::size_t>{0, range.size() - 1}(random_)];
  }

  TabletopShape any_shape() {
    return static_cast<TabletopShape>(std::uniform_int_distribution<>{
      static_cast<int>(TabletopShape::cube), static_cast<int>(TabletopShape::disc)}(random_));
  }

  SceneColour unlike(const SceneColour& ground, int least) {
    for (;;)
      if (const auto result = one_of(paints); distance(result, ground) >= least)
        return result;
  }

  TabletopSnapshot any_table() {
    constexpr std::array materials{TableLook::Material::wood, TableLook::Material::cloth,
                                   TableLook::Material::plain, TableLook::Material::plain};
    TabletopSnapshot result;
    result.table.material = one_of(materials);
    result.table.colour = one_of(grounds);
    result.seed = random_();
    return result;
  }

  TabletopObject thing(double least, double most) {
    using Shape = TabletopShape;
    TabletopObject result;
    result.shape = any_shape();
    result.colour = one_of(paints);
    result.x = between(-0.25, 0.25);
    result.y = between(-0.17, 0.2);
    const double side = between(least, most);
    const bool is_long = result.shape == Shape::box || result.shape == Shape::rectangle;
    const bool is_as_high = result.shape == Shape::cube || result.shape == Shape::sphere;
    result.size.x = side;
    result.size.y = is_long ? side * between(0.5, 0.8) : side;
    result.size.z = is_flat(result.shape) ? 0.005 : is_as_high ? side : side * between(0.6, 1.5);
    result.turned_degrees = between(0, 360);
    return result;
  }

  /// As many as there is room for, if fewer.
  void place_things(TabletopSnapshot& scene, std::size_t number, double least, double most,
                    double gap = 0.02) {
    for (int tries = 0; tries < 1000 && scene.objects.size() < number; ++tries) {
      const auto next = thing(least, most);
      if (std::ranges::all_of(scene.objects, [&](auto& x) {
            return std::hypot(x.x - next.x, x.y - next.y) >= gap + 0.75 * (x.size.x + next.size.x);
          }))
        scene.objects.push_back(next);
    }
  }

  RenderedTable with_things(std::size_t number, double least, double most, double gap = 0.02) {
    RenderedTable result{any_table(), {}};
    place_things(result.scene, number, least, most, gap);
    for (auto& x : result.scene.objects)
      x.colour = unlike(result.scene.table.colour, 90);
    return result;
  }

  std::mt19937 random_;
};

/// Covers what of a picture shows no thing with a texture, weakly or strongly.
void cover(cv::Mat& picture, const cv::Mat& labels, const cv::Mat& texture, double strength) {
  cv::Mat tiled;
  cv::resize(texture, tiled, picture.size());
  const double mean = cv::mean(tiled)[0];
  for (int y = 0; y < picture.rows; ++y)
    for (int x = 0; x < picture.cols; ++x)
      if (labels.at<uchar>(y, x) == 0) {
        const double factor = 1 + strength * (tiled.at<uchar>(y, x) / mean - 1);
        for (int channel = 0; channel < 3; ++channel) {
          auto& value = picture.at<cv::Vec3b>(y, x)[channel];
          value = cv::saturate_cast<uchar>(value * factor);
        }
      }
}

struct TableKind {
  std::string name;
  std::function<RenderedTable(TableGenerator&)> draw;
  /// For its ground; none for what is rendered.
  std::vector<cv::Mat> textures{};
};

void measure(const TableKind& kind, int pictures, unsigned seed, Reliability& colours) {
  TableGenerator generator{seed};
  const Camera camera = look_at({0, -0.62, 0.55}, {0, 0.03, 0}, 42, 640, 480);
  std::size_t things = 0;
  std::size_t found = 0;
  std::size_t regions = 0;
  std::size_t right = 0;
  std::chrono::duration<double, std::milli> time{0};
  for (int i = 0; i < pictures; ++i) {
    const auto table = kind.draw(generator);
    Image image = render(table.scene, camera, table.options);
    const Image labels = render_labels(table.scene, camera);
    if (!kind.textures.empty()) {
      cv::Mat picture = as_mat(image);
      const auto number = static_cast<std::size_t>(i);
      const double strength = number / kind.textures.size() % 2 == 0 ? 0.7 : 0.35;
      cover(picture, as_mat(labels), kind.textures[number % kind.textures.size()], strength);
    }
    const auto begin = std::chrono::steady_clock::now();
    const auto segments = segment_table(image, &camera);
    time += std::chrono::steady_clock::now() - begin;
    std::vector<ROI> rois;
    for (auto& segment : segments)
      rois.push_back(make_roi(image, segment));
    std::vector<const ROI*> seen;
    for (auto& roi : rois)
      seen.push_back(&roi);
    cv::Mat_<int> truth;
    as_mat(labels).convertTo(truth, CV_32S);
    truth -= 1;
    const auto number = table.scene.objects.size();
    const auto matches = clevr::match_regions(seen, truth, number, least_overlap);
    for (auto& match : matches) {
      const auto& roi = rois[match.region];
      const auto said = best_of(name_colour(roi.region, roi.mask));
      auto& bin = colours[std::min(static_cast<std::size_t>(10 * said.confidence), std::size_t{9})];
      ++bin.all;
      bin.right += said.value == name_of(table.scene.objects[match.object].colour) ? 1 : 0;
    }
    things += number;
    found += matches.size();
    regions += segments.size();
    right += matches.size() == number && segments.size() == number ? 1 : 0;
  }
  fmt::print("{:<44} {:>4} of {:<4} {:>5} {:>6} of {:<4} {:>6.1f}\n", kind.name, found, things,
             regions - found, right, pictures, time.count() / std::max(pictures, 1));
}

std::vector<cv::Mat> grey_pictures_in(const std::string& folder) {
  std::vector<std::filesystem::path> files;
  std::error_code no_folder;
  for (auto& x : std::filesystem::directory_iterator{folder, no_folder})
    files.push_back(x.path());
  std::ranges::sort(files);
  std::vector<cv::Mat> result;
  for (auto& file : files)
    if (cv::Mat picture = cv::imread(file.string(), cv::IMREAD_GRAYSCALE); !picture.empty())
      result.push_back(picture);
  return result;
}

} // namespace

} // namespace castor::vision

int main(int argc, char** argv) {
  using namespace castor::vision;
  const int pictures = argc > 1 ? std::atoi(argv[1]) : 40;
  const auto seed = static_cast<unsigned>(argc > 2 ? std::atoi(argv[2]) : 1);
  if (pictures < 1 || argc > 4) {
    fmt::print(stderr, "usage: segmentation_benchmark [PICTURES] [SEED] [TEXTURES]\n");
    return 2;
  }
  std::vector<TableKind> kinds{
    {"things of 5 to 10 cm", &TableGenerator::usual},
    {"things of 1 to 2 cm", &TableGenerator::small},
    {"low lamp, hard shadows", [](auto& x) { return x.with_low_lamp(0.01); }},
    {"low lamp, soft shadows", [](auto& x) { return x.with_low_lamp(0.2); }},
    {"two things of one colour that touch", &TableGenerator::touching},
    {"brown things on brown wood", &TableGenerator::brown_on_wood},
    {"things hardly different from the table", &TableGenerator::low_contrast},
    {"one thing that fills much of the picture", &TableGenerator::large},
  };
  if (argc > 3) {
    auto textures = grey_pictures_in(argv[3]);
    if (textures.empty()) {
      fmt::print(stderr, "segmentation_benchmark: there are no pictures in {}\n", argv[3]);
      return 2;
    }
    kinds.push_back({"textures for a table", &TableGenerator::usual, std::move(textures)});
  }
  fmt::print("{:<44} {:>12} {:>5} {:>14} {:>6}\n", "tables", "found", "false", "pictures right",
             "ms");
  Reliability colours;
  for (auto& kind : kinds)
    measure(kind, pictures, seed, colours);
  fmt::print("\n{:<44} {:>12}\n", "confidence of colours", "right");
  for (std::size_t tenth = 0; tenth < colours.size(); ++tenth)
    if (colours[tenth].all > 0)
      fmt::print("0.{:<42} {:>4} of {:<4}\n", tenth, colours[tenth].right, colours[tenth].all);
}
