#include "castor/actors/component/registry.hpp"
#include "castor/perception/vision/components/looks_at_scene.hpp"
#include "castor/perception/vision/scene_object_changes.hpp"
#include "castor/perception/vision/tracking/box_tracker.hpp"
#include "castor/perception/vision/tracking/moved_object.hpp"
#include "castor/perception/vision/types.hpp"
#include "castor/wm/entries/failure.hpp"

#include <chrono>
#include <cmath>
#include <map>
#include <string>
#include <utility>

namespace castor::vision {

namespace {

using namespace std::chrono_literals;

/// Takes over the objects that a segmentor has found in a still scene, and keeps their positions up
/// to date while they move. One that it has lost is the segmentor's again.
class ObjectTracker final : public LooksAtScene<UnmanagedComponent> {
  void configure() override {
    TrackingOptions options;
    options.max_missing = max_missing_;
    options.min_similarity = min_similarity_;
    options.found_similarity = found_similarity_;
    tracker_ = BoxTracker{options};
  }

  void start() override {
    watch_inhibition();
    on_change(added<SceneObject>(), [this](const ChangeEvent& event) { take(event.address); });
    on_change(deleted<SceneObject>(),
              [this](const ChangeEvent& event) { forget(event.address.id); });
    // Somebody else has seen the object anew: that tells better than a tracker where it is.
    on_change(changed(&ROI::box, &ROI::region), [this](const ChangeEvent& event) {
      if (event.source != component_name())
        take_object_of(event.address);
    });
    // What a predecessor had, or did not get to.
    for (auto& x : read_all<SceneObject>())
      take(x.address);
  }

  void run() override {
    while (sleep_for(period_.get())) {
      if (followed_.empty())
        continue;
      auto frame = picture_of_scene(camera_);
      if (!frame)
        continue;
      for (auto& track : tracker_.update(frame->image)) {
        if (track.is_lost)
          give_back(track.name);
        else if (track.missing == 0)
          report(track, *frame);
      }
    }
  }

  void stop() override {
    while (!followed_.empty())
      give_back(followed_.begin()->first);
  }

  void take_object_of(const Address& roi) {
    try {
      take(here(read<ROI>(roi)->object_id));
    } catch (const DoesNotExistOnWM&) {
      debug("{} is gone before its object was taken over", roi.id);
    }
  }

  void take(const Address& address) {
    try {
      while (!try_take(address))
        debug("{} was changed meanwhile; once more", address.id);
    } catch (const DoesNotExistOnWM&) {
      forget(address.id);
    }
  }

  /// False if somebody else wrote the object at the same time.
  bool try_take(const Address& address) {
    auto object = read<SceneObject>(address);
    auto is_mine = object->managing_process == component_name();
    if (object->roi_ids.empty() || (!is_mine && object->managing_process != from_.get()))
      return true;
    auto roi = read<ROI>(here(object->roi_ids.front()));
    if (roi->camera != number_)
      return true;
    if (!is_mine && !hand(object, component_name()))
      return false;
    tracker_.follow(address.id, roi->box, roi->region, roi->mask);
    followed_[address.id].box = roi->box;
    return true;
  }

  void give_back(const std::string& id) {
    try {
      while (true) {
        auto object = read<SceneObject>(here(id));
        if (object->managing_process != component_name() || hand(object, from_))
          break;
      }
    } catch (const DoesNotExistOnWM&) {
      debug("{} is gone already", id);
    }
    forget(id);
  }

  /// Makes `to` the object's manager; false if somebody else wrote it at the same time.
  bool hand(const EntryOf<SceneObject>& object, const std::string& to) {
    auto handed = *object;
    handed.managing_process = to;
    return write(object, std::move(handed), {});
  }

  void forget(const std::string& id) {
    tracker_.forget(id);
    followed_.erase(id);
  }

  /// Writes where the object is, if it has moved and it is time to say so.
  void report(const Track& track, const CameraFrame& frame) {
    auto& followed = followed_.at(track.name);
    auto way = std::hypot(track.box.center.x - followed.box.center.x,
                          track.box.center.y - followed.box.center.y);
    if (way < least_move_ || now() - followed.reported < Timestamp{update_period_.get()})
      return;
    try {
      while (!move(track, frame))
        debug("{} was changed meanwhile; once more", track.name);
      followed.reported = now();
      followed.box = track.box;
    } catch (const DoesNotExistOnWM&) {
      forget(track.name);
    }
  }

  /// False if somebody else wrote the object or its region at the same time.
  bool move(const Track& track, const CameraFrame& frame) {
    auto object = read<SceneObject>(here(track.name));
    if (object->managing_process != component_name())
      return true;
    auto roi = read<ROI>(here(object->roi_ids.at(0)));
    // Then there is a new view of it, of which an event is on its way.
    if (roi->time > frame.time)
      return true;
    auto moved_object = *object;
    auto moved_roi = *roi;
    move_to(track.box, frame.camera, moved_roi, moved_object);
    moved_object.time = moved_roi.time = frame.time;
    WriteBatch batch;
    batch.overwrite(roi.address, std::move(moved_roi));
    return write(object, std::move(moved_object), std::move(batch));
  }

  /// Overwrites the object, along with what is in `batch`.
  bool write(const EntryOf<SceneObject>& before, SceneObject after, WriteBatch batch) {
    batch.add(here(new_id()), changes(before.address.id, *before, after), update_life);
    batch.overwrite(before.address, std::move(after));
    try {
      SubarchitectureComponent::write(batch);
    } catch (const ConsistencyException&) {
      return false;
    }
    return true;
  }

  Option<StandaloneName> camera_{this, "camera", "camera", "the camera component to pull from"};
  Option<int> number_{this, "number", 0, "that camera's number"};
  Option<ComponentName> from_{this, "from", "segmentor",
                              "the component whose objects are taken over, and given back"};
  Option<std::chrono::milliseconds> period_{this, "period", 100ms, "time between pictures"};
  Option<std::chrono::milliseconds> update_period_{
    this, "update-period", 300ms, "least time between two updates of an object's position"};
  Option<double> least_move_{this, "least-move", 2,
                             "least distance by which an object has moved, pixels"};
  Option<int> max_missing_{this, "max-missing", TrackingOptions{}.max_missing,
                           "pictures in a row without an object after which it is lost"};
  Option<double> min_similarity_{
    this, "min-similarity", TrackingOptions{}.min_similarity,
    "least colour similarity at which a box still shows its object, 0 to 1"};
  Option<double> found_similarity_{
    this, "found-similarity", TrackingOptions{}.found_similarity,
    "least colour similarity at which an object is found elsewhere, 0 to 1"};

  struct Followed {
    /// Box in the working memory.
    ImageBox box;
    Timestamp reported{0};
  };

  BoxTracker tracker_;
  /// By the object's id.
  std::map<std::string, Followed> followed_;
};

CASTOR_COMPONENT(ObjectTracker, "keeps the positions of scene objects up to date while they move")

} // namespace

} // namespace castor::vision
