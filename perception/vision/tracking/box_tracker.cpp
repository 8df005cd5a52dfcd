#include "castor/perception/vision/tracking/box_tracker.hpp"

#include "castor/perception/vision/opencv_bridge.hpp"
#include "castor/perception/vision/tracking/appearance.hpp"

#include <optional>
#include <utility>

#include <opencv2/imgproc.hpp>
#include <opencv2/tracking.hpp>

namespace castor::vision {

struct BoxTracker::Thing {
  Appearance appearance;
  ImageBox box;
  int missing = 0;
  /// The last picture in which it was seen, in grey and as it was; none before the first.
  cv::Mat grey;
  cv::Mat picture;
  /// Made when it first moves, from where it was seen last.
  cv::Ptr<cv::TrackerCSRT> filter;

  /// What happens this near to the thing may be its own motion.
  cv::Rect surroundings(const cv::Size& size) const {
    auto rect = pixels_of(box);
    return cv::Rect(rect.x - rect.width / 2, rect.y - rect.height / 2, 2 * rect.width,
                    2 * rect.height) &
           cv::Rect({0, 0}, size);
  }

  bool is_still(const cv::Mat& now, const TrackingOptions& options) const {
    auto around = surroundings(now.size());
    if (grey.size() != now.size() || around.empty())
      return false;
    cv::Mat difference;
    cv::absdiff(grey(around), now(around), difference);
    auto changed = cv::countNonZero(difference > options.pixel_threshold);
    return changed <= options.still_share * around.area();
  }

  /// Where the correlation filter sees it, if it does.
  std::optional<ImageBox> filtered(const cv::Mat& now) {
    if (picture.size() != now.size())
      return std::nullopt;
    if (!filter) {
      auto rect = pixels_of(box) & cv::Rect({0, 0}, picture.size());
      // Anything smaller has nothing to be recognised by.
      constexpr int min_side = 4;
      if (rect.width < min_side || rect.height < min_side)
        return std::nullopt;
      filter = cv::TrackerCSRT::create();
      filter->init(picture, rect);
    }
    cv::Rect rect;
    if (!filter->update(now, rect))
      return std::nullopt;
    return box_of(rect);
  }
};

BoxTracker::BoxTracker(TrackingOptions options) : options_(options) {}
BoxTracker::BoxTracker(BoxTracker&&) noexcept = default;
BoxTracker& BoxTracker::operator=(BoxTracker&&) noexcept = default;
BoxTracker::~BoxTracker() = default;

void BoxTracker::follow(const std::string& name, const ImageBox& box, const Image& region,
                        const Image& mask) {
  things_.insert_or_assign(
    name, std::make_unique<Thing>(Thing{Appearance{region, mask}, box, 0, {}, {}, {}}));
}

void BoxTracker::forget(const std::string& name) {
  things_.erase(name);
}

std::vector<Track> BoxTracker::update(const Image& image) {
  if (things_.empty())
    return {};
  // The image may change after this call, and things remember it.
  auto picture = as_mat(image).clone();
  cv::Mat grey;
  cv::cvtColor(picture, grey, cv::COLOR_BGR2GRAY);
  std::optional<ColourPicture> colours;
  std::vector<Track> result;
  auto place = [&](Thing& thing, const ImageBox& box) {
    thing.box = box;
    thing.missing = 0;
    thing.picture = picture;
    thing.grey = grey;
  };
  for (auto& [name, thing] : things_) {
    auto& track = result.emplace_back();
    track.name = name;
    if (thing->missing == 0 && thing->is_still(grey, options_))
      continue;
    if (!colours)
      colours.emplace(image);
    // Before the first picture, it is where others say that it is.
    std::optional<ImageBox> box;
    if (thing->picture.empty())
      box = thing->box;
    else if (thing->missing == 0)
      box = thing->filtered(picture);
    auto least = thing->picture.empty() ? options_.found_similarity : options_.min_similarity;
    track.similarity = box ? thing->appearance.similarity(*colours, *box) : 0;
    if (box && track.similarity >= least)
      place(*thing, *box);
    else
      ++thing->missing;
  }
  // What has jumped is looked for where nothing else is.
  std::vector<ImageBox> taken;
  for (auto& [name, thing] : things_)
    if (thing->missing == 0)
      taken.push_back(thing->box);
  for (auto& track : result) {
    auto& thing = *things_.at(track.name);
    if (thing.missing > 0) {
      thing.filter.reset();
      if (auto box = thing.appearance.find(*colours, thing.box.width, thing.box.height, taken,
                                           options_.found_similarity)) {
        track.similarity = thing.appearance.similarity(*colours, *box);
        place(thing, *box);
        taken.push_back(*box);
      }
    }
    track.box = thing.box;
    track.missing = thing.missing;
    track.is_lost = thing.missing >= options_.max_missing;
    if (track.is_lost)
      forget(track.name);
  }
  return result;
}

} // namespace castor::vision
