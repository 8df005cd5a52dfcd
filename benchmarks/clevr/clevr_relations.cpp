// Which of the objects in CLEVR images are left of, right of, in front of and behind which.
//
//     clevr_relations DIR
//
// DIR holds images and scene graphs in any of CLEVR's layouts. Objects are found as in
// clevr_benchmark. Where they are on the ground follows from their outline in the image and from
// one fixed camera for all images, the nominal one of CLEVR's Blender scene (CameraGuess's
// defaults): where the camera of an image really was, the corpus moves it by up to half a unit each
// time, is not used, nor is any direction, position or relation of the scene graph. Those are what
// the answers are compared with, for all ordered pairs of objects that were found, and to pair
// regions with objects. A relation holds as the corpus defines it: from 0.2 units along the
// direction on.

#include <cstdio>
#include <exception>
#include <filesystem>
#include <stdexcept>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "castor/benchmarks/clevr/evaluation.hpp"
#include "castor/benchmarks/clevr/relations.hpp"

namespace {

using namespace castor;
using namespace castor::clevr;

void print(const char* name, const Tally& tally) {
  std::printf(
    "%-34s %6.2f %%  %5zu of %zu\n", name,
    tally.all == 0 ? 0.0 : 100 * static_cast<double>(tally.hits) / static_cast<double>(tally.all),
    tally.hits, tally.all);
}

void run(const std::filesystem::path& folder) {
  cv::setNumThreads(1);
  const auto scenes = load_scenes(folder);
  if (scenes.empty())
    throw std::runtime_error("no scene with an image below " + folder.string());
  vision::RegionOptions options;
  options.shape.candidates = {"cube", "cylinder", "sphere"};
  std::vector<Outcome> outcomes;
  std::size_t objects = 0;
  for (const auto& scene : scenes) {
    outcomes.push_back(evaluate(scene, CameraGuess{}, options, vision::trained_shape_network()));
    objects += scene.objects.size();
  }
  // The size of the image does not change where the camera looks.
  const auto summary = judge_relations(outcomes, make_camera(CameraGuess{}, 320, 240, 1));
  for (const auto& mistake : summary.mistakes)
    std::printf("%s: object %zu is%s %s of object %zu; it was seen %.2f units to that side, the "
                "scene graph has %.2f along the nominal direction\n",
                mistake.scene->image.filename().c_str(), mistake.target,
                mistake.seen > relation_margin ? " not" : "", mistake.word.c_str(),
                mistake.landmark, mistake.seen, mistake.is);
  std::printf("\n%zu images, %zu objects, %zu of them found, %zu ordered pairs\n", scenes.size(),
              objects, summary.objects, summary.pairs);
  for (const auto& [word, tally] : summary.words)
    print(word.c_str(), tally);
  print("all four", summary.all);
  print("of relations that hold, said", summary.recall);
  print("of relations said, hold", summary.precision);
}

} // namespace

int main(int argc, char** argv) {
  try {
    if (argc != 2)
      throw std::invalid_argument("usage: clevr_relations DIR");
    run(argv[1]);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "clevr_relations: %s\n", error.what());
    return 1;
  }
}
