#include "castor/mapping/slam/loop_closer.hpp"

#include "castor/actors/component/registry.hpp"
#include "castor/mapping/planar/poses.hpp"
#include "castor/mapping/slam/graph_updater.hpp"
#include "castor/mapping/slam/types.hpp"
#include "castor/wm/entries/failure.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

// The component is named like the class that does the work.
namespace castor::mapping::components {

namespace {

/// Searches each new keyframe among the earlier ones, and adds a constraint where the robot has
/// come back. One that is started again goes on with the keyframes that are there.
class LoopCloser final : public UnmanagedComponent {
  void configure() override {
    LoopCloserOptions options;
    options.least_path = least_path_;
    options.most_window = most_window_;
    options.surface.max_range = max_range_;
    closer_ = std::make_unique<mapping::LoopCloser>(options);
  }

  void start() override {
    on_change(changed<GraphPoses>().in(subarchitecture()),
              [this](const ChangeEvent& event) { look_at_graph(event.address); });
    on_change(added<Keyframe>().in(subarchitecture()), [this](const ChangeEvent& event) {
      take(*read<Keyframe>(event.address));
      search();
    });
    for (auto& x : read_all<GraphPoses>())
      graph_ = *x;
    std::int64_t searched = 0;
    std::vector<Constraint> loops;
    for (auto& x : read_all<Constraint>())
      if (x->kind == ConstraintKind::loop) {
        searched = std::max(searched, x->to);
        loops.push_back(*x);
      }
    for (auto& x : read_all<Keyframe>())
      take(*x);
    remember(searched, loops);
    search();
  }

  /// What another one has searched before, as far as that is known: all but the newest keyframes.
  void remember(std::int64_t searched, const std::vector<Constraint>& loops) {
    constexpr std::int64_t searched_again = 100;
    if (!waiting_.empty())
      searched = std::max(searched, waiting_.rbegin()->first - searched_again);
    while (!waiting_.empty() && waiting_.begin()->first == closer_->keyframes() &&
           waiting_.begin()->first <= searched) {
      auto& keyframe = waiting_.begin()->second;
      local_poses_.push_back(keyframe.local_pose);
      closer_->remember(keyframe);
      waiting_.erase(waiting_.begin());
    }
    for (const auto& x : loops)
      if (x.from < closer_->keyframes() && x.to < closer_->keyframes()) {
        closer_->remember(x);
        ++loops_;
      }
    if (closer_->keyframes() > 0)
      info("goes on from keyframe {} with {} loops", closer_->keyframes() - 1, loops_);
  }

  void take(const Keyframe& x) {
    if (x.number >= closer_->keyframes())
      waiting_.emplace(x.number, x);
  }

  void look_at_graph(const Address& address) {
    try {
      graph_ = *read<GraphPoses>(address);
    } catch (const DoesNotExistOnWM&) {
      return;
    }
    search();
  }

  void search() {
    while (is_running() && !waiting_.empty() && waiting_.begin()->first == closer_->keyframes()) {
      // A large correction makes old poses useless until it has been made.
      if (needs_correction_ && graph_.loops < loops_)
        return;
      needs_correction_ = false;
      auto keyframe = std::move(waiting_.begin()->second);
      waiting_.erase(waiting_.begin());
      local_poses_.push_back(keyframe.local_pose);
      auto poses = keyframe_poses(graph_, local_poses_);
      for (const auto& x : closer_->add(keyframe, poses)) {
        auto predicted =
          between(poses[static_cast<std::size_t>(x.from)], poses[static_cast<std::size_t>(x.to)]);
        auto correction = distance(predicted, x.pose);
        needs_correction_ =
          needs_correction_ || correction > GraphUpdaterOptions{}.correction_at_once;
        if (correction > report_)
          info("keyframe {} is where {} was, which corrects {:.2f} m", x.to, x.from, correction);
        put(here("loop-" + std::to_string(x.from) + "-" + std::to_string(x.to)), x);
        ++loops_;
      }
    }
  }

  Option<double> least_path_{this, "least-path", LoopCloserOptions{}.least_path,
                             "way after which a place may be met again, metres"};
  Option<double> most_window_{this, "most-window", LoopCloserOptions{}.most_window,
                              "largest correction that is searched, metres"};
  Option<double> max_range_{this, "max-range", SurfaceOptions{}.max_range,
                            "beams that end further away are left out, metres"};
  Option<double> report_{this, "report", 0.5, "corrections above this are logged, metres"};

  std::unique_ptr<mapping::LoopCloser> closer_;
  GraphPoses graph_;
  /// By number, up to those that have been searched.
  std::vector<Pose2> local_poses_;
  std::map<std::int64_t, Keyframe> waiting_;
  std::int64_t loops_ = 0;
  bool needs_correction_ = false;
};

CASTOR_COMPONENT(LoopCloser, "notices where a robot comes back to, by its keyframes")

} // namespace

} // namespace castor::mapping::components
