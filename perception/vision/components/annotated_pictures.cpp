#include "castor/actors/registry.hpp"
#include "castor/perception/vision/annotate.hpp"
#include "castor/perception/vision/camera/image_source_file.hpp"
#include "castor/perception/vision/types.hpp"
#include "castor/wm/failure.hpp"

#include <fmt/core.h>

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

namespace castor::vision {

namespace {

using namespace std::chrono_literals;

/// Draws what vision working memory says of the scene on a picture of it, for people to look at.
class AnnotatedPictures final : public UnmanagedComponent {
  void start() override {
    if (output_->empty())
      return;
    std::filesystem::create_directories(output_.get());
    auto note = [this](const ChangeEvent&) { is_due_ = true; };
    on_change(changed<ROI>(), note);
    on_change(changed<SceneObject>(), note);
    // A scene in which nothing was found is worth a picture too.
    on_change(overwritten<SceneChanged>(), [this](const ChangeEvent& event) {
      is_due_ = is_due_ || read<SceneChanged>(event.address)->processed;
    });
  }

  void run() override {
    if (output_->empty())
      return;
    while (is_running()) {
      // A picture is worth making once what belongs to it has arrived.
      if (wait_for_changes(settle_.get()) || !is_due_)
        continue;
      draw();
    }
  }

  void stop() override {
    if (is_due_)
      draw();
  }

  void draw() {
    is_due_ = false;
    auto frame = pull<CameraFrame>(camera_);
    std::vector<Annotation> annotations;
    for (auto& roi : read_all<ROI>()) {
      auto& annotation = annotations.emplace_back();
      annotation.box = roi->box;
      annotation.contour = roi->contour;
      annotation.lines = describe(*roi);
    }
    auto file = std::filesystem::path{output_.get()} /
                fmt::format("{}-{:03}.png", component_name(), ++pictures_);
    write_png(file, annotate(frame->image, annotations));
    info("wrote {}", file.string());
  }

  std::vector<AnnotationLine> describe(const ROI& roi) {
    try {
      auto object = read<SceneObject>(here(roi.object_id));
      std::vector<AnnotationLine> lines{{"object " + roi.object_id, {}}};
      for (auto* x : {&object->color, &object->shape, &object->size})
        lines.push_back({x->value, x->confidence});
      return lines;
    } catch (const DoesNotExistOnWM&) {
      return {{"no object", {}}};
    }
  }

  Option<std::string> camera_{this, "camera", "camera", "the camera whose pictures are drawn on"};
  Option<std::string> output_{this, "output", "", "folder to write pictures to; none if empty"};
  Option<std::chrono::milliseconds> settle_{this, "settle", 300ms,
                                            "how long nothing may change before a picture is made"};

  bool is_due_ = false;
  int pictures_ = 0;
};

CASTOR_COMPONENT(AnnotatedPictures, "writes pictures of the scene with what is known of it")

} // namespace

} // namespace castor::vision
