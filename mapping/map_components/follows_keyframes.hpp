#pragma once

#include "castor/actors/component/option.hpp"
#include "castor/actors/component/subarchitecture_component.hpp"
#include "castor/mapping/map_components/keyframe_poses.hpp"
#include "castor/mapping/slam/types.hpp"
#include "castor/wm/entries/failure.hpp"

#include <map>
#include <optional>
#include <string>

namespace castor::mapping {

/// A component derived from `Base` that is told of keyframes, and of each correction of their
/// poses.
template <class Base>
class FollowsKeyframes : public Base {
protected:
  /// Keyframes are in the component's own subarchitecture, or in the one that --keyframes names. To
  /// be called in `start()`: tells of all that there are.
  void follow_keyframes() {
    auto where = keyframes_->empty() ? this->subarchitecture() : std::string{keyframes_.get()};
    this->on_change(added<Keyframe>().in(where), [this](const ChangeEvent& event) {
      try {
        take(this->template read<Keyframe>(event.address));
        placed();
      } catch (const DoesNotExistOnWM&) {
        this->debug("{} was deleted before it was read", event.address.id);
      }
    });
    this->on_change(deleted<Keyframe>().in(where), [this](const ChangeEvent& event) {
      if (known_.erase(event.address.id) > 0)
        remove(event.address.id);
      placed();
    });
    auto correct = [this](const ChangeEvent& event) {
      try {
        graph_ = *this->template read<GraphPoses>(event.address);
        place_all();
      } catch (const DoesNotExistOnWM&) {
        this->debug("the poses were deleted before they were read");
      }
    };
    this->on_change(added<GraphPoses>().in(where), correct);
    this->on_change(overwritten<GraphPoses>().in(where), correct);
    // What there was before.
    for (auto& x : this->template read_all_in<GraphPoses>(where))
      graph_ = *x;
    for (auto& x : this->template read_all_in<Keyframe>(where))
      take(x);
    placed();
  }

  /// A keyframe is new, or its pose may have been corrected.
  virtual void place(const EntryOf<Keyframe>& keyframe, const Pose2& robot) = 0;
  virtual void remove(const std::string& keyframe) = 0;
  /// Everything that came at once was told.
  virtual void placed() = 0;

private:
  void take(const EntryOf<Keyframe>& keyframe) {
    known_.insert_or_assign(keyframe.address.id, keyframe);
    place(keyframe, pose_in_map(*keyframe, graph_));
  }

  void place_all() {
    for (auto& [id, x] : known_)
      place(x, pose_in_map(*x, graph_));
    placed();
  }

  Option<SubarchitectureName> keyframes_{this, "keyframes", "",
                                         "subarchitecture of the keyframes; empty: its own"};
  std::map<std::string, EntryOf<Keyframe>> known_;
  std::optional<GraphPoses> graph_;
};

} // namespace castor::mapping
