#include "castor/actors/component/registry.hpp"
#include "castor/perception/vision/camera/open_image_source.hpp"
#include "castor/perception/vision/components/looks_at_scene.hpp"
#include "castor/perception/vision/recognition/regions.hpp"
#include "castor/perception/vision/recognition/size_on_table.hpp"
#include "castor/perception/vision/scene_object_changes.hpp"
#include "castor/perception/vision/segmentation/background_model.hpp"
#include "castor/perception/vision/segmentation/region_matching.hpp"
#include "castor/perception/vision/segmentation/segmentation.hpp"
#include "castor/perception/vision/segmentation/size_limits.hpp"
#include "castor/perception/vision/types.hpp"
#include "castor/wm/entries/failure.hpp"

#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace castor::vision {

namespace {

/// Cuts a still scene into regions of interest, and keeps one SceneObject behind each.
class Segmentor final : public LooksAtScene<ManagedComponent> {
  void configure() override {
    limits_.min_area = min_area_;
    limits_.min_length = min_length_;
    segmentation_.max_area = max_area_;
    segmentation_.working_side = working_side_;
    segmentation_.max_border = max_border_;
    // While the camera and others begin.
    preparation_ = std::jthread(prepare_segmentation);
    if (!background_->empty())
      learn_background();
  }

  void start() override {
    watch_inhibition();
    on_change(overwritten<SceneChanged>(), [this](const ChangeEvent& event) {
      consider(event.address, *read<SceneChanged>(event.address));
    });
    on_change(changed(&SceneObject::managing_process), [this](const ChangeEvent& event) {
      if (event.source != component_name())
        look_for_what_was_handed_back(event.address);
    });
    // What a predecessor did not get to.
    for (auto& x : read_all<SceneChanged>())
      consider(x.address, *x);
  }

  void consider(const Address& address, const SceneChanged& scene) {
    if (scene.camera == number_ && scene.changed && !scene.processed)
      propose_look(address);
  }

  /// Somebody who has lost an object, such as a tracker, leaves it to this component to say what
  /// has become of it: now, unless a look at the scene is due anyway.
  void look_for_what_was_handed_back(const Address& object) {
    try {
      if (read<SceneObject>(object)->managing_process != component_name())
        return;
    } catch (const DoesNotExistOnWM&) {
      return;
    }
    for (auto& x : read_all<SceneChanged>())
      if (x->camera == number_ && x->changed && x->processed)
        propose_look(x.address);
  }

  void propose_look(const Address& address) {
    // Only the latest still scene is worth the effort.
    retract_task(task_);
    task_ = propose_task("segment the scene", [this, address] { look(address); });
  }

  void learn_background() {
    ImageSourceOptions options;
    options.at_end = ImageSourceOptions::AtEnd::hold_last;
    auto source = open_image_source(background_, options);
    background_model_.emplace();
    for (int i = 0; i < background_images_; ++i)
      background_model_->learn(source->next().image);
    info("learned the background from {} pictures of {}", background_model_->images(),
         source->description());
  }

  void look_again() override {
    if (!std::exchange(was_inhibited_, false))
      return;
    for (auto& x : read_all<SceneChanged>())
      if (x->camera == number_ && x->changed)
        propose_look(x.address);
  }

  void look(const Address& scene) {
    auto frame = picture_of_scene(camera_);
    while (!frame && !is_inhibited() && sleep_for(time_between_pictures))
      frame = picture_of_scene(camera_);
    if (!frame) {
      was_inhibited_ = true;
      debug("looks at the scene when nobody inhibits that any more");
      return;
    }
    auto segments = segment_table(frame->image, &frame->camera, limits_, segmentation_,
                                  background_model_ ? &*background_model_ : nullptr);
    std::vector<ROI> fresh;
    std::vector<ImageBox> fresh_boxes;
    for (auto& x : segments) {
      auto& roi = fresh.emplace_back(make_roi(frame->image, x));
      roi.camera = number_;
      roi.time = frame->time;
      fresh_boxes.push_back(roi.box);
    }
    auto known = read_all<ROI>();
    std::erase_if(known, [this](auto& x) { return x->camera != number_; });
    std::vector<ImageBox> known_boxes;
    for (auto& x : known)
      known_boxes.push_back(x->box);
    auto matches = match_boxes(fresh_boxes, known_boxes, same_overlap_);
    match_what_others_follow(fresh, known, matches);
    // Removed before new ones are added: working memory stays small.
    std::vector<bool> seen(known.size());
    for (auto& match : matches)
      if (match)
        seen[*match] = true;
    for (std::size_t i = 0; i < known.size(); ++i)
      if (!seen[i])
        remove(known[i]);
    for (std::size_t i = 0; i < fresh.size(); ++i) {
      if (!matches[i])
        add_object(std::move(fresh[i]), frame->camera);
      else
        update(known[*matches[i]], std::move(fresh[i]), frame->camera);
    }
    info("{} regions in the scene", fresh.size());
    mark_processed(scene);
  }

  /// A tracker may not have got to where its objects have come to rest: these are told by their
  /// looks.
  void match_what_others_follow(const std::vector<ROI>& fresh,
                                const std::vector<EntryOf<ROI>>& known,
                                std::vector<std::optional<std::size_t>>& matches) {
    std::vector<const ROI*> unmatched;
    std::vector<std::size_t> unmatched_at;
    for (std::size_t i = 0; i < fresh.size(); ++i)
      if (!matches[i]) {
        unmatched.push_back(&fresh[i]);
        unmatched_at.push_back(i);
      }
    std::vector<const ROI*> followed;
    std::vector<std::size_t> followed_at;
    for (std::size_t i = 0; i < known.size(); ++i)
      if (std::find(matches.begin(), matches.end(), i) == matches.end() && !is_mine(*known[i])) {
        followed.push_back(known[i].object.get());
        followed_at.push_back(i);
      }
    auto pairs = match_looks(unmatched, followed, unchanged_colour_);
    for (std::size_t i = 0; i < pairs.size(); ++i)
      if (pairs[i])
        matches[unmatched_at[i]] = followed_at[*pairs[i]];
  }

