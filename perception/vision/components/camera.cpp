#include "castor/actors/component/registry.hpp"
#include "castor/perception/vision/camera/camera_model_file.hpp"
#include "castor/perception/vision/camera/open_image_source.hpp"
#include "castor/perception/vision/types.hpp"

#include <algorithm>
#include <chrono>
#include <memory>
#include <string>
#include <utility>

// The component is named like the entry type that says where it stands and how it sees.
namespace castor::vision::components {

namespace {

using namespace std::chrono_literals;

enum class AfterLast { loop, hold };
CASTOR_REFLECT_ENUM(AfterLast, loop, hold)

/// The video server: takes pictures at its own pace, gives the newest to whoever pulls and pushes
/// each to whoever asked for that.
class Camera final : public StandaloneComponent {
  void configure() override {
    ImageSourceOptions options;
    options.clock = [this, start = now()] { return now() - start; };
    options.base_directory = base_->empty() ? std::string{} : base_.get();
    options.at_end = after_last_ == AfterLast::loop ? ImageSourceOptions::AtEnd::loop
                                                    : ImageSourceOptions::AtEnd::hold_last;
    options.device_width = width_;
    options.device_height = height_;
    if (!calibration_->empty())
      options.calibration = load_camera(calibration_.get());
    if (source_->empty())
      throw ImageSourceError(ImageFault::not_found, "--source", "it is not set",
                             "Name a picture, a folder, a video, a device or scene:FILE");
    source_of_frames_ = open_image_source(source_, options);
    info("pictures come from {}", source_of_frames_->description());
    for (auto& x : source_of_frames_->warnings())
      warning("{}", x);
    take();
  }

  void start() override {
    provide<CameraFrame>([this] { return frame_; });
  }

  void run() override {
    while (sleep_for(period_.get())) {
      try {
        take();
        patience_ = period_;
      } catch (const ImageSourceError& e) {
        if (!e.transient())
          throw;
        // A plug may be put back in; whoever pulls meanwhile gets the last picture.
        patience_ = std::min<std::chrono::milliseconds>(2 * patience_, 5s);
        warning("{}; trying again in {} ms", e.what(), patience_.count());
        if (!sleep_for(patience_))
          return;
        continue;
      }
      push(frame_);
    }
  }

  void take() {
    auto next = source_of_frames_->next();
    frame_.image = std::move(next.image);
    frame_.camera = source_of_frames_->camera();
    frame_.camera.number = number_;
    frame_.time = now().count();
    frame_.index = next.index;
  }

  Option<std::string> source_{
    this, "source", "", "a picture, a folder of pictures, a video, /dev/videoN or scene:FILE"};
  Option<std::string> base_{this, "base", "",
                            "folder in which a relative source is looked for too"};
  Option<std::string> calibration_{this, "calibration", "",
                                   "calibration file; a guess is made without one"};
  Option<std::chrono::milliseconds> period_{this, "period", 50ms, "time between pictures"};
  Option<AfterLast> after_last_{this, "after-last", AfterLast::hold,
                                "what follows the last picture of a folder or video"};
  Option<int> number_{this, "number", 0,
                      "number of this camera, in the entries about its pictures"};
  Option<int> width_{this, "width", 640, "width requested from a device, pixels"};
  Option<int> height_{this, "height", 480, "height requested from a device, pixels"};

  std::unique_ptr<ImageSource> source_of_frames_;
  CameraFrame frame_;
  std::chrono::milliseconds patience_{0};
};

CASTOR_COMPONENT(Camera, "delivers pictures from files, videos, devices or a rendered table")

} // namespace

} // namespace castor::vision::components
