#include "castor/actors/component/registry.hpp"
#include "castor/mapping/slam/graph_updater.hpp"
#include "castor/mapping/slam/types.hpp"
#include "castor/wm/entries/failure.hpp"

#include <cstdint>
#include <memory>
#include <string>

namespace castor::mapping {

namespace {

/// Computes the poses of all keyframes by all constraints, and keeps one GraphPoses. One that is
/// started again goes on from the poses that are there.
class PoseGraphOptimiser final : public UnmanagedComponent {
  void configure() override {
    GraphUpdaterOptions options;
    options.keyframes_each_solve = keyframes_;
    updater_ = std::make_unique<GraphUpdater>(options);
  }

  void start() override {
    // What is added meanwhile is met twice, which does no harm.
    on_change(added<Keyframe>().in(subarchitecture()), [this](const ChangeEvent& event) {
      updater_->add(*read<Keyframe>(event.address));
      update();
    });
    on_change(changed<Constraint>().in(subarchitecture()), [this](const ChangeEvent& event) {
      try {
        updater_->add(*read<Constraint>(event.address));
      } catch (const DoesNotExistOnWM&) {
        return;
      }
      update();
    });
    for (auto& x : read_all<Keyframe>())
      updater_->add(*x);
    for (auto& x : read_all<Constraint>())
      updater_->add(*x);
    for (auto& x : read_all<GraphPoses>())
      updater_->restore(*x);
    if (updater_->graph().size() > 0)
      info("goes on with {} keyframes and {} loops", updater_->graph().size(),
           updater_->graph().loops());
    update();
  }

  void stop() override {
    // Those who read the entry afterwards have all keyframes in it.
    if (updater_->graph().size() > 0)
      put(here("graph-poses"), updater_->solve());
  }

  void update() {
    if (updater_->is_due())
      put(here("graph-poses"), updater_->solve());
  }

  Option<std::int64_t> keyframes_{this, "keyframes", GraphUpdaterOptions{}.keyframes_each_solve,
                                  "new keyframes after which small corrections are made"};

  std::unique_ptr<GraphUpdater> updater_;
};

CASTOR_COMPONENT(PoseGraphOptimiser, "computes the path of a robot from keyframes and constraints")

} // namespace

} // namespace castor::mapping