  /// Whether the object of the region is this component's to delete, as long as there is one.
  bool is_mine(const ROI& roi) {
    try {
      return read<SceneObject>(here(roi.object_id))->managing_process == component_name();
    } catch (const DoesNotExistOnWM&) {
      return true;
    }
  }

  // An object and its region come, change and go together, whenever this component may fail.

  void remove(const EntryOf<ROI>& roi) {
    auto object = here(roi->object_id);
    WriteBatch batch;
    try {
      if (read<SceneObject>(object)->managing_process != component_name())
        return; // somebody else, such as a tracker, has taken it over
      batch.delete_entry(object);
    } catch (const DoesNotExistOnWM&) {
      debug("the object of {} is gone already", roi.address.id);
    }
    batch.delete_entry(roi.address);
    write(batch);
  }

  std::optional<AlignedBox> place(const ROI& roi, const vision::Camera& camera) const {
    return extent_on_table(camera, roi.contour);
  }

  void add_object(ROI roi, const vision::Camera& camera) {
    auto roi_id = new_id();
    auto object_id = new_id();
    SceneObject object;
    object.time = roi.time;
    object.roi_ids = {roi_id};
    object.managing_process = component_name();
    if (auto box = place(roi, camera))
      place_at(*box, object);
    SceneObjectUpdate update;
    update.object_id = object_id;
    update.position = true;
    roi.object_id = object_id;
    WriteBatch batch;
    batch.add(here(object_id), std::move(object));
    batch.add(here(new_id()), std::move(update), update_life);
    batch.add(here(roi_id), std::move(roi));
    write(batch);
  }

  /// A region that is still where it was and looks as it did is left alone, with all that is known
  /// of it; any other is replaced by its new view.
  void update(const EntryOf<ROI>& known, ROI fresh, const vision::Camera& camera) {
    if (overlap(known->box, fresh.box) > unchanged_overlap_ &&
        colour_distance(*known, fresh) < unchanged_colour_)
      return;
    fresh.object_id = known->object_id;
    try {
      auto object = *read<SceneObject>(here(fresh.object_id));
      object.time = fresh.time;
      if (auto box = place(fresh, camera))
        place_at(*box, object);
      SceneObjectUpdate update;
      update.object_id = fresh.object_id;
      update.position = true;
      if (read<ROI>(known.address)->time > fresh.time)
        return; // somebody has seen it in a later picture
      WriteBatch batch;
      batch.overwrite(here(fresh.object_id), std::move(object));
      batch.add(here(new_id()), std::move(update), update_life);
      batch.overwrite(known.address, std::move(fresh));
      write(batch);
    } catch (const ConsistencyException& e) {
      // Somebody refines the old view; the next change of the scene comes back to it.
      debug("{}", e.what());
    }
  }

  void mark_processed(const Address& address) {
    auto scene = *read<SceneChanged>(address);
    if (!scene.changed)
      return; // it is moving again
    scene.processed = true;
    try {
      overwrite(address, scene);
    } catch (const ConsistencyException&) {
      debug("the scene has changed meanwhile");
    }
  }

  Option<StandaloneName> camera_{this, "camera", "camera", "the camera component to pull from"};
  Option<int> number_{this, "number", 0, "that camera's number"};
  Option<std::string> background_{this, "background", "",
                                  "pictures of the empty scene (folder or video); none if empty"};
  Option<int> background_images_{this, "background-images", 30, "how many of them to learn from"};
  Option<double> min_area_{
    this, "min-area", SizeLimits{}.min_area,
    "smallest region kept, as a share of the picture; 0: by min-length where "
    "the camera is calibrated, else a fixed number of pixels"};
  Option<double> min_length_{this, "min-length", SizeLimits{}.min_length,
                             "longest side on the table of the smallest thing kept, metres"};
  Option<double> max_area_{this, "max-area", SegmentationOptions{}.max_area,
                           "largest region kept, as a share of the picture"};
  Option<double> max_border_{this, "max-border", SegmentationOptions{}.max_border,
                             "regions with a larger share of their outline on the picture's border "
                             "are dropped; 1 keeps all"};
  Option<int> working_side_{this, "working-side", SegmentationOptions{}.working_side,
                            "larger pictures are shrunk to this length for segmentation, pixels"};
  Option<double> same_overlap_{this, "same-overlap", 0.5,
                               "regions that overlap more than this show the same object"};
  Option<double> unchanged_overlap_{this, "unchanged-overlap", 0.85,
                                    "an object whose region overlaps more than this has not moved"};
  Option<double> unchanged_colour_{
    this, "unchanged-colour", 12,
    "and has not changed if its mean colour differs by fewer grey levels"};

  /// How soon the camera is asked for a newer picture.
  static constexpr std::chrono::milliseconds time_between_pictures{20};

  /// A look is due that was inhibited.
  bool was_inhibited_ = false;
  SegmentationOptions segmentation_;
  SizeLimits limits_;
  std::optional<BackgroundModel> background_model_;
  std::jthread preparation_;
  TaskId task_;
};

CASTOR_COMPONENT(Segmentor, "cuts a still scene into regions of interest and scene objects")

} // namespace

} // namespace castor::vision
