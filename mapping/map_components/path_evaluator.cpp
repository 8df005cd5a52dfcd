#include "castor/actors/component/registry.hpp"
#include "castor/mapping/body/types.hpp"
#include "castor/mapping/map_components/follows_keyframes.hpp"
#include "castor/mapping/map_components/path_comparison.hpp"

#include <chrono>
#include <numbers>
#include <optional>
#include <string>

namespace castor::mapping {

namespace {

using namespace std::chrono_literals;

/// Says how far the path of SLAM is from the true one, which a simulated robot tells.
class PathEvaluator final : public FollowsKeyframes<UnmanagedComponent> {
  void start() override {
    for (auto& x : read_all_in<TruePath>(subarchitecture()))
      comparison_.add_truths(*x);
    on_push<BodyStatus>(robot_.get(), [this](const std::shared_ptr<const BodyStatus>& x) {
      comparison_.add_truth(x->time, x->pose);
      status_ = *x;
    });
    follow_keyframes();
    every(period_.get(), [this] { tell(); });
  }

  void place(const EntryOf<Keyframe>& keyframe, const Pose2& robot) override {
    comparison_.place(keyframe.address.id, keyframe->time, robot);
  }

  void remove(const std::string& keyframe) override { comparison_.remove(keyframe); }

  void placed() override {}

  /// The entries of a robot that stands are not overwritten.
  void tell() {
    if (is_behind())
      return;
    const auto x = error();
    auto as_told = x;
    as_told.time = told_ ? told_->time : 0;
    if (told_ == as_told)
      return;
    told_ = x;
    put(here("path-error"), x);
    put(here("true-path"), comparison_.truth());
  }

  PathError error() const {
    auto result = comparison_.error();
    result.time = status_.time;
    result.collisions = status_.collisions;
    result.least_clearance = status_.least_clearance;
    result.driven = status_.driven;
    return result;
  }

  void stop() override {
    catch_up();
    tell();
    auto x = error();
    if (x.keyframes == 0)
      return info("no keyframe to compare with the true path of {}", robot_.get());
    constexpr double degree = std::numbers::pi / 180;
    info("{} keyframes on {:.1f} m are off by {:.3f} m (median), {:.3f} m at most, aligned by {:.3f} "
         "m, {:.3f} m at most, and {:.2f} degrees, {:.2f} at most; {} collisions, clearance at "
         "least {:.2f} m",
         x.keyframes, x.driven, x.median, x.most, x.aligned_median, x.aligned_most,
         x.heading_median / degree, x.heading_most / degree, x.collisions, x.least_clearance);
  }

  Option<StandaloneName> robot_{this, "robot", "robot", "the simulated robot that tells the truth"};
  Option<std::chrono::milliseconds> period_{this, "period", 10s,
                                            "time from one comparison to the next"};

  PathComparison comparison_;
  BodyStatus status_;
  std::optional<PathError> told_;
};

CASTOR_COMPONENT(PathEvaluator, "compares the path of SLAM with the true one of a simulated robot")

} // namespace

} // namespace castor::mapping
