#include "castor/actors/component/registry.hpp"
#include "castor/perception/vision/annotate.hpp"
#include "castor/perception/vision/camera/image_source_file.hpp"
#include "castor/perception/vision/types.hpp"
#include "castor/wm/entries/failure.hpp"

#include <fmt/core.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace castor::vision {

namespace {

using namespace std::chrono_literals;

/// Draws what vision working memory says of the scene on a picture of it, for people to look at: in
/// files, and in an entry.
class AnnotatedPictures final : public UnmanagedComponent {
  void start() override {
    if (!is_wanted())
      return;
    if (!output_->empty())
      make_output();
    auto note = [this](const ChangeEvent&) { is_due_ = true; };
    on_change(changed<ROI>(), note);
    on_change(changed<SceneObject>(), note);
    // A scene in which nothing was found is worth a picture too.
    on_change(overwritten<SceneChanged>(), [this](const ChangeEvent& event) {
      is_due_ = is_due_ || read<SceneChanged>(event.address)->processed;
    });
  }

  void run() override {
    if (!is_wanted())
      return;
    while (is_running()) {
      // A picture is worth making once what belongs to it has arrived.
      if (wait_for_changes(settle_.get()) || !is_due_)
        continue;
      draw();
    }
  }

  void stop() override {
    // Nobody will be there to look at an entry.
    if (is_due_ && !output_->empty())
      draw();
  }

  void make_output() const {
    std::error_code error;
    std::filesystem::create_directories(output_.get(), error);
    if (error)
      throw std::runtime_error("cannot make the folder " + output_.get() +
                               ", which --output names: " + error.message());
  }

  bool is_wanted() const { return !output_->empty() || entry_width_ > 0; }

  void draw() {
    is_due_ = false;
    auto frame = pull<CameraFrame>(camera_);
    auto rois = read_all<ROI>();
    if (!output_->empty())
      write_file(*frame, rois);
    if (entry_width_ > 0)
      write_entry(*frame, rois);
  }

  void write_file(const CameraFrame& frame, const std::vector<EntryOf<ROI>>& rois) {
    auto file = std::filesystem::path{output_.get()} /
                fmt::format("{}-{:03}.png", component_name(), ++pictures_);
    write_png(file, annotate(frame.image, annotations(rois, &AnnotatedPictures::describe)));
    info("wrote {}", file.string());
  }

  void write_entry(const CameraFrame& frame, const std::vector<EntryOf<ROI>>& rois) {
    auto width = static_cast<std::uint32_t>(entry_width_.get());
    AnnotateOptions options;
    // Letters that can still be read when the picture is small.
    options.text_scale = 2;
    ScenePicture picture;
    picture.image =
      shrunk(annotate(frame.image, annotations(rois, &AnnotatedPictures::name), options), width);
    picture.camera = frame.camera.number;
    picture.time = frame.time;
    if (entry_.id.empty())
      entry_ = add(std::move(picture), EntryLife{.ephemeral = true});
    else
      overwrite(entry_, std::move(picture));
  }

  /// @param label what is said of each
  std::vector<Annotation>
  annotations(const std::vector<EntryOf<ROI>>& rois,
              std::vector<AnnotationLine> (AnnotatedPictures::*label)(const ROI&)) {
    std::vector<Annotation> result;
    for (auto& roi : rois) {
      auto& annotation = result.emplace_back();
      annotation.box = roi->box;
      annotation.contour = roi->contour;
      annotation.lines = (this->*label)(*roi);
    }
    return result;
  }

  std::vector<AnnotationLine> name(const ROI& roi) {
    try {
      auto object = read<SceneObject>(here(roi.object_id));
      return {{object->label.confidence > 0 ? object->label.value : roi.object_id, {}}};
    } catch (const DoesNotExistOnWM&) {
      return {};
    }
  }

  std::vector<AnnotationLine> describe(const ROI& roi) {
    try {
      auto object = read<SceneObject>(here(roi.object_id));
      std::vector<AnnotationLine> lines{{"object " + roi.object_id, {}}};
      for (auto* x : {&object->colour, &object->shape, &object->size})
        lines.push_back({x->value, x->confidence});
      return lines;
    } catch (const DoesNotExistOnWM&) {
      return {{"no object", {}}};
    }
  }

  Option<StandaloneName> camera_{this, "camera", "camera",
                                 "the camera whose pictures are drawn on"};
  Option<std::string> output_{this, "output", "", "folder to write pictures to; none if empty"};
  Option<int> entry_width_{this, "entry-width", 0,
                           "pixels across of the picture that an entry keeps of the scene; none if "
                           "0"};
  Option<std::chrono::milliseconds> settle_{this, "settle", 100ms,
                                            "time without a change before a picture is made"};

  Address entry_;
  bool is_due_ = false;
  int pictures_ = 0;
};

CASTOR_COMPONENT(AnnotatedPictures, "makes pictures of the scene with what is known of it")

} // namespace

} // namespace castor::vision
