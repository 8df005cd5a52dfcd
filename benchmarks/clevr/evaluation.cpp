#include "castor/benchmarks/clevr/evaluation.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>

#include <opencv2/imgcodecs.hpp>

#include "castor/benchmarks/clevr/clevr_truth.hpp"
#include "castor/perception/vision/opencv_bridge.hpp"

namespace castor::clevr {

namespace {

constexpr double loose_overlap = 0.3;

bool contains(const vision::ImageBox& box, const vision::Point2& pixel) {
  return std::abs(pixel.x - box.center.x) <= box.width / 2 &&
         std::abs(pixel.y - box.center.y) <= box.height / 2;
}

/// The largest number of pairs of an object and a region whose box contains its centre: augmenting
/// paths in the bipartite graph.
std::size_t count_box_hits(const Scene& scene, const std::vector<vision::Region>& regions) {
  constexpr auto free = std::numeric_limits<std::size_t>::max();
  std::vector<std::size_t> owner(regions.size(), free);
  std::size_t hits = 0;
  for (std::size_t start = 0; start < scene.objects.size(); ++start) {
    std::vector<bool> tried(regions.size(), false);
    const std::function<bool(std::size_t)> assign = [&](std::size_t object) {
      for (std::size_t region = 0; region < regions.size(); ++region) {
        if (tried[region] || !contains(regions[region].roi.box, scene.objects[object].pixel))
          continue;
        tried[region] = true;
        if (owner[region] == free || assign(owner[region])) {
          owner[region] = object;
          return true;
        }
      }
      return false;
    };
    hits += assign(start) ? 1 : 0;
  }
  return hits;
}

std::size_t solid_index(const std::string& shape) {
  const std::array<std::string, 3> solids{"cube", "cylinder", "sphere"};
  return static_cast<std::size_t>(std::find(solids.begin(), solids.end(), shape) - solids.begin());
}

void add_word(const std::string& kind, const vision::Hypothesis& said, const std::string& is,
              Tally& tally, Summary& summary) {
  const bool right = said.value == is;
  tally.add(right);
  auto& bins = summary.reliability[kind];
  const auto place = static_cast<std::size_t>(10 * said.confidence);
  auto& bin = bins[std::min(place, bins.size() - 1)];
  bin.confidence += said.confidence;
  bin.right.add(right);
}

} // namespace

Outcome evaluate(const Scene& scene, const CameraGuess& usual, const vision::RegionOptions& options,
                 const vision::ShapeNetwork& network) {
  const cv::Mat pixels = cv::imread(scene.image.string());
  if (pixels.empty())
    throw std::runtime_error("cannot read " + scene.image.string());
  const vision::Image image = vision::to_image(pixels);
  const auto camera = make_camera(usual, pixels.cols, pixels.rows, metres_per_unit);
  Outcome outcome;
  outcome.scene = &scene;
  const auto begin = std::chrono::steady_clock::now();
  outcome.regions = vision::find_regions(image, &camera, options, nullptr, network);
  const std::chrono::duration<double, std::milli> taken = std::chrono::steady_clock::now() - begin;
  outcome.milliseconds = taken.count();
  const Scene* only = &scene;
  // Within half a unit: that is how far CLEVR moves its camera.
  const auto own = fit_camera({&only, 1}, usual, 0.3, pixels.cols, pixels.rows);
  const auto labels =
    visible_objects(scene, make_camera(own, pixels.cols, pixels.rows, 1), pixels.size());
  std::vector<const vision::ROI*> regions;
  for (const auto& region : outcome.regions)
    regions.push_back(&region.roi);
  outcome.matches = match_regions(regions, labels, scene.objects.size(), found_overlap);
  outcome.loose_matches =
    match_regions(regions, labels, scene.objects.size(), loose_overlap).size();
  outcome.box_hits = count_box_hits(scene, outcome.regions);
  return outcome;
}

Summary summarize(const std::vector<Outcome>& outcomes) {
  Summary summary;
  const auto add = [](Tally& tally, std::size_t hits, std::size_t all) {
    tally.hits += hits;
    tally.all += all;
  };
  for (const auto& outcome : outcomes) {
    const auto& objects = outcome.scene->objects;
    add(summary.recall, outcome.matches.size(), objects.size());
    add(summary.precision, outcome.matches.size(), outcome.regions.size());
    add(summary.loose_recall, outcome.loose_matches, objects.size());
    add(summary.box_recall, outcome.box_hits, objects.size());
    summary.milliseconds.push_back(outcome.milliseconds);
    for (const auto& match : outcome.matches) {
      const Object& object = objects[match.object];
      const vision::Region& region = outcome.regions[match.region];
      summary.overlap_sum += match.overlap;
      add_word("colour", region.colour, object.colour, summary.colour, summary);
      add_word("shape", region.shape, object.shape, summary.shape, summary);
      add_word("size", region.size, object.size, summary.size, summary);
      summary.shape_by_material[object.material].add(region.shape.value == object.shape);
      const std::size_t truth = solid_index(object.shape);
      if (truth < summary.shapes.size())
        ++summary.shapes[truth][solid_index(region.shape.value)];
    }
  }
  std::sort(summary.milliseconds.begin(), summary.milliseconds.end());
  return summary;
}

} // namespace castor::clevr
