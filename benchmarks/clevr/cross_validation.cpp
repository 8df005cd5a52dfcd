#include "castor/benchmarks/clevr/cross_validation.hpp"

#include <map>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "castor/benchmarks/clevr/shape_samples.hpp"

namespace castor::clevr {

namespace {

/// What is estimated from the images of other groups.
struct Estimate {
  CameraGuess camera;
  vision::ShapeNetwork network;
};

} // namespace

CameraGuess usual_camera(std::span<const Scene* const> scenes) {
  std::vector<const Scene*> alike;
  cv::Size size;
  for (const auto* scene : scenes) {
    const cv::Mat image = cv::imread(scene->image.string());
    if (size.empty())
      size = image.size();
    // Pixel coordinates of images of another size do not fit together.
    if (image.size() == size)
      alike.push_back(scene);
  }
  if (alike.empty())
    return {};
  return fit_camera(alike, {}, 1.0, size.width, size.height);
}

std::vector<Outcome> evaluate_all(const std::vector<Scene>& scenes,
                                  const vision::RegionOptions& options) {
  std::vector<const Scene*> all;
  for (const auto& scene : scenes)
    all.push_back(&scene);
  const CameraGuess usual = usual_camera(all);
  const auto& network = vision::trained_shape_network();
  // The first call of some OpenCV functions builds tables; that is not the time of any image.
  evaluate(scenes.front(), usual, options, network);
  std::vector<Outcome> outcomes;
  for (const auto& scene : scenes)
    outcomes.push_back(evaluate(scene, usual, options, network));
  return outcomes;
}

std::vector<Outcome> cross_validate(const std::vector<Scene>& scenes,
                                    std::span<const std::size_t> groups,
                                    const vision::RegionOptions& options) {
  const auto seen = clevr_samples(scenes, clevr_weight);
  const auto rendered = rendered_samples(rendered_scenes, rendered_seed, scenes.size());
  const auto estimate_without = [&](std::size_t group) {
    std::vector<const Scene*> others;
    for (std::size_t i = 0; i < scenes.size(); ++i)
      if (groups[i] != group)
        others.push_back(&scenes[i]);
    std::vector<const Sample*> samples;
    for (const auto& sample : rendered)
      samples.push_back(&sample);
    for (const auto& sample : seen)
      if (groups[sample.scene] != group)
        samples.push_back(&sample);
    return Estimate{usual_camera(others), train(samples, {})};
  };
  std::map<std::size_t, Estimate> estimates;
  for (const std::size_t group : groups)
    if (!estimates.contains(group))
      estimates.emplace(group, estimate_without(group));
  std::vector<Outcome> outcomes;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const auto& [camera, network] = estimates.at(groups[i]);
    outcomes.push_back(evaluate(scenes[i], camera, options, network));
  }
  return outcomes;
}

} // namespace castor::clevr
