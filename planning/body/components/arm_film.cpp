#include "castor/actors/component/registry.hpp"
#include "castor/actors/component/subarchitecture_component.hpp"
#include "castor/perception/vision/types.hpp"
#include "castor/planning/body/film_strip.hpp"
#include "castor/planning/manipulation/types.hpp"
#include "castor/wm/entries/failure.hpp"

#include <filesystem>
#include <stdexcept>
#include <string>

namespace castor::manipulation {

namespace {

/// Takes a picture of each step of an arm's actions, and writes a strip of them at the end of each:
/// action-1.png, action-2.png, ...
class ArmFilm final : public UnmanagedComponent {
  void start() override {
    if (output_->empty())
      return;
    on_change(changed<Manipulation>(), [this](const ChangeEvent& event) {
      try {
        show(*read<Manipulation>(event.address));
      } catch (const DoesNotExistOnWM&) {
        debug("{} was deleted before it was read", event.address.id);
      }
    });
  }

  void show(const Manipulation& x) {
    if (x.step == step_ && x.task == task_)
      return;
    step_ = x.step;
    task_ = x.task;
    const bool is_over = x.status == ManipulationStatus::succeeded ||
                         x.status == ManipulationStatus::failed ||
                         x.status == ManipulationStatus::cancelled;
    if (strip_.size() >= most_frames_ && !is_over)
      return;
    strip_.add(pull<vision::CameraFrame>(camera_)->image, is_over ? enum_text(x) : x.step);
    if (!is_over)
      return;
    const auto file =
      std::filesystem::path(output_.get()) / ("action-" + std::to_string(++actions_) + ".png");
    try {
      write_png(strip_.picture(), file);
      info("{}: {} frames in {}", x.task, strip_.size(), file.string());
    } catch (const std::runtime_error& e) {
      warning("{}", e.what());
    }
    strip_ = FilmStrip(width_);
  }

  /// How it ended.
  static std::string enum_text(const Manipulation& x) {
    if (x.status == ManipulationStatus::succeeded)
      return "done: " + x.task;
    return x.status == ManipulationStatus::failed ? "failed" : "cancelled";
  }

  Option<StandaloneName> camera_{this, "camera", "camera", "the camera that takes the pictures"};
  Option<std::string> output_{this, "output", "", "folder for the strips; empty: none"};
  Option<int> width_{this, "width", 320, "of each frame, pixels"};

  static constexpr std::size_t most_frames_ = 60;

  FilmStrip strip_{320};
  std::string step_;
  std::string task_;
  int actions_ = 0;
};

CASTOR_COMPONENT(ArmFilm, "writes film strips of what an arm does")

} // namespace

} // namespace castor::manipulation
