#pragma once

#include "castor/actors/component/option.hpp"
#include "castor/actors/component/subarchitecture_component.hpp"
#include "castor/mapping/map_components/keyframe_backlog.hpp"
#include "castor/mapping/slam/types.hpp"
#include "castor/wm/entries/failure.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace castor::mapping {

/// A component derived from `Base` that is told of keyframes, and of each correction of their
/// poses. Many at once are told in steps, between which it answers calls and is told of events.
template <class Base>
class FollowsKeyframes : public Base {
protected:
  /// Keyframes are in the component's own subarchitecture, or in the one that --keyframes names. To
  /// be called in `start()`: begins to tell of all that there are.
  void follow_keyframes() {
    auto where = keyframes_->empty() ? this->subarchitecture() : std::string{keyframes_.get()};
    this->on_change(added<Keyframe>().in(where), [this](const ChangeEvent& event) {
      try {
        backlog_.add(this->template read<Keyframe>(event.address));
        advance();
      } catch (const DoesNotExistOnWM&) {
        this->debug("{} was deleted before it was read", event.address.id);
      }
    });
    this->on_change(deleted<Keyframe>().in(where), [this](const ChangeEvent& event) {
      if (backlog_.remove(event.address.id))
        remove(event.address.id);
      advance();
    });
    auto correct = [this](const ChangeEvent& event) {
      try {
        backlog_.correct(this->template read<GraphPoses>(event.address).object);
        advance();
      } catch (const DoesNotExistOnWM&) {
        this->debug("the poses were deleted before they were read");
      }
    };
    this->on_change(added<GraphPoses>().in(where), correct);
    this->on_change(overwritten<GraphPoses>().in(where), correct);
    // What there was before.
    for (auto& x : this->template read_all_in<GraphPoses>(where))
      backlog_.correct(x.object);
    for (auto& x : this->template read_all_in<Keyframe>(where))
      backlog_.add(x);
    newest_at_start_ = backlog_.newest();
    advance();
  }

  /// Whether there was that keyframe when it began to follow them.
  bool was_there(const Keyframe& keyframe) const { return keyframe.number <= newest_at_start_; }

  /// A keyframe is new, or its pose was corrected. By increasing numbers, until all are placed().
  virtual void place(const EntryOf<Keyframe>& keyframe, const Pose2& robot) = 0;
  virtual void remove(const std::string& keyframe) = 0;
  /// Everything that there was to tell was told: what follows from it may be published. In between,
  /// some keyframes are where they were before a correction, or missing after a restart.
  virtual void placed() = 0;

  /// Whether it is in the midst of what is told in several steps.
  bool is_behind() const { return timer_.has_value() || !has_placed_; }

  /// Tells the rest at once, as in `stop()`.
  void catch_up() {
    while (timer_)
      tell(std::chrono::steady_clock::duration::max());
  }

private:
  using Duration = std::chrono::steady_clock::duration;

  /// What is little is told at once.
  void advance() {
    if (timer_)
      return;
    tell(slice_.get());
  }

  /// A step: one keyframe at least, and more as long as the time lasts.
  void tell(Duration time) {
    const auto begin = std::chrono::steady_clock::now();
    auto used = Duration::zero();
    for (auto x = backlog_.take(); x; x = used < time ? backlog_.take() : std::nullopt) {
      place(x->keyframe, x->robot);
      ++told_;
      used = std::chrono::steady_clock::now() - begin;
    }
    ++steps_;
    longest_ = std::max(longest_, used);
    if (!backlog_.has_next())
      complete();
    if (backlog_.has_next() && !timer_)
      timer_ = this->every(std::chrono::milliseconds{1}, [this] { tell(slice_.get()); });
    else if (!backlog_.has_next() && timer_) {
      this->remove_timer(*timer_);
      timer_.reset();
    }
  }

  /// The end of a pass.
  void complete() {
    placed();
    has_placed_ = true;
    if (steps_ > 1)
      this->debug("{} keyframes in {} steps of {:.0f} ms at most", told_, steps_,
                  std::chrono::duration<double, std::milli>(longest_).count());
    told_ = steps_ = 0;
    longest_ = {};
    backlog_.begin_pass();
  }

  Option<SubarchitectureName> keyframes_{this, "keyframes", "",
                                         "subarchitecture of the keyframes; empty: its own"};
  Option<std::chrono::milliseconds> slice_{
    this, "slice", std::chrono::milliseconds{10},
    "time for keyframes between which calls and events are dealt with"};

  KeyframeBacklog backlog_;
  std::int64_t newest_at_start_ = -1;
  std::optional<TimerId> timer_;
  bool has_placed_ = false;
  /// Of this pass.
  std::size_t told_ = 0;
  std::size_t steps_ = 0;
  Duration longest_{};
};

} // namespace castor::mapping
