#include "castor/actors/component/registry.hpp"
#include "castor/perception/vision/components/looks_at_scene.hpp"
#include "castor/perception/vision/scene_watch.hpp"
#include "castor/perception/vision/types.hpp"
#include "castor/wm/entries/failure.hpp"

#include <chrono>
#include <optional>
#include <string>

namespace castor::vision {

namespace {

using namespace std::chrono_literals;

/// Watches a camera and keeps one SceneChanged entry up to date. One that is started again goes on
/// with the entry that it left, and takes what it sees for a change.
class ChangeDetector final : public LooksAtScene<UnmanagedComponent> {
  void start() override {
    watch_inhibition();
    for (auto& x : read_all<SceneChanged>())
      if (x->camera == number_)
        scene_ = x.address;
    has_predecessor_ = !scene_.id.empty();
    if (has_predecessor_)
      return;
    SceneChanged nothing_yet;
    nothing_yet.camera = number_;
    scene_ = add(nothing_yet);
  }

  void run() override {
    SceneWatchOptions options;
    options.pixel_threshold = threshold_;
    options.changed_share = share_;
    options.changed_square = square_;
    options.still_frames = still_frames_;
    options.first_frame_counts = first_frame_ || has_predecessor_;
    SceneWatch watch{options};
    do {
      auto frame = picture_of_scene(camera_);
      if (!frame)
        continue;
      tell_of(frame->camera);
      if (auto changed = watch.observe(frame->image)) {
        changed->camera = number_;
        // Others overwrite the entry too, when they have seen to the change: the newest news
        // counts.
        put(scene_, *changed);
      }
    } while (sleep_for(period_.get()));
  }

  /// Where the camera stands and how it sees, for those who only look at working memory.
  void tell_of(const Camera& camera) {
    if (camera == told_)
      return;
    told_ = camera;
    put(here("camera " + std::to_string(number_)), camera);
  }

  Option<StandaloneName> camera_{this, "camera", "camera", "the camera component to watch"};
  Option<int> number_{this, "number", 0, "that camera's number"};
  Option<std::chrono::milliseconds> period_{this, "period", 100ms, "time between pictures"};
  Option<int> threshold_{this, "threshold", SceneWatchOptions{}.pixel_threshold,
                         "grey levels by which a changed pixel differs, of 255"};
  Option<double> share_{this, "share", SceneWatchOptions{}.changed_share,
                        "share of changed pixels in a changed picture"};
  Option<int> square_{
    this, "square", SceneWatchOptions{}.changed_square,
    "side of a square that is enough if all of it has changed, pixels; 0: none is"};
  Option<int> still_frames_{this, "still-frames", SceneWatchOptions{}.still_frames,
                            "pictures without change after which the scene is still"};
  Option<bool> first_frame_{this, "first-frame", SceneWatchOptions{}.first_frame_counts,
                            "whether the first picture counts as a change"};

  std::optional<Camera> told_;
  Address scene_;
  bool has_predecessor_ = false;
};

CASTOR_COMPONENT(ChangeDetector, "reports when the scene changes and when it is still again")

} // namespace

} // namespace castor::vision
