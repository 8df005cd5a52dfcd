// What the vision core makes of CLEVR images.
//
//     clevr_benchmark DIR... [--output DIR] [--leave-one-out | --leave-one-source-out]
//     clevr_benchmark DIR... --calibrations DIR
//
// DIR holds images and scene graphs in any of CLEVR's layouts. An object is found if a region
// covers the part of it that is visible with an overlap (intersection by union) of at least 0.5,
// one to one; what is visible is computed from the scene graph. Colour, shape and size are counted
// over the objects found. With --leave-one-out, the shape classifier and the camera for each image
// are estimated anew without that image; with --leave-one-source-out, for the images of each DIR
// without all of that DIR. --calibrations only writes the camera without that image, as a file for
// the component Camera: below that DIR as the image is below its own, NAME.camera for NAME.png.

#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "castor/benchmarks/clevr/cross_validation.hpp"
#include "castor/benchmarks/clevr/evaluation.hpp"

namespace {

using namespace castor;
using namespace castor::clevr;

enum class Without { nothing, image, source };

struct Arguments {
  std::vector<std::filesystem::path> folders;
  std::optional<std::filesystem::path> output;
  std::optional<std::filesystem::path> calibrations;
  Without without = Without::nothing;
};

Arguments parse(int argc, char** argv) {
  Arguments arguments;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "--leave-one-out")
      arguments.without = Without::image;
    else if (argument == "--leave-one-source-out")
      arguments.without = Without::source;
    else if (argument == "--output" && i + 1 < argc)
      arguments.output = argv[++i];
    else if (argument == "--calibrations" && i + 1 < argc)
      arguments.calibrations = argv[++i];
    else if (!argument.starts_with("--"))
      arguments.folders.push_back(argument);
    else
      throw std::invalid_argument("cannot use the argument " + argument);
  }
  if (arguments.folders.empty())
    throw std::invalid_argument("usage: clevr_benchmark DIR... [--output DIR] [--leave-one-out | "
                                "--leave-one-source-out] | --calibrations DIR");
  return arguments;
}

/// For each image, the camera that explains the others best.
///
/// \param names path of each image below the folder that it was found in
void write_calibrations(const std::vector<Scene>& scenes,
                        const std::vector<std::filesystem::path>& names,
                        const std::filesystem::path& folder) {
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const auto& scene = scenes[i];
    const cv::Size size = cv::imread(scene.image.string()).size();
    const auto path = (folder / names[i]).replace_extension(".camera");
    std::filesystem::create_directories(path.parent_path());
    std::ofstream file{path};
    std::vector<const Scene*> others;
    for (const auto& other : scenes)
      if (&other != &scene)
        others.push_back(&other);
    file << camera_file(usual_camera(others), size.width, size.height, metres_per_unit);
    if (!file.flush())
      throw std::runtime_error("cannot write " + path.string());
  }
}

void annotate(const Outcome& outcome, const std::filesystem::path& folder) {
  constexpr int zoom = 3;
  cv::Mat picture = cv::imread(outcome.scene->image.string());
  cv::resize(picture, picture, cv::Size(), zoom, zoom, cv::INTER_CUBIC);
  for (std::size_t i = 0; i < outcome.regions.size(); ++i) {
    const auto& region = outcome.regions[i];
    bool right = false;
    for (const auto& match : outcome.matches) {
      const Object& object = outcome.scene->objects[match.object];
      if (match.region == i)
        right = object.colour == region.colour.value && object.shape == region.shape.value &&
                object.size == region.size.value;
    }
    std::vector<cv::Point> outline;
    for (const auto& point : region.roi.contour)
      outline.emplace_back(cvRound(zoom * point.x + 1), cvRound(zoom * point.y + 1));
    const cv::Scalar colour = right ? cv::Scalar(80, 255, 80) : cv::Scalar(60, 60, 255);
    cv::polylines(picture, outline, true, colour);
    const std::string text =
      region.size.value + " " + region.colour.value + " " + region.shape.value;
    const cv::Point place(cvRound(zoom * (region.roi.box.center.x - region.roi.box.width / 2)),
                          cvRound(zoom * (region.roi.box.center.y + region.roi.box.height / 2)) +
                            12);
    cv::putText(picture, text, place, cv::FONT_HERSHEY_SIMPLEX, 0.4, colour, 1, cv::LINE_AA);
  }
  cv::imwrite((folder / (outcome.scene->image.stem().string() + ".png")).string(), picture);
}

void print(const char* name, const Tally& tally) {
  std::printf(
    "%-34s %5.1f %%  %4zu of %zu\n", name,
    tally.all == 0 ? 0.0 : 100 * static_cast<double>(tally.hits) / static_cast<double>(tally.all),
    tally.hits, tally.all);
}

