#include "castor/benchmarks/tracking/otb_sequence.hpp"

#include "castor/perception/vision/camera/image_source_file.hpp"
#include "castor/perception/vision/recognition/regions.hpp"
#include "castor/perception/vision/segmentation/region_matching.hpp"

#include <algorithm>
#include <chrono>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

namespace castor::otb {

Sequence load_sequence(const std::filesystem::path& folder) {
  Sequence result;
  for (auto& x : std::filesystem::directory_iterator{folder / "img"})
    if (x.path().extension() == ".jpg")
      result.files.push_back(x.path());
  std::sort(result.files.begin(), result.files.end());
  std::ifstream truth{folder / "groundtruth_rect.txt"};
  for (std::string line; std::getline(truth, line);) {
    // Some sequences separate by commas, some by blanks; pixels are counted from 1.
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream words{line};
    double x = 0;
    double y = 0;
    double width = 0;
    double height = 0;
    if (words >> x >> y >> width >> height)
      result.truth.push_back({{x - 1 + (width - 1) / 2, y - 1 + (height - 1) / 2}, width, height});
  }
  if (result.files.empty() || result.files.size() != result.truth.size())
    throw std::runtime_error(folder.string() + ": " + std::to_string(result.files.size()) +
                             " pictures, but " + std::to_string(result.truth.size()) +
                             " boxes in groundtruth_rect.txt");
  return result;
}

Score run(const Sequence& sequence, const vision::TrackingOptions& options) {
  Score score;
  vision::BoxTracker tracker{options};
  auto box = sequence.truth.front();
  std::chrono::duration<double, std::milli> time{0};
  for (std::size_t i = 0; i < sequence.files.size(); ++i) {
    auto picture = vision::read_image(sequence.files[i]);
    auto start = std::chrono::steady_clock::now();
    if (i == 0)
      tracker.follow("thing", box, vision::make_roi(picture, {box, {}, {}}).region);
    for (auto& track : tracker.update(picture)) {
      box = track.box;
      score.missed += track.missing > 0;
    }
    time += std::chrono::steady_clock::now() - start;
    if (i == 0)
      continue;
    auto overlap = vision::overlap(box, sequence.truth[i]);
    ++score.pictures;
    score.mean_overlap += overlap;
    score.success_rate += overlap >= 0.5;
  }
  score.mean_overlap /= score.pictures;
  score.success_rate /= score.pictures;
  score.ms_per_picture = time.count() / score.pictures;
  return score;
}

} // namespace castor::otb
