#include "castor/actors/component/registry.hpp"
#include "castor/base/named_file.hpp"
#include "castor/perception/vision/tabletop/tabletop_renderer.hpp"
#include "castor/perception/vision/tabletop/tabletop_scene_parser.hpp"
#include "castor/perception/vision/types.hpp"
#include "castor/planning/body/table_things.hpp"
#include "castor/planning/body/types.hpp"

#include <chrono>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

namespace castor::manipulation {

namespace {

using namespace std::chrono_literals;

/// Renders the table of a SimulatedArm, with the arm: whoever pulls gets a picture of now. Pictures
/// are pushed, too, if there is a period.
class TableCamera final : public StandaloneComponent {
  void configure() override {
    if (scene_file_->empty())
      throw std::invalid_argument("--scene is not set: name the scene of the SimulatedArm");
    scene_ = vision::load_tabletop_scene(file_named(scene_file_, base_.get())).scene;
    frame_.camera = scene_.camera;
    frame_.camera.number = number_;
  }

  void start() override {
    provide<vision::CameraFrame>([this] {
      look();
      return frame_;
    });
    if (period_.get() > 0ms)
      every(period_.get(), [this] {
        look();
        push(frame_);
      });
  }

  void look() {
    if (looks_ > 0 && now() - looked_ < exposure)
      return;
    const auto view = pull<TableView>(arm_);
    looked_ = now();
    // While nothing moves only the noise is new.
    if (looks_ == 0 || view->change != shown_)
      clean_ =
        vision::render_without_noise(snapshot_of(scene_.setting, view->bodies), scene_.camera);
    shown_ = view->change;
    frame_.image = clean_;
    frame_.time = looked_.count();
    frame_.index = looks_++;
    vision::add_sensor_noise(frame_.image, scene_.setting.noise, scene_.setting.seed, frame_.index);
  }

  /// Pictures are not taken more often.
  static constexpr std::chrono::milliseconds exposure{10};

  Option<std::string> scene_file_{this, "scene", "", "the scene of the SimulatedArm"};
  Option<std::string> base_{this, "base", "", "folder in which a relative file is looked for too"};
  Option<StandaloneName> arm_{this, "arm", "arm", "the SimulatedArm"};
  Option<int> number_{this, "number", 0,
                      "number of this camera, in the entries about its pictures"};
  Option<std::chrono::milliseconds> period_{this, "period", 0ms,
                                            "time between pushes of pictures; 0: none"};

  vision::TabletopScene scene_;
  vision::CameraFrame frame_;
  vision::Image clean_;
  std::uint64_t shown_ = 0;
  std::uint64_t looks_ = 0;
  Timestamp looked_{0};
};

CASTOR_COMPONENT(TableCamera, "delivers pictures of the table of a SimulatedArm")

} // namespace

} // namespace castor::manipulation