void print_mistakes(const Outcome& outcome) {
  const std::string image = outcome.scene->image.filename().string();
  std::vector<bool> found(outcome.scene->objects.size(), false);
  std::vector<bool> used(outcome.regions.size(), false);
  for (const auto& match : outcome.matches) {
    const Object& object = outcome.scene->objects[match.object];
    const auto& region = outcome.regions[match.region];
    found[match.object] = used[match.region] = true;
    const std::string is = object.size + " " + object.colour + " " + object.shape;
    const std::string said =
      region.size.value + " " + region.colour.value + " " + region.shape.value;
    if (is != said)
      std::printf("%s: %s %s is called %s (%.2f %.2f %.2f)\n", image.c_str(),
                  object.material.c_str(), is.c_str(), said.c_str(), region.size.confidence,
                  region.colour.confidence, region.shape.confidence);
  }
  for (std::size_t i = 0; i < found.size(); ++i) {
    const Object& object = outcome.scene->objects[i];
    if (!found[i])
      std::printf("%s: %s %s %s %s is not found\n", image.c_str(), object.size.c_str(),
                  object.colour.c_str(), object.material.c_str(), object.shape.c_str());
  }
  for (std::size_t i = 0; i < used.size(); ++i) {
    const auto& box = outcome.regions[i].roi.box;
    if (!used[i])
      std::printf("%s: nothing is at (%.0f, %.0f), %.0f x %.0f\n", image.c_str(), box.center.x,
                  box.center.y, box.width, box.height);
  }
}

/// How often words are right that are said with a confidence of this tenth.
void print_reliability(const std::string& kind, const Reliability& reliability) {
  std::printf("\n%-12s%8s%12s%8s\n", kind.c_str(), "words", "confidence", "right");
  for (const auto& bin : reliability) {
    if (bin.right.all == 0)
      continue;
    const auto all = static_cast<double>(bin.right.all);
    std::printf("%-12s%8zu%12.3f%8.3f\n", "", bin.right.all, bin.confidence / all,
                static_cast<double>(bin.right.hits) / all);
  }
}

void print(const Summary& summary, std::size_t images) {
  std::printf("\n%zu images, %zu objects, %zu regions\n", images, summary.recall.all,
              summary.precision.all);
  print("recall (overlap >= 0.5)", summary.recall);
  print("precision (overlap >= 0.5)", summary.precision);
  print("recall (overlap >= 0.3)", summary.loose_recall);
  print("recall (centre in a region's box)", summary.box_recall);
  print("colour of those found", summary.colour);
  print("shape of those found", summary.shape);
  for (const auto& [material, shape] : summary.shape_by_material)
    print(("  of " + material).c_str(), shape);
  print("size of those found", summary.size);
  if (summary.recall.hits > 0)
    std::printf("%-34s %5.3f\n", "mean overlap of those found",
                summary.overlap_sum / static_cast<double>(summary.recall.hits));
  std::printf("\n%-10s%8s%10s%8s%8s\n", "is called", "cube", "cylinder", "sphere", "other");
  const char* const names[] = {"cube", "cylinder", "sphere"};
  for (std::size_t i = 0; i < summary.shapes.size(); ++i)
    std::printf("%-10s%8zu%10zu%8zu%8zu\n", names[i], summary.shapes[i][0], summary.shapes[i][1],
                summary.shapes[i][2], summary.shapes[i][3]);
  for (const auto& [kind, reliability] : summary.reliability)
    print_reliability(kind, reliability);
  if (!summary.milliseconds.empty()) {
    const auto last = summary.milliseconds.size() - 1;
    std::printf("\nms per image, one thread: median %.1f, 95th percentile %.1f\n",
                summary.milliseconds[last / 2], summary.milliseconds[last * 95 / 100]);
  }
}

void run(const Arguments& arguments) {
  cv::setNumThreads(1);
  std::vector<Scene> scenes;
  std::vector<std::size_t> groups;
  std::vector<std::filesystem::path> names;
  for (std::size_t source = 0; source < arguments.folders.size(); ++source) {
    const auto& folder = arguments.folders[source];
    auto found = load_scenes(folder);
    if (found.empty())
      throw std::runtime_error("no scene with an image below " + folder.string());
    for (auto& scene : found) {
      groups.push_back(arguments.without == Without::source ? source : scenes.size());
      names.push_back(std::filesystem::relative(scene.image, folder));
      scenes.push_back(std::move(scene));
    }
  }
  if (arguments.calibrations) {
    write_calibrations(scenes, names, *arguments.calibrations);
    return;
  }
  vision::RegionOptions options;
  options.shape.candidates = {"cube", "cylinder", "sphere"};
  const auto outcomes = arguments.without == Without::nothing
                          ? evaluate_all(scenes, options)
                          : cross_validate(scenes, groups, options);
  for (const auto& outcome : outcomes) {
    print_mistakes(outcome);
    if (arguments.output) {
      std::filesystem::create_directories(*arguments.output);
      annotate(outcome, *arguments.output);
    }
  }
  if (arguments.without == Without::source)
    for (std::size_t source = 0; source < arguments.folders.size(); ++source) {
      std::vector<Outcome> own;
      for (std::size_t i = 0; i < scenes.size(); ++i)
        if (groups[i] == source)
          own.push_back(outcomes[i]);
      std::printf("\n%s, with what was learned from the others", arguments.folders[source].c_str());
      print(summarize(own), own.size());
    }
  print(summarize(outcomes), scenes.size());
}

} // namespace

int main(int argc, char** argv) {
  try {
    run(parse(argc, argv));
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "clevr_benchmark: %s\n", error.what());
    return 1;
  }
}
