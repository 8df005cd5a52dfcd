#include "castor/actors/component/option.hpp"
#include "castor/actors/component/registry.hpp"
#include "castor/actors/component/subarchitecture_component.hpp"
#include "castor/mapping/body/types.hpp"
#include "castor/mapping/map_components/pose_comparison.hpp"
#include "castor/mapping/slam/types.hpp"
#include "castor/wm/entries/failure.hpp"

#include <chrono>
#include <memory>
#include <numbers>
#include <string>

namespace castor::mapping {

namespace {

using namespace std::chrono_literals;

/// Says how far RobotPose is from the true pose, which a simulated robot tells.
class PoseEvaluator final : public UnmanagedComponent {
  void start() override {
    on_push<BodyStatus>(robot_.get(), [this](const std::shared_ptr<const BodyStatus>& x) {
      comparison_.add_truth(x->time, x->pose);
      status_ = *x;
    });
    on_change(changed<RobotPose>().in(localisation_->empty() ? subarchitecture()
                                                             : std::string{localisation_.get()}),
              [this](const ChangeEvent& event) {
                try {
                  comparison_.add_pose(*read<RobotPose>(event.address));
                } catch (const DoesNotExistOnWM&) {
                  debug("{} was deleted before it was read", event.address.id);
                }
              });
    every(period_.get(), [this] { put(here("pose-error"), comparison_.error()); });
  }

  void stop() override {
    auto x = comparison_.error();
    put(here("pose-error"), x);
    if (x.tracking == 0)
      return info("the robot was not found in {} poses", x.poses);
    constexpr double degree = std::numbers::pi / 180;
    info("{} of {} poses on {:.1f} m were tracked: off by {:.3f} m (median), {:.3f} m at most, and "
         "{:.2f} degrees, {:.2f} at most; lost {} times; {} collisions",
         x.tracking, x.poses, status_.driven, x.median, x.most, x.heading_median / degree,
         x.heading_most / degree, x.lost, status_.collisions);
  }

  Option<StandaloneName> robot_{this, "robot", "robot", "the simulated robot that tells the truth"};
  Option<SubarchitectureName> localisation_{this, "localisation", "",
                                            "subarchitecture of the RobotPose; empty: its own"};
  Option<std::chrono::milliseconds> period_{this, "period", 10s,
                                            "time from one report to the next"};

  PoseComparison comparison_;
  BodyStatus status_;
};

CASTOR_COMPONENT(PoseEvaluator,
                 "compares what localisation says with the true pose of a simulated robot")

} // namespace

} // namespace castor::mapping
